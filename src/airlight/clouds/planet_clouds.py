"""Fields and optical properties of a planet's clouds, as renderer and solvers take them."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np
import numpy.typing as npt

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_files import read_cloud_file
from airlight.clouds.cloud_optics import CloudOptics
from airlight.clouds.cloud_types import SIZE, cloud_field
from airlight.errors import ParameterError
from airlight.physics.units import values_in
from airlight.planets.clouds import WATER, CloudFile, Clouds, CloudType

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

#: Number of fields, and of shapes, that are kept: those of a picture, and the last edited ones.
_KEPT: Final = 4
#: Parameters of clouds on which their shapes do not depend, those of the wind that moves them among
#: them (wind shear tilts clouds), and values.
_NO_SHAPE: Final[dict[str, Any]] = {
    "name": None,
    "base": 0.0,
    "optical_depth": 1.0,
    "particles": WATER,
    "effective_radius": 1e-5,
    "effective_variance": 0.1,
    "wind_speed": 0.0,
    "wind_direction": 0.0,
    "latitude": None,
    "longitude": None,
}


class Box(NamedTuple):
    """Box of generated clouds.

    Parameters
    ----------
    latitude, longitude : float
        The place, in the middle, of clouds without one. [deg]
    size : float
        Side. [m]
    spacing : float, optional
        Horizontal width of a cell; by default that of each type. [m]
    levels : int, optional
        Number of levels; by default that of each type.
    """

    latitude: float = 0.0
    longitude: float = 0.0
    size: float = SIZE
    spacing: float | None = None
    levels: int | None = None


def clouds_of(
    planet: Planet, wavelengths: npt.ArrayLike, box: Box | None = None
) -> tuple[tuple[CloudField, CloudOptics], ...]:
    """Field and optical properties of each of the clouds of a planet; none without clouds.

    Fields are cached by the parameters of the clouds and the box.

    Parameters
    ----------
    planet : Planet
        Planet with clouds.
    wavelengths : array, shape (w,)
        Wavelengths. [nm]
    box : Box, optional
        Place, size and resolution of generated clouds; the place also of files without one.

    Raises
    ------
    ParameterError
        If clouds reach above the top of the air, or a file is not one of clouds.
    FileError
        If a file cannot be read.

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> earth = load_planet("earth", {"clouds": [{"kind": "cirrus"}]})
    >>> [(field, optics)] = clouds_of(earth, [550.0], Box(spacing=800.0))
    >>> field.extinction.shape, float(optics.albedo[0])
    ((32, 32, 32), 1.0)
    """
    nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
    found = []
    for index, one in enumerate(planet.clouds):
        field, radius = field_of(one, box or Box(), planet.bottom_radius)
        if field.top > planet.thickness:
            allowed = f"tops of at most {planet.thickness:g} m, the top of the air"
            raise ParameterError(f"clouds[{index}]", f"{field.top:g} m", allowed)
        found.append((field, CloudOptics.of_clouds(one, nm, radius)))
    return tuple(found)


@lru_cache(maxsize=_KEPT)
def field_of(clouds: Clouds, box: Box, bottom_radius: float) -> tuple[CloudField, float]:
    """Field of clouds and their effective radius [m], cached.

    Parameters
    ----------
    clouds : Clouds
        Clouds.
    box : Box
        Argument of ``clouds_of``.
    bottom_radius : float
        Radius of the ground. [m]
    """
    if isinstance(clouds, CloudType):
        shapes = _shapes(replace(clouds, **_NO_SHAPE), box.size, box.spacing, box.levels)
        return replace(
            shapes,
            extinction=np.float32(clouds.optical_depth) * shapes.extinction,
            base=clouds.base,
            latitude=box.latitude if clouds.latitude is None else clouds.latitude,
            longitude=box.longitude if clouds.longitude is None else clouds.longitude,
        ), clouds.effective_radius
    assert isinstance(clouds, CloudFile)
    return read_cloud_file(
        clouds, radius=bottom_radius, latitude=box.latitude, longitude=box.longitude
    )


@lru_cache(maxsize=_KEPT)
def _shapes(
    clouds: CloudType, size: float, spacing: float | None, levels: int | None
) -> CloudField:
    """Field of the shapes of clouds, of any altitude, place and mean optical depth."""
    return cloud_field(clouds, size=size, spacing=spacing, levels=levels)
