"""A planet as one HTML file that opens from disk: flight, sun, exposure, without a server."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError, ParameterError
from airlight.exports.whole_file import check_target, whole_file
from airlight.kernel.threads import Cancel, Progress
from airlight.paint.solve_planet import solve_planet
from airlight.planets import load_planet
from airlight.planets.picture_wavelengths import LIVE, picture_wavelengths
from airlight.viewer.browser.package import planet_tables, program
from airlight.viewer.browser.page_solver import amount_parameters, solver_data
from airlight.viewer.browser.page_text import page_text
from airlight.viewer.browser.tables_text import DIGITS, as_text, deflated, rounded
from airlight.viewer.parameters.parameter import Parameter, Value
from airlight.viewer.parameters.view_parameters import VIEW_VALUES
from airlight.viewer.session.session import Session

#: A page larger than this is refused. [byte]
LARGEST: Final = 3_000_000
#: What the page says about the planet's own parameters.
NOTE: Final = "The planet is as it was solved; the desktop viewer edits it: airlight view {name}"

#: The same where the page solves for itself.
EDITED: Final = (
    "Amounts and the ground are edited here; the desktop viewer edits all: airlight view {name}"
)


@dataclass(frozen=True)
class Page:
    """A page that was written.

    Attributes
    ----------
    path : Path
    size : int
        [byte]
    quality : str
        Of the solution: ``preview`` where that of the better one is too large for a page.
    """

    path: Path
    size: int
    quality: str


def page_parameters() -> tuple[Parameter, ...]:
    """The declared parameters that a page can change: all of the view that need no solution."""
    return tuple(one for one in VIEW_VALUES if one.part != "planet")


def page_data(
    solution: Any, name: str, title: str, values: Mapping[str, Value], count: str
) -> dict[str, Any]:
    """What a page carries, as ``web/main.js`` reads it.

    Parameters
    ----------
    solution : MomentsSolution
        Of three or four wavelengths.
    name, title : str
        Of the preset or file; of the page.
    values : mapping
        Of the view's parameters, by path.
    count : str
        ``three`` or ``four``: how many wavelengths were solved.
    """
    numbers, tables = planet_tables(solution)
    solver = solver_data(solution)
    edited = () if solver is None else amount_parameters(solution)
    parameters = page_parameters()
    fixed = program()
    return {
        "title": title,
        "planet": name,
        "note": (EDITED if edited else NOTE).format(name=name),
        "parameters": [one.as_json() for one in (*edited, *parameters)],
        "values": {
            **{one.path: values[one.path] for one in parameters},
            **{one.path: 1.0 for one in edited},
        },
        "solution": f"{count} wavelengths, solved at the quality {solution.settings.as_text()}",
        "solver": solver,
        "picture": {
            **fixed,
            "shaders": deflated(json.dumps(fixed["shaders"])),
            **numbers,
            "tables": {
                key: {"format": kind, "data": _table_text(key, table, numbers["uniforms"])}
                for key, (kind, table) in tables.items()
            },
        },
    }


def _table_text(key: str, table: NDArray[np.float32], uniforms: Mapping[str, Any]) -> str:
    """A table as text, with the digits that a display shows, next to its neighbour in radius."""
    constituents = int(uniforms["constituents"])
    if key == "scalars":  # of which the columns alone may be rounded
        start, *shape = (int(n) for n in uniforms["table_columns"])
        columns = slice(start, start + int(np.prod(shape)) * 2)
        table = table.copy()
        table[columns] = rounded(table[columns], DIGITS)
        return as_text(table, 2 * constituents)
    if key == "fields":
        degree, suns = int(uniforms["degree"]), int(uniforms["suns"])
        texels = suns * (1 + (degree + 1) * (degree + 2) // 2)
        return as_text(rounded(table, DIGITS), 4 * texels)
    return as_text(rounded(table, DIGITS), 4 * constituents)


def export_page(
    planet: str | Path,
    output: str | Path,
    *,
    changes: Mapping[str, Any] | None = None,
    view: Mapping[str, Value] | None = None,
    quality: str = "default",
    wavelengths: str = "four",
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Page:
    """Solve a planet and write its page.

    Parameters
    ----------
    planet : str or Path
        The name of a preset, or a planet file.
    output : str or Path
        The page; written whole or not at all.
    changes : mapping, optional
        Of the planet's file, by path, as ``load_planet`` takes them.
    view : mapping, optional
        Where the page begins: values of the view's parameters by path, in their units.
    quality : str
        ``preview``, ``default`` or ``fine``; where the page would be larger than 3 MB, ``preview``.
    wavelengths : str
        ``three`` or ``four``.
    cache : bool
        Whether solutions on disk are read and kept.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.

    Returns
    -------
    Page

    Raises
    ------
    ParameterError
        If the planet or a value of the view cannot be.
    FileError
        If the page cannot be written, or would be larger than 3 MB even at ``preview``.
    """
    check_target(output)
    session = Session(planet)
    for path, value in (view or {}).items():
        if path not in {one.path for one in page_parameters()}:
            known = ", ".join(one.path for one in page_parameters())
            raise ParameterError("view", path, known)
        session.set(path, value)
    world = load_planet(planet, dict(changes or {}), progress=progress)
    title = f"{world.name} – airlight"
    for level in dict.fromkeys((quality, "preview")):
        solution = solve_planet(
            world,
            picture_wavelengths(world, wavelengths, most=LIVE),
            level,
            cache=cache,
            progress=progress,
            cancel=cancel,
        )
        data = page_data(solution, str(planet), title, session.values, wavelengths)
        content = page_text(title, data).encode()
        if len(content) <= LARGEST:
            break
    if len(content) > LARGEST:
        size = f"{len(content) / 1e6:.1f} MB"
        reason = f"the page would have {size}, more than 3 MB, even at the quality preview"
        raise FileError(output, reason)
    with whole_file(output) as place:
        place.write_bytes(content)
    return Page(Path(output), len(content), level)
