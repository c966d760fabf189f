"""Photograph of a sky: colours of some directions, by a camera of known projection."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError, ParameterError, warn
from airlight.files.input_files import LARGEST_PICTURE, check_input
from airlight.image.header import PREFIX
from airlight.kernel.memory import check_picture
from airlight.scene.camera import Camera
from airlight.scene.limits import HIGHEST_ALTITUDE, within
from airlight.studies.fit.measurements import angle_from_sun

FloatArray = NDArray[np.float64]

#: Cells along the longer side of the picture; each gives one colour.
CELLS: Final = 28
#: Width of the central part of a cell over which the colour is averaged, relative to the cell. [1]
_MIDDLE: Final = 0.5
#: Encoded values that count as too dark or too bright to be linear, of 8 or 16 bits. [1]
_DARK, _BRIGHT = 0.04, 0.97
#: Lower limit of the other channels' uncertainty, relative to the largest channel. [1]
_LEAST_SHARE: Final = 0.2
#: Parts of a side by which colours are grouped: errors of neighbours are correlated.
_PARTS: Final = 4
#: Smallest number of directions of a photograph.
FEWEST: Final = 12


@dataclass(frozen=True, kw_only=True, eq=False)
class Photograph:
    """Colours of a sky in nd directions, in an unknown unit.

    Attributes
    ----------
    source : str
        Source file.
    rgb : array, shape (nd, 3)
        Linear sRGB.
    view_zenith, azimuth : array, shape (nd,)
        Zenith angle; azimuth from the sun's side. [deg]
    sun_zenith : float
        [deg]
    altitude : float
        [m]
    place : array, shape (nd, 2)
        Row and column of the centre of each cell in the picture. [pixel]
    part : array of int, shape (nd,)
        Part of the picture, from 0.
    shape : (int, int)
        Rows and columns of the picture. [pixel]
    """

    source: str
    rgb: FloatArray
    view_zenith: FloatArray
    azimuth: FloatArray
    sun_zenith: float
    altitude: float
    place: FloatArray
    part: NDArray[np.int64]
    shape: tuple[int, int]

    @property
    def sizes(self) -> FloatArray:
        """Denominators of relative errors: channels, at least a fifth of the largest, (nd, 3)."""
        largest = np.abs(self.rgb).max(axis=1, keepdims=True)
        return np.asarray(np.maximum(np.abs(self.rgb), _LEAST_SHARE * largest))

    @property
    def angle_from_sun(self) -> FloatArray:
        """Angle between view and sun, shape (nd,). [deg]"""
        return angle_from_sun(self.view_zenith, np.asarray(self.sun_zenith), self.azimuth)


@dataclass(frozen=True, kw_only=True)
class Shot:
    """Camera, sun and selection of directions of a photograph.

    Attributes
    ----------
    projection : str
        ``fisheye`` or ``perspective``, or another of ``airlight.scene``.
    field_of_view : float, optional
        See ``Camera``. [deg]
    look_zenith : float, optional
        [deg]
    look_azimuth : float
        From the sun's side. [deg]
    roll : float
        [deg]
    sun_zenith : float
        [deg]
    altitude : float
        Altitude of the camera above the planet's ground. [m]
    encoding : str
        Encoding of a PNG or JPEG: ``srgb``, ``gamma`` or ``linear``; EXR is linear.
    tone_map : str, optional
        Tone map to invert, from ``airlight.image.tone_maps.TONE_MAPS``; default: that of the
        metadata of an airlight PNG, otherwise none. Other display settings in the metadata are
        inverted with it.
    above : float
        Smallest elevation of used directions. [deg]
    exclude_sun : float
        Smallest angle from the sun of used directions, because of glare. [deg]
    """

    projection: str = "fisheye"
    field_of_view: float | None = None
    look_zenith: float | None = None
    look_azimuth: float = 0.0
    roll: float = 0.0
    sun_zenith: float
    altitude: float = 0.0
    encoding: str = "srgb"
    tone_map: str | None = None
    above: float = 5.0
    exclude_sun: float = 15.0

    def __post_init__(self) -> None:
        for name, low, high, unit in (
            ("sun_zenith", 0.0, 180.0, "deg"),
            ("altitude", 0.0, HIGHEST_ALTITUDE, "m"),
            ("above", -90.0, 90.0, "deg"),
            ("exclude_sun", 0.0, 180.0, "deg"),
        ):
            object.__setattr__(self, name, within(name, getattr(self, name), low, high, unit))


def read_photograph(path: str | Path, shot: Shot) -> Photograph:
    """Read the colours of a photograph.

    The colour of a cell of the picture is the mean of its central part. Cells with a pixel that is
    too dark, too bright, near the sun or not sky are omitted.

    Parameters
    ----------
    path : str or Path
        PNG of 8 or 16 bits, JPEG, or EXR with linear sRGB.
    shot : Shot
        Camera, sun, and selection of directions.
    """
    linear, sound = _pixels(Path(path), shot)
    height, width = linear.shape[:2]
    names = ("projection", "field_of_view", "look_zenith", "look_azimuth", "roll")
    given: dict[str, Any] = {name: getattr(shot, name) for name in names}
    seen = Camera(width=width, height=height, **given).directions()
    side = max(max(height, width) // CELLS, 1)
    half = max(int(0.5 * _MIDDLE * side), 0)
    found: list[tuple[FloatArray, FloatArray, tuple[int, int]]] = []
    for row in range(side // 2, height, side):
        for column in range(side // 2, width, side):
            box = (
                slice(max(row - half, 0), row + half + 1),
                slice(max(column - half, 0), column + half + 1),
            )
            if seen[row, column].any() and sound[box].all() and seen[box].any(axis=-1).all():
                mean = seen[box].mean(axis=(0, 1))
                mean /= np.linalg.norm(mean)
                found.append((linear[box].mean(axis=(0, 1)), mean, (row, column)))
    if not found:
        raise FileError(path, "has no sky pixels of usable brightness")
    rgb, vectors = np.array([one[0] for one in found]), np.array([one[1] for one in found])
    place = np.array([one[2] for one in found], dtype=np.float64)
    zenith = np.degrees(np.arccos(np.clip(vectors[:, 2], -1.0, 1.0)))
    azimuth = np.degrees(np.arctan2(-vectors[:, 1], vectors[:, 0]))
    away = angle_from_sun(zenith, np.asarray(shot.sun_zenith), azimuth)
    kept = (zenith <= 90.0 - shot.above) & (away >= shot.exclude_sun)
    if kept.sum() < FEWEST:
        words = f"shows {int(kept.sum())} usable directions of sky; at least {FEWEST} are needed"
        raise FileError(path, words)
    parts = (place * _PARTS / np.array([height, width])).astype(np.int64)
    part = np.unique((parts[:, 0] * _PARTS + parts[:, 1])[kept], return_inverse=True)[1]
    return Photograph(
        source=str(path),
        rgb=rgb[kept],
        view_zenith=zenith[kept],
        azimuth=azimuth[kept],
        sun_zenith=shot.sun_zenith,
        altitude=shot.altitude,
        place=place[kept],
        part=np.asarray(part, dtype=np.int64).reshape(-1),
        shape=(height, width),
    )


def _pixels(path: Path, shot: Shot) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Linear colours, shape (h, w, 3), and which pixels are neither too dark nor too bright."""
    check_input(path, LARGEST_PICTURE)
    if path.suffix.lower() == ".exr":
        from airlight.image.exr import read_exr

        rgb, _ = read_exr(path)
        linear = rgb.astype(np.float64)
        finite = np.isfinite(linear).all(axis=-1)
        if not finite.all():
            count = np.count_nonzero(~finite)
            warn(f"{path}: {count} pixels are not finite and are excluded")
        return linear, finite & (linear.max(axis=-1) > 0.0)
    from airlight.image.display import decoded_light, exposed_light
    from airlight.image.display_settings import LINEAR, DisplaySettings
    from airlight.image.encoding import ENCODINGS

    encoded, texts = _encoded(path)
    own = {k.removeprefix(PREFIX): v for k, v in texts.items() if k.startswith(PREFIX)}
    encoding = own.get("encoding", shot.encoding)
    if encoding not in (*ENCODINGS, LINEAR):
        raise ParameterError("encoding", encoding, ", ".join((*ENCODINGS, LINEAR)))
    mapped = own | ({} if shot.tone_map is None else {"tone_map": shot.tone_map})
    settings = DisplaySettings.from_metadata({**mapped, "encoding": encoding})
    shown = "tone_map" in mapped
    long, medium, short = map(float, own.get("white_gains", "1 1 1").split())
    light = decoded_light(encoded, settings)
    if shown:
        light = exposed_light(encoded, settings, (long, medium, short))
    sound = (encoded.max(axis=-1) < _BRIGHT) & (encoded.min(axis=-1) > _DARK)
    return np.asarray(light, dtype=np.float64), sound


