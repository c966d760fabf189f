"""Render passes in OpenEXR files: colour, alpha, depth, position and normals by name.

Blender writes one part per pass or, before 5.0, a single part, with channels such as
``ViewLayer.Depth.Z``; other programs write ``R``, ``Z`` or ``depth.Z``.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError, ParameterError
from airlight.image.exr import check_exr

Float32Array = NDArray[np.float32]

#: Suffixes of names of depth passes in order of preference, and the kind of depth.
_DEPTHS: Final = (
    ("Depth.Z", "planar"),
    ("Position.X", "position"),
    ("depth.Z", "inverse"),
    ("distance.Z", "distance"),
    ("distance.Y", "distance"),
    ("Depth.V", "planar"),
    ("depth.V", "planar"),
    ("Z", "planar"),
)


@dataclass(frozen=True, eq=False)
class RenderPasses:
    """Channels of a file.

    Attributes
    ----------
    path : Path
        Path of the file.
    channels : dict of str to array, shape (h, w)
        Channels by full name: layer, pass and channel.
    header : dict
        Attributes of the first part.
    """

    path: Path
    channels: dict[str, NDArray[Any]]
    header: dict[str, Any]

    @property
    def size(self) -> tuple[int, int]:
        """Width and height. [pixel]"""
        height, width = next(iter(self.channels.values())).shape
        return width, height

    def group(self, prefix: str, letters: str) -> Float32Array:
        """Channels of one pass, shape (h, w, n).

        Parameters
        ----------
        prefix : str
            Name of the pass with its dot; empty for unnamed passes.
        letters : str
            Last letters of the channels.
        """
        return np.stack([self.channels[prefix + one] for one in letters], axis=-1).astype(
            np.float32
        )

    def _prefixes(self, letters: str) -> list[str]:
        """Names of the passes with all of these channels, best first."""
        found = {
            name[:-1]
            for name in self.channels
            if name.endswith(letters[0])
            and all(name[:-1] + one in self.channels for one in letters)
        }
        found = {one for one in found if not one or one.endswith(".")}
        return sorted(found, key=lambda one: (not one.endswith("Combined."), one != "", one))

    def colors(self, layer: str | None = None) -> tuple[Float32Array, Float32Array | None]:
        """Colours, shape (h, w, 3), and alpha, shape (h, w), if there is one.

        Parameters
        ----------
        layer : str, optional
            Prefix of the pass, such as ``ViewLayer``.
        """
        found = self._prefixes("RGB")
        if layer is not None:
            found = [one for one in found if one.startswith(layer)]
        if not found:
            raise self._lacking("colour", "R, G, B")
        combined = [one for one in found if one.endswith("Combined.")]
        if len(combined) > 1 or (len(found) > 1 and not combined and found[0] != ""):
            names = ", ".join(one.rstrip(".") for one in found)
            raise ParameterError("layer", layer, f"one of {names}", self.path)
        alpha = self.channels.get(found[0] + "A")
        return self.group(found[0], "RGB"), None if alpha is None else alpha.astype(np.float32)

    def depth(self, kind: str, channel: str | None = None) -> tuple[NDArray[Any], str]:
        """Depth pass and its kind.

        Parameters
        ----------
        kind : str
            One of ``composition.depth.KINDS``; ``auto``: by the name of the channel.
        channel : str, optional
            Full name of the channel or, for positions, of the pass.

        Returns
        -------
        array, shape (h, w) or (h, w, 3)
            Depth, or positions. [scene units]
        kind : str
            Kind.
        """
        if channel is not None:
            if channel in self.channels:
                return self.channels[channel], "planar" if kind == "auto" else kind
            if all(f"{channel}.{one}" in self.channels for one in "XYZ"):
                return self.group(f"{channel}.", "XYZ"), "position"
            raise self._lacking("depth_channel", channel)
        for ending, means in _DEPTHS:
            if kind == "position" and means != "position":
                continue
            if kind not in ("auto", "position") and means == "position":
                continue
            found = [one for one in self.channels if one == ending or one.endswith(f".{ending}")]
            if ending == "Z":
                found = [one for one in found if one == "Z"]
            if not found:
                continue
            if means == "position":
                return self.group(min(found)[:-1], "XYZ"), "position"
            return self.channels[min(found)], means if kind == "auto" else kind
        raise self._lacking("depth", "Depth.Z, Z or Position.X, .Y, .Z")

    def vectors(self, letters: str, names: tuple[str, ...]) -> Float32Array:
        """Pass of three channels, shape (h, w, 3).

        Parameters
        ----------
        letters : str
            Last letters of its channels.
        names : tuple of str
            Suffixes of its name, best first; empty for unnamed passes.
        """
        for name in names:
            for prefix in self._prefixes(letters):
                stem = prefix.rstrip(".")
                if stem == name or (name and stem.endswith(f".{name}")):
                    return self.group(prefix, letters)
        wanted = " or ".join(one for one in names if one)
        raise self._lacking(wanted, f"{names[0]}.{letters[0]}, .{letters[1]}, .{letters[2]}")

    def only(self) -> NDArray[Any]:
        """Only channel of the file, shape (h, w)."""
        if len(self.channels) > 1:
            raise self._lacking("a pass", "a single channel")
        return next(iter(self.channels.values()))

    def _lacking(self, what: str, wanted: str) -> ParameterError:
        names = ", ".join(list(self.channels)[:12])
        return ParameterError(what, f"in channels {names}", wanted, self.path)


def read_render_passes(path: str | Path) -> RenderPasses:
    """Read all channels of all parts of an OpenEXR file.

    Parameters
    ----------
    path : str or Path
        Path of the file, scan lines or tiles.
    """
    import OpenEXR

    check_exr(path)
    channels: dict[str, NDArray[Any]] = {}
    try:
        with OpenEXR.File(str(path), separate_channels=True) as image:
            header = dict(image.parts[0].header)
            for part in image.parts:
                name = part.header.get("name") or ""
                for key, channel in part.channels.items():
                    whole = (
                        key if "." in key or not name or len(image.parts) == 1 else f"{name}.{key}"
                    )
                    channels[whole] = np.array(channel.pixels)
    except (RuntimeError, ValueError, TypeError, KeyError) as error:
        raise FileError(path, f"cannot be read as OpenEXR: {error}") from error
    shapes = {one.shape for one in channels.values()}
    if len(shapes) != 1 or len(next(iter(shapes))) != 2:
        raise FileError(path, f"its passes have no common size: {sorted(shapes)}")
    return RenderPasses(Path(path), channels, header)
