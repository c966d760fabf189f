"""Air in a moon's shadow: exact limits, the look of totality, and the judgement of histories."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

import airlight
from airlight.solver.eclipsed.solution import EclipsedSolution
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.montecarlo.eclipse import eclipsed_estimate
from airlight.solver.montecarlo.settings import MonteCarloSettings

from .conftest import NM, moon_over


def place(solution: MomentsSolution, beside: float, altitude: float = 2.0) -> np.ndarray:
    """Point at an arc from (0, 0, R) in y. [m]"""
    angle = beside / solution.medium.bottom_radius
    up = np.array([0.0, np.sin(angle), np.cos(angle)])
    return (solution.medium.bottom_radius + altitude) * up


def towards(zenith: float, azimuth: float) -> np.ndarray:
    """Direction at (0, 0, R); azimuth from the sun to the right of an observer facing it. [deg]"""
    z, a = np.radians(zenith), np.radians(azimuth)
    return np.array([np.sin(z) * np.cos(a), -np.sin(z) * np.sin(a), np.cos(z)])


def unshadowed(
    solution: MomentsSolution, elevation: float, zenith: float, azimuth: float, altitude: float
) -> np.ndarray:
    sun = solution.lights[0].irradiance
    return (solution.radiance(altitude=altitude, sun_zenith=90.0 - elevation, view_zenith=zenith,
                              azimuth=azimuth).values / sun)[None]  # fmt: skip


@pytest.mark.parametrize(("zenith", "azimuth", "altitude"), [
    (30.0, 60.0, 2.0), (88.0, 200.0, 2.0), (110.0, 120.0, 3e4), (170.0, 40.0, 9e4),
])  # fmt: skip
def test_a_tiny_moon_leaves_the_unshadowed_light(
    earth: MomentsSolution, zenith: float, azimuth: float, altitude: float
) -> None:
    eclipsed = EclipsedSolution(earth, moon_over(earth, 20.0, size=0.005), cache=True)
    point = np.array([0.0, 0.0, earth.medium.bottom_radius + altitude])
    got = eclipsed.relative_radiance(point, towards(zenith, azimuth))
    assert_allclose(got, unshadowed(earth, 20.0, zenith, azimuth, altitude), rtol=1e-3)


def test_a_moon_beside_the_sun_changes_nothing(earth: MomentsSolution) -> None:
    # So far to the side that its penumbra passes the planet.
    eclipsed = EclipsedSolution(earth, moon_over(earth, 20.0, beside=2e7), cache=False)
    assert not eclipsed.shadow.field.any()
    point = np.array([0.0, 0.0, earth.medium.bottom_radius + 2.0])
    got = eclipsed.relative_radiance(point, towards(70.0, 90.0))
    assert_allclose(got, unshadowed(earth, 20.0, 70.0, 90.0, 2.0), rtol=1e-4)


def test_totality_is_darkest_at_the_zenith_and_orange_at_the_horizon(
    totality: EclipsedSolution,
) -> None:
    earth = totality.solution
    point = np.array([0.0, 0.0, earth.medium.bottom_radius + 2.0])
    zeniths = np.array([0.0, 30.0, 60.0, 80.0, 88.0])
    for azimuth in (0.0, 90.0, 180.0):
        views = np.stack([towards(z, azimuth) for z in zeniths])
        sky = totality.relative_radiance(np.tile(point, (5, 1)), views)
        # Shaw (1975), doi:10.1364/AO.14.000388: a minimum about the zenith.
        assert np.all(np.diff(sky[1:, 1]) > 0.0)
        assert sky[0, 1] < 1.5 * sky.min(axis=0)[1]
        assert sky[-1, 1] / sky[-1, 0] > 2.0 * sky[0, 1] / sky[0, 0]
    # Emde & Mayer (2007), doi:10.5194/acp-7-2259-2007: three to four orders below the day.
    day = unshadowed(earth, 45.0, 0.0, 0.0, 2.0)
    ratio = day / totality.relative_radiance(point, towards(0.0, 0.0))
    assert np.all((ratio > 1e3) & (ratio < 1e4))


def test_the_sky_of_a_symmetric_shadow_is_symmetric(totality: EclipsedSolution) -> None:
    point = np.array([0.0, 0.0, totality.solution.medium.bottom_radius + 2.0])
    left, right = (totality.relative_radiance(point, towards(75.0, side)) for side in (50.0, -50.0))
    assert_allclose(left, right, rtol=1e-3)


def test_the_ground_in_the_penumbra_has_the_stars_visible_part(totality: EclipsedSolution) -> None:
    earth = totality.solution
    far = place(earth, 1500e3)[None]
    star, sky = totality.relative_ground_irradiance(far)
    r = np.array([earth.medium.bottom_radius])
    cosine = far[0] @ [np.sqrt(0.5), 0.0, np.sqrt(0.5)] / np.linalg.norm(far)
    whole = earth.relative_direct_irradiance(r, np.array([cosine]))
    part = star / whole
    assert np.all((part > 0.3) & (part < 0.6))
    assert part[0, 1] > part[0, 0]  # the sun's rim is redder
    day = earth.relative_sky_irradiance(r, np.array([cosine]))
    assert_allclose(sky / day, part, rtol=0.02)  # Sharp et al. (1971): a sky of a dimmer sun


def test_penumbra_against_histories(totality: EclipsedSolution) -> None:
    check(totality, [(500e3, 0.0, 0.0)], 0.05, 60_000)


@pytest.mark.validation
@pytest.mark.parametrize("elevation", [20.0, 60.0])
def test_shadow_against_histories(elevation: float) -> None:
    # Scalar transfer on both sides: the light that a shadow leaves is not polarised transfer's.
    solution = airlight.solve(airlight.load_planet("earth"), NM, polarisation=False)
    eclipsed = EclipsedSolution(solution, moon_over(solution, elevation))
    views = [(0.0, 0.0), (85.0, 0.0), (85.0, 100.0), (85.0, 180.0)]
    check(eclipsed, [(y, *v) for y in (0.0, 40e3) for v in views], 0.2, 600_000, elevation)
    check(eclipsed, [(y, *v) for y in (150e3, 1000e3) for v in views], 0.05, 300_000, elevation)


def check(
    eclipsed: EclipsedSolution, cases: list[tuple[float, float, float]], allowed: float,
    histories: int, elevation: float = 45.0,
) -> None:  # fmt: skip
    """Compare lines of sight, at an arc from the umbra's centre, with histories of fixed seed."""
    solution = eclipsed.solution
    planet = airlight.load_planet("earth")
    judge = airlight.solve(
        planet, NM, solver="montecarlo",
        quality=MonteCarloSettings(
            relative_error=0.002, most_histories=histories,
            polarisation=solution.settings.polarisation,
        ),
    )  # fmt: skip
    star = moon_over(solution, elevation)
    points = np.stack([place(solution, y) for y, *_ in cases])
    views = []
    for (_, zenith, azimuth), point in zip(cases, points, strict=True):
        up = point / np.linalg.norm(point)
        side = np.array([0.0, up[2], -up[1]])
        x, y, z = towards(zenith, azimuth)
        views.append(x * np.array([1.0, 0.0, 0.0]) + y * side + z * up)
    got = eclipsed.relative_radiance(points, np.stack(views))
    judged = eclipsed_estimate(judge, star, points, np.stack(views))
    error = np.abs(got / judged.total - 1.0)
    sure = 3.0 * judged.total_error / judged.total
    assert np.all(error < allowed + sure), (cases, got / judged.total)
