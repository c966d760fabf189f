"""Continuity where a formula changes: picture edges, horizon, top of the air."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest
from marched_pictures import centres
from numpy.testing import assert_allclose

from airlight import Camera, Scene, look_at
from airlight.image.spectral import rgb_weights
from airlight.image.xyz import rgb_to_xyz
from airlight.render import render
from airlight.solver.moments.solution import MomentsSolution

Lit = Callable[..., MomentsSolution]

#: With the faces right, left, up, down, ahead, behind: pairs whose right and left edges meet.
NEIGHBOURS = [(4, 0), (0, 5), (5, 1), (1, 4)]


def joined(one: np.ndarray, other: np.ndarray) -> None:
    """Compare the step across an edge with those on both sides of it, with a margin for curves."""
    inner = np.maximum(np.abs(one[:, -1] - one[:, -2]), np.abs(other[:, 1] - other[:, 0]))
    step = np.abs(other[:, 0] - one[:, -1])
    assert (step <= 1.5 * inner + 1e-3 * np.abs(one).max()).all()


def test_the_panorama_closes(lit: Lit) -> None:
    camera = Camera(projection="equirectangular", width=96, height=48, look_azimuth=70.0)
    rgb = render(lit(), Scene(camera=camera, altitude=2.0, sun_zenith=70.0)).rgb
    joined(rgb, rgb)


@pytest.mark.parametrize("altitude", [2.0, 35e3])
def test_cube_faces_meet(altitude: float, lit: Lit) -> None:
    camera = Camera(projection="cubemap", width=6 * 32, height=32, look_azimuth=20.0)
    rgb = render(lit(), Scene(camera=camera, altitude=altitude, sun_zenith=140.0)).rgb
    faces = np.split(rgb, 6, axis=1)
    for one, other in NEIGHBOURS:
        joined(faces[one], faces[other])
    # ahead's upper edge is up's lower edge, ahead's lower edge down's upper edge
    joined(np.swapaxes(faces[2], 0, 1), np.swapaxes(faces[4], 0, 1))
    joined(np.swapaxes(faces[4], 0, 1), np.swapaxes(faces[3], 0, 1))


@pytest.mark.parametrize("sun_zenith", [30.0, 88.0, 94.0])
@pytest.mark.parametrize(
    "altitude",
    [2.0, 35e3, 400e3],
)
def test_no_line_of_pixels_stands_out_at_the_horizon(
    altitude: float, sun_zenith: float, lit: Lit, tell: Callable[[str], None]
) -> None:
    # second path: the same moments integrated with eight times the points, ray by ray. Where the
    # renderer's coarser march has an error it must be alike from pixel to pixel: a stripe is a
    # pixel whose relative error is far from the mean of its two neighbours'. No pixel points
    # exactly at the edge of the ground, where rounding alone would decide.
    solution = lit()
    bottom = solution.medium.bottom_radius
    zenith, _ = look_at("horizon", altitude=altitude, sun_zenith=sun_zenith, bottom_radius=bottom)
    camera = Camera(width=1, height=240, field_of_view=0.02, look_zenith=zenith, look_azimuth=70.0)
    scene = Scene(camera=camera, altitude=altitude, sun_zenith=sun_zenith)
    seen = rgb_to_xyz(centres(solution, scene))[:, 0, 1]
    x, y, z = camera.directions()[:, 0].T
    finer = MomentsSolution(
        solution.medium,
        dataclasses.replace(solution.settings, march_nodes=32, march_panels=4),
        solution.moments,
        0.0,
    )
    radiance = finer.radiance(
        altitude=altitude,
        sun_zenith=sun_zenith,
        view_zenith=np.degrees(np.arctan2(np.hypot(x, y), z)),
        azimuth=np.degrees(np.arctan2(y, x)),
    )
    weights = rgb_weights(solution.wavelengths, solution.planet.star.irradiances)
    truth = rgb_to_xyz(np.asarray(radiance) @ weights)[:, 1]
    error = seen / truth - 1.0
    spike = np.abs(error[1:-1] - 0.5 * (error[:-2] + error[2:]))
    tell(
        f"horizon from {altitude:g} m, sun {sun_zenith:g}: worst error {np.abs(error).max():.1e}, "
        f"worst spike {spike.max():.1e}"
    )
    assert np.abs(error).max() < 3e-2
    assert spike.max() < 1e-2  # an eye sees a line from a contrast of about one per cent on


@pytest.mark.parametrize("sun_zenith", [40.0, 95.0])
def test_nothing_jumps_when_the_observer_leaves_the_air(sun_zenith: float, lit: Lit) -> None:
    # continuity: over 2 cm at the top of the shell directions change by 1e-9, light by no more
    # than the square root of that at the shell's edge
    camera = Camera(projection="equirectangular", width=48, height=24, look_azimuth=10.0)
    below, above = (
        render(lit(), Scene(camera=camera, altitude=1e5 + step, sun_zenith=sun_zenith)).rgb
        for step in (-0.01, 0.01)
    )
    assert_allclose(above, below, rtol=2e-3, atol=1e-5 * float(np.median(below[16:])))
