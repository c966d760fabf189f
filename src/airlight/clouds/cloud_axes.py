"""Axes of a dataset of clouds, and values on a regular box of cells."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import MOST_CELLS, CloudField
from airlight.errors import ParameterError
from airlight.physics.units import quantity, with_powers

if TYPE_CHECKING:
    import xarray as xr

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Names of the axes; a dimension may have more after an underscore, or the attribute ``axis``.
EAST: Final = ("x", "xt", "xm", "xc", "east", "lon", "longitude", "west_east")
NORTH: Final = ("y", "yt", "ym", "yc", "north", "lat", "latitude", "south_north")
UP: Final = ("z", "zt", "zm", "zc", "up", "height", "altitude", "alt", "lev", "level", "bottom_top")
#: Further names of altitudes on a vertical axis of indices.
ALTITUDES: Final = ("altitude", "height", "alt", "z")
#: Longest axis.
LONGEST: Final = 1 << 20
#: Relative irregularity of horizontal spacing that is neglected.
_REGULAR: Final = 1e-3
#: Largest extent in latitude and longitude. [deg]
_WIDEST: Final = 60.0
#: Largest ratio of the numbers of levels after and before resampling.
_FINER: Final = 8


@dataclass(frozen=True, kw_only=True)
class Axes:
    """Axes of a variable of three dimensions, ascending.

    Parameters
    ----------
    names : tuple of three str
        Dimensions eastwards, northwards and upwards.
    east, north : array
        Coordinates of the centres. [m], or [deg] if ``angular``
    up : array
        Altitudes of the centres. [m]
    flipped : tuple of three bool
        Whether the file's axis descends.
    angular : bool
        Whether the horizontal axes are longitude and latitude.
    """

    names: tuple[str, str, str]
    east: FloatArray
    north: FloatArray
    up: FloatArray
    flipped: tuple[bool, bool, bool]
    angular: bool

    @property
    def size(self) -> int:
        """Number of cells."""
        return self.east.size * self.north.size * self.up.size

    def ordered(self, variable: xr.DataArray, name: str) -> Float32Array:
        """Values of a variable, axes towards east, north and up."""
        rest = [one for one in variable.dims if one not in self.names]
        if variable.dtype.kind not in "fiu" or any(variable.sizes[one] != 1 for one in rest):
            raise ParameterError(name, _shape(variable), "numbers of three dimensions")
        if any(one not in variable.dims for one in self.names):
            allowed = f"dimensions {', '.join(self.names)}"
            raise ParameterError(f"dimensions of {name}", _shape(variable), allowed)
        whole = variable.isel(dict.fromkeys(rest, 0)).transpose(*self.names)
        steps = tuple(slice(None, None, -1) if one else slice(None) for one in self.flipped)
        return np.ascontiguousarray(whole.values[steps], np.float32)

    def by_level(self, variable: xr.DataArray, name: str) -> FloatArray:
        """Values of a variable of the vertical axis alone."""
        rest = [one for one in variable.dims if one != self.names[2]]
        if self.names[2] not in variable.dims or any(variable.sizes[one] != 1 for one in rest):
            raise ParameterError(
                f"dimensions of {name}", _shape(variable), f"dimension {self.names[2]}"
            )
        values = np.asarray(variable.isel(dict.fromkeys(rest, 0)).values, np.float64)
        return values[::-1] if self.flipped[2] else values


def axes_of(data: xr.Dataset, name: str) -> Axes:
    """Axes of a variable by the names and attributes of its dimensions.

    Parameters
    ----------
    data : xarray.Dataset
        Dataset.
    name : str
        Name of the variable.

    Raises
    ------
    ParameterError
        If an axis is unknown, occurs twice, or has no coordinates; a coordinate is irregular or has
        no unit; or there is a further dimension, such as several times.
    """
    variable = data[name]
    found: dict[str, str] = {}
    for dim in map(str, variable.dims):
        axis = _axis(dim, data[dim].attrs if dim in data.variables else {})
        if axis == "" and variable.sizes[dim] == 1:
            continue
        if axis == "":
            allowed = "x or longitude, y or latitude, z or height, and one time"
            raise ParameterError(f"dimension of {name}", f"{dim} ({variable.sizes[dim]})", allowed)
        if axis in found:
            allowed = f"one axis {axis}; {found[axis]} is one"
            raise ParameterError(f"dimension of {name}", dim, allowed)
        found[axis] = dim
    if len(found) != 3:
        raise ParameterError(f"dimensions of {name}", _shape(variable), "three: x, y and z")
    for dim in found.values():
        if variable.sizes[dim] > LONGEST:
            raise ParameterError(dim, variable.sizes[dim], f"at most {LONGEST} values")
    angular = _is_angle(data, found["x"]) and _is_angle(data, found["y"])
    unit = "deg" if angular else "m"
    east, flip_x = _ascending(_coordinate(data, found["x"], unit), found["x"])
    north, flip_y = _ascending(_coordinate(data, found["y"], unit), found["y"])
    up, flip_z = _ascending(_altitudes(data, found["z"]), found["z"])
    for values, dim in ((east, found["x"]), (north, found["y"])):
        steps = np.diff(values)
        if steps.size and np.ptp(steps) > _REGULAR * steps.mean():
            span = f"{steps.min():.6g} to {steps.max():.6g} {unit}"
            raise ParameterError(f"spacing of {dim}", span, "a regular grid")
        if angular and np.ptp(values) > _WIDEST:
            raise ParameterError(dim, f"{np.ptp(values):g} deg", f"at most {_WIDEST:g} deg wide")
    return Axes(
        names=(found["x"], found["y"], found["z"]),
        east=east,
        north=north,
        up=up,
        flipped=(flip_x, flip_y, flip_z),
        angular=angular,
    )


def regular(
    extinction: Float32Array,
    axes: Axes,
    *,
    radius: float,
    place: tuple[float, float],
    beyond: str,
) -> CloudField:
    """Field of values on axes: vertically by their means, horizontally linear if angular.

    Parameters
    ----------
    extinction : array, shape (nx, ny, nz)
        Extinction in the cells of the axes. [m⁻¹]
    axes : Axes
        Axes.
    radius : float
        Radius of the planet. [m]
    place : tuple of float
        Latitude and longitude of the middle of a grid in metres. [deg]
    beyond : str
        See ``CloudField``.
    """
    edges = _edges(axes.up)
    level = float(np.diff(edges).min())
    count = round(float(edges[-1] - edges[0]) / level)
    columns = axes.east.size * axes.north.size
    count = max(min(count, _FINER * axes.up.size, MOST_CELLS // columns), 1)
    level = float(edges[-1] - edges[0]) / count
    if np.ptp(np.diff(edges)) > 1e-6 * level or count != axes.up.size:
        shares = overlaps(edges, edges[0] + level * np.arange(count + 1))
        extinction = np.asarray(extinction @ shares.T.astype(np.float32), np.float32)
    if axes.angular:
        place = (
            0.5 * float(axes.north[0] + axes.north[-1]),
            0.5 * float(axes.east[0] + axes.east[-1]),
        )
        extinction, steps = _gnomonic(extinction, axes, place, radius)
    else:
        steps = _step(axes.east), _step(axes.north)
    return CloudField(
        extinction=extinction,
        spacing=(*steps, level),
        base=float(edges[0]),
        latitude=place[0],
        longitude=(place[1] + 180.0) % 360.0 - 180.0,
        beyond=beyond,
    )


def overlaps(old: FloatArray, new: FloatArray) -> FloatArray:
    """Shares of old cells in the means of new ones, shape (new, old); columns are conserved. [1]

    Parameters
    ----------
    old, new : array
        Edges of the cells, ascending. [m]
    """
    low = np.maximum(new[:-1, None], old[None, :-1])
    high = np.minimum(new[1:, None], old[None, 1:])
    return np.asarray(np.maximum(high - low, 0.0) / np.diff(new)[:, None])


def _gnomonic(
    extinction: Float32Array, axes: Axes, place: tuple[float, float], radius: float
) -> tuple[Float32Array, tuple[float, float]]:
    """Values on a regular grid of gnomonic coordinates of the same size, and its steps [m]."""
    from scipy.ndimage import map_coordinates

    nx, ny = axes.east.size, axes.north.size
    middle = np.radians(place[0])
    half_east = radius * np.tan(0.5 * np.radians(np.ptp(axes.east))) * np.cos(middle)
    half_north = radius * np.tan(0.5 * np.radians(np.ptp(axes.north)))
    x = np.linspace(-half_east, half_east, nx)[:, None] / radius
    y = np.linspace(-half_north, half_north, ny)[None, :] / radius
    across = np.sqrt(1.0 + x**2 + y**2)
    latitude = np.arcsin((np.sin(middle) + y * np.cos(middle)) / across)
    longitude = np.arctan2(x, np.cos(middle) - y * np.sin(middle))
    i = (np.degrees(longitude) + place[1] - axes.east[0]) / _step(axes.east)
    j = (np.degrees(latitude) - axes.north[0]) / _step(axes.north)
    found = np.empty_like(extinction)
    for level in range(extinction.shape[2]):
        map_coordinates(
            extinction[:, :, level], [i, j], found[:, :, level], order=1, mode="nearest"
        )
    return found, (2.0 * half_east / max(nx - 1, 1), 2.0 * half_north / max(ny - 1, 1))


# --- coordinates ------------------------------------------------------------------------------


def _axis(dim: str, attributes: Any) -> str:
    """Axis of a dimension: x, y or z; empty if unknown."""
    axis = str(attributes.get("axis", "")).lower()
    if axis in ("x", "y", "z"):
        return axis
    name = dim.lower()
    for axis, names in (("x", EAST), ("y", NORTH), ("z", UP)):
        if name in names or name.rpartition("_")[0] in names or name.partition("_")[0] in names:
            return axis
    return ""


def _shape(variable: xr.DataArray) -> str:
    return ", ".join(f"{name} ({size})" for name, size in variable.sizes.items())[:80] or "one"


def _is_angle(data: xr.Dataset, name: str) -> bool:
    units = str(data[name].attrs.get("units", "")) if name in data.variables else ""
    return units.startswith("deg") or units == "°"


def _coordinate(data: xr.Dataset, name: str, unit: str) -> FloatArray:
    """Values of a coordinate. [unit]"""
    if name not in data.variables or data[name].ndim != 1 or data[name].dtype.kind not in "fiu":
        raise ParameterError(f"coordinate {name}", "missing", f"positions in {unit}")
    given = data[name].attrs.get("units")
    if not isinstance(given, str) or not given:
        raise ParameterError(f"units of {name}", "missing", f"such as {unit!r}")
    if unit == "deg":
        factor = 1.0
    else:
        try:
            factor = quantity(f"1 {with_powers(given)}", unit)
        except ParameterError:
            raise ParameterError(f"units of {name}", given, f"units of {unit}") from None
    values = factor * np.asarray(data[name].values, np.float64)
    if not np.isfinite(values).all():
        raise ParameterError(name, "missing or infinite values", "finite numbers")
    return np.asarray(values)


def _altitudes(data: xr.Dataset, name: str) -> FloatArray:
    """Altitudes of a vertical axis, by itself or by another variable of this axis. [m]"""
    for other in (name, *ALTITUDES):
        if other in data.variables and data[other].dims == (name,):
            try:
                return _coordinate(data, other, "m")
            except ParameterError:
                if other == ALTITUDES[-1]:
                    raise
    return _coordinate(data, name, "m")


def _ascending(values: FloatArray, name: str) -> tuple[FloatArray, bool]:
    """Ascending coordinates, and whether they descend in the file."""
    flipped = values.size > 1 and values[0] > values[-1]
    if flipped:
        values = values[::-1]
    if values.size == 0 or (np.diff(values) <= 0.0).any():
        raise ParameterError(name, "coordinates in no order", "ascending or descending ones")
    return values, bool(flipped)


def _step(centres: FloatArray) -> float:
    """Spacing of regular centres; 1000 of a single one."""
    if centres.size < 2:
        return 1000.0
    return float((centres[-1] - centres[0]) / (centres.size - 1))


def _edges(centres: FloatArray) -> FloatArray:
    """Edges of cells halfway between their centres. [m]"""
    if centres.size == 1:
        return np.array([max(centres[0] - 50.0, 0.0), centres[0] + 50.0])
    middles = 0.5 * (centres[:-1] + centres[1:])
    first, last = 2.0 * centres[0] - middles[0], 2.0 * centres[-1] - middles[-1]
    return np.concatenate([[first], middles, [last]])
