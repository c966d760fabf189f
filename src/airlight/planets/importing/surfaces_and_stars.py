"""Albedo of a planet's ground and spectrum of its star from tables over wavelength."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError, ParameterError
from airlight.physics.data_tables.data_table import DataTable, Quantity
from airlight.physics.units import quantity
from airlight.planets.importing.phase_tables import WAVELENGTH
from airlight.planets.importing.planet_tables import PlanetTables
from airlight.planets.importing.thinning import thinned
from airlight.planets.spectral import MOST_WAVELENGTHS

FloatArray = NDArray[np.float64]

REFLECTANCE: Final = Quantity(
    name="reflectance",
    unit="1",
    names=("albedo", "refl", "reflectivity", "surfacealbedo"),
    low=0.0,
    high=1.0,
    units="1, %",
)
IRRADIANCE: Final = Quantity(
    name="irradiance",
    unit="W/m^2/nm",
    names=("flux", "fluxdensity", "ssi", "spectralirradiance", "solarirradiance", "etr"),
    low=0.0,
    high=1e9,
    units="W/m^2/nm, mW/m^2/nm, W/m^2/um, erg/s/cm^2/angstrom",
)
SURFACE_FLUX: Final = replace(
    IRRADIANCE, name="surface flux", names=("stellarsurfaceflux", "fluxatsurface"), high=1e14
)
#: Keys of the ground that show another ground than that of one albedo.
_SHOWN_GROUND: Final = (
    *("map", "relief", "rocks", "craters", "lights", "clouds", "clouds_from_space", "wind"),
    *("brightness", "cloud_optical_depth", "cloud_altitude", "wavelengths"),
)
#: Tolerances of thinning: of the reflectance, and of the logarithm of the irradiance. [1]
_TOLERANCE: Final = 1e-3


def import_albedo(planet: PlanetTables, table: DataTable) -> None:
    """Replace the albedo of the ground; maps and other ground are left out."""
    nm, values = _spectrum(table, REFLECTANCE)
    kept, error = thinned(nm, values, _TOLERANCE)
    ground = planet.tables["ground"]
    for key in _SHOWN_GROUND:
        ground.pop(key, None)
    ground["wavelengths"] = f"{', '.join(f'{one:.7g}' for one in nm[kept])} nm"
    ground["albedo"] = [float(f"{one:.5g}") for one in values[kept]]
    name = table.notes.get("Name", "")
    planet.comment("ground", f"{planet.source}{f': {name}' if name else ''}")
    planet.notes.append(
        f"ground: {kept.size} of {nm.size} rows kept, within {error:.2g}; without a map"
    )


def import_star(planet: PlanetTables, table: DataTable, angular_radius: str | None = None) -> None:
    """Replace the spectrum of the star.

    Parameters
    ----------
    planet : PlanetTables
        Tables of the planet file, changed in place.
    table : DataTable
        Irradiance at the planet over wavelength; or the flux F at the star's surface, whose
        irradiance is F sin² of the angular radius.
    angular_radius : str, optional
        Angular radius with its unit; by default that of the base planet's star.
    """
    radius = angular_radius or f"{planet.base.star.angular_radius_degrees:.6g} deg"
    at_surface = table.find(SURFACE_FLUX) is not None
    nm, values = _spectrum(_within(table, planet), SURFACE_FLUX if at_surface else IRRADIANCE)
    if at_surface:
        values = values * math.sin(quantity(radius, "rad")) ** 2
        planet.notes.append(f"star: irradiances are surface fluxes seen at a radius of {radius}")
    kept, error = np.arange(nm.size), 0.0
    if (values > 0.0).all():
        kept, error = thinned(np.log(nm), np.log(values), _TOLERANCE, most=MOST_WAVELENGTHS)
    planet.notes.append(f"star: {kept.size} of {nm.size} rows kept, within {100.0 * error:.2g} %")
    planet.comment("star", planet.source)
    planet.tables["star"] = {
        "wavelengths": f"{', '.join(f'{one:.8g}' for one in nm[kept])} nm",
        "irradiance": f"{', '.join(f'{one:.6g}' for one in values[kept])} W/m^2/nm",
        "angular_radius": radius,
    }


def _within(table: DataTable, planet: PlanetTables) -> DataTable:
    """Rows of a spectrum at wavelengths that planets may have."""
    table.check_lists(WAVELENGTH)
    nm = table.numbers(replace(WAVELENGTH, low=0.0, high=math.inf))
    kept = (nm >= WAVELENGTH.low) & (nm <= WAVELENGTH.high)
    if kept.all():
        return table
    planet.notes.append(f"star: {(~kept).sum()} rows outside 10 nm to 1 mm left out")
    return table.where(kept)


def _spectrum(table: DataTable, wanted: Quantity) -> tuple[FloatArray, FloatArray]:
    """Wavelengths, ascending, and values. [nm], [unit]"""
    table.check_lists(WAVELENGTH, wanted)
    nm, values = table.numbers(WAVELENGTH), table.numbers(wanted)
    if nm.size < 2:
        raise FileError(table.source, "requires two rows or more of a wavelength and a value")
    steps = np.diff(nm)
    sign = 1.0 if nm[-1] > nm[0] else -1.0
    if not (sign * steps > 0.0).all():
        k = int(np.argmax(sign * steps <= 0.0)) + 1
        allowed = "wavelengths that ascend, or descend, throughout"
        raise ParameterError(
            f"{table.place(k)}, wavelength", f"{nm[k]:g} nm", allowed, table.source
        )
    order = slice(None, None, int(sign))
    return nm[order], values[order]
