"""Export of a planet as one HTML file with flight, sun and exposure, without a server."""

from __future__ import annotations

import base64
import html
import io
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from string import Template
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError, ParameterError
from airlight.files.atomic_file import atomic_file, check_target
from airlight.geometry.ephemeris.sun_formula import NUMBERED
from airlight.image.display import to_display
from airlight.kernel.threads import Cancel, Progress
from airlight.planets import load_planet
from airlight.planets.picture_wavelengths import texel_wavelengths
from airlight.render import render
from airlight.render.solve_planet import solve_planet
from airlight.solver.moments.harmonics import moment_count
from airlight.viewer.browser.modules import join_modules, web_file
from airlight.viewer.browser.package import program, solution_package
from airlight.viewer.browser.page_solver import MOST, solver_data
from airlight.viewer.browser.tables_text import DIGITS, as_text, deflated, rounded
from airlight.viewer.navigation.viewpoints import view_in
from airlight.viewer.parameters.amounts import amounts_of
from airlight.viewer.parameters.parameter import Parameter, Value
from airlight.viewer.parameters.sun_clock import OF_DATE
from airlight.viewer.parameters.view_parameters import VIEW_VALUES, scene_of, settings_of
from airlight.viewer.session.session import Session

#: Largest size of a page. [byte]
LARGEST: Final = 5_000_000
#: Size of the picture, of which a browser shows the part that its window has: a square holds what a
#: window of any shape, wider than high, sees. [pixel]
SIDE: Final = 840
#: Largest size of the file, and size that a page must leave for it. [byte]
LARGEST_PICTURE: Final = 60_000
LEAST_PICTURE: Final = 25_000
#: Content security policy: nothing may be loaded, only inline script and style are allowed.
_POLICY: Final = (
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src blob: data:"
)

#: Picture and words that stand before the script and the data, which a browser reads later.
_FIRST: Final = Template(
    '<img class="airlight-first" src="$address" alt="" style="object-fit: $fit">'
    '<div class="airlight-over airlight-progress">preview — loading</div>'
)
#: Note of a page about the planet's parameters.
NOTE: Final = "The planet is as it was solved; the desktop viewer edits it: airlight view {name}"

#: Note of a page that solves edits of amounts and ground.
EDITED: Final = (
    "Amounts and the ground are edited here; the desktop viewer edits all: airlight view {name}"
)


@dataclass(frozen=True)
class Page:
    """Written page.

    Attributes
    ----------
    path : Path
        Path of the file.
    size : int
        Size of the file. [byte]
    quality : str
        Quality of the solution; ``preview`` if the requested quality is too large for a page.
    wavelengths : str
        ``three`` or ``four``; ``three`` if four are too large for a page.
    """

    path: Path
    size: int
    quality: str
    wavelengths: str


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
    solution: Any, name: str, title: str, values: Mapping[str, Value], count: str
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

    Returns
    -------
    dict
        JSON values.
    """
    numbers, tables = solution_package(solution)
    solver = solver_data(solution)
    if solver["plan"]["tables"]["ratios"]["shape"][:3] == numbers["uniforms"]["table_columns"][1:]:
        solver["scalars"]["ratios"] = None  # the table is already in the picture
    planet = solution.planet
    edited = () if planet is None else amounts_of(planet, MOST)
    body = None if solution.planet is None else solution.planet.body
    parameters = page_parameters(dated=body in NUMBERED)
    medium = solution.medium
    fixed = program(bool(medium.rings) or medium.flattening > 0.0)
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
        Name of a preset, or path of a planet file.
    output : str or Path
        Path of the page; written completely or not at all.
    changes : mapping, optional
        Overrides of the planet's file by path, as for ``load_planet``.
    view : mapping, optional
        Initial view values by path; without any, those of the first viewpoint. [parameter.unit]
    quality : str
        ``preview``, ``default`` or ``fine``; replaced by ``preview`` above 5 MB.
    wavelengths : str
        Number of wavelengths, ``three`` or ``four``; replaced by ``three`` if the page has more
        than 5 MB at ``preview``.
    cache : bool
        Whether solutions are cached on disk.

    Raises
    ------
    FileError
        If the page cannot be written, or would be larger than 5 MB even at ``preview`` with three
        wavelengths.
    """
    check_target(output)
    session = Session(planet)
    if not any(path.startswith("view.") for path in view or {}):
        session.move(view_in(session))
    world = load_planet(planet, dict(changes or {}), progress=progress)
    known = [one.path for one in page_parameters(dated=world.body in NUMBERED)]
    for path, value in (view or {}).items():
        if path not in known:
            raise ParameterError("view", path, ", ".join(known))
        session.set(path, value)
    title = f"{world.name} – airlight"
    attempts = ((quality, wavelengths), ("preview", wavelengths), ("preview", "three"))
    for level, count in dict.fromkeys(attempts):
        solution = solve_planet(
            world,
            texel_wavelengths(world, count),
            level,
            cache=cache,
            progress=progress,
            cancel=cancel,
        )
        data = page_data(solution, str(planet), title, session.values, count)
        length = len(page_text(title, data).encode()) + LEAST_PICTURE
        if length <= LARGEST:
            break
    if length > LARGEST:
        size = f"{length / 1e6:.1f} MB"
        most = f"{LARGEST / 1e6:g} MB"
        least = "at the quality preview with three wavelengths"
        reason = f"the page would have {size}, more than {most}, even {least}"
        raise FileError(output, reason)
    left = min(LARGEST_PICTURE, LARGEST - length + LEAST_PICTURE)
    first = first_picture(solution, session.values, left, progress=progress, cancel=cancel)
    content = page_text(title, data, first).encode()
    with atomic_file(output) as place:
        place.write_bytes(content)
    return Page(Path(output), len(content), level, count)


