"""Star behind a moon: the table of its visible part, and where points see it."""

from __future__ import annotations

import numpy as np
import pytest

from airlight.errors import ParameterError
from airlight.geometry.disc_overlap import visible_light
from airlight.geometry.occulted_star import OccultedStar, occulted_star, star_visible_fraction
from airlight.kernel import compiled_loop
from airlight.physics.spectra.limb_darkening import solar_darkening

NM = (400.0, 700.0)
SUN = np.radians(0.2638)
MOON = 1737.4e3
REACH = 6.5e6


def star(away: float, **more: float) -> OccultedStar:
    return occulted_star([0.0, 0.0, away], MOON, [0.004, 0.0, 1.0], SUN,
                         darkening=solar_darkening(NM), reach=REACH, **more)  # fmt: skip


@compiled_loop
def _fill(points, eclipse, out):
    for k in range(out.size):
        out[k] = star_visible_fraction(points[k, 0], points[k, 1], points[k, 2], eclipse)


@pytest.mark.parametrize("away", [360e6, 377.4e6, 400e6])  # total, of both kinds, annular
def test_the_table_has_the_overlap_of_the_discs_at_every_sample(away: float) -> None:
    sun_distance = 1.5e11
    eclipse = star(away, distance=sun_distance)
    # Points of the sphere around the shadow's axis, up to its penumbra's edge.
    rng = np.random.default_rng(3)
    across = rng.normal(size=(300, 2)) * np.repeat([3e4, 3e5, 3e6], 100)[:, None]
    across[:, 0] += -0.004 * away
    across *= np.minimum(6.3e6 / np.linalg.norm(across, axis=1), 1.0)[:, None]
    up = np.sqrt(6.371e6**2 - (across**2).sum(axis=1))
    points = np.column_stack([across, up])
    sun = sun_distance * np.array([eclipse.star_x, eclipse.star_y, eclipse.star_z])
    moon = np.array([0.0, 0.0, away])
    expected = []
    for point in points:
        a, b = sun - point, moon - point
        apart = np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b)
        size = np.arcsin(MOON / np.linalg.norm(b))
        expected.append(visible_light(np.degrees(SUN), np.degrees(apart), np.degrees(size),
                                      darkening=solar_darkening(NM)))  # fmt: skip
    for k in range(2):
        got = np.empty(len(points))
        _fill(points, eclipse.lane(k), got)
        exact = np.array(expected)[:, k]
        assert 0.0 <= got.min() < 0.1
        assert got.max() == 1.0
        np.testing.assert_allclose(got, exact, rtol=0.01, atol=5e-5)


def test_a_turned_frame_and_another_scale_change_nothing() -> None:
    eclipse = star(366e6)
    point = np.array([[-1.3e6, 2.0e5, 6.2e6]])
    rng = np.random.default_rng(1)
    axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    here, there = np.empty(1), np.empty(1)
    _fill(point, eclipse.lane(0), here)
    _fill(point @ axes.T / 1.5, eclipse.moved(axes, 1.5).lane(0), there)
    assert 0.01 < here[0] < 0.99
    np.testing.assert_allclose(there, here, rtol=1e-6)


@pytest.mark.parametrize(("field", "arguments"), [
    ("occluder", ([7e6, 0.0, 0.0], MOON, [1.0, 0.0, 0.0], SUN)),
    ("star_radius", ([3.6e8, 0.0, 0.0], MOON, [1.0, 0.0, 0.0], 0.0)),
])  # fmt: skip
def test_moons_in_the_air_and_stars_without_a_disc_are_refused(
    field: str, arguments: tuple[object, ...]
) -> None:
    with pytest.raises(ParameterError, match=field):
        occulted_star(*arguments, darkening=np.ones((1, 1)), reach=REACH)  # type: ignore[arg-type]
