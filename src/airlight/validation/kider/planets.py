"""Atmosphere above Ithaca on a measured day: published and improved inputs."""

from __future__ import annotations

import datetime
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import FileError
from airlight.physics.constants import ASTRONOMICAL_UNIT
from airlight.physics.optics.gas_absorption import column_from_dobson, ozone_profile_afgl1986
from airlight.physics.optics.legendre import phase_integral
from airlight.physics.spectra.sun import solar_irradiance
from airlight.planets import Constituent, Ground, Planet, Star
from airlight.planets.matter.absorbers import OzoneAbsorption
from airlight.planets.matter.gases import GasScattering, RefractiveScattering
from airlight.planets.matter.phases import (
    CornetteShanks,
    DoubleHenyeyGreenstein,
    PhaseFunction,
    Rayleigh,
    TabulatedPhase,
)
from airlight.planets.matter.profiles import Exponential, Tabulated
from airlight.planets.spectral import PerWavelength
from airlight.studies.fit.scans import BAND_WIDTH, Scans
from airlight.validation.reference_files import read_table

FloatArray = NDArray[np.float64]

#: Mean temperature of AFGL's ozone in the U.S. Standard Atmosphere, 1976. [K]
OZONE_TEMPERATURE: Final = 225.0
#: File of the aerosol's phase function of that day, measured 500 km away; AERONET.
FILE: Final = "aeronet-egbert-2013-05-27-phase-function.csv"
#: Allowed relative deviation of its integral over the sphere from 4π. [1]
_INTEGRAL_OFF: Final = 0.05

#: Pressure at sea level, and 270 m above it, the altitude of the instrument. U.S. Standard
#: Atmosphere 1976. [Pa]
SEA_LEVEL: Final = 101_325.0
SITE: Final = SEA_LEVEL * (1.0 - 2.255_77e-5 * 270.0) ** 5.255_88
#: Distance from the sun on that day: 1.00014 - 0.01671 cos g - 0.00014 cos 2g au with g = 140.3°;
#: the Astronomical Almanac's low-precision formula. [m]
SUN_DISTANCE: Final = 1.0133 * ASTRONOMICAL_UNIT
#: Day of these figures.
DAY: Final = "2013-05-27"
#: Ozone column of the profile used: Anderson et al. (1986), AFGL-TR-86-0110. [DU]
OZONE: Final = 345.0


@dataclass(frozen=True, kw_only=True)
class AngstromLaw:
    """Ångström's law of the aerosol's optical depth, τ = β λ^-α with λ in µm.

    Attributes
    ----------
    beta, alpha : float
        [1]
    """

    beta: float
    alpha: float

    def optical_depth(self, wavelengths: ArrayLike) -> FloatArray:
        """Vertical optical depth at wavelengths [nm], shape (...). [1]

        Examples
        --------
        >>> f"{float(AngstromLaw(beta=0.04, alpha=0.8).optical_depth(1000.0)):.3f}"
        '0.040'
        """
        return np.asarray(self.beta * (np.asarray(wavelengths, dtype=float) / 1e3) ** -self.alpha)


#: Ångström law of all published models: Bruneton (2017), section 3.
PUBLISHED_AEROSOL: Final = AngstromLaw(beta=0.04, alpha=0.8)
#: Ångström law measured 500 km away that morning: optical depth at 440 nm 0.1139, 0.1180, 0.1245,
#: 0.1252, 0.1283, and Ångström exponent from 440 to 870 nm 1.175, 1.119, 0.999, 0.929, 0.862, means
#: of the five almucantars of the phase function. AERONET, Egbert, level 1.5, version 2; PI:
#: N. O'Neill, I. Abboud, V. Fioletov.
AERONET_AEROSOL: Final = AngstromLaw(beta=0.12199 * 0.44**1.0166, alpha=1.0166)
#: Single-scattering albedo of all published models; AERONET retrieved none.
PUBLISHED_ALBEDO: Final = 0.8
#: Single-scattering albedo of clean continental air: Hess, Koepke & Schult (1998), BAMS 79, 831,
#: Table 4, at 550 nm.
CLEAN_ALBEDO: Final = 0.972


