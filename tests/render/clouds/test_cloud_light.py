"""Parts of the light of clouds that need no solution."""

import numpy as np
import pytest

from airlight import Scene, load_planet
from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_types import cloud_field
from airlight.errors import ParameterError
from airlight.kernel import compiled_loop
from airlight.planets.clouds import CumulusHumilis
from airlight.render.clouds.beam_depth import LONG_STEP, STEP, beam_depths
from airlight.render.clouds.clear_distance import clear_distances
from airlight.render.clouds.cloud_deck import solved_wavelengths
from airlight.render.clouds.cloud_light import box_spectrum, coarse_field
from airlight.render.clouds.clouds_around import CloudsAround
from airlight.render.clouds.directions import fill_harmonics, harmonic_norms
from airlight.render.clouds.sight_extent import node_distance, node_of_distance, sight_extent
from airlight.solver.boxes.directions import harmonics

RADIUS = 6.371e6


def layer(cells=(4, 4, 8), extinction=0.01, beyond="periodic"):
    return CloudField(
        extinction=np.full(cells, extinction, np.float32),
        spacing=(100.0, 100.0, 50.0),
        base=1000.0,
        beyond=beyond,
    )


@pytest.mark.parametrize("zenith", [0.0, 40.0, 75.0])
def test_depth_of_an_even_layer_is_that_of_its_slant_path(zenith):
    mu, sine = np.cos(np.radians(zenith)), np.sin(np.radians(zenith))
    field = layer()
    depth, below = beam_depths(field, clear_distances(field), (float(sine), 0.0, float(mu)), RADIUS)
    np.testing.assert_allclose(below, 0.01 * 400.0 / mu, rtol=0.06)
    np.testing.assert_allclose(depth[0], 0.01 * 375.0 / mu, rtol=0.06)
    assert np.all(np.diff(depth[:, 0, 0]) < 0.0)


def test_sun_below_the_horizon_lights_clouds_from_below():
    """The beam enters a wide layer through its base, to which it is nearer from low cells."""
    field = CloudField(
        extinction=np.full((200, 1, 8), 1e-4, np.float32), spacing=(1e3, 1e3, 50.0), base=1000.0
    )
    mu = -0.01
    towards = ((1.0 - mu * mu) ** 0.5, 0.0, mu)
    depth, below = beam_depths(field, clear_distances(field), towards, RADIUS)
    middle = depth[:, 0, 100]
    assert np.all(np.diff(middle) >= 0.0)
    assert below[0, 100] < 0.05 * middle[-1]
    assert middle[0] < 0.1 * middle[-1]


@pytest.mark.parametrize("height", [0.5, 0.05])
def test_steps_through_clear_air_change_no_depth(height):
    cells = np.zeros((24, 24, 12), np.float32)
    cells[5:9, 3:6, 4:9], cells[17, 20, 6] = 0.01, 0.1
    field = CloudField(
        extinction=cells, spacing=(100.0, 100.0, 50.0), base=500.0, beyond="periodic"
    )
    towards, clear = ((1.0 - height * height) ** 0.5, 0.0, height), clear_distances(field)
    assert clear.max() > 300.0
    found, small = (
        beam_depths(field, one, towards, RADIUS) for one in (clear, np.zeros_like(clear))
    )
    for one, other in zip(found, small, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-5, atol=1e-6)


@pytest.mark.parametrize("height", [0.9, 0.3])
def test_long_steps_of_a_first_light_miss_little_of_a_beam(height):
    # Transmittances below cumuli by steps of half a cell.
    field = cloud_field(CumulusHumilis(), size=6400.0)
    towards, clear = ((1.0 - height * height) ** 0.5, 0.0, height), clear_distances(field)
    short, long = (
        np.exp(-beam_depths(field, clear, towards, RADIUS, step=step)[0])
        for step in (STEP, LONG_STEP)
    )
    assert 0.05 < short.mean() < 0.95
    assert np.sqrt(((long - short) ** 2).mean()) < 0.02
    np.testing.assert_allclose(long.mean(), short.mean(), atol=2e-3)


def test_nothing_is_in_the_clear_distance():
    cells = np.zeros((32, 32, 16), np.float32)
    cells[20, 5, 8] = 0.1
    field = CloudField(
        extinction=cells, spacing=(100.0, 100.0, 50.0), base=500.0, beyond="periodic"
    )
    clear = clear_distances(field)
    x, y, z = np.meshgrid(*(np.arange(n) for n in cells.shape), indexing="ij")
    way_x = np.minimum(np.abs(x - 20), 32 - np.abs(x - 20))
    way_y = np.minimum(np.abs(y - 5), 32 - np.abs(y - 5))
    distance = np.sqrt((100.0 * way_x) ** 2 + (100.0 * way_y) ** 2 + (50.0 * (z - 8)) ** 2)
    assert np.all(clear.transpose(2, 1, 0) <= distance)
    assert clear[8, 5, 20] == 0.0
    assert clear.max() > 500.0


