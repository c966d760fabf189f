"""Star's disc: its full irradiance, at the star's position, cut by the planet."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import Camera, Planet, Scene, look_at
from airlight.image.spectral import rgb_weights
from airlight.image.xyz import rgb_to_xyz
from airlight.physics.spectra.limb_darkening import solar_darkening
from airlight.render.cpu_renderer import CpuRenderer
from airlight.solver.moments.solution import MomentsSolution

Lit = Callable[..., MomentsSolution]
Starred = Callable[[float], Planet]


def rendered(
    solution: MomentsSolution, scene: Scene, *, disc: bool, air: bool = True
) -> np.ndarray:  # fmt: skip
    """Draw a picture with or without the disc, in float64; without the air the disc alone."""
    camera = scene.camera
    rgb = np.zeros((camera.height, camera.width, 3), np.float32)
    renderer = CpuRenderer(solution, scene, disc=disc, air=air)
    renderer.fill_sky_view()
    renderer.render_rows(0, camera.height, rgb)
    return rgb.astype(np.float64)


@pytest.fixture
def disc() -> Callable[[MomentsSolution, Scene], np.ndarray]:
    """Contribution of the disc to a picture."""

    def only(solution: MomentsSolution, scene: Scene) -> np.ndarray:
        return rendered(solution, scene, disc=True) - rendered(solution, scene, disc=False)

    return only


def solid_angles(camera: Camera, rows: slice = slice(None)) -> np.ndarray:
    """Solid angle of each pixel, from the corners' directions: two flat triangles. [sr]"""
    a, b, c, d = (
        camera.directions(rows, offset=(dx, dy))
        for dx, dy in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))
    )
    return 0.5 * np.linalg.norm(np.cross(c - a, d - b), axis=-1)


def starlight(solution: MomentsSolution, scene: Scene) -> np.ndarray:
    """Law for the total: irradiance at the planet times transmittance, as linear sRGB."""
    transmittance = solution.transmittance(altitude=scene.altitude, view_zenith=scene.sun_zenith)
    received = np.asarray(transmittance) * solution.medium.solar_irradiance
    return np.asarray(
        received @ rgb_weights(solution.wavelengths, solution.planet.star.irradiances)
    )


@pytest.mark.parametrize("radius", [0.2678, 1.5])
@pytest.mark.parametrize("altitude", [0.0, 8e3, 400e3])
def test_a_disc_of_many_pixels_sends_the_star_s_irradiance(
    radius: float, altitude: float, lit: Lit, with_star: Starred, disc: Callable[..., np.ndarray]
) -> None:
    camera = Camera(width=64, height=64, field_of_view=4.0 * radius, look_zenith=40.0)
    scene = Scene(camera=camera, altitude=altitude, sun_zenith=40.0)
    solution = lit(with_star(radius))
    added = disc(solution, scene)
    total = (added * solid_angles(camera)[..., None]).sum(axis=(0, 1))
    # the rim is sampled 16 times a pixel, the disc's area to 0.1 %; the air varies less over it
    assert_allclose(total, starlight(solution, scene), rtol=1e-2)


def test_the_disc_is_darkened_as_neckel_measured(
    lit: Lit, with_star: Starred, disc: Callable[..., np.ndarray]
) -> None:
    # Two pictures of one disc, with its law and without: their ratio along a radius is the law of
    # Neckel (2005), here by its polynomial at the pixel's own angle. A pixel of a thirtieth of the
    # radius has the mean of its width, which differs from it by 1 % up to 0.9 of the radius.
    camera = Camera(width=65, height=65, field_of_view=0.6, look_zenith=40.0)
    scene = Scene(camera=camera, altitude=80e3, sun_zenith=40.0)
    solution = lit(with_star(0.2678))
    even = solution.with_light(replace(solution.lights[0], darkening=None))
    dark, plain = disc(solution, scene), disc(even, scene)
    solid = solid_angles(camera)[..., None]
    assert_allclose((dark * solid).sum(axis=(0, 1)), (plain * solid).sum(axis=(0, 1)), rtol=1e-3)
    # sRGB of the measured law at the three wavelengths
    weights = solution.lights[0].colors()
    apart = np.arccos(camera.directions()[32] @ scene.sun_direction) / np.radians(0.2678)
    inside = apart < 0.9
    mu = np.sqrt(1.0 - apart[inside] ** 2)
    law = (mu[:, None] ** np.arange(6)) @ solar_darkening(solution.wavelengths).T
    assert_allclose(
        (dark / np.maximum(plain, 1e-30))[32][inside], (law @ weights) / weights.sum(axis=0),
        rtol=0.02,
    )  # fmt: skip


def test_a_sphere_of_dust_sends_the_light_of_its_phase(
    lit: Lit, with_star: Starred, disc: Callable[..., np.ndarray]
) -> None:
    # Lommel and Seeliger's law over the disc has the mean 1 at every phase, so that the disc has
    # its irradiance; half of it is dark at half moon, and the bright limb is where it is said.
    camera = Camera(width=96, height=96, field_of_view=0.7, look_zenith=40.0)
    scene = Scene(camera=camera, altitude=80e3, sun_zenith=40.0)
    solution = lit(with_star(0.26))
    star = replace(solution.lights[0], darkening=None)
    solid, even = solid_angles(camera)[..., None], disc(solution.with_light(star), scene)
    for phase, limb in ((1.0, 0.0), (60.0, 90.0), (90.0, -90.0), (130.0, 200.0)):
        moon = disc(solution.with_light(replace(star, phase=phase, limb=limb)), scene)
        ratio = (moon * solid).sum(axis=(0, 1)) / (even * solid).sum(axis=(0, 1))
        assert_allclose(ratio, 1.0, rtol=5e-3 if phase < 100.0 else 2e-2)
        side = moon[..., 1].copy()
        middle = np.average(np.indices(side.shape)[1], weights=side) - 47.5
        if phase == 90.0:
            assert middle < -5.0  # lit from the left
            assert side[:, 49:].max() < 0.1 * side.max()
        if phase == 60.0:
            assert middle > 3.0


