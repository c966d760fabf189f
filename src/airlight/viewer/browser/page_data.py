"""Data of a page: declared parameters, values, solver and picture."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.ephemeris.sun_formula import NUMBERED
from airlight.solver.moments.harmonics import moment_count
from airlight.viewer.browser.package import program, solution_package
from airlight.viewer.browser.page_solver import MOST, solver_data
from airlight.viewer.browser.tables_text import DIGITS, as_text, deflated, rounded
from airlight.viewer.parameters.amounts import amounts_of
from airlight.viewer.parameters.parameter import Parameter, Value
from airlight.viewer.parameters.sun_clock import OF_DATE
from airlight.viewer.parameters.view_parameters import VIEW_VALUES

#: Note of a page about the planet's parameters.
NOTE: Final = "The planet is as it was solved; the desktop viewer edits it: airlight view {name}"

#: Note of a page that solves edits of amounts and ground.
EDITED: Final = (
    "Amounts and the ground are edited here; the desktop viewer edits all: airlight view {name}"
)


def page_parameters(*, dated: bool = True) -> tuple[Parameter, ...]:
    """View parameters that a page can change: those that need no new solution.

    Parameters
    ----------
    dated : bool
        Whether a date determines the sun of the planet's ``body`` in the page.
    """
    return tuple(
        one for one in VIEW_VALUES if one.part != "planet" and (dated or one.path not in OF_DATE)
    )


def page_data(
    solution: Any,
    name: str,
    title: str,
    values: Mapping[str, Value],
    count: str,
    layers: tuple[str, ...] = (),
) -> dict[str, Any]:
    """Data of a page, as read by ``web/main.js``.

    Parameters
    ----------
    solution : MomentsSolution
        Solution at three or four wavelengths.
    name, title : str
        Name of the preset or file; title of the page.
    values : mapping
        View values by path.
    count : str
        Number of wavelengths, ``three`` or ``four``.
    layers : tuple of str
        Argument of ``program``.

    Returns
    -------
    dict
        JSON values.
    """
    numbers = picture_data(solution)
    solver = solver_data(solution)
    if solver["plan"]["tables"]["ratios"]["shape"][:3] == numbers["uniforms"]["table_columns"][1:]:
        solver["scalars"]["ratios"] = None  # the table is already in the picture
    planet = solution.planet
    edited = () if planet is None else amounts_of(planet, MOST)
    body = None if solution.planet is None else solution.planet.body
    parameters = page_parameters(dated=body in NUMBERED)
    return {
        "title": title,
        "planet": name,
        "body": body,
        "note": (EDITED if edited else NOTE).format(name=name),
        "parameters": [one.as_json() for one in (*edited, *parameters)],
        "values": {
            **{one.path: values[one.path] for one in parameters},
            **{one.path: one.present for one in edited},
        },
        "solution": f"{count} wavelengths, solved at the quality {solution.settings.as_text()}",
        "solver": solver,
        "picture": {**program_data((solution,), layers), **numbers},
    }


def program_data(solutions: Iterable[Any], layers: tuple[str, ...] = ()) -> dict[str, Any]:
    """Data for all solutions, see ``program``, with the shaders as text.

    Parameters
    ----------
    solutions : iterable of MomentsSolution
        Solutions of the planets; every pixel is marched if one has rings or is oblate.
    layers : tuple of str
        Argument of ``program``.
    """
    media = (one.medium for one in solutions)
    fixed = program(any(one.rings or one.flattening > 0.0 for one in media), layers)
    return {**fixed, "shaders": deflated(json.dumps(fixed["shaders"]))}


def picture_data(solution: Any) -> dict[str, Any]:
    """Data of a solution, see ``solution_package``, with the tables as text."""
    numbers, tables = solution_package(solution)
    return numbers | {
        "tables": {
            key: {"format": kind, "data": _table_text(key, table, numbers["uniforms"])}
            for key, (kind, table) in tables.items()
        }
    }


def _table_text(key: str, table: NDArray[np.float32], uniforms: Mapping[str, Any]) -> str:
    """Encode a table as text, with display precision, as differences along the radius."""
    constituents = int(uniforms["constituents"])
    if key == "scalars":  # only the columns may be rounded
        start, *shape = (int(n) for n in uniforms["table_columns"])
        columns = slice(start, start + int(np.prod(shape)) * 2)
        table = table.copy()
        table[columns] = rounded(table[columns], DIGITS)
        return as_text(table, 2 * constituents)
    if key == "fields":
        degree, suns = int(uniforms["degree"]), int(uniforms["sun_angles"])
        texels = suns * (1 + moment_count(degree))
        return as_text(rounded(table, DIGITS), 4 * texels)
    return as_text(rounded(table, DIGITS), 4 if key == "disc" else 4 * constituents)