def _encoded(path: Path) -> tuple[FloatArray, dict[str, str]]:
    """Encoded red, green, blue, 0 to 1, and the metadata of the file."""
    from PIL import Image, UnidentifiedImageError

    try:
        with warnings.catch_warnings():  # Pillow warns of large pictures when it opens them
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            opened = Image.open(path)
        with opened as image:
            check_picture(path, *image.size)
            image.load()
            texts = {str(k): str(v) for k, v in image.info.items() if isinstance(v, str)}
            sixteen = _sixteen_bits(path) if image.format == "PNG" else None
            pixels = np.asarray(image.convert("RGB"), dtype=np.float64) / 255.0
    except (OSError, ValueError, UnidentifiedImageError, Image.DecompressionBombError) as error:
        raise FileError(path, f"cannot be read as a picture: {error}") from None
    return (pixels if sixteen is None else sixteen), texts


def _sixteen_bits(path: Path) -> FloatArray | None:
    """Pixels of a 16-bit PNG, which Pillow truncates to 8 bits; None for 8 bits."""
    import png

    try:
        width, height, rows, info = png.Reader(bytes=path.read_bytes()).asRGB()
    except png.Error:
        return None
    facts: dict[str, Any] = info
    if facts["bitdepth"] != 16:
        return None
    table = np.array([np.asarray(row) for row in rows], dtype=np.float64)
    return table.reshape(height, width, 3) / 65535.0
