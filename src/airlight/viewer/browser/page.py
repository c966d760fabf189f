"""Export of a planet, or of a scene of several bodies, as one HTML file without a server."""

from __future__ import annotations

import base64
import html
import io
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from string import Template
from typing import TYPE_CHECKING, Any, Final

from airlight.errors import FileError
from airlight.files.atomic_file import atomic_file, check_target
from airlight.image.display import to_display
from airlight.kernel.threads import Cancel, Progress
from airlight.viewer.browser.modules import join_modules, web_file
from airlight.viewer.browser.page_subject import page_subject
from airlight.viewer.parameters.parameter import Value
from airlight.viewer.parameters.view_parameters import settings_of

if TYPE_CHECKING:
    from airlight.scene.frame import Frame

#: Largest size of a page. [byte]
LARGEST: Final = 5_000_000
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
    """Solve a planet, or those of a scene, and write the page.

    Parameters
    ----------
    planet : str or Path
        Name of a preset, or path of a planet or scene file.
    output : str or Path
        Path of the page; written completely or not at all.
    changes : mapping, optional
        Overrides of the file by path, as for ``load_planet`` or ``load_system``.
    view : mapping, optional
        Initial view values by path; without any, those of the first viewpoint, or of the scene.
        [parameter.unit]
    quality : str
        ``preview``, ``default`` or ``fine``; replaced by ``preview`` if the page has more than 5 MB
        even without stars.
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
    ConflictError
        If only the CPU draws the scene.
    """
    check_target(output)
    report: dict[str, Any] = {"progress": progress, "cancel": cancel}
    subject = page_subject(planet, changes or {}, progress)
    values = subject.values(view or {})
    title = f"{subject.title} – airlight"
    attempts = ((quality, wavelengths), ("preview", wavelengths), ("preview", "three"))
    for level, count in dict.fromkeys(attempts):
        solutions = subject.solved(count, level, cache=cache, **report)
        data = subject.data(solutions, title, values, count, **report)
        length = len(page_text(title, data).encode()) + LEAST_PICTURE
        if length > LARGEST and data["picture"].pop("star_sky", None):
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
    first = first_picture(subject.frame(solutions, values, **report), values, left)
    content = page_text(title, data, first).encode()
    with atomic_file(output) as place:
        place.write_bytes(content)
    return Page(Path(output), len(content), level, count)


def first_picture(
    frame: Frame, values: Mapping[str, Value], largest: int = LARGEST_PICTURE
) -> dict[str, str]:
    """Embedded image of a view.

    Parameters
    ----------
    frame : Frame
        Frame of the view, a square.
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
