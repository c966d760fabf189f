"""Files of an environment map: image, JSON sidecar, and scene file where supported."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.environment.gamut import grey_of
from airlight.engines.environment.mitsuba_scene import mitsuba_scene
from airlight.engines.environment.sidecar import FORMAT, as_json, described, standard_attributes
from airlight.engines.environment.texels import reaching_poles
from airlight.engines.environment.usd_scene import usd_scene
from airlight.errors import FileError, ParameterError
from airlight.files.atomic_file import atomic_file, check_target
from airlight.files.manifest import check_replaceable, fingerprint_of, own_files, sealed
from airlight.image.exr import LARGEST_HALF, write_exr
from airlight.image.hdr import write_hdr
from airlight.plain_text import is_plain
from airlight.render.picture import LINEAR, picture_suffix, write_picture

if TYPE_CHECKING:
    from airlight.engines.environment.consumers import Consumer
    from airlight.engines.environment.environment_map import EnvironmentMap

#: Scene of a program: suffix and writing function.
SCENES: Final[dict[str, tuple[str, Callable[[EnvironmentMap, str, float], str]]]] = {
    "usd": (".usda", usd_scene),
    "mitsuba": (".xml", mitsuba_scene),
}
#: Texts about a scene's place.
_PLACE: Final = ("latitude", "longitude")
#: Luminance below which halves begin to lose digits, with a margin of four bits over the smallest
#: normal one, 2⁻¹⁴.
_DIM: Final = 2.0**-10
#: Share of the lit texels that may be dimmer than that.
_DIM_SHARE: Final = 0.05
#: Exponent of the largest scale: a night darker than starlight may lose its digits.
_HIGHEST: Final = 24
#: Number of texels by which that share is judged.
_SAMPLED: Final = 1 << 20


@dataclass(frozen=True, kw_only=True)
class WrittenMap:
    """Files that were written.

    Attributes
    ----------
    path : Path
        Map.
    beside : tuple of Path
        JSON sidecar, and scene file if any.
    scale : float
        Ratio of the map's values to radiances. [1]
    exposure : float or None
        Exposure of a PNG. [EV]
    """

    path: Path
    beside: tuple[Path, ...]
    scale: float
    exposure: float | None


def check_beside(
    path: Path, consumer: Consumer, *, overwrite: bool = False
) -> tuple[tuple[Path, ...], tuple[Path, ...]]:
    """Paths of the accompanying files of a map, checked to be writable.

    Parameters
    ----------
    consumer : Consumer
        Target program.
    overwrite : bool
        Whether to replace accompanying files that airlight did not write or that were modified; the
        map is always replaced.

    Returns
    -------
    (tuple of Path, tuple of Path)
        JSON and scene files; and scene files of an existing JSON, which are removed.
    """
    suffix = picture_suffix(path)
    if not is_plain(path.name):
        raise FileError(path, "contains control characters")
    suffixes = [".json"]
    if consumer.name in SCENES and suffix in LINEAR:
        suffixes.append(SCENES[consumer.name][0])
    others = tuple(path.with_suffix(one) for one in suffixes)
    for one in (path, *others):
        check_target(one)
    manifest = others[0]
    own = own_files(manifest, FORMAT, overwrite=overwrite)
    names = [one.name for one in others]
    check_replaceable(path.parent, names, (manifest.name, *own), overwrite=overwrite)
    scenes = {path.with_suffix(suffix).name for suffix, _ in SCENES.values()}
    return others, tuple(path.parent / name for name in own if name in scenes)


def write_map(
    path: Path,
    made: EnvironmentMap,
    *,
    precision: str = "float",
    compression: str = "zip",
    scale: float | None = None,
    metadata: Mapping[str, str] | None = None,
    display: Mapping[str, Any] | None = None,
    overwrite: bool = False,
) -> WrittenMap:
    """Write a map with its accompanying files.

    Parameters
    ----------
    path : Path
        Path ending in ``.exr`` or ``.hdr``, or ``.png`` for a preview.
    precision, compression : str
        Names for ``write_exr``.
    scale : float, optional
        Factor of linear values, above 0. Default: 1, or for half floats, in the file or in the
        target program, a power of two from ``half_scale``. [1]
    metadata : mapping of str to str, optional
        Additional metadata.
    display : mapping, optional
        Arguments of ``write_picture`` for a PNG.
    overwrite : bool
        As for ``check_beside``.
    """
    others, stale = check_beside(path, made.consumer, overwrite=overwrite)
    facts = {"planet": made.planet, **(metadata or {}), **_facts(made)}
    if not made.placed:  # a scene without a place on the globe has no coordinates
        facts = {name: text for name, text in facts.items() if name not in _PLACE}
    suffix = path.suffix.lower()
    halves = precision == "half" or compression == "dwa" or made.consumer.keeps_halves
    factor, exposure = 1.0, None
    if suffix in LINEAR:
        factor = scale if scale is not None else half_scale(made.rgb) if halves else 1.0
        if not 0.0 < factor < np.inf:
            raise ParameterError("scale", factor, "above 0")
        peak = float(made.rgb.max()) * factor
        if halves and peak > LARGEST_HALF:
            words = f"at most {LARGEST_HALF / float(made.rgb.max()):.3g}: half floats end at 65504"
            raise ParameterError("scale", factor, words)
        facts["scale"] = f"{factor:.10g}"
        if made.consumer.rows_reach_poles:
            facts["rows"] = "zenith angles even from 0 deg, the first, to 180 deg, the last"
        texts = {**made.frame.metadata, **facts}
        rgb = reaching_poles(made.rgb) if made.consumer.rows_reach_poles else made.rgb
        if suffix == ".hdr":
            write_hdr(path, rgb * np.float32(factor), texts, scale=factor)
        else:
            write_exr(
                path,
                rgb * np.float32(factor),
                texts,
                precision=precision,
                compression=compression,
                attributes=standard_attributes(made, factor),
            )
    else:
        written = write_picture(path, replace(made.frame), facts, **(display or {}))
        exposure = written.exposure
    for scene in stale:
        scene.unlink(missing_ok=True)
    # The JSON lists a scene before it exists, so that an interrupted run leaves no unlisted scene.
    scenes = {
        other: SCENES[made.consumer.name][1](made, path.name, factor).encode()
        for other in others[1:]
    }
    contents = described(made, path.name, factor)
    contents["files"] = {other.name: fingerprint_of(text) for other, text in scenes.items()}
    _write(others[0], (as_json(sealed(contents)) + "\n").encode())
    for other, text in scenes.items():
        _write(other, text)
    return WrittenMap(path=path, beside=others, scale=factor, exposure=exposure)


def _facts(made: EnvironmentMap) -> dict[str, str]:
    """Header metadata: units and axes."""
    consumer, bearing = made.consumer, f"{made.consumer.centre % 360.0:.10g} deg"
    where = "middle" if consumer.projection == "equirectangular" else "bottom"
    axes = {
        word: ", ".join(f"{value:g}" for value in consumer.direction(np.array(unit)) + 0.0)
        for word, unit in (("east", (1, 0, 0)), ("north", (0, 1, 0)), ("up", (0, 0, 1)))
    }
    return {
        "for": consumer.title,
        f"bearing_of_{where}": bearing,
        "axes": "; ".join(f"{word} ({text})" for word, text in axes.items()),
        "sun_disc": made.sun,
        "lower_half": made.ground,
        "gamut": f"sRGB: {100.0 * made.gamut.share:.3g} % of the texels changed, by at most "
        f"{made.gamut.largest:.3g} of their luminance",
    }


def _write(path: Path, content: bytes) -> None:
    try:
        with atomic_file(path) as part:
            part.write_bytes(content)
    except OSError as error:
        raise FileError(path, f"cannot be written: {error}") from error


def half_scale(rgb: NDArray[np.floating]) -> float:
    """Power of two that scales a map into the range of half floats.

    Below 1 if a texel, such as one with the sun's disc, would overflow; above 1 if more than 5 % of
    the nonzero texels would be subnormal, as at night, and the brightest texel permits it.

    Parameters
    ----------
    rgb : array, shape (h, w, 3)
        Linear sRGB, not negative.

    Returns
    -------
    float
        Scale. [1]

    Examples
    --------
    >>> half_scale(np.full((1, 1, 3), 2.4e6)), half_scale(np.full((1, 1, 3), 10.0))
    (0.015625, 1.0)
    """
    peak = float(np.max(rgb, initial=0.0))
    if not peak > 0.0:
        return 1.0
    most = math.floor(math.log2(LARGEST_HALF / peak))
    step = max(1, round((rgb.shape[0] * rgb.shape[1] / _SAMPLED) ** 0.5))
    grey = grey_of(rgb[::step, ::step])
    dim = float(np.quantile(grey[grey > 0.0], _DIM_SHARE)) if np.any(grey > 0.0) else 1.0
    least = min(max(math.ceil(math.log2(_DIM / dim)), 0), _HIGHEST)
    return 2.0 ** min(most, least)
