"""Clouds of NetCDF and Zarr files: extinction, or liquid water and effective radius."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_axes import Axes, axes_of, regular
from airlight.clouds.cloud_field import MOST_CELLS, CloudField
from airlight.clouds.cloud_optics import REFERENCE, droplets
from airlight.errors import AirlightError, ParameterError
from airlight.files.datasets import damaged_dataset, open_dataset
from airlight.kernel.memory import check_memory
from airlight.physics.units import quantity, with_powers
from airlight.planets.clouds import ICE, CloudFile

if TYPE_CHECKING:
    import xarray as xr

Float32Array = NDArray[np.float32]

#: Names of variables, and CF standard names.
EXTINCTION: Final = (
    *("extinction", "ext", "extinction_coefficient"),
    "volume_extinction_coefficient_in_air_due_to_cloud_particles",
)
WATER: Final = (
    *("lwc", "ql", "clwc", "qc", "qcloud", "cloud_liquid_water_mixing_ratio"),
    "mass_concentration_of_cloud_liquid_water_in_air",
    "mass_fraction_of_cloud_liquid_water_in_air",
)
ICE_WATER: Final = (
    *("iwc", "qi", "ciwc", "qice", "mass_concentration_of_cloud_ice_in_air"),
    "mass_fraction_of_cloud_ice_in_air",
)
RADIUS: Final = (
    *("reff", "re", "rel", "effective_radius"),
    "effective_radius_of_cloud_liquid_water_particles",
    "effective_radius_of_cloud_ice_particles",
)
AIR_DENSITY: Final = ("rho", "rho_air", "density", "air_density", "dn0")
#: Densities of water and ice. [kg m⁻³]
_DENSITY: Final = (1000.0, 917.0)
#: Extinction efficiency of crystals, far larger than the wavelength. [1]
_CRYSTALS: Final = 2.0
#: Allowed effective radii. [m]
_RADII: Final = (1e-7, 1e-3)
#: Number of radii between which the efficiency is linear.
_NODES: Final = 64
#: Memory of a cell while a file is read, measured with 512 × 512 × 128 cells. [byte]
_CELL: Final = 40.0
#: Largest ratio of effective radii whose efficiency is taken as one.
_NARROW: Final = 1.05


class CloudData(NamedTuple):
    """Clouds of a file.

    Attributes
    ----------
    field : CloudField
        Extinction.
    effective_radius : float
        Effective radius, mean weighted by extinction. [m]
    """

    field: CloudField
    effective_radius: float


def read_cloud_file(
    clouds: CloudFile, *, radius: float = 6.371e6, latitude: float = 0.0, longitude: float = 0.0
) -> CloudData:
    """Read the clouds of a NetCDF or Zarr file.

    Parameters
    ----------
    clouds : CloudFile
        Path, substance, and effective radius for files without one.
    radius : float
        Radius of the planet, for grids of longitude and latitude. [m]
    latitude, longitude : float
        The place in the middle of a grid in metres. [deg]

    Raises
    ------
    FileError
        If the file cannot be read, or its clouds are invalid: one line with the reason.
    """
    with open_dataset(Path(clouds.file), "clouds") as data:
        try:
            return cloud_data(data, clouds, radius=radius, latitude=latitude, longitude=longitude)
        except ParameterError as error:
            raise error.in_file(clouds.file) from None
        except AirlightError:
            raise
        except Exception as error:  # a damaged file: whatever its library raises
            raise damaged_dataset(clouds.file, "clouds", error) from error


def cloud_data(
    data: xr.Dataset,
    clouds: CloudFile,
    *,
    radius: float = 6.371e6,
    latitude: float = 0.0,
    longitude: float = 0.0,
) -> CloudData:
    r"""Clouds of a dataset.

    Extinction is that of liquid water of the density ρ and the mass concentration L,

    .. math:: \beta = \frac{3 L Q}{4 \rho r_e},

    where Q, about 2.1, is the efficiency of the gamma distribution at 550 nm by Mie theory.

    Parameters
    ----------
    data : xarray.Dataset
        Variables with CF units and a coordinate for each dimension.
    clouds, radius, latitude, longitude
        See ``read_cloud_file``.
    """
    name = _named(data, EXTINCTION)
    ice = clouds.particles == ICE
    if name is None:
        name = _named(data, ICE_WATER if ice else WATER)
    if name is None:
        known = ", ".join([*EXTINCTION[:1], *(ICE_WATER if ice else WATER)[:5]])
        names = ", ".join(map(str, data.data_vars))[:60] or "none"
        raise ParameterError("variables", names, f"one of {known}")
    axes = axes_of(data, name)
    if axes.size > MOST_CELLS:
        raise ParameterError(name, f"{axes.size} cells", f"at most {MOST_CELLS} cells")
    check_memory(_CELL * axes.size, f"a cloud field of {axes.size} cells")
    unit = _unit(data, name)
    sizes = _radii(data, axes, clouds.effective_radius)
    if _is_a(unit, "1/m"):
        extinction = _values(data, name, axes, "1/m")
    else:
        water = _values(data, name, axes, "kg/m^3" if _is_a(unit, "kg/m^3") else "1")
        if not _is_a(unit, "kg/m^3"):
            water *= _air_density(data, axes)
        extinction = _of_water(water, sizes, clouds, ice)
    field = regular(
        extinction, axes, radius=radius, place=(latitude, longitude), beyond=clouds.beyond
    )
    weights = extinction.sum(dtype=np.float64)
    if isinstance(sizes, float) or weights == 0.0:
        return CloudData(field, clouds.effective_radius)
    mean = float(np.sum(sizes * extinction, dtype=np.float64))
    return CloudData(field, mean / float(weights))


def standard_air_density(altitude: NDArray[np.float64]) -> NDArray[np.float64]:
    """Density of the standard atmosphere up to 20 km; isothermal above. [kg m⁻³]

    ISO 2533:1975.

    Parameters
    ----------
    altitude : array
        Altitude. [m]

    Examples
    --------
    >>> standard_air_density(np.array([0.0, 5000.0, 15000.0])).round(4).tolist()
    [1.225, 0.7361, 0.1937]
    """
    below = 1.225 * np.maximum(1.0 - 2.25577e-5 * altitude, 0.1) ** 4.25588
    above = 0.36391 * np.exp(-(altitude - 11000.0) / 6341.6)
    return np.asarray(np.where(altitude < 11000.0, below, above))


# --- variables --------------------------------------------------------------------------------


def _named(data: xr.Dataset, names: tuple[str, ...]) -> str | None:
    """Name of the variable with one of the names or standard names."""
    for name in names:
        if name in data.variables:
            return name
    for one, variable in data.variables.items():
        if variable.attrs.get("standard_name") in names:
            return str(one)
    return None


def _unit(data: xr.Dataset, name: str) -> str:
    unit = data[name].attrs.get("units")
    if not isinstance(unit, str) or not unit:
        raise ParameterError(f"units of {name}", "missing", "such as 'g m-3'")
    return with_powers(unit)


def _is_a(unit: str, wanted: str) -> bool:
    """Whether a unit can be converted to another one."""
    try:
        quantity(f"1 {unit}" if unit != "1" else 1.0, wanted, bare=wanted == "1")
    except ParameterError:
        return False
    return True


def _factor(data: xr.Dataset, name: str, wanted: str) -> float:
    unit = _unit(data, name)
    if not _is_a(unit, wanted):
        raise ParameterError(f"units of {name}", unit, f"units of {wanted}")
    return 1.0 if unit == "1" else quantity(f"1 {unit}", wanted, bare=wanted == "1")


def _values(data: xr.Dataset, name: str, axes: Axes, unit: str) -> Float32Array:
    """Values of a variable on the axes east, north and up. [unit]"""
    factor = _factor(data, name, unit)
    values = axes.ordered(data[name], name)
    values = values * np.float32(factor)
    if not np.isfinite(values).all():
        raise ParameterError(name, "missing or infinite values", "finite numbers")
    if (values < 0.0).any():
        raise ParameterError(name, float(values.min()), f"0 or more, in {unit}")
    return values


def _radii(data: xr.Dataset, axes: Axes, default: float) -> float | Float32Array:
    """Effective radius of the file, or the default. [m]"""
    name = _named(data, RADIUS)
    if name is None:
        return default
    values = axes.ordered(data[name], name) * np.float32(_factor(data, name, "m"))
    return np.asarray(np.nan_to_num(values, nan=0.0, posinf=0.0, neginf=0.0), np.float32)


def _air_density(data: xr.Dataset, axes: Axes) -> Float32Array:
    """Density of the air: the file's, on the grid or by level, or the standard one. [kg m⁻³]"""
    name = _named(data, AIR_DENSITY)
    if name is None:
        return np.asarray(standard_air_density(axes.up), np.float32)
    if data[name].ndim < 3:
        values = np.asarray(axes.by_level(data[name], name) * _factor(data, name, "kg/m^3"))
        if not (values > 0.0).all():
            raise ParameterError(name, float(values.min()), "more than 0 kg/m^3")
        return np.asarray(values, np.float32)
    return _values(data, name, axes, "kg/m^3")