def first_picture(
    solution: Any,
    values: Mapping[str, Value],
    largest: int = LARGEST_PICTURE,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> dict[str, str]:
    """Embedded image of a view.

    Parameters
    ----------
    solution : MomentsSolution
        Solution embedded in the page.
    values : mapping
        View values by path.
    largest : int
        Largest size. [byte]

    Returns
    -------
    dict
        ``address``: WebP as a ``data:`` URI; ``fit``: how it fills the window, in CSS: ``cover`` in
        perspective, ``contain`` for projections with a fixed aspect ratio.
    """
    scene = scene_of(values, SIDE, SIDE)
    frame = render(
        solution, scene, orders=str(values["light.orders"]), progress=progress, cancel=cancel
    )
    exposure = float(values["display.exposure"])
    if values["display.automatic"]:
        exposure += frame.exposure
    pixels = to_display(frame.rgb, exposure, settings=settings_of(values), **frame.lens)
    perspective = values["view.projection"] == "perspective"
    return {
        "address": "data:image/webp;base64," + base64.b64encode(_webp(pixels, largest)).decode(),
        "fit": "cover" if perspective else "contain",
    }


def _webp(pixels: Any, largest: int) -> bytes:
    """WebP in the best quality within the size limit."""
    from PIL import Image

    picture, content = Image.fromarray(pixels), b""
    for quality in (96, 90, 80, 60, 30, 10):
        file = io.BytesIO()
        picture.save(file, "WEBP", quality=quality, method=4)
        content = file.getvalue()
        if 4 * len(content) // 3 <= largest:
            break
    return content


def page_text(title: str, data: Mapping[str, Any], first: Mapping[str, str] | None = None) -> str:
    """Text of a page.

    Parameters
    ----------
    title : str
        Title of the page.
    data : mapping
        Data for ``web/main.js``, as JSON values.
    first : mapping, optional
        Image that is shown immediately, see ``first_picture``.

    Returns
    -------
    str
        Text in HTML.
    """
    # Within a script element "</" could end it, and "<!--" could start a comment.
    carried = json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    script = join_modules("main.js")
    if "</script" in script.lower() or "<!--" in script:
        raise AssertionError("the viewer's script contains the end of a script element")
    return Template(web_file("page.html")).substitute(
        title=html.escape(title),
        policy=_POLICY,
        style=web_file("style.css"),
        first="" if first is None else _FIRST.substitute(first),
        data=carried,
        script=script,
    )
