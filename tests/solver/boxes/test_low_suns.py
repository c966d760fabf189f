"""Boxes under suns near and below the horizon, whose beam is that of a sphere."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics
from airlight.errors import ConflictError, ParameterError
from airlight.kernel import compiled_loop
from airlight.planets.matter.phases.formulas import HenyeyGreenstein
from airlight.solver.boxes.beam import BeamCells, depth_towards
from airlight.solver.boxes.light import BoxBeam, BoxLight
from airlight.solver.boxes.solve import solve_box

RADIUS = 6.371e6


@compiled_loop
def _depth(point, direction, cells):
    return depth_towards(point, direction, cells)


def _towards(zenith: float) -> tuple[float, float, float]:
    angle = np.radians(zenith)
    return float(0.8 * np.sin(angle)), float(0.6 * np.sin(angle)), float(np.cos(angle))


@pytest.mark.parametrize("zenith", [60.0, 89.5, 90.0, 91.0, 92.0])
def test_depth_on_a_sphere_is_the_sum_of_small_steps(zenith):
    # Altitudes of exact straight lines above a sphere; those below the horizon leave the cloud
    # downwards and pass it again on the other side. From the top of the box and from its middle.
    cells = np.random.default_rng(2).random((6, 5, 4)).astype(np.float32) * 1e-5
    field = CloudField(
        extinction=cells, spacing=(300.0, 200.0, 500.0), base=8e3, beyond="periodic",
        interpolated=False,
    )  # fmt: skip
    clear = np.zeros((3, 5, 6), np.float32)
    grid = BeamCells(
        np.concatenate([clear, np.ascontiguousarray(cells.transpose(2, 1, 0))]),
        np.append(8e3 / 3.0 * np.arange(3.0), 8e3 + 500.0 * np.arange(5.0)),
        (field.west, field.south), (300.0, 200.0), True, 3, False, 1.0 / RADIUS,
    )  # fmt: skip
    way = _towards(zenith)
    steps = (np.arange(400_000) + 0.5) * 2.5
    for altitude in (9e3, 9.99e3):
        r = RADIUS + altitude
        up = np.sqrt(r**2 + 2.0 * r * steps * way[2] + steps**2) - RADIUS
        expected = 2.5 * field.at(17.0 + way[0] * steps, 5.0 + way[1] * steps, up).sum()
        assert_allclose(_depth((17.0, 5.0, altitude), way, grid), expected, rtol=3e-3)


@pytest.mark.parametrize("zenith", [89.0, 90.0, 91.0, 92.0])
def test_a_thin_layer_scatters_what_the_beam_gives_it(zenith):
    # Optical depth 1e-3 of a layer 2 km deep at 9 km: the beam along chords of a sphere, by hand.
    # Two per cent: light scattered twice, and means over levels.
    depth, base, top, levels = 1e-3, 9e3, 11e3, 8
    field = CloudField(
        extinction=np.full((1, 1, levels), depth / (top - base), np.float32),
        spacing=(100.0, 100.0, (top - base) / levels), base=base, beyond="periodic",
    )  # fmt: skip
    optics = CloudOptics(
        wavelengths=np.array([550.0]),
        extinction=np.ones(1),
        albedo=np.ones(1),
        phase=HenyeyGreenstein(asymmetry=0.6),
    )
    scaled = (1.0 - 0.6**6) * depth / (top - base)

    def beam(altitudes):
        return np.exp(-2.0 * np.exp(-np.asarray(altitudes) / 8e3))[:, None]

    light = BoxLight(
        towards=_towards(zenith),
        albedo=np.zeros(1),
        ground=0.0,
        beam=BoxBeam(irradiance=beam, radius=RADIUS),
    )
    found = solve_box(field, optics, light, cache=False)
    altitudes = base + (np.arange(400) + 0.5) * (top - base) / 400
    r, mu = RADIUS + altitudes, np.cos(np.radians(zenith))
    nearest = r**2 * (1.0 - mu**2)

    def chord(radius):  # from the nearest point of the line
        return np.sqrt(np.maximum(radius**2 - nearest, 0.0))

    inside = np.abs(chord(RADIUS + top) - r * mu)
    if mu < 0.0:  # twice through the layer, without what is below its base
        inside = chord(RADIUS + top) - r * mu - 2.0 * chord(RADIUS + base)
    given = (beam(altitudes)[:, 0] * np.exp(-scaled * inside)).mean() * scaled * (top - base)
    assert_allclose(found.up + found.down, given, rtol=0.02)
    assert_allclose(found.report.energy, 0.0, atol=5e-3)


def test_beams_of_other_shapes_are_refused_and_lines_of_sight_have_none():
    field = CloudField(
        extinction=np.zeros((1, 1, 2), np.float32), spacing=(1.0, 1.0, 9.0), base=0.0,
        beyond="periodic",
    )  # fmt: skip
    optics = CloudOptics(
        wavelengths=np.array([550.0]), extinction=np.ones(1), albedo=np.ones(1),
        phase=HenyeyGreenstein(asymmetry=0.6),
    )  # fmt: skip

    def light(irradiance):
        return BoxLight(
            towards=_towards(95.0),
            albedo=np.zeros(1),
            beam=BoxBeam(irradiance=irradiance, radius=RADIUS),
        )

    with pytest.raises(ParameterError, match=r"beam\.irradiance"):
        solve_box(field, optics, light(np.zeros_like), cache=False)
    solution = solve_box(field, optics, light(lambda z: np.zeros((z.size, 1))), cache=False)
    with pytest.raises(ConflictError, match="lines of sight"):
        solution.radiance([[0.0, 0.0, 0.0]], [[0.0, 0.0, 1.0]])
