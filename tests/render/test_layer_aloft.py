"""Thin layer high above the ground: neither the picture nor a query may step over it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Camera, Constituent, Planet, Scene, load_planet, replace
from airlight.physics.optics.density_profile import DensitySegments, exponential, tent
from airlight.physics.optics.layer_edges import layer_edges
from airlight.planets.matter.phases import HenyeyGreenstein
from airlight.planets.matter.profiles import Tent
from airlight.render import render
from airlight.render.pixels import march_points
from airlight.render.pixels.march_points import MarchPoints
from airlight.solver.moments.solution import MomentsSolution

Lit = Callable[..., MomentsSolution]


def layered() -> Planet:
    earth = load_planet("earth-atmosphere-plus")
    layer = Constituent(
        name="layer",
        profile=Tent(center=22e3, half_width=2e3),
        scattering=1e-4,  # optical depth 0.2
        phase_function=HenyeyGreenstein(asymmetry=0.7),
    )
    return replace(earth, constituents=(*earth.constituents, layer))


def test_a_picture_has_the_radiance_of_queries_under_a_layer(lit: Lit) -> None:
    # Second method: the query marches with more points. Without panels that end at the layer the
    # picture was up to 30 % darker from the zenith to 76°, and had a jump there.
    solution = lit(layered())
    camera = Camera(width=3, height=90, field_of_view=1.0, look_zenith=60.0, look_azimuth=90.0)
    rgb = render(solution, Scene(altitude=0.0, sun_zenith=60.0, camera=camera)).rgb[:, 1]
    zenith = np.degrees(np.arccos(camera.directions(slice(0, 90))[:, 1, 2]))
    sky = solution.radiance(altitude=0.0, sun_zenith=60.0, view_zenith=zenith, azimuth=90.0)
    relative = np.asarray(sky) / solution.medium.solar_irradiance
    assert_allclose(rgb, relative @ solution.lights[0].colors(), rtol=5e-3)


def test_a_layer_has_the_column_that_its_profile_has(lit: Lit) -> None:
    # An exact integral: single scattering, straight down from space onto black ground, is the sum
    # of slabs; here the share of the layer, whose optical depth is 1e-4 · 2 km.
    solution = lit(layered())
    transmittance = solution.transmittance(altitude=30e3, view_zenith=180.0, distance=16e3)
    below = solution.transmittance(altitude=18e3, view_zenith=180.0, distance=4e3)
    bare = lit("earth-atmosphere-plus")
    air = bare.transmittance(altitude=30e3, view_zenith=180.0, distance=16e3)
    assert_allclose(np.asarray(transmittance) / np.asarray(air), np.exp(-0.2), rtol=1e-4)
    assert_allclose(
        np.asarray(below),
        np.asarray(bare.transmittance(altitude=18e3, view_zenith=180.0, distance=4e3)),
        rtol=1e-6,
    )


@pytest.mark.parametrize(
    ("sun", "rtol"),
    # the median pixel with its eight points was 0.6 and 9 % off, the farthest 4 and 12 %
    [(66.0, 0.006), (90.0, 0.003)],
)
def test_few_points_see_a_faint_stratosphere(
    sun: float, rtol: float, lit: Lit, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Second method: a march of 72 points a leg. The layer has a depth of 0.007, of which eight
    # points of a steep line see one or two; light is bent, so the layer's lower edge is 1.2 km
    # lower by optical altitude, and the density has a corner at the tropopause.
    solution = lit(load_planet("earth"), (680.0, 550.0, 440.0))
    camera = Camera(width=24, height=14, look_zenith=sun - 8.0)
    scene = Scene(altitude=2.0, sun_zenith=sun, camera=camera)
    rendered = render(solution, scene, exact=True).rgb
    monkeypatch.setitem(march_points.BY_PANELS, 1, MarchPoints((24, 24, 24, 24), 3))
    exact = render(solution, scene, exact=True).rgb
    assert_allclose(rendered, exact, rtol=rtol)


def test_sweeps_take_no_more_panels_for_a_faint_wide_layer() -> None:
    # What counts for a line of sight costs a solve 10 %, and changes it by less than 0.4 %.
    rows = [exponential(8e3, 1e5), tent(22e3, 12e3, 1e5)]
    density, faint = DensitySegments.from_rows(rows), np.array([1e-5, 5e-7])
    assert layer_edges(density, faint, faint_and_wide=0.01).size == 0
    assert_allclose(layer_edges(density, faint), [10.1e3, 22e3, 33.9e3], atol=100.0)


def test_layer_edges_are_those_of_what_scatters_aloft() -> None:
    # The tent's own ends and top, to the samples' 50 m and the 1 % at which it counts as ended;
    # none from constituents that are densest at the ground, or do not scatter.
    rows = [exponential(8e3, 1e5), tent(22e3, 2e3, 1e5), tent(50e3, 5e3, 1e5)]
    found = layer_edges(DensitySegments.from_rows(rows), np.array([1e-5, 1e-4, 0.0]))
    assert_allclose(found, [20e3, 22e3, 24e3], atol=100.0)


def test_a_narrow_layer_keeps_both_its_ends() -> None:
    # Its own ends, 1 km apart in 100 km of air, without a peak between them; that of a wide layer
    # next to one of them is left out, as is one between them.
    rows = [exponential(8e3, 1e5), tent(83e3, 500.0, 1e5), tent(80e3, 3e3, 1e5)]
    density = DensitySegments.from_rows(rows)
    found = layer_edges(density, np.array([1e-5, 1e-4, 0.0]))
    assert_allclose(found, [82.5e3, 83.5e3], atol=100.0)
    found = layer_edges(density, np.array([1e-5, 1e-4, 1e-4]))
    assert_allclose(found, [77e3, 80e3, 82.5e3, 83.5e3], atol=100.0)
