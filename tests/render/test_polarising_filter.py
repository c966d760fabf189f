"""Pictures through a polarising filter, and of Q and U, against lines of sight and Malus's law."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Camera, ParameterError, Scene, load_planet, render, replace, solve
from airlight.image.xyz import luminance
from airlight.solver.moments.solution import MomentsSolution


@pytest.fixture(scope="module")
def solution(solved: Callable[..., Any]) -> MomentsSolution:
    """Earth at preview quality."""
    found: MomentsSolution = solved(load_planet("earth-atmosphere-plus"), quality="preview")
    return found


def _scene(**camera: Any) -> Scene:
    seen = Camera(width=40, height=24, look_zenith=70.0, look_azimuth=-60.0, **camera)
    return Scene(altitude=200.0, sun_zenith=65.0, camera=seen)


def test_a_picture_of_q_and_u_has_those_of_its_lines(solution: MomentsSolution) -> None:
    # the angles of a pixel, given to ``radiance``; both sides of the sun
    for turn in (100.0, -100.0):
        scene = _scene()
        scene = replace(scene, camera=replace(scene.camera, look_azimuth=turn))
        frame = render(solution, scene, stokes=True, exact=True, disc=False)
        assert frame.polarised is not None
        x, y, z = scene.camera.directions()[5, 7]
        lines = solution.radiance(
            altitude=200.0, sun_zenith=65.0, view_zenith=np.degrees(np.arccos(z)),
            azimuth=np.degrees(np.arctan2(-y, x)), stokes=True,
        )  # fmt: skip
        weights = solution.lights[0].colors() / solution.lights[0].irradiance[:, None]
        wanted = lines.values @ weights
        got = np.stack([frame.rgb[5, 7], *frame.polarised[:, 5, 7]])
        assert_allclose(got, wanted, atol=2e-3 * np.abs(wanted[0]).max())
        assert abs(luminance(wanted[2])) > 0.05 * luminance(wanted[0])  # the sign of U is tested


@pytest.mark.parametrize("azimuth", [100.0, -100.0])
def test_a_filter_sees_the_stokes_parameters_of_its_line(
    azimuth: float, solution: MomentsSolution
) -> None:
    # ½ (I + Q cos 2α + U sin 2α), where the camera's up lies in the meridian plane of its axis
    lines = solution.radiance(
        altitude=200.0, sun_zenith=65.0, view_zenith=70.0, azimuth=azimuth, stokes=True
    )
    weights = solution.lights[0].colors() / solution.lights[0].irradiance[:, None]
    i, q, u = lines.values @ weights
    for angle in (0.0, 30.0, 75.0, 130.0):
        camera = Camera(
            width=3, height=3, field_of_view=0.01, look_zenith=70.0, look_azimuth=azimuth,
            polariser=angle,
        )  # fmt: skip
        scene = Scene(altitude=200.0, sun_zenith=65.0, camera=camera)
        seen = render(solution, scene, exact=True, disc=False).rgb[1, 1]
        turn = 2.0 * np.radians(angle)
        wanted = 0.5 * (i + q * np.cos(turn) + u * np.sin(turn))
        assert_allclose(seen, wanted, atol=1e-3 * np.abs(i).max())
    assert abs(luminance(u)) > 0.05 * luminance(i)  # a wrong sense of turning is 25 times the bound


@pytest.mark.parametrize("azimuth", [0.0, 90.0, -40.0])
@pytest.mark.parametrize("end", [0.0, 180.0])
def test_a_vertical_line_is_the_limit_of_lines_around_it(
    azimuth: float, end: float, solution: MomentsSolution
) -> None:
    # all orders; a vertical line has an azimuth by its frame alone
    tilts = np.array([0.0, 1e-5, 1e-4, 1e-2])
    lines = solution.radiance(
        altitude=30e3, sun_zenith=70.0, view_zenith=np.abs(end - tilts), azimuth=azimuth,
        stokes=True,
    )  # fmt: skip
    assert_allclose(lines.values, lines.values[3:].repeat(4, 0), rtol=2e-3, atol=1e-4)


@pytest.mark.parametrize("exact", [False, True])
def test_filters_at_right_angles_let_all_light_through(
    exact: bool, solution: MomentsSolution
) -> None:
    # an identity of the ideal filter, wherever the camera looks; and Malus's cosine between them
    whole = render(solution, _scene(), exact=exact).rgb
    parts = {
        angle: render(solution, _scene(polariser=angle), exact=exact).rgb.astype(float)
        for angle in (0.0, 30.0, 60.0, 90.0)
    }
    assert_allclose(parts[0.0] + parts[90.0], whole, rtol=2e-6, atol=1e-6 * whole.max())
    mean, swing = 0.5 * (parts[0.0] + parts[90.0]), 0.5 * (parts[0.0] - parts[90.0])
    aslant = (parts[30.0] - mean - 0.5 * swing) / np.sin(np.radians(60.0))
    expected = mean - 0.5 * swing + aslant * np.sin(np.radians(120.0))
    assert_allclose(parts[60.0], expected, rtol=1e-5, atol=1e-5 * whole.max())
    assert luminance(parts[0.0] - parts[90.0]).max() > 0.2 * luminance(whole).max()


def test_the_table_of_the_sky_keeps_the_degree(solution: MomentsSolution) -> None:
    # the same picture marched; the zenith, where all azimuths meet, is in it
    scene = Scene(
        altitude=2.0, sun_zenith=50.0, camera=Camera(projection="fisheye", width=300, height=300)
    )
    quick, exact = (render(solution, scene, stokes=True, exact=one) for one in (False, True))
    for one in (quick, exact):
        assert one.polarised is not None
    bright = luminance(exact.rgb)
    seen = bright > 0.0
    apart = luminance(quick.polarised - exact.polarised)[:, seen] / bright[seen]
    assert np.abs(apart).max() < 2e-3


def test_a_filter_needs_polarised_light() -> None:
    scalar = solve(load_planet("earth-atmosphere-plus"), quality="preview", polarisation=False)
    with pytest.raises(ParameterError, match=r"camera\.polariser is 30\.0; allowed: a solution"):
        render(scalar, _scene(polariser=30.0))
    with pytest.raises(ParameterError, match="stokes is True"):
        scalar.radiance(altitude=0.0, sun_zenith=30.0, view_zenith=60.0, azimuth=90.0, stokes=True)
    with pytest.raises(ParameterError, match=r"camera\.polariser is 500\.0; allowed: -360 to 360"):
        Camera(polariser=500.0)


def test_a_filter_takes_one_stop_and_what_it_darkens_stays_darker(
    solution: MomentsSolution,
) -> None:
    # grey is shown as without it, at any angle, as by the filter factor 2 of an ideal polariser;
    # at 90° from the sun the picture of the sky is darker at one angle than at the other
    plain = render(solution, _scene())
    shown = []
    for angle in (0.0, 60.0, 90.0, 150.0):
        frame = render(solution, _scene(polariser=angle))
        assert_allclose(frame.exposure, plain.exposure + 1.0, atol=1e-9)
        shown.append(2.0**frame.exposure * luminance(frame.rgb.astype(float)).mean())
    assert min(shown) < 0.8 * max(shown)
    unfiltered = 2.0**plain.exposure * luminance(plain.rgb.astype(float)).mean()
    assert min(shown) < unfiltered < max(shown)
