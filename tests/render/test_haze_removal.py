"""Pictures without haze against lines of sight, and where haze remains."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import Camera, ParameterError, Scene, load_planet, render
from airlight.cli import main
from airlight.render.pixels.view_uniforms import ORDERS
from airlight.scene.frame import Frame
from airlight.scene.metering import dehazed_exposure
from airlight.solver.moments.solution import MomentsSolution


@pytest.fixture(scope="module")
def solution(solved: Callable[..., Any]) -> MomentsSolution:
    """Earth at preview quality."""
    found: MomentsSolution = solved(load_planet("earth-atmosphere-plus"), quality="preview")
    return found


def _frame(
    solution: MomentsSolution,
    dehaze: float,
    sun_zenith: float = 40.0,
    altitude: float = 4e5,
    **camera: Any,
) -> Frame:
    seen = Camera(width=24, height=16, dehaze=dehaze, **camera)
    return render(solution, Scene(altitude=altitude, sun_zenith=sun_zenith, camera=seen))


def test_what_is_removed_is_path_radiance_where_the_ground_is_seen(
    solution: MomentsSolution,
) -> None:
    # f T L of lines of sight, a second method; the look-up table is accurate to a per cent
    camera: dict[str, Any] = {"look_zenith": 150.0, "look_azimuth": 60.0, "field_of_view": 30.0}
    lost = _frame(solution, 0.0, **camera).rgb - _frame(solution, 0.7, **camera).rgb
    seen = Camera(width=24, height=16, **camera).directions()
    x, y, z = np.moveaxis(seen[[2, 9], [3, 20]], -1, 0)
    bottom = solution.medium.bottom_radius
    near = -(bottom + 4e5) * z
    distance = near - np.sqrt(near**2 - 4e5 * (2.0 * bottom + 4e5))
    zenith = np.degrees(np.arccos(z))
    lines, _axes = solution.lines_of_sight(
        altitude=4e5, sun_zenith=40.0, view_zenith=zenith, azimuth=np.degrees(np.arctan2(-y, x))
    )
    path, _whole = solution.path_and_total_radiance(lines, int(ORDERS["all"]))
    clear = solution.transmittance(
        altitude=4e5, view_zenith=zenith, distance=distance * (1.0 - 1e-9)
    )
    wanted = 0.7 * (path * clear.values) @ solution.lights[0].colors()
    assert_allclose(lost[[2, 9], [3, 20]], wanted, rtol=0.02)


@pytest.mark.parametrize(
    "view",
    [
        {"look_zenith": 100.0, "field_of_view": 10.0},  # the limb
        {"look_zenith": 150.0, "sun_zenith": 95.0, "field_of_view": 20.0},  # night and dusk
        {"look_zenith": 150.0, "altitude": 5e4},
    ],
)
def test_sky_dusk_and_views_from_the_air_keep_their_light(
    view: dict[str, float], solution: MomentsSolution
) -> None:
    assert_array_equal(_frame(solution, 0.9, **view).rgb, _frame(solution, 0.0, **view).rgb)


def test_the_exposure_without_haze_is_that_of_a_camera_at_most() -> None:
    # a dark sea is no reason to burn clouds; at dusk and from the air the metering stands
    assert_allclose(dehazed_exposure(3.0, 1.0, 0.5, 0.9, 4e5), 1.8)
    for mu_s, altitude, dehaze in ((-0.1, 4e5, 0.9), (0.5, 2.0, 0.9), (0.5, 4e5, 0.0)):
        assert_allclose(dehazed_exposure(3.0, 1.0, mu_s, dehaze, altitude), 3.0)


def test_pictures_of_radiance_refuse_the_removal_of_haze(
    capsys: pytest.CaptureFixture[str],
) -> None:
    for words in (["a.exr"], ["a.png", "--show", "dolp"]):
        assert main(["render", "earth", "--dehaze", "0.5", "-o", *words]) != 0
        assert "--dehaze does not apply to pictures of radiance" in capsys.readouterr().err


def test_a_fraction_beyond_one_is_refused() -> None:
    with pytest.raises(ParameterError, match=r"camera\.dehaze is 1\.5; allowed: 0 to 1"):
        Camera(dehaze=1.5)
