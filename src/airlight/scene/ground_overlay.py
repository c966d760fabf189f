"""Overlay of the ground: light that it emits, drawn over the map by night.

The overlay is a map of its own, whose colours are the radiance of lamps relative to that of the
brightest towns.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Final

import numpy as np

from airlight.color.texels import CHANNELS
from airlight.errors import FileError
from airlight.planets.map_picture import map_pixels
from airlight.scene.surface_map import SurfaceMap, from_pixels

_DATA = Path(__file__).parent / "data"
#: Suffix of packaged lights: ``earth`` is in ``data/earth-lights.jpg``.
_SUFFIX: Final = "-lights.jpg"
#: Luminance of lights of the value 1: 1e-7 W cm⁻² sr⁻¹ between 0.5 and 0.9 µm, which VIIRS sees
#: over the middle of large towns (Elvidge et al. 2017, Int. J. Remote Sens. 38, 5860: up to some
#: 1e-7, suburbs 1e-8, villages 1e-9), at 200 lm/W, between those of sodium lamps and of warm white
#: diodes. [cd m⁻²]
TOWN_LUMINANCE: Final = 0.2
#: Temperature of the black body whose colour the lamps have. [K]
LAMP_TEMPERATURE: Final = 2700.0


def lights_file(name: str) -> Path:
    """File of lights, which may be missing: of a packaged map, or the path itself.

    Examples
    --------
    >>> lights_file("earth").name
    'earth-lights.jpg'
    """
    packaged = _DATA / f"{name}{_SUFFIX}"
    return packaged if "/" not in name and packaged.is_file() else Path(name)


@cache
def ground_overlay(lights: str | None) -> SurfaceMap | None:
    """Load an overlay; it is read once.

    Parameters
    ----------
    lights : str or None
        Name of lights that ship with airlight (``earth``), or path of an equirectangular picture;
        of a coloured one the brightness counts.

    Returns
    -------
    SurfaceMap or None
        Map whose colours are the light of the ground, 1 for the brightest towns; None without
        lights.

    Raises
    ------
    FileError
        If there is no such file, or ``map_pixels`` refuses it.
    """
    if lights is None:
        return None
    try:
        grey = map_pixels(lights_file(lights), grey=True)
    except FileNotFoundError as error:
        known = ", ".join(sorted(p.name.removesuffix(_SUFFIX) for p in _DATA.glob(f"*{_SUFFIX}")))
        raise FileError(lights, f"there are no such lights (known: {known})") from error
    return from_pixels(lights, np.repeat(grey[..., None], CHANNELS - 1, axis=2))
