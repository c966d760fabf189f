"""Measured sky radiances: directions, wavelengths, values and scans."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.physics.units import values_in

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

#: Units of measured quantities and of their directions.
UNITS: Final = {
    "wavelength": "nm",
    "altitude": "m",
    **dict.fromkeys(("sun_zenith", "view_zenith", "azimuth"), "deg"),
    **dict.fromkeys(("radiance", "uncertainty"), "W/m^2/sr/nm"),
    "bandwidth": "nm",
    "solar_irradiance": "W/m^2/nm",
}


@dataclass(frozen=True, kw_only=True, eq=False)
class Measurements:
    """Radiances of a sky, n values, as numbers or quantities.

    Attributes
    ----------
    source : str
        Source file.
    wavelength : array, shape (n,)
        [nm]
    altitude : array, shape (n,)
        Altitude of the instrument above the planet's ground. [m]
    sun_zenith, view_zenith, azimuth : array, shape (n,)
        Zenith angles of sun and view; azimuth 0 is on the sun's side. [deg]
    radiance : array, shape (n,)
        [W m⁻² sr⁻¹ nm⁻¹]
    uncertainty : array, shape (n,), or None
        Standard deviations. [W m⁻² sr⁻¹ nm⁻¹]
    scan : array of int, shape (n,)
        Number of the scan of each value, from 0.
    scans : tuple of str
        Names of the scans.
    line : array of int, shape (n,), or None
        Lines of the file, for errors.
    bandwidth : array, shape (n,), or None
        Full widths of the instrument's bands, one at each wavelength; None: single wavelengths.
        [nm]
    solar_irradiance : array, shape (n,), or None
        Irradiance of the star outside the air, in the band and at the time of each value; None:
        that of the planet's star. [W m⁻² nm⁻¹]
    date : array of datetime64[D], shape (n,), or None
        Day of each value, for the distance of the star; None: that of the planet's file.
    """

    source: str
    wavelength: FloatArray
    altitude: FloatArray
    sun_zenith: FloatArray
    view_zenith: FloatArray
    azimuth: FloatArray
    radiance: FloatArray
    uncertainty: FloatArray | None
    scan: IntArray
    scans: tuple[str, ...]
    line: IntArray | None = None
    bandwidth: FloatArray | None = None
    solar_irradiance: FloatArray | None = None
    date: NDArray[np.datetime64] | None = None

    def __post_init__(self) -> None:
        for name, unit in UNITS.items():
            value = getattr(self, name)
            if value is not None:
                object.__setattr__(self, name, values_in(value, unit, name))

    @property
    def wavelengths(self) -> FloatArray:
        """Distinct wavelengths, ascending. [nm]"""
        return np.unique(self.wavelength)

    @property
    def bandwidths(self) -> FloatArray | None:
        """Width of the band at each of ``wavelengths``, or None. [nm]"""
        if self.bandwidth is None:
            return None
        bands = np.unique(np.stack([self.wavelength, self.bandwidth]), axis=1)
        twice = np.flatnonzero(np.diff(bands[0]) == 0.0)
        if twice.size:
            shown = f"{bands[1, twice[0]]:g} and {bands[1, twice[0] + 1]:g} nm"
            where = f"bandwidth at {bands[0, twice[0]]:g} nm"
            raise ParameterError(where, shown, "one width at each wavelength", self.source)
        return np.asarray(bands[1])

    @property
    def angle_from_sun(self) -> FloatArray:
        """Angle between view and sun, shape (n,). [deg]"""
        return angle_from_sun(self.view_zenith, self.sun_zenith, self.azimuth)

    def where(self, kept: NDArray[np.bool_]) -> Measurements:
        """Subset of the values, with renumbered scans."""
        if not kept.any():
            raise ParameterError(self.source, "0 values", "at least one value that is not excluded")
        chosen, numbered = np.unique(self.scan[kept], return_inverse=True)
        given = [name for name in (*UNITS, "line", "date") if getattr(self, name) is not None]
        return replace(
            self,
            **{name: getattr(self, name)[kept] for name in given},
            scan=numbered.astype(np.int64),
            scans=tuple(self.scans[k] for k in chosen),
        )

    def named(self, field: str, index: int) -> str:
        """Name of a value in errors, with its line."""
        return field if self.line is None else f"line {self.line[index]}, {field}"


def angle_from_sun(
    view_zenith: FloatArray, sun_zenith: FloatArray, azimuth: FloatArray
) -> FloatArray:
    """Angle between view and sun, shape (...). [deg]

    Parameters
    ----------
    view_zenith, sun_zenith, azimuth : array, shapes that broadcast to (...)
        [deg]

    Examples
    --------
    >>> round(float(angle_from_sun(30.0, 60.0, 180.0)), 6)  # over the zenith
    90.0
    """
    view, sun, around = np.radians(view_zenith), np.radians(sun_zenith), np.radians(azimuth)
    nu = np.cos(view) * np.cos(sun) + np.sin(view) * np.sin(sun) * np.cos(around)
    return np.asarray(np.degrees(np.arccos(np.clip(nu, -1.0, 1.0))))


def turned(
    view_zenith: FloatArray, azimuth: FloatArray, by_zenith: FloatArray, by_azimuth: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Directions of an instrument with a pointing offset.

    Parameters
    ----------
    view_zenith, azimuth : array, shape (...)
        Directions as recorded. [deg]
    by_zenith, by_azimuth : array, shape (...)
        Offsets. [deg]

    Returns
    -------
    view_zenith, azimuth : array, shape (...)
        True directions; past the zenith the azimuth changes by 180°. [deg]

    Examples
    --------
    >>> [float(x) for x in turned(1.0, 30.0, -3.0, 2.0)]
    [2.0, -148.0]
    """
    zenith, around = np.asarray(view_zenith + by_zenith), np.asarray(azimuth + by_azimuth)
    past = (zenith < 0.0) | (zenith > 180.0)
    zenith = np.abs(zenith)
    zenith = np.where(zenith > 180.0, 360.0 - zenith, zenith)
    around = around + np.where(past, 180.0, 0.0)
    return zenith, np.remainder(around + 180.0, 360.0) - 180.0
