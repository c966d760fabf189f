"""The sea of a picture against Monte Carlo, which mirrors every direction of the sky."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Camera, Scene, load_planet, solve
from airlight.render import render
from airlight.solver.montecarlo.settings import MonteCarloSettings

SEA = {"ground.law": "water", "ground.albedo": 0.02, "ground.wind": "5 m/s"}
#: Altitude, zenith angle and azimuth of lines that end on the sea, away from the glitter.
LINES = [(200.0, 92.0, 90.0), (200.0, 100.0, 90.0), (200.0, 120.0, 120.0), (200.0, 95.0, 180.0),
         (200.0, 160.0, 180.0), (400e3, 150.0, 180.0), (400e3, 112.0, 90.0)]  # fmt: skip
#: Footprint of a pixel that resolves no waves of this wind. [m]
FOOTPRINT = 70.0


@pytest.mark.slow
@pytest.mark.parametrize("sun", [50.0, 85.0])
def test_the_sea_is_as_bright_as_by_monte_carlo(sun: float) -> None:
    # The second method draws directions: no fit, no sky-view LUT. Its rare bright paths leave
    # an error of 8 % near the horizon, 2 % elsewhere.
    planet, nm = load_planet("earth-atmosphere-plus", SEA), (550.0,)
    solution = solve(planet, nm, quality="default")
    judge = solve(
        planet, nm, solver="montecarlo",
        quality=MonteCarloSettings(relative_error=0.02, most_histories=200_000),
    )  # fmt: skip
    green = float(solution.lights[0].colors()[0, 1])
    for altitude, view, azimuth in LINES:
        pixel = np.degrees(FOOTPRINT * np.cos(np.radians(view)) ** 2 / altitude)
        camera = Camera(width=1, height=1, field_of_view=max(pixel, 0.05), look_zenith=view,
                        look_azimuth=azimuth)  # fmt: skip
        scene = Scene(camera=camera, altitude=altitude, sun_zenith=sun)
        wanted = judge.relative_radiance(judge.lines_of_sight(
            altitude=altitude, sun_zenith=sun, view_zenith=view, azimuth=azimuth)[0])  # fmt: skip
        seen = render(solution, scene, exact=True).rgb[0, 0, 1]
        assert_allclose(seen / green, np.ravel(wanted)[0], rtol=0.1)
