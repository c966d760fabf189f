"""Scans of a measured sky on one day, by direction and wavelength."""

from __future__ import annotations

import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError
from airlight.files.input_files import LARGEST_DATA, check_input
from airlight.solver.solution import Solution
from airlight.studies.fit.measurements import Measurements, angle_from_sun

FloatArray = NDArray[np.float64]

#: Full width at half height of the instrument's bands in Kider et al. (2014), by the sun's lines in
#: the scans of 27 May 2013: with 6 nm the ratio to a smooth sky's spectrum scatters by 1.4 % below
#: 660 nm, with the 3 nm of an ASD FieldSpec at 700 nm by 2.9 %. [nm]
BAND_WIDTH: Final = 6.0
#: Full width of the box of the same variance: that times √(12 / (8 ln 2)). [nm]
BOX_WIDTH: Final = 1.471 * BAND_WIDTH


@dataclass(frozen=True, eq=False, kw_only=True)
class Scans:
    """Measured sky radiance, ``ns`` scans of ``nd`` directions at ``nl`` wavelengths.

    Attributes
    ----------
    time : tuple of str, length ns
        Local time of day.
    sun_zenith : array, shape (ns,)
        [deg]
    view_zenith, azimuth : array, shape (ns, nd)
        Zenith angle and azimuth of the view; azimuth 0 is on the sun's side. [deg]
    wavelengths : array, shape (nl,)
        [nm]
    radiance : array, shape (ns, nd, nl)
        [W m⁻² sr⁻¹ nm⁻¹]
    solar_irradiance, ground_albedo : array, shape (nl,)
        Inputs of all published models. [W m⁻² nm⁻¹], [1]
    date : str
        Day of the measurement, ``YYYY-MM-DD``.
    bandwidth : array, shape (nl,)
        Full widths of the bands. [nm]
    """

    time: tuple[str, ...]
    sun_zenith: FloatArray
    view_zenith: FloatArray
    azimuth: FloatArray
    wavelengths: FloatArray
    radiance: FloatArray
    solar_irradiance: FloatArray
    ground_albedo: FloatArray
    date: str = ""

    @property
    def angle_from_sun(self) -> FloatArray:
        """Angle between view and sun, shape (ns, nd). [deg]"""
        return angle_from_sun(self.view_zenith, self.sun_zenith[:, None], self.azimuth)

    def seen(
        self,
        solution: Solution,
        view_zenith: FloatArray | None = None,
        azimuth: FloatArray | None = None,
    ) -> FloatArray:
        """Radiance of a solution in the measured directions, shape (ns, nd, nl).

        Parameters
        ----------
        solution : Solution
            Solution at ``wavelengths``, with the ground at the instrument's altitude.
        view_zenith, azimuth : array, shape (ns, nd), optional
            Other directions than the measured ones. [deg]

        Returns
        -------
        array
            [W m⁻² sr⁻¹ nm⁻¹]
        """
        zenith = self.view_zenith if view_zenith is None else view_zenith
        around = self.azimuth if azimuth is None else azimuth
        got = solution.radiance(
            altitude=0.0, sun_zenith=self.sun_zenith[:, None], view_zenith=zenith, azimuth=around
        )
        return np.asarray(got.values, dtype=np.float64)

    def measurements(self, source: str) -> Measurements:
        """Flat list of radiances in bands, in the order of ``radiance``."""
        shape = self.radiance.shape
        try:
            date = np.full(self.radiance.size, np.datetime64(self.date, "D")) if self.date else None
        except ValueError:
            date = None

        def spread(values: FloatArray) -> FloatArray:
            return np.broadcast_to(values, shape).ravel()

        return Measurements(
            source=source,
            wavelength=spread(self.wavelengths),
            altitude=np.zeros(self.radiance.size),
            sun_zenith=spread(self.sun_zenith[:, None, None]),
            view_zenith=spread(self.view_zenith[..., None]),
            azimuth=spread(self.azimuth[..., None]),
            radiance=self.radiance.ravel(),
            uncertainty=None,
            scan=np.repeat(np.arange(shape[0]), shape[1] * shape[2]),
            scans=self.time,
            bandwidth=np.full(self.radiance.size, BOX_WIDTH),
            date=date,
        )


def read_scan_file(file: Path) -> Scans:
    """Read the scans of one day.

    Parameters
    ----------
    file : Path
        Archive ``.npz`` with ``time`` (ns, such as ``2013-05-27 09.30.00``), ``sun_zenith_deg``
        (ns), ``view_zenith_deg`` and ``relative_azimuth_deg`` (ns, nd), ``wavelength_nm`` (nl),
        ``radiance`` (ns, nd, nl) in W m⁻² sr⁻¹ nm⁻¹, ``solar_irradiance`` and ``ground_albedo``
        (nl).
    """
    check_input(file, LARGEST_DATA)
    try:
        with file.open("rb") as stream, np.load(stream, allow_pickle=False) as stored:
            moments = [str(one) for one in stored["time"]]
            time = tuple(one[11:16].replace(".", ":") for one in moments)
            arrays = {
                ours: np.asarray(stored[theirs], dtype=np.float64)
                for ours, theirs in (
                    ("sun_zenith", "sun_zenith_deg"),
                    ("view_zenith", "view_zenith_deg"),
                    ("azimuth", "relative_azimuth_deg"),
                    ("wavelengths", "wavelength_nm"),
                    ("radiance", "radiance"),
                    ("solar_irradiance", "solar_irradiance"),
                    ("ground_albedo", "ground_albedo"),
                )
            }
    except KeyError as error:
        raise FileError(file, f"has no array {error}") from error
    except (OSError, ValueError, EOFError, MemoryError, zipfile.BadZipFile) as error:
        raise FileError(file, f"cannot be read: {error}") from error
    scans = Scans(time=time, date=moments[0][:10] if moments else "", **arrays)
    shape = scans.radiance.shape
    shapes = {
        "sun_zenith": shape[:1],
        "view_zenith": shape[:2],
        "azimuth": shape[:2],
        "wavelengths": shape[2:],
        "solar_irradiance": shape[2:],
        "ground_albedo": shape[2:],
    }
    if len(shape) != 3 or len(time) != shape[0]:
        raise FileError(file, f"radiance is {shape} for {len(time)} scans")
    for name, expected in shapes.items():
        if arrays[name].shape != expected:
            raise FileError(file, f"{name} is {arrays[name].shape}, not {expected}")
    for name, values in arrays.items():
        if not np.isfinite(values).all():
            raise FileError(file, f"{name} contains a value that is not a number")
    return scans
