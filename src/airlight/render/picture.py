"""Pictures as files in the format of their suffix."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError
from airlight.files.atomic_file import check_target
from airlight.image.exr import read_exr_header, write_exr
from airlight.image.hdr import read_hdr_header, write_hdr
from airlight.image.png import read_png_header, write_png
from airlight.physics.units import Measure, quantity, without_unit

if TYPE_CHECKING:
    from airlight.image.display_settings import DisplaySettings
    from airlight.scene.frame import Frame

#: Suffixes of the formats that can be written.
SUFFIXES = (".png", ".exr", ".hdr")
#: Suffixes of linear light, which has no display.
LINEAR: Final = (".exr", ".hdr")
#: Text of an EXR with Q and U.
STOKES_FRAME: Final = (
    "I in R, G, B; Q and U in the layers Q and U, in the same unit; Q > 0 along the plane of the "
    "line of sight and the observer's zenith, U > 0 at 45 deg from it, counterclockwise as the "
    "observer looks"
)


@dataclass(frozen=True, kw_only=True)
class Written:
    """Written picture.

    Parameters
    ----------
    size : int
        Size of the file. [byte]
    exposure : float or None
        Exposure used, or None for a linear file. [EV]
    """

    path: Path
    size: int
    exposure: float | None


def picture_suffix(path: str | Path) -> str:
    """Suffix of a picture to be written; an error if it cannot be.

    Parameters
    ----------
    path : str or Path
        Path of the file.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in SUFFIXES:
        raise FileError(path, f"the name of a picture ends in {', '.join(SUFFIXES)}")
    check_target(path)
    return suffix


def write_picture(
    path: str | Path,
    picture: Frame | NDArray[np.float32],
    metadata: Mapping[str, str] | None = None,
    *,
    exposure: float | str = "auto",
    settings: DisplaySettings | None = None,
    pixel_angle: Measure = 0.0,
    layers: Mapping[str, NDArray[np.float32]] | None = None,
    crop: tuple[int, int, int, int] | None = None,
    **changes: Any,
) -> Written:
    """Write a frame's colours as PNG (exposed, tone mapped, encoded), or linear as EXR or HDR.

    An EXR has Q and U of the frame as layers ``Q.R`` to ``U.B``. For the limits of HDR see
    ``write_hdr``.

    Parameters
    ----------
    path : str or Path
        Path ending in ``.png``, ``.exr`` or ``.hdr``.
    picture : Frame or array, shape (h, w, 3)
        Frame, or linear sRGB radiance, weighted by the colour-matching functions, float32. [W m⁻²
        sr⁻¹]
    metadata : mapping of str to str, optional
        Further metadata for the file.
    exposure : float or "auto"
        Exponent of two that multiplies the colours; ``auto``: see ``Frame.exposure`` and, for an
        array, ``airlight.image.exposure.automatic_exposure``. Only for PNG. [EV]
    settings : DisplaySettings, optional
        Tone map, mesopic vision, encoding, primaries, bits, dither and glare. Only for PNG.
    pixel_angle : float
        Angle of a pixel of an array; without it there is no glare. [rad]
    layers : mapping of str to array, optional
        Further channels of an EXR, as for ``airlight.image.exr.write_exr``.
    crop : (int, int, int, int), optional
        Written window: left and top edge, width and height. Exposure and glare are those of the
        whole picture. Only for PNG. [pixel]
    **changes :
        Single fields of ``settings``: ``tone_map="agx"``, ``bits=16``.

    Returns
    -------
    Written
        Path, size, and the exposure used.

    Raises
    ------
    ParameterError
        For an exposure or a setting that is not allowed.
    FileError
        If the file cannot be written; an existing file is then unchanged.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     grey = np.full((2, 4, 3), 0.2, np.float32)
    ...     written = write_picture(f"{folder}/grey.png", grey, exposure=1.0)
    >>> written.path.name, written.exposure
    ('grey.png', 1.0)
    """
    suffix = picture_suffix(path)
    from airlight.image.display_settings import display_settings
    from airlight.scene.frame import Frame

    chosen = display_settings(settings, **changes).adapted(exposure)

    if isinstance(picture, Frame):
        frame = picture
    else:
        angle = quantity(pixel_angle, "rad", "pixel_angle", bare=True)
        frame = Frame(rgb=without_unit(picture, "picture"), pixel_angle=angle)
    rgb = frame.rgb
    metadata = {**frame.metadata, **(metadata or {})}
    used: float | None = None
    if suffix == ".exr":
        if frame.polarised is not None:
            layers = {"Q": frame.polarised[0], "U": frame.polarised[1], **(layers or {})}
            metadata = {**metadata, "stokes": STOKES_FRAME}
        write_exr(path, rgb, metadata, layers=layers)
    elif suffix == ".hdr":
        write_hdr(path, rgb, metadata)
    else:
        from airlight.image.display import display_of, resolve_exposure, to_display

        used = frame.exposure if exposure == "auto" else resolve_exposure(rgb, exposure)
        pixels = to_display(rgb, used, settings=chosen, **frame.lens)
        if crop is not None:
            left, top, width, height = crop
            metadata["crop"] = ",".join(map(str, crop))
            pixels = np.ascontiguousarray(pixels[top : top + height, left : left + width])
        white = display_of(rgb, used, chosen, frame.star_white)[-3:]
        metadata["white_gains"] = " ".join(f"{gain:.8g}" for gain in white)
        texts = {**metadata, "exposure": f"{used:.10g} EV", **chosen.metadata()}
        if frame.pixel_angle == 0.0:
            del texts["glare"]
        write_png(path, pixels, texts, encoding=str(chosen.encoding), primaries=chosen.primaries)
    return Written(path=Path(path), size=Path(path).stat().st_size, exposure=used)


def read_picture_metadata(path: str | Path) -> dict[str, str]:
    """Metadata of a complete picture file.

    Parameters
    ----------
    path : str or Path
        Path of a PNG, EXR or HDR file.

    Returns
    -------
    dict of str to str
        Texts by name, with the prefix ``airlight.``.
    """
    try:
        if Path(path).suffix.lower() == ".exr":
            return read_exr_header(path)
        if Path(path).suffix.lower() == ".hdr":
            return read_hdr_header(path)
        return read_png_header(path)
    except (OSError, ValueError, SyntaxError) as error:
        raise FileError(path, f"cannot be read as a picture: {error}") from error
