"""The air over a picture: against a picture of the same geometry, and where it must not show."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from scipy.ndimage import binary_erosion

from airlight import AirlightWarning, Camera, ParameterError, Scene, load_planet, render
from airlight.engines.composition import Pinhole, Placement, compose
from airlight.engines.composition.depth import KINDS
from airlight.engines.composition.relight import SurfaceLight
from airlight.solver.moments.solution import MomentsSolution

from .views import directions, distance_to_sphere, looking


def ground_below(solution: MomentsSolution, camera: Pinhole, place: Placement):
    """Distance to the planet's ground, and the ground's own radiance without air before it."""
    bottom = solution.medium.bottom_radius
    centre = np.array([0.0, 0.0, -bottom])
    away = distance_to_sphere(camera, centre, bottom)
    hit = np.isfinite(away)
    points = camera.position - centre + away[hit][:, None] * directions(camera)[hit]
    zenith = np.degrees(np.arccos(np.clip(points @ place.sun / bottom, -1.0, 1.0)))
    received = solution.irradiance(altitude=0.0, sun_zenith=zenith)
    light = np.asarray(received["direct"] + received["diffuse"])
    rgb = np.zeros((*away.shape, 3))
    weights = solution.lights[0].colors() / solution.lights[0].irradiance[:, None]
    rgb[hit] = solution.medium.ground_albedo * light / np.pi @ weights
    return away, rgb


@pytest.mark.parametrize(
    ("altitude", "pitch", "fov", "sun"),
    [(400e3, -30.0, 60.0, 40.0), (36e6, -88.0, 20.0, 30.0), (10e3, -10.0, 60.0, 75.0)],
)
def test_a_ground_composed_is_the_ground_rendered(
    earth: MomentsSolution, altitude: float, pitch: float, fov: float, sun: float
) -> None:
    # the same light twice: there the renderer's own ground, here a picture of it without air
    place = Placement(sun_zenith=sun, sun_azimuth=90.0)
    camera = looking(altitude, pitch, 30.0, field_of_view=fov)
    away, rgb = ground_below(earth, camera, place)
    depth = np.where(np.isfinite(away), away, 1e10)
    got = compose(
        rgb, depth, camera, earth, place, depth_kind="distance", white=None, exact=True
    ).rgb  # fmt: skip
    seen = Camera(
        width=96, height=54, field_of_view=fov, look_zenith=90.0 - pitch, look_azimuth=30.0 - 90.0
    )
    scene = Scene(altitude=altitude, sun_zenith=sun, sun_azimuth=90.0, camera=seen)
    wanted = render(earth, scene, exact=True).rgb
    hit = np.isfinite(away)
    assert 0.3 < hit.mean() < 0.95
    # render takes nine samples of pixels on the horizon; elsewhere the bar is 1 %
    ground = binary_erosion(hit, np.ones((3, 3)))
    assert_allclose(got[ground], wanted[ground], rtol=0.01)
    assert np.median(np.abs(got[ground] / wanted[ground] - 1.0)) < 1e-3
    sky = binary_erosion(~hit, np.ones((3, 3)))
    assert_allclose(got[sky], wanted[sky], rtol=1e-5, atol=1e-6)


def test_a_sphere_before_the_horizon_shows_no_stripe(earth: MomentsSolution) -> None:
    # A grey ball 8 km away hides the horizon. The air before it knows nothing of what is behind,
    # so across the horizon, and along it, its light has no step: neighbours follow a line.
    camera = looking(2000.0, -1.0, 60.0, size=(192, 128), field_of_view=30.0)
    place = Placement(sun_zenith=70.0, sun_azimuth=90.0)
    centre = np.array([8e3 * np.sin(np.radians(60.0)), 8e3 * np.cos(np.radians(60.0)), 1800.0])
    away = distance_to_sphere(camera, centre, 1500.0)
    rgb = np.full((128, 192, 3), 0.05)
    for exact in (True, False):
        got = compose(
            rgb, np.where(np.isfinite(away), away, np.inf), camera, earth, place,
            depth_kind="distance", exact=exact,
        ).rgb  # fmt: skip
        ball = binary_erosion(np.isfinite(away), iterations=25)
        up = directions(camera)[..., 2]
        dip = -np.sqrt(2.0 * 2000.0 / earth.medium.bottom_radius)
        assert (up[ball] > dip).any()
        assert (up[ball] < dip).any()
        for axis in (0, 1):
            bent = np.diff(got, 2, axis=axis) / got.max(axis=-1, keepdims=True).max()
            inner = np.take(ball, range(1, ball.shape[axis] - 1), axis=axis)
            assert np.abs(bent[inner]).max() < 5e-4, (exact, axis)


def test_each_kind_of_depth_gives_the_same_picture(earth: MomentsSolution) -> None:
    # one ball seen by a camera with pixels that are not square, and a centre that is not the middle
    base = looking(20.0, 2.0, 40.0, size=(48, 40))
    camera = Pinhole(
        width=48, height=40, focal_x=60.0, focal_y=50.0, centre_x=20.0, centre_y=23.0,
        to_world=base.to_world,
    )  # fmt: skip
    place = Placement(sun_zenith=60.0, metres_per_unit=10.0)
    centre = camera.position + 300.0 * camera.axes[2]
    away = distance_to_sphere(camera, centre, 120.0)
    hit = np.isfinite(away)
    planar = away / np.linalg.norm(camera.rays(slice(0, 40)), axis=-1)
    points = camera.position + np.where(hit, away, 0.0)[..., None] * directions(camera)
    passes = {
        "distance": np.where(hit, away, 1e10),
        "planar": np.where(hit, planar, np.inf),
        "inverse": np.where(hit, 1.0 / planar, 0.0),
        "position": np.where(hit[..., None], points, 0.0),
    }
    assert set(passes) == set(KINDS) - {"auto"}
    rgb = np.full((40, 48, 3), 0.3)
    pictures = [
        compose(rgb, one, camera, earth, place, depth_kind=kind).rgb for kind, one in passes.items()
    ]
    for other in pictures[1:]:
        assert_allclose(other, pictures[0], rtol=1e-5)
    by_itself = compose(rgb, passes["position"], camera, earth, place).rgb
    assert_allclose(by_itself, pictures[3], rtol=0)


def test_a_pixel_half_covered_is_half_sky(earth: MomentsSolution) -> None:
    # premultiplied colours are linear in the cover, whether the depth saw the surface or missed it
    camera, place = looking(20.0, 10.0, size=(24, 16)), Placement(sun_zenith=50.0)
    depth, rgb, alpha = np.full((16, 24), 900.0), np.full((16, 24, 3), 0.2), np.ones((16, 24))
    whole = compose(rgb, depth, camera, earth, place, alpha=alpha).rgb
    sky = compose(rgb, np.full_like(depth, 1e10), camera, earth, place, alpha=alpha).rgb
    alpha[:, 12], alpha[:, 13:] = 0.5, 0.0
    rgb *= alpha[..., None]
    depth[:, 13:] = 1e10
    for at_edge in (900.0, 1e10):
        depth[:, 12] = at_edge
        got = compose(rgb, depth, camera, earth, place, alpha=alpha).rgb
        assert_allclose(got[:, :12], whole[:, :12], rtol=1e-6)
        assert_allclose(got[:, 13:], sky[:, 13:], rtol=1e-6)
        # the neighbour's depth is planar: 1e-3 of the distance between two pixels at most
        assert_allclose(got[:, 12], 0.5 * (whole + sky)[:, 12], rtol=2e-4)


def test_what_touches_the_camera_keeps_its_colour(earth: MomentsSolution) -> None:
    # an exact limit: no air, no change, in any unit
    camera, place = looking(100.0, -5.0, size=(8, 6)), Placement(sun_zenith=30.0)
    rgb = np.random.default_rng(1).uniform(0.0, 5.0, (6, 8, 3))
    for white in (1.0, 0.25, None):
        got = compose(rgb, np.full((6, 8), 1e-3), camera, earth, place, white=white)
        assert_allclose(got.rgb, rgb, rtol=1e-5, atol=1e-6)


def test_a_white_surface_far_away_is_the_sky_of_its_direction(earth: MomentsSolution) -> None:
    # nothing is left of a black surface beyond the air but the air's own light
    camera, place = looking(100.0, 30.0, size=(8, 6)), Placement(sun_zenith=30.0)
    black = np.zeros((6, 8, 3))
    behind = compose(black, np.full((6, 8), 9e8), camera, earth, place, exact=True).rgb
    sky = compose(black, np.full((6, 8), 1e10), camera, earth, place, exact=True).rgb
    assert_allclose(behind, sky, rtol=1e-4)


def test_froxels_err_by_less_than_their_bar(earth: MomentsSolution) -> None:
    # a plane from 100 m to 20 km, and a wall: by the table and, the judge, pixel by pixel
    camera = looking(60.0, -3.0, 60.0, size=(160, 96), field_of_view=12.0)
    place = Placement(sun_zenith=80.0, sun_azimuth=90.0)
    down = directions(camera)[..., 2]
    away = np.where(down < -0.003, 60.0 / np.maximum(-down, 1e-9), 12e3 / np.cos(down))
    rgb = np.full((96, 160, 3), 0.1)
    fast, slow = (
        compose(rgb, away, camera, earth, place, depth_kind="distance", exact=exact)
        for exact in (False, True)
    )
    assert slow.marched == 1.0
    assert fast.marched < 0.4
    assert 0.0 < fast.error <= 2e-3
    assert_allclose(fast.rgb, slow.rgb, rtol=4e-3)


def test_white_light_is_dimmed_by_the_star_s_mean_transmittance(earth: MomentsSolution) -> None:
    # a white surface has the star's own spectrum: what is left of it is exact
    light = SurfaceLight(earth, 1.0)
    transmittance = np.array([[0.9, 0.7, 0.4], [0.5, 0.5, 0.5]])
    white = np.pi * light.scale[None, :].repeat(2, axis=0)
    assert_allclose(light.through(white, transmittance), transmittance @ light.colors, rtol=1e-6)
    grey = light.through(np.array([[3.0, 2.0, 1.0]]), transmittance[1:])
    assert_allclose(grey, [[1.5, 1.0, 0.5]], rtol=1e-6)


def test_bent_light_reaches_the_same_distance(solved) -> None:
    # By a second method: Solution.transmittance, by quadrature of the profiles along the bent ray.
    solution = solved(load_planet("earth"), (680.0, 550.0, 440.0), "preview")
    assert solution.geometry.shell is not None
    camera, place = looking(500.0, 25.0, size=(8, 6)), Placement(sun_zenith=60.0)
    rays = directions(camera)
    black = np.zeros((6, 8, 3))
    white = np.tile(solution.lights[0].colors().sum(axis=0), (6, 8, 1))
    pictures = [
        compose(one, np.full((6, 8), 30e3), camera, solution, place, depth_kind="distance",
                white=None, exact=True).rgb
        for one in (white, black)
    ]  # fmt: skip
    wanted = solution.transmittance(
        altitude=500.0, view_zenith=np.degrees(np.arccos(rays[..., 2])), distance=30e3
    )
    got = pictures[0] - pictures[1]
    # the march counts forward peaks of the aerosol as unscattered: its transmittance is larger
    expected = np.asarray(wanted) @ solution.lights[0].colors()
    assert (got > 0.99 * expected).all()
    assert_allclose(got[..., 0], expected[..., 0], rtol=0.1)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"rgb": np.zeros((3, 3, 3))}, "rgb is (3, 3, 3)"),
        ({"rgb": np.full((6, 8, 3), np.nan)}, "rgb is nan; allowed: finite"),
        ({"depth": np.zeros((5, 8))}, "depth is (5, 8)"),
        ({"depth": np.zeros((6, 8, 3)), "depth_kind": "planar"}, "depth is (6, 8, 3)"),
        ({"depth_kind": "normalised"}, "depth_kind is 'normalised'; allowed: auto, planar"),
        ({"alpha": np.full((6, 8), 2.0)}, "alpha is 2.0; allowed: 0 to 1"),
        ({"alpha": np.full((6, 8), np.nan)}, "alpha is nan; allowed: 0 to 1; 48 values are not"),
        ({"rgb": np.full((6, 8, 3), np.inf)}, "rgb is inf; allowed: finite numbers; 144 values"),
        (
            {"albedo": np.full((6, 8, 3), 1.5), "normals": np.ones((6, 8, 3))},
            "albedo is 1.5; allow",
        ),
        (
            {"albedo": np.full((6, 8, 3), -0.1), "normals": np.ones((6, 8, 3))},
            "albedo is -0.1; all",
        ),
        ({"albedo": np.zeros((6, 8, 3)), "normals": np.full((6, 8, 3), np.nan)}, "normals is nan"),
        (
            {
                "albedo": np.zeros((6, 8, 3)),
                "normals": np.ones((6, 8, 3)),
                "shadow": np.full((6, 8), np.nan),
            },
            "shadow is nan; allowed: 0 to 1",
        ),
        ({"white": 0.0}, "white is 0.0; allowed: above 0"),
        ({"camera": looking(-5.0, 0.0, size=(8, 6))}, "camera's altitude is '-5 m'"),
    ],
)
def test_bad_input_gets_one_clear_line(earth: MomentsSolution, changes, words: str) -> None:
    given = {
        "rgb": np.zeros((6, 8, 3)), "depth": np.ones((6, 8)),
        "camera": looking(5.0, 0.0, size=(8, 6)), "solution": earth, "place": Placement(),
    } | changes  # fmt: skip
    with pytest.raises(ParameterError) as raised:
        compose(**given)
    assert words in str(raised.value)
    assert "\n" not in str(raised.value)


def test_depth_that_is_no_number_is_sky_and_counted(earth: MomentsSolution) -> None:
    # without a surface a pixel shows the sky of its direction, as where the depth is infinite
    given = {
        "rgb": np.full((6, 8, 3), 0.1), "camera": looking(5.0, 0.0, size=(8, 6)),
        "solution": earth, "place": Placement(),
    }  # fmt: skip
    missing, endless = np.full((6, 8), 100.0), np.full((6, 8), 100.0)
    missing[1, 2:5], endless[1, 2:5] = np.nan, np.inf
    for alpha in (None, np.ones((6, 8))):
        with pytest.warns(AirlightWarning, match="depth is NaN in 3 pixels"):
            composed = compose(depth=missing, alpha=alpha, **given)
        assert_array_equal(composed.rgb, compose(depth=endless, alpha=alpha, **given).rgb)
        assert np.isfinite(composed.rgb).all()
