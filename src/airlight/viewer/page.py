"""A planet as one HTML file that opens from disk: flight, sun, exposure, without a server."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from airlight.errors import FileError, ParameterError
from airlight.exports.whole_file import check_target, whole_file
from airlight.kernel.threads import Cancel, Progress
from airlight.planets import load_planet
from airlight.solvers import solve
from airlight.viewer.package import planet_tables, program
from airlight.viewer.page_text import page_text
from airlight.viewer.parameter import Parameter, Value
from airlight.viewer.session import Session
from airlight.viewer.solving import evenly_spaced
from airlight.viewer.tables_text import as_text
from airlight.viewer.view_parameters import view_parameters
from airlight.viewer.wanted import SOLVED

#: A page larger than this is refused. [byte]
LARGEST: Final = 3_000_000
#: What the page says about the planet's own parameters.
NOTE: Final = "The planet is as it was solved; the desktop viewer edits it: airlight view {name}"


@dataclass(frozen=True)
class Page:
    """A page that was written.

    Attributes
    ----------
    path : Path
    size : int
        [byte]
    """

    path: Path
    size: int


def page_parameters() -> tuple[Parameter, ...]:
    """The declared parameters that a page can change: all of the view that need no solution."""
    return tuple(one for one in view_parameters() if one.path not in SOLVED)


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
    parameters = page_parameters()
    return {
        "title": title,
        "planet": name,
        "note": NOTE.format(name=name),
        "parameters": [one.as_json() for one in parameters],
        "values": {one.path: values[one.path] for one in parameters},
        "solution": f"{count} wavelengths, solved at the quality {solution.settings.as_text()}",
        "picture": {
            **program(),
            **numbers,
            "tables": {
                key: {"format": kind, "data": as_text(table)}
                for key, (kind, table) in tables.items()
            },
        },
    }


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
        ``preview``, ``default`` or ``fine``.
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
        If the page cannot be written, or would be larger than 3 MB.
    """
    check_target(output)
    session = Session(planet)
    for path, value in (view or {}).items():
        if path not in {one.path for one in page_parameters()}:
            known = ", ".join(one.path for one in page_parameters())
            raise ParameterError("view", path, known)
        session.set(path, value)
    world = load_planet(planet, dict(changes or {}), progress=progress)
    solution = solve(
        world,
        wavelengths=tuple(evenly_spaced(world, wavelengths)),
        quality=quality,
        cache=cache,
        progress=progress,
        cancel=cancel,
    )
    title = f"{world.name} – airlight"
    data = page_data(solution, str(planet), title, session.values, wavelengths)
    content = page_text(title, data).encode()
    if len(content) > LARGEST:
        size = f"{len(content) / 1e6:.1f} MB"
        reason = f"the page would have {size}, more than 3 MB: lower the quality"
        raise FileError(output, reason)
    with whole_file(output) as place:
        place.write_bytes(content)
    return Page(Path(output), len(content))