def _of_water(
    water: Float32Array, sizes: float | Float32Array, clouds: CloudFile, ice: bool
) -> Float32Array:
    """Extinction at 550 nm of a mass concentration [kg m⁻³]. [m⁻¹]"""
    cloudy = water > 0.0
    if isinstance(sizes, float):
        low = high = sizes
    elif cloudy.any():
        low, high = float(sizes[cloudy].min()), float(sizes[cloudy].max())
    else:
        return water
    if not (_RADII[0] <= low and high <= _RADII[1]):
        value = low if low < _RADII[0] else high
        raise ParameterError("effective radius", value, f"{_RADII[0]:g} to {_RADII[1]:g} m")
    held = np.float32(low) if isinstance(sizes, float) else np.where(cloudy, sizes, np.float32(low))
    efficiency: Any = np.float32(_CRYSTALS)
    if not ice:
        efficiency = np.float32(extinction_efficiency(low, clouds.effective_variance))
        if high > _NARROW * low:
            # Q - 2 is proportional to r^(-2/3) for large droplets (van de Hulst 1957, chapter 17)
            excess = np.array([efficiency, extinction_efficiency(high, clouds.effective_variance)])
            radii = np.geomspace(low, high, _NODES)
            powers = radii[::-1] ** (-2.0 / 3.0)
            between = np.interp(powers, powers[[0, -1]], excess[::-1])[::-1]
            efficiency = np.interp(held, radii, between).astype(np.float32)
    return np.asarray(np.float32(0.75 / _DENSITY[ice]) * efficiency * water / held, np.float32)


def extinction_efficiency(effective_radius: float, effective_variance: float) -> float:
    """Extinction over projected area of droplets at 550 nm by Mie theory. [1]

    Parameters
    ----------
    effective_radius : float
        Effective radius of the gamma distribution. [m]
    effective_variance : float
        Effective variance. [1]
    """
    particles = droplets(effective_radius, effective_variance)
    extinction, _ = particles.cross_sections([REFERENCE])
    return float(extinction[0] / (np.pi * particles.sizes.moment(2)))