@dataclass(frozen=True, kw_only=True)
class Inputs:
    """Inputs of a planet; default: those of all published models.

    Attributes
    ----------
    measured_sun : bool
        Whether the sun's spectrum is averaged over the instrument's bands at the day's distance,
        rather than over the 11.75 nm above each wavelength at 1 au.
    measured_air : bool
        Whether the air has the refractivity of Peck & Reeder, the King factor of Bates and a scale
        height of 8434 m, rather than Penndorf's values and 8 km.
    pressure : float
        Pressure at the ground. [Pa]
    ozone : float
        [DU]
    load : AngstromLaw
        Optical depth of the aerosol.
    single_scattering_albedo : float
        Single-scattering albedo of the aerosol. [1]
    aeronet_phase : bool
        Whether the aerosol has its measured phase function, rather than Cornette and Shanks's with
        g = 0.7.
    lobes : tuple of three floats, or None
        Asymmetries of two Henyey-Greenstein lobes and the weight of the first, instead of either.
    """

    measured_sun: bool = False
    measured_air: bool = False
    pressure: float = SEA_LEVEL
    ozone: float = 0.0
    load: AngstromLaw = PUBLISHED_AEROSOL
    single_scattering_albedo: float = PUBLISHED_ALBEDO
    aeronet_phase: bool = False
    lobes: tuple[float, float, float] | None = None


#: Inputs of all published models.
PUBLISHED_INPUTS: Final = Inputs()
#: Best available inputs of the day.
BEST: Final = Inputs(
    measured_sun=True,
    measured_air=True,
    pressure=SITE,
    ozone=OZONE,
    load=AERONET_AEROSOL,
    aeronet_phase=True,
)


def steps() -> list[tuple[str, Inputs]]:
    """Named inputs, changed one at a time from the published to the best."""
    named_steps: tuple[tuple[str, dict[str, Any]], ...] = (
        ("same inputs as everybody", {}),
        (
            f"sun: {BAND_WIDTH:g} nm bands at 1.0133 au for 11.75 nm means at 1 au",
            {"measured_sun": True},
        ),
        ("air: Peck & Reeder, Bates for Penndorf", {"measured_air": True}),
        (f"air: {SITE / 100:.0f} hPa of the site for 1013", {"pressure": SITE}),
        (f"ozone, {OZONE:g} DU", {"ozone": OZONE}),
        ("aerosol: AERONET's phase function", {"aeronet_phase": True}),
        ("aerosol: AERONET's optical depth and exponent", {"load": AERONET_AEROSOL}),
    )
    inputs, out = PUBLISHED_INPUTS, []
    for name, change in named_steps:
        inputs = replace(inputs, **change)
        out.append((name, inputs))
    return out


def air_refractivity_edlen1953(wavelengths: ArrayLike) -> FloatArray:
    r"""Refractivity of standard air at 15 °C and 101 325 Pa, as in Penndorf's tables.

    .. math:: n - 1 = 10^{-8} \left(6432.8 + \frac{2949810}{146 - \sigma^2}
              + \frac{25540}{41 - \sigma^2}\right), \quad \sigma = 1/\lambda

    Parameters
    ----------
    wavelengths : array, shape (...)
        [nm]

    Returns
    -------
    array, shape (...)
        n - 1. [1]

    References
    ----------
    Edlén (1953), JOSA 43, 339. doi:10.1364/JOSA.43.000339

    Examples
    --------
    >>> from airlight.physics.optics.refractive_index import air_refractivity_peck1972
    >>> difference = air_refractivity_edlen1953(550.0) / air_refractivity_peck1972(550.0) - 1.0
    >>> bool(abs(difference) < 1e-4)  # two measurements of the same air
    True
    """
    squared = (1e3 / np.asarray(wavelengths, dtype=np.float64)) ** 2
    return 1e-8 * (6432.8 + 2_949_810.0 / (146.0 - squared) + 25_540.0 / (41.0 - squared))


def penndorf_scattering(wavelengths: ArrayLike) -> RefractiveScattering:
    """Rayleigh scattering of Penndorf's tables, at 15 °C and sea level.

    Parameters
    ----------
    wavelengths : array, shape (nl,)
        [nm]

    References
    ----------
    Penndorf (1957), JOSA 47, 176: refractivity of Edlén (1953), depolarisation 0.035, molecules
    per volume 2.54743e25 m⁻³. doi:10.1364/JOSA.47.000176

    Examples
    --------
    >>> beta = penndorf_scattering([360.0, 550.0, 700.0]).coefficients([360.0, 550.0, 700.0])
    >>> (1e6 * beta * 288.16 / 273.16).round(2).tolist()  # Table III, 0 °C: 70.45, 12.26, 4.605
    [70.41, 12.25, 4.6]
    """
    nm = np.asarray(wavelengths, dtype=np.float64)
    return RefractiveScattering(
        refractivity=_spectral(nm, air_refractivity_edlen1953(nm)),
        number_density=2.547_43e25,
        depolarisation=0.035,
    )