@pytest.mark.parametrize(
    ("pixels_per_degree", "allowed"),
    [
        (6.0, 0.05),
        (2.0, 1e-3),
        (0.4, 1e-3),
    ],
)
@pytest.mark.parametrize(
    "projection",
    [
        "perspective",
        pytest.param("equirectangular", marks=pytest.mark.slow),
        pytest.param("cubemap", marks=pytest.mark.slow),
        "fisheye",
    ],
)
def test_a_disc_of_few_pixels_keeps_its_energy(
    projection: str, pixels_per_degree: float, allowed: float, lit: Lit, with_star: Starred,
    disc: Callable[..., np.ndarray], tell: Callable[[str], None],
) -> None:  # fmt: skip
    # a twelfth of the rim's pixels changes with each of 5 x 5 samples a pixel; a disc of a pixel or
    # less is distributed by solid angle, which the test measures in the same way
    solution = lit(with_star(0.2678))
    side = round(90 * pixels_per_degree)
    size = {"equirectangular": (4 * side, 2 * side), "cubemap": (6 * side, side)}.get(
        projection, (side, side)
    )
    ratios = []
    for shift in np.random.default_rng(2).uniform(-3.0, 3.0, 4):
        camera = Camera(
            projection=projection, width=size[0], height=size[1], look_azimuth=float(shift),
            look_zenith=75.0,
            field_of_view=90.0 if projection in ("perspective", "fisheye") else None,
        )  # fmt: skip
        scene = Scene(camera=camera, altitude=400e3, sun_zenith=75.0 + float(shift) / 3.0)
        # in panoramas, which are large, without the air before it
        around = projection in ("equirectangular", "cubemap")
        added = rendered(solution, scene, disc=True, air=False) if around else disc(solution, scene)
        row = np.flatnonzero(added[..., 1].any(axis=1))
        angles = solid_angles(camera, slice(row.min(), row.max() + 1)) if row.size else np.zeros(1)
        lit_rows = added[row.min() : row.max() + 1] if row.size else np.zeros((1, 3))
        total = (lit_rows * angles[..., None]).reshape(-1, 3).sum(axis=0)
        ratios.append((total / starlight(solution, scene))[1])
    tell(
        f"disc of {0.5356 * pixels_per_degree:.1f} pixels, {projection}: energy "
        f"{min(ratios):.3f} to {max(ratios):.3f}"
    )
    assert_allclose(ratios, 1.0, atol=allowed)


def test_the_disc_stands_where_the_star_is(
    lit: Lit, with_star: Starred, disc: Callable[..., np.ndarray]
) -> None:
    camera = Camera(width=61, height=41, field_of_view=12.0, look_zenith=57.0, look_azimuth=-2.0)
    scene = Scene(camera=camera, sun_zenith=58.0)
    added = disc(lit(with_star(0.5)), scene)[..., 1]
    middle = np.einsum("ij,ijk->k", added, camera.directions())
    angle = np.degrees(np.arccos(middle @ scene.sun_direction / np.linalg.norm(middle)))
    assert angle < 0.02  # a tenth of a pixel


@pytest.mark.parametrize("altitude", [2.0, 35e3, 400e3])
def test_the_horizon_cuts_the_disc(
    altitude: float, lit: Lit, with_star: Starred, disc: Callable[..., np.ndarray]
) -> None:
    solution = lit(with_star(0.2678))
    bottom = solution.medium.bottom_radius
    zenith, _ = look_at("horizon", altitude=altitude, sun_zenith=0.0, bottom_radius=bottom)
    camera = Camera(width=48, height=48, field_of_view=1.0, look_zenith=zenith)
    added = disc(solution, Scene(camera=camera, altitude=altitude, sun_zenith=zenith))
    r = bottom + altitude
    horizon = -np.sqrt((r - bottom) * (r + bottom)) / r
    lowest = camera.directions(offset=(0.0, 0.5))[..., 2]
    highest = camera.directions(offset=(0.0, -0.5))[..., 2]
    light = rgb_to_xyz(added)[..., 1]
    inside = camera.directions() @ scene_sun(zenith) > np.cos(np.radians(0.2))
    assert_array_equal(added[highest < horizon], 0.0)
    assert (light[inside & (lowest > horizon)] > 0.0).all()


def scene_sun(zenith: float) -> np.ndarray:
    return Scene(sun_zenith=zenith).sun_direction


def test_a_star_behind_the_planet_has_no_disc(
    lit: Lit, with_star: Starred, disc: Callable[..., np.ndarray]
) -> None:
    for altitude, zenith in ((2.0, 100.0), (400e3, 150.0), (1e8, 179.0)):
        camera = Camera(width=24, height=24, field_of_view=3.0, look_zenith=zenith)
        scene = Scene(camera=camera, altitude=altitude, sun_zenith=zenith)
        assert_array_equal(disc(lit(with_star(0.2678)), scene), 0.0)


def test_a_point_star_is_not_drawn(
    lit: Lit, with_star: Starred, disc: Callable[..., np.ndarray]
) -> None:
    camera = Camera(width=24, height=24, field_of_view=3.0, look_zenith=40.0)
    assert_array_equal(disc(lit(with_star(0.0)), Scene(camera=camera, sun_zenith=40.0)), 0.0)