def test_harmonics_are_those_of_the_solver():
    vectors = np.random.default_rng(3).normal(size=(20, 3))
    vectors /= np.linalg.norm(vectors, axis=1, keepdims=True)
    out = np.empty((20, 36))
    _every(vectors, harmonic_norms(5), out)
    np.testing.assert_allclose(out, harmonics(vectors, 5), atol=1e-12)


@compiled_loop
def _every(vectors, norms, out):
    for k in range(len(vectors)):
        fill_harmonics(vectors[k, 0], vectors[k, 1], vectors[k, 2], norms, out[k])


@pytest.mark.parametrize("beam_power", [0.0, 4.0])  # 4: the same spectrum as the sky's
def test_weights_of_solved_wavelengths_are_exact_for_grey_scattering(beam_power):
    nm = np.linspace(400.0, 700.0, 16)
    chosen, beam, sky = solved_wavelengths(16), (nm / 550.0) ** beam_power, (550.0 / nm) ** -4
    light = 0.3 * beam + (0.2 + 1e-3 * nm) * sky
    weights = box_spectrum(nm, chosen, beam, sky)
    np.testing.assert_allclose(light[chosen] @ weights[: chosen.size], light, rtol=1e-6)
    assert np.abs(weights).max() < 3.0


def test_levels_are_joined_before_columns_until_cells_are_cubes(monkeypatch):
    monkeypatch.setattr("airlight.render.clouds.cloud_light.MOST_SOLVED", 600)
    cells = np.random.default_rng(1).random((8, 8, 32)).astype(np.float32)
    field = CloudField(extinction=cells, spacing=(100.0, 100.0, 28.0), base=0.0)
    coarse = coarse_field(field)
    assert coarse.extinction.shape == (8, 8, 8)
    np.testing.assert_allclose(coarse.column_optical_depth, field.column_optical_depth, rtol=1e-5)
    assert coarse.top == field.top
    wide = coarse_field(CloudField(extinction=cells, spacing=(50.0, 50.0, 140.0), base=0.0))
    assert wide.extinction.shape == (4, 4, 32)


def test_a_large_field_is_solved_in_more_cells(monkeypatch):
    for name, value in (("LARGE", 2000), ("MOST_SOLVED", 300), ("MOST_OF_LARGE", 600)):
        monkeypatch.setattr(f"airlight.render.clouds.cloud_light.{name}", value)
    cells, spacing = np.ones((8, 8, 32), np.float32), (100.0, 100.0, 28.0)
    fields = [CloudField(extinction=one, spacing=spacing, base=0.0) for one in (cells, cells[:4])]
    shapes = [coarse_field(one).extinction.shape for one in fields]
    assert shapes == [(8, 8, 8), (4, 8, 8)]


def test_coarse_field_keeps_the_mean(monkeypatch):
    monkeypatch.setattr("airlight.render.clouds.cloud_light.MOST_SOLVED", 40)
    random = np.random.default_rng(1).random((8, 8, 4)).astype(np.float32)
    field = CloudField(extinction=random, spacing=(100.0, 100.0, 50.0), base=0.0)
    coarse = coarse_field(field)
    assert coarse.extinction.size <= 40
    assert coarse.extinction.mean() == pytest.approx(random.mean(), rel=1e-5)
    assert coarse.west == field.west


@pytest.mark.parametrize(
    ("altitude", "zenith"), [(2.0, 30.0), (2.0, 89.0), (11e3, 120.0), (1.5e3, 91.0), (4e5, 150.0)]
)
def test_line_meets_base_and_top(altitude, zenith):
    eye, base, top = RADIUS + altitude, RADIUS + 1e3, RADIUS + 2e3
    mu, sine = np.cos(np.radians(zenith)), np.sin(np.radians(zenith))
    extent = sight_extent(mu, sine, zenith > 100.0, eye, RADIUS, base, top)

    def radius(s):
        return np.sqrt(eye * eye + s * s + 2.0 * eye * s * mu)

    if altitude > 2e3:
        assert radius(extent.first) == pytest.approx(top, abs=1e-3)
    else:
        assert extent.first == 0.0
    assert radius(extent.last) == pytest.approx(RADIUS if zenith > 100.0 else top, abs=1e-3)
    for node in range(24):
        distance = node_distance(node, 24, extent)
        assert node_of_distance(distance, 24, extent) == pytest.approx(node, abs=1e-6)


def test_decks_are_sorted_and_know_their_clouds():
    two = load_planet("earth", {"clouds": [{"kind": "cirrus"}, {"kind": "cumulus"}]})
    around = CloudsAround.of(two, Scene())
    assert [deck.number for deck in around.decks] == [1, 0]
    assert around.decks[0].field.top < around.decks[1].field.base
    assert CloudsAround.of(two.without_clouds, Scene()) is None


def test_a_picture_has_at_most_three_kinds_of_clouds():
    kinds = [{"kind": kind} for kind in ("cumulus", "stratus", "altocumulus", "cirrus")]
    with pytest.raises(ParameterError, match="4 kinds'; allowed: at most 3 kinds in a picture"):
        CloudsAround.of(load_planet("earth", {"clouds": kinds}), Scene())
