"""OpenEXR files: linear float32 or half floats."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError, ParameterError
from airlight.files.atomic_file import atomic_file
from airlight.files.input_files import LARGEST_PICTURE, check_input
from airlight.image.exr_bands import write_bands
from airlight.image.header import header
from airlight.kernel.large_arrays import LARGE, bands
from airlight.kernel.memory import check_picture
from airlight.physics.constants import LUMINOUS_EFFICACY

#: Chromaticities of red, green, blue and white. [ITU-R BT.709-6, item 1.3 and 1.4]
REC_709 = (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290)
#: Types of the channels by name.
PRECISIONS: Final[dict[str, type[np.floating[Any]]]] = {"float": np.float32, "half": np.float16}
#: Compressions by name, with their name in OpenEXR; ``dwa`` is lossy at an invisible level.
_NAMES: Final = {"zip": "ZIP", "dwa": "DWAA", "none": "NO"}
COMPRESSIONS: Final = {name: f"{own}_COMPRESSION" for name, own in _NAMES.items()}

#: Precision after compression, independent of that of the channels.
_FORCED_PRECISION: Final = {"dwa": "half"}
#: Largest half float. [IEEE 754-2019, binary16]
LARGEST_HALF: Final = 65504.0


def write_exr(
    path: str | Path,
    rgb: NDArray[np.float32],
    metadata: Mapping[str, str] | None = None,
    *,
    precision: str = "float",
    compression: str = "zip",
    attributes: Mapping[str, Any] | None = None,
    layers: Mapping[str, NDArray[np.float32]] | None = None,
) -> None:
    """Write linear radiance.

    Parameters
    ----------
    rgb : array, shape (h, w, 3)
        Linear sRGB radiance, weighted by the colour-matching functions, float32.
        [W m⁻² sr⁻¹; 683 times its luminance is cd m⁻², recorded in the file as ``whiteLuminance``]
    metadata : mapping of str to str, optional
        String attributes to add, each name prefixed with ``airlight.``.
    precision : str
        Name from ``PRECISIONS``.
    compression : str
        Name from ``COMPRESSIONS``.
    attributes : mapping, optional
        Standard attributes of OpenEXR, instead of the default ones.
    layers : mapping of str to array, shape (h, w, 3) or (h, w), optional
        Further channels, float32: ``NAME.R``, ``NAME.G`` and ``NAME.B`` of a colour, otherwise
        ``NAME``.

    Raises
    ------
    FileError
        If the file cannot be written; an existing file is then unchanged.
    """
    import OpenEXR

    if rgb.dtype != np.float32 or rgb.ndim != 3 or rgb.shape[2] != 3:
        raise ParameterError("rgb", f"{rgb.dtype} {rgb.shape}", "float32, shape (h, w, 3)")
    layers = layers or {}
    for name, layer in layers.items():
        if layer.dtype != np.float32 or layer.shape not in (rgb.shape, rgb.shape[:2]):
            allowed = f"float32, shape {rgb.shape} or {rgb.shape[:2]}"
            raise ParameterError(f"layers[{name}]", f"{layer.dtype} {layer.shape}", allowed)
    if precision not in PRECISIONS:
        raise ParameterError("precision", precision, ", ".join(PRECISIONS))
    if compression not in COMPRESSIONS:
        raise ParameterError("compression", compression, ", ".join(COMPRESSIONS))
    largest = max(
        float(np.abs(band).max(initial=0.0))
        for one in (rgb, *layers.values())
        for band in bands(one)
    )
    if LARGEST_HALF < largest < np.inf and "half" in (
        precision,
        _FORCED_PRECISION.get(compression),
    ):
        words = f"at most {LARGEST_HALF:g} in half floats: scale it"
        raise ParameterError("rgb", f"{largest:.4g}", words)
    written: dict[str, Any] = {
        "compression": getattr(OpenEXR, COMPRESSIONS[compression]),
        "type": OpenEXR.scanlineimage,
        # Scene-referred and unclipped: channels are negative for light beyond these primaries.
        "chromaticities": REC_709,
        "whiteLuminance": LUMINOUS_EFFICACY,
        **header(metadata or {}),
        **(attributes or {}),
    }
    channels, kind = _channels(rgb, layers), PRECISIONS[precision]
    with atomic_file(path) as part:
        try:
            if rgb.nbytes >= LARGE:
                write_bands(part, written, channels, kind)
            else:
                with np.errstate(over="ignore"):
                    pixels = {
                        name: np.ascontiguousarray(values.astype(kind, copy=False))
                        for name, values in channels.items()
                    }
                OpenEXR.File(written, pixels).write(str(part))
        except (RuntimeError, ValueError, TypeError) as error:
            raise FileError(path, f"cannot be written: {error}") from error


def _channels(
    rgb: NDArray[np.float32], layers: Mapping[str, NDArray[np.float32]]
) -> dict[str, NDArray[np.float32]]:
    """Pixels by channel name."""
    channels = {"RGB": rgb}
    for name, layer in layers.items():
        if layer.ndim == 2:
            channels[name] = layer
        else:
            channels |= {f"{name}.{letter}": layer[..., k] for k, letter in enumerate("RGB")}
    return channels


def write_exr_channels(
    path: str | Path,
    channels: Mapping[str, NDArray[Any]],
    metadata: Mapping[str, str] | None = None,
) -> None:
    """Write named channels of values that are not colours.

    Parameters
    ----------
    channels : mapping of str to array, shape (h, w)
        Values, float16 or float32, all of one shape and type.
    metadata : mapping of str to str, optional
        Attributes, as for ``write_exr``.

    Raises
    ------
    FileError
        If the file cannot be written; an existing file is then unchanged.
    """
    import OpenEXR

    kinds = {(array.dtype.name, array.shape) for array in channels.values()}
    sound = all(name in ("float16", "float32") and len(shape) == 2 for name, shape in kinds)
    if len(kinds) != 1 or not sound:
        raise ParameterError("channels", sorted(kinds), "a common shape (h, w), float16 or float32")
    attributes: dict[str, Any] = {
        "compression": OpenEXR.ZIP_COMPRESSION,
        "type": OpenEXR.scanlineimage,
        **header(metadata or {}),
    }
    with atomic_file(path) as part:
        try:
            arrays = {name: np.ascontiguousarray(array) for name, array in channels.items()}
            OpenEXR.File(attributes, arrays).write(str(part))
        except (RuntimeError, ValueError, TypeError) as error:
            raise FileError(path, f"cannot be written: {error}") from error


def read_exr_channels(path: str | Path) -> dict[str, NDArray[Any]]:
    """Read a file written by ``write_exr_channels``: channels by name."""
    import OpenEXR

    check_exr(path)
    try:
        with OpenEXR.File(str(path), separate_channels=True) as image:
            return {name: np.array(one.pixels) for name, one in image.channels().items()}
    except (RuntimeError, ValueError, TypeError) as error:
        raise FileError(path, f"cannot be read as OpenEXR: {error}") from error


def read_exr(path: str | Path) -> tuple[NDArray[np.float32], dict[str, str]]:
    """Read a file written by ``write_exr``.

    Returns
    -------
    (array, dict)
        Linear red, green, blue, shape (h, w, 3), and the string attributes.
    """
    import OpenEXR

    check_exr(path)
    try:
        with OpenEXR.File(str(path)) as image:
            rgb = np.array(image.channels()["RGB"].pixels)
            texts = {k: v for k, v in image.header().items() if isinstance(v, str)}
    except (RuntimeError, ValueError, TypeError, KeyError) as error:
        raise FileError(path, f"cannot be read as RGB OpenEXR: {error}") from error
    return rgb, texts


def check_exr(path: str | Path) -> None:
    """Raise an error for a file that is too large by its headers, before decoding.

    Raises
    ------
    FileError
        If the file cannot be read, or is larger than ``check_picture`` allows.
    """
    import OpenEXR

    check_input(path, LARGEST_PICTURE)
    try:
        with OpenEXR.File(str(path), header_only=True) as image:
            windows = [part.header["dataWindow"] for part in image.parts]
            sides = [np.asarray(last) - np.asarray(first) + 1 for first, last in windows]
    except (RuntimeError, ValueError, TypeError, KeyError) as error:
        raise FileError(path, f"cannot be read as OpenEXR: {error}") from error
    for width, height in sides:
        check_picture(path, int(width), int(height))


def read_exr_header(path: str | Path) -> dict[str, str]:
    """String attributes of a file."""
    import OpenEXR

    check_input(path, LARGEST_PICTURE)
    try:
        with OpenEXR.File(str(path), header_only=True) as image:
            return {k: v for k, v in image.header().items() if isinstance(v, str)}
    except (RuntimeError, ValueError, TypeError) as error:
        raise FileError(path, f"cannot be read as OpenEXR: {error}") from error