def sun_distance(date: str) -> float:
    r"""Distance from the sun at noon of a day. [m]

    .. math:: R = 1.00014 - 0.01671 \cos g - 0.00014 \cos 2g, \quad
              g = 357.528° + 0.9856003°\,n

    with n days from J2000.0.

    Parameters
    ----------
    date : str
        ``YYYY-MM-DD``; 27 May 2013 if invalid.

    References
    ----------
    The Astronomical Almanac, page C5, low-precision formulas for the Sun.

    Examples
    --------
    >>> round(sun_distance("2013-05-27") / SUN_DISTANCE, 4)
    1.0
    """
    try:
        days = (datetime.date.fromisoformat(date) - datetime.date(2000, 1, 1)).days
    except ValueError:
        return SUN_DISTANCE
    g = np.radians(357.528 + 0.985_600_3 * days)
    distance = 1.00014 - 0.01671 * np.cos(g) - 0.00014 * np.cos(2.0 * g)
    return float(distance) * ASTRONOMICAL_UNIT


def band_irradiance(wavelengths: ArrayLike, distance: float = SUN_DISTANCE) -> FloatArray:
    """Irradiance of the sun in the instrument's bands, at the distance of the day.

    Parameters
    ----------
    wavelengths : array, shape (nl,)
        Centres of Gaussian bands. [nm]
    distance : float
        Distance from the sun. [m]

    Returns
    -------
    array, shape (nl,)
        [W m⁻² nm⁻¹]
    """
    sigma = BAND_WIDTH / np.sqrt(8.0 * np.log(2.0))
    away = np.linspace(-4.0 * sigma, 4.0 * sigma, 65)
    weights = np.exp(-0.5 * np.square(away / sigma))
    spectrum = solar_irradiance(np.asarray(wavelengths, dtype=np.float64)[:, None] + away)
    mean = np.asarray(spectrum @ (weights / weights.sum()))
    return mean * (ASTRONOMICAL_UNIT / distance) ** 2


def aeronet_file(folder: Path, date: str) -> Path | None:
    """File of the aerosol's phase function on a day, if the folder has one."""
    found = sorted(folder.glob(f"aeronet-*-{date}-phase-function.csv")) if date else []
    return found[0] if found else None


def best_inputs(folder: Path, date: str) -> Inputs:
    """Best inputs of a day.

    Without a measured optical depth or phase function, that of the published models is used.

    Parameters
    ----------
    folder : Path
        Folder of reference data.
    date : str
        ``YYYY-MM-DD``
    """
    if date == DAY:
        return BEST
    measured = aeronet_file(folder, date) is not None
    return replace(BEST, load=PUBLISHED_AEROSOL, aeronet_phase=measured)


