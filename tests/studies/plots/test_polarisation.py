"""Polarisation in figures: neutral points, colours of angles, pictures with a legend."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

pytest.importorskip("matplotlib")

from airlight.errors import ParameterError
from airlight.image.encoding import srgb_decode
from airlight.image.oklab import rgb_to_oklab
from airlight.scene.frame import Frame
from airlight.solver.solution import Solution
from airlight.studies.observables.neutral_points import neutral_points
from airlight.studies.plots.polarisation import polarisation_dome, polarisation_plane
from airlight.studies.plots.polarised_picture import angle_colors, is_lit, polarised_picture


def test_neutral_points_lie_where_they_were_seen_and_have_no_q(solution: Solution) -> None:
    # Coulson 1988, section 4.4: some 10° to 30° from the sun and from the point opposite to it
    sun = 75.0
    points = neutral_points(solution, sun_zenith=sun)
    for name, origin, side in (("Babinet", sun, -1.0), ("Arago", sun - 180.0, 1.0)):
        seen = points[name][np.isfinite(points[name])]
        assert seen.size > 0
        assert np.all((side * (seen - origin) > 5.0) & (side * (seen - origin) < 35.0))
    babinet = points["Babinet"][-1]
    light = solution.radiance(altitude=0, sun_zenith=sun, view_zenith=babinet, stokes=True)
    i, q, u = np.asarray(light)[:, -1]
    assert abs(q) < 2e-4 * i  # between nodes a quarter of a degree apart
    assert abs(u) < 1e-6 * i  # by symmetry
    # the sun at the zenith has one above the horizon on each side, or none: it is Babinet's
    assert np.all(np.isnan(neutral_points(solution, sun_zenith=0.0)["fourth"]))


def test_marks_stand_at_the_neutral_points_and_are_named(solution: Solution) -> None:
    figure = polarisation_plane(solution, sun_zenith=75.0)
    points = neutral_points(solution, sun_zenith=75.0)
    marked = [
        np.asarray(line.get_xdata()) for line in figure.axes[0].lines if line.get_marker() == "o"
    ]
    assert_array_equal(np.transpose(marked), np.array(list(points.values())))
    words = " ".join(text.get_text() for text in figure.axes[0].texts)
    assert "Babinet" in words
    assert "Arago" in words


def test_bars_of_a_dome_swing_across_the_line_to_the_sun(solution: Solution) -> None:
    # far from the sun light swings at right angles to the plane of line and sun, to a few degrees
    sun = 60.0
    figure = polarisation_dome(solution, sun_zenith=sun)
    (bars,) = [one for one in figure.axes[0].collections if hasattr(one, "get_segments")]
    tested = 0
    for start, end in bars.get_segments():
        x, y = 0.5 * (start + end)
        along = end - start
        zenith, turn = np.radians(np.hypot(x, y)), np.arctan2(x, -y)
        away = np.sin(zenith) * np.sin(np.radians(sun)) * np.cos(turn)
        if abs(away + np.cos(zenith) * np.cos(np.radians(sun))) > 0.35 or not np.any(along):
            continue
        # line of sight, e to larger azimuths and down, in axes to the sun, right and up
        line = np.array(
            [np.sin(zenith) * np.cos(turn), np.sin(zenith) * np.sin(turn), np.cos(zenith)]
        )
        right = np.array([-np.sin(turn), np.cos(turn), 0.0])
        upward = np.cross(line, right) * np.sign(np.cross(line, right)[2])
        inward = np.array([-np.sin(turn), np.cos(turn)])  # the zenith's side in the figure
        beside = np.array([inward[1], -inward[0]])
        swing = upward * (along @ inward) + right * (along @ beside)
        swing = swing / np.linalg.norm(swing)
        star = np.array([np.sin(np.radians(sun)), 0.0, np.cos(np.radians(sun))])
        assert abs(swing @ star) < 0.12
        tested += 1
    assert tested > 20


def test_colors_of_angles_have_one_lightness_and_meet_at_both_ends() -> None:
    angles = np.linspace(-90.0, 90.0, 73)
    colors = angle_colors(angles)
    lab = rgb_to_oklab(srgb_decode(colors))
    assert np.ptp(lab[:, 0]) < 1e-6  # nothing is clipped by the gamut
    steps = np.linalg.norm(np.diff(lab, axis=0), axis=-1)
    assert_allclose(steps, steps[0], rtol=1e-5)
    assert_allclose(colors[0], colors[-1], atol=1e-12)


def test_pictures_are_dark_without_light_and_angles_fade_with_the_degree() -> None:
    rgb = np.ones((4, 240, 3), np.float32)
    polarised = np.zeros((2, 4, 240, 3), np.float32)
    rgb[0], polarised[0, 1], polarised[1, 2] = 0.0, -0.5, 0.01
    frame = Frame(rgb=rgb, polarised=polarised)
    degree, angle = (polarised_picture(frame, show)[:4, 0] for show in ("dolp", "aolp"))
    assert_array_equal(degree[0], 0)
    assert_array_equal(degree[3], [68, 1, 84])  # viridis at 0
    assert_array_equal(angle[[0, 3]], 0)
    assert_allclose(angle[1], 255.0 * angle_colors(90.0), atol=0.51)
    assert_allclose(angle[2], 127.5 * angle_colors(45.0), atol=0.51)  # 1 % of 2 %
    with pytest.raises(ParameterError, match="width is 100; allowed: 240 pixels or more"):
        polarised_picture(Frame(rgb=rgb[:, :100], polarised=polarised[:, :, :100]), "dolp")
    with pytest.raises(ParameterError, match=r"frame\.polarised is None; allowed: Q and U"):
        polarised_picture(Frame(rgb=rgb), "dolp")


def test_scalar_light_has_no_such_figure(known_light: Callable[..., Solution]) -> None:
    plain = known_light(lambda lines, order: np.ones(lines.r.size))
    with pytest.raises(ParameterError, match="stokes is True; allowed: a solution with polarised"):
        polarisation_dome(plain)


def test_towns_of_the_night_side_are_dark_beside_the_day() -> None:
    # Unpolarised and a hundred million times fainter; by night alone the same light is seen. The
    # disc of a star, unpolarised too, does not make its sky dark.
    day, town, disc = (900.0, 300.0, 0.0), (1e-5, 0.0, 0.0), (1e8, 0.0, 0.0)
    assert is_lit(np.transpose([day, town, disc])).tolist() == [True, False, True]
    assert is_lit(np.transpose([town, (1e-12, 0.0, 0.0)])).tolist() == [True, False]
