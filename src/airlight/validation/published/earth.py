"""Earth: illuminance, twilight zenith, colour temperatures, Belt of Venus.

* Seidelmann (1992), IES (1984) and Patat et al. (2006): see ``twilight``.
* American Meteorological Society, Glossary of Meteorology, "civil twilight", "astronomical
  twilight", "antitwilight arch", "dark segment": what clear evenings have, ranges included.
* Hernández-Andrés, Romero, Nieves & Lee (2001), Color and spectral analysis of daylight in southern
  Europe, JOSA A 18, 1325: 2600 spectra of the light on level ground at Granada, under all skies.
* Hernández-Andrés, Romero & Lee (2001), Colorimetric and spectroradiometric characteristics of
  narrow-field-of-view clear skylight in Granada, Spain, JOSA A 18, 412: 1500 spectra of the sky.
* Lee (2015), Measuring and modeling twilight's Belt of Venus, Applied Optics 54, B194.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.image.color_temperature import correlated_color_temperature
from airlight.image.spectral import rgb_weights
from airlight.image.xyz import chromaticity, rgb_to_xyz
from airlight.solver import Solution
from airlight.validation.published.row import PublishedRow, PublishedSection
from airlight.validation.published.twilight import (
    ground_illuminance,
    ground_light,
    illuminance_ies1984,
    illuminance_seidelmann1992,
    paranal_zenith_v,
    zenith_v_patat2006,
)
from airlight.validation.suite import Threshold

FloatArray = NDArray[np.float64]

#: True altitudes of the sun. [deg]
ALTITUDES: Final = (90, 60, 40, 20, 10, 5, 2, 0, -1, -3, -5, -6, -8, -10, -12)
#: Altitudes of the sun to which the target of the illuminance applies [deg], and that target. [%]
AIMED: Final = (-10.0, 5.0)
ILLUMINANCE_TARGET: Final = 25.0
#: Lowest altitude of the sun that is compared with daylight of the IES. [deg]
DAYLIGHT: Final = 10.0
#: Depressions of the sun for the magnitude of the zenith [deg], and its target. [mag]
DEPRESSIONS: Final = (5.0, 6.0, 8.0, 10.0, 12.0)
ZENITH_TARGET: Final = 0.35
#: Altitude of the sun at sunset by the almanac's convention. [deg]
SUNSET: Final = -50.0 / 60.0
#: Altitude of the sun for the colour of daylight. [deg]
DAY: Final = 45.0
#: Altitudes of the sun for the colour of the sky. [deg]
SKIES: Final = (10.0, 30.0, 60.0)
#: Depressions of the sun with a Belt of Venus. [deg]
BELT: Final = (1.0, 2.0, 3.0, 4.0)
#: Elevations at which the belt is sought. [deg]
_ELEVATIONS: Final = np.arange(0.25, 30.1, 0.25)
_AMS: Final = "AMS, Glossary of Meteorology"


def illuminances(solution: Solution, altitudes: Sequence[float] = ALTITUDES) -> PublishedSection:
    """Horizontal illuminance under a clear sky, from noon to the end of nautical twilight.

    Parameters
    ----------
    solution : Solution
        Earth with average aerosol.
    altitudes : sequence of float
        True altitudes of the sun. [deg]
    """
    supplement = "Seidelmann (1992); Urban & Seidelmann (2013), Table 12.8"
    rows, aimed = [], []
    for altitude in altitudes:
        known, ours = illuminance_seidelmann1992(altitude), ground_illuminance(solution, altitude)
        row = PublishedRow(f"illuminance, sun {altitude:g}°", known, ours, supplement, "lx")
        rows.append(row)
        if AIMED[0] <= altitude <= AIMED[1]:
            aimed.append(row.percent)
        if altitude >= DAYLIGHT:
            daylight, name = illuminance_ies1984(altitude), f"daylight, sun {altitude:g}°"
            rows.append(PublishedRow(name, daylight, ours, "IES (1984)", "lx"))
    for altitude, low, high, when in (
        (SUNSET, 410.0, 585.0, "at sunset"),
        (-6.0, 2.0, 3.5, "at the end of civil twilight"),
    ):
        ours, source = ground_illuminance(solution, altitude), f"{_AMS}, civil twilight"
        middle, half, stated = 0.5 * (low + high), 0.5 * (high - low), f"{low:g} to {high:g} lx"
        rows.append(PublishedRow(f"illuminance {when}", middle, ours, source, "lx", half, stated))
    nautical, source = "at the end of nautical twilight", f"{_AMS}, astronomical twilight"
    ours = ground_illuminance(solution, -12.0)
    rows.append(PublishedRow(f"illuminance {nautical}", 0.008, ours, source, "lx"))
    name = f"illuminance, sun {AIMED[1]:+g}° to {AIMED[0]:g}°: largest difference"
    source = "target for an average clear day"
    aim = Threshold(name, max(aimed, default=0.0), ILLUMINANCE_TARGET, "%", source)
    return PublishedSection(
        title="Illuminance of level ground under a clear sky",
        rows=rows,
        aims=[aim] if aimed else [],
        note="Ours has the average continental aerosol of Hess et al. (1998), optical depth 0.151, "
        "since the published numbers are of average clear days; gas bands and the night's own "
        "light are left out, and the ground is the mean of the Earth. The Supplement's curve is of "
        "no single air: over that of the IES it falls from 1.08, sun overhead, to 0.82 at 20°.",
    )


def zeniths(solution: Solution) -> PublishedSection:
    """V magnitude of the zenith at Paranal in twilight; ``solution`` is of preset ``earth``."""
    source, unit = "Patat et al. (2006), Table 1", "mag arcsec⁻²"
    rows = []
    for one in DEPRESSIONS:
        what = f"V of the zenith 2635 m up, sun {-one:g}°"
        known, ours = zenith_v_patat2006(-one), paranal_zenith_v(solution, -one)
        rows.append(PublishedRow(what, known, ours, source, unit, compare="difference"))
    suns = f"{-DEPRESSIONS[0]:g}° to {-DEPRESSIONS[-1]:g}°"
    largest = max(row.departure for row in rows)
    why = "target: the scatter of the nights, 0.18 mag, and that of a night's ozone and dust"
    aim = Threshold(
        f"V of the zenith, sun {suns}: largest difference", largest, ZENITH_TARGET, "mag", why
    )
    note = "Ours with the night's own 21.6 mag arcsec⁻² (Patat 2003)."
    return PublishedSection(title="Zenith in twilight", rows=rows, aims=[aim], note=note)


def colors(average: Solution) -> PublishedSection:
    """Colour temperatures of daylight on the ground and of the clear sky.

    Parameters
    ----------
    average : Solution
        Earth with average aerosol.
    """
    day = correlated_color_temperature(_xyz(average, ground_light(average, DAY)))
    warmest = min(min(sky_temperatures(average, altitude)) for altitude in SKIES)
    warm = "warmest of the clear sky, sun 10 to 60°"
    source = "Hernández-Andrés et al. (2001), JOSA A 18, "
    return PublishedSection(
        title="Colour temperatures",
        rows=[
            PublishedRow(f"light on level ground, sun {DAY:g}°", 5700.0, day, f"{source}1325", "K"),
            PublishedRow(warm, 3800.0, warmest, f"{source}412", "K", stated="3800 K and more"),
        ],
        note="Published for Granada: of level ground the most typical of two years under all "
        "skies, of the clear sky the lowest of 44 directions in seven months, of which the suns "
        "are not known here.",
    )


def sky_temperatures(solution: Solution, altitude: float) -> list[float]:
    """Colour temperatures of sky directions, for a sun altitude [deg]. [K]

    Directions on four meridians at zenith angles of 0 to 85°, more than 5° from the sun.
    """
    view, around = np.meshgrid(np.arange(0.0, 86.0, 17.0), [0.0, 45.0, 90.0, 180.0])
    view, around = view.ravel(), around.ravel()
    far = (around != 0.0) | (np.abs(view - (90.0 - altitude)) > 5.0)
    sky = solution.radiance(
        altitude=0.0, sun_zenith=90.0 - altitude, view_zenith=view[far], azimuth=around[far]
    ).values
    return [
        correlated_color_temperature(one)
        for one in _xyz(solution, sky / solution.lights[0].irradiance)
    ]


def belts(solution: Solution) -> PublishedSection:
    """Dark segment and Belt of Venus as functions of solar depression."""
    found = [antitwilight(solution, one) for one in BELT]
    source = f"{_AMS}, dark segment; Lee (2015)"
    rows = [
        PublishedRow(
            f"top of the dark segment, sun {-one:g}°",
            one,
            top,
            source,
            "°",
            None,
            f"above {one:g}°",
        )
        for one, (top, _) in zip(BELT, found, strict=True)
    ]
    below = Threshold(
        "Belt of Venus: depressions at which the dark segment is below the antisolar point",
        sum(not row.ours > row.published for row in rows),
        0,
        source=f"{_AMS}: it is always higher than the sun is low",
    )
    reddest = ", ".join(f"{belt:.1f}" for _, belt in found)
    return PublishedSection(
        title="Belt of Venus",
        rows=rows,
        aims=[below],
        note="The dark segment ends where the sky's chromaticity x rises fastest; the belt, where "
        f"x is largest, stands above it, at {reddest}°.",
    )


def antitwilight(solution: Solution, depression: float) -> tuple[float, float]:
    """Elevations of the dark segment's top and of the Belt of Venus opposite the sun.

    Parameters
    ----------
    depression : float
        Depression of the sun. [deg]

    Returns
    -------
    top, belt : float
        See ``rise_and_maximum``, of the chromaticity x. [deg]
    """
    sky = solution.radiance(
        altitude=0.0, sun_zenith=90.0 + depression, view_zenith=90.0 - _ELEVATIONS, azimuth=180.0
    ).values
    x = chromaticity(_xyz(solution, sky / solution.lights[0].irradiance))[:, 0]
    return rise_and_maximum(_ELEVATIONS, x)


def rise_and_maximum(elevations: FloatArray, x: FloatArray) -> tuple[float, float]:
    """Elevations of a curve's uppermost maximum and of the steepest rise below it.

    The rise begins at the minimum below the maximum, as the sky reddens towards the horizon.

    Parameters
    ----------
    elevations, x : array, shape (n,)
        Equidistant elevations, ascending [deg], and chromaticities [1].

    Returns
    -------
    rise, maximum : float
        NaN if the curve has no maximum between its ends. [deg]

    Examples
    --------
    >>> at = np.arange(0.0, 10.0, 0.5)
    >>> rise_and_maximum(at, np.sin(np.pi * (at - 2.25) / 4.5))  # up at 2.25, largest at 4.5
    (2.25, 4.5)
    >>> rise_and_maximum(at, np.sin(np.pi * (at - 2.25) / 4.5) + 9.0 * (at == 0.0))
    (2.25, 4.5)
    >>> rise_and_maximum(at, -at)
    (nan, nan)
    """
    inside = np.flatnonzero((x[1:-1] > x[:-2]) & (x[1:-1] >= x[2:])) + 1
    if not inside.size:
        return float("nan"), float("nan")
    belt = int(inside[-1])
    bluest = int(x[:belt].argmin())
    steepest = bluest + int(np.diff(x[bluest : belt + 1]).argmax())
    return float(elevations[steepest : steepest + 2].mean()), float(elevations[belt])


def _xyz(solution: Solution, relative: FloatArray) -> FloatArray:
    """Tristimulus values of radiance over the star's irradiance, shape (..., 3)."""
    light = solution.lights[0]
    weights = rgb_weights(solution.wavelengths, light.spectrum)
    return np.asarray(rgb_to_xyz(relative * light.irradiance @ weights))