def read_aeronet_phase(folder: Path, wavelengths: ArrayLike, date: str = DAY) -> TabulatedPhase:
    """Read the aerosol's phase function retrieved by AERONET, interpolated in wavelength.

    Between the four wavelengths, and beyond the first, log p is linear in log λ at each angle;
    each row is divided by its integral. At 360 nm this extrapolates by 82 nm.

    Parameters
    ----------
    wavelengths : array, shape (n,)
        Ascending. [nm]
    date : str
        Day of the measurement, ``YYYY-MM-DD``.

    Raises
    ------
    FileError
        If the file cannot be read, or is not a table of a phase function normalised to 4π.
    """
    file = aeronet_file(folder, date) or folder / FILE
    headings, table = read_table(file)
    try:
        known = [float(name.removeprefix("p_").removesuffix("nm")) for name in headings[1:]]
    except ValueError as error:
        raise FileError(file, f"is not a table of numbers by wavelength: {error}") from error
    if table.ndim != 2 or table.shape[1] != len(known) + 1 or len(known) < 2:
        raise FileError(file, f"has rows that do not match its {len(known)} wavelengths")
    if not (table[:, 1:] > 0.0).all() or not min(known) > 0.0:
        raise FileError(file, "contains a phase function that is not above 0")
    angles, logs, x = table[:, 0], np.log(table[:, 1:]), np.log(known)
    nm = np.asarray(wavelengths, dtype=np.float64)
    k = np.clip(np.searchsorted(x, np.log(nm)) - 1, 0, len(x) - 2)
    share = (np.log(nm) - x[k]) / (x[k + 1] - x[k])
    log_rows = ((1.0 - share) * logs[:, k] + share * logs[:, k + 1]).T

    def between(nu: FloatArray) -> FloatArray:
        angle = np.degrees(np.arccos(np.clip(nu, -1.0, 1.0)))
        return np.stack([np.exp(np.interp(angle, angles, row)) for row in log_rows])

    integrals = phase_integral(between)
    off = integrals / (4.0 * np.pi) - 1.0
    if not (np.abs(off) <= _INTEGRAL_OFF).all():
        worst = integrals[np.abs(off).argmax()]
        raise FileError(file, f"integrates to {worst:.3f} over the sphere, not to 4π")
    rows = np.exp(log_rows) / integrals[:, None]
    return TabulatedPhase(
        angles=tuple(angles.tolist()),
        rows=tuple(tuple(row) for row in rows.tolist()),
        wavelengths=tuple(nm.tolist()),
    )


def planet(inputs: Inputs, scans: Scans, data: Path) -> Planet:
    """Planet with some inputs, at the wavelengths of the scans.

    Parameters
    ----------
    scans : Scans
        Source of the ground's albedo, and of the sun's irradiance of all published models.
    data : Path
        Folder of the AERONET file.
    """
    nm = scans.wavelengths
    if inputs.measured_air:
        bottom, top = 6371e3, 6471e3
        share = inputs.pressure / SEA_LEVEL
        air = Constituent(
            name="air",
            profile=Exponential(scale_height=8434.0),
            scattering=GasScattering(gas="air", temperature=288.15, pressure=share * SEA_LEVEL),
        )
    else:
        bottom, top = 6360e3, 6420e3
        air = Constituent(
            name="air",
            profile=Exponential(scale_height=8000.0),
            scattering=penndorf_scattering(nm),
            phase_function=Rayleigh(),
        )
    depth, albedo, height = inputs.load.optical_depth(nm), inputs.single_scattering_albedo, 1200.0
    lobe: PhaseFunction = CornetteShanks(asymmetry=0.7)
    if inputs.lobes is not None:
        first, second, weight = inputs.lobes
        lobe = DoubleHenyeyGreenstein(asymmetry_1=first, asymmetry_2=second, weight=weight)
    elif inputs.aeronet_phase:
        lobe = read_aeronet_phase(data, np.union1d(nm[::3], nm[-1:]), scans.date)
    parts = [
        air,
        Constituent(
            name="aerosol",
            profile=Exponential(scale_height=height),
            scattering=_spectral(nm, albedo * depth / height),
            absorption=_spectral(nm, (1.0 - albedo) * depth / height),
            phase_function=lobe,
        ),
    ]
    if inputs.ozone > 0.0:
        altitudes, densities = ozone_profile_afgl1986()
        parts.append(
            Constituent(
                name="ozone",
                profile=Tabulated(
                    altitudes=tuple(altitudes), densities=tuple(densities / densities.max())
                ),
                absorption=OzoneAbsorption(
                    column=column_from_dobson(inputs.ozone), temperature=OZONE_TEMPERATURE
                ),
            )
        )
    at = sun_distance(scans.date)
    irradiance = band_irradiance(nm, at) if inputs.measured_sun else scans.solar_irradiance
    return Planet(
        name=f"Ithaca, {scans.date}".rstrip(", "),
        bottom_radius=bottom,
        top_radius=top,
        ground=Ground(albedo=_spectral(nm, scans.ground_albedo)),
        star=Star(irradiance=_spectral(nm, irradiance), angular_radius=0.263),
        constituents=tuple(parts),
    )


def _spectral(wavelengths: FloatArray, values: FloatArray) -> PerWavelength:
    return PerWavelength(wavelengths=tuple(wavelengths.tolist()), values=tuple(values.tolist()))
