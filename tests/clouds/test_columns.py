"""Columns of planets with clouds, and their mean."""

from dataclasses import replace

import numpy as np
import pytest

import airlight
from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics, droplets
from airlight.clouds.columns import EvenLayer, planet_columns, reflecting_depth, with_even_layer
from airlight.errors import ConflictError, ParameterError
from airlight.planets import Medium
from airlight.planets.clouds import Altocumulus, CumulusHumilis, Stratocumulus, Stratus

_PLANET = airlight.load_planet("earth-atmosphere-plus")


def _under(*clouds):
    return replace(_PLANET, clouds=clouds)


def test_kinds_overlap_at_random():
    found = planet_columns(_under(CumulusHumilis(cover=0.25), Altocumulus(cover=0.5)))
    assert [one.fraction for one in found] == [0.375, 0.375, 0.125, 0.125]
    assert [len(one.planet.constituents) for one in found] == [3, 4, 4, 5]
    assert not any(one.planet.clouds for one in found)


def test_full_and_absent_cover_are_one_column():
    (overcast,) = planet_columns(_under(Stratus(cover=1.0), Altocumulus(cover=0.0)))
    assert overcast.fraction == 1.0
    names = [one.name for one in overcast.planet.constituents]
    assert names[-1] == "stratus (clouds)"


def test_a_layer_has_its_depth_between_base_and_top():
    (overcast,) = planet_columns(_under(Stratus(base=700.0, depth=300.0, optical_depth=12.0)))
    solution = airlight.solve(overcast.planet, [550.0], "preview")
    depths = [
        -np.log(float(solution.transmittance(altitude=z, view_zenith=0.0).item()))
        for z in (0.0, 699.0, 850.0, 1001.0)
    ]
    assert depths[0] - depths[1] < 0.1
    np.testing.assert_allclose(depths[1] - depths[2], 6.0, rtol=0.01)
    np.testing.assert_allclose(depths[1] - depths[3], 12.0, rtol=0.01)


def test_solve_is_the_mean_of_its_columns():
    clouds = Stratocumulus(cover=0.4, effective_radius=6e-6)
    below = {"altitude": 0.0, "sun_zenith": 45.0}
    mean, none, full = (
        airlight.solve(planet, [550.0], "preview").irradiance(**below)
        for planet in (_under(clouds), _PLANET, _under(replace(clouds, cover=1.0)))
    )
    for part in ("direct", "diffuse"):
        np.testing.assert_allclose(mean[part], 0.6 * none[part] + 0.4 * full[part], rtol=1e-6)


def test_clouds_above_the_air_and_too_many_kinds_are_rejected():
    with pytest.raises(ParameterError, match=r"stratus\.base"):
        planet_columns(_under(Stratus(base=9.99e4)))
    kinds = [Altocumulus(name=f"layer {k}", base=1000.0 + 500.0 * k) for k in range(4)]
    with pytest.raises(ConflictError, match="at most 3"):
        planet_columns(_under(*kinds))


def _even(*depths):
    return EvenLayer(0.5, 1000.0, 500.0, np.array(depths, np.float32))


def test_a_layer_reflects_as_its_columns_on_average():
    """The definition, for columns of reflectances 1/2 and 1/6: 1/3."""
    b = 0.5 * np.sqrt(3.0) * 0.15
    depth = reflecting_depth(np.array([1.0, 0.2]) / b, 0.85)
    assert b * depth / (1.0 + b * depth) == pytest.approx(1.0 / 3.0, rel=1e-6)
    assert reflecting_depth(np.array([7.0, 7.0]), 0.85) == pytest.approx(7.0, rel=1e-6)
    assert reflecting_depth(np.array([1e-4, 3e-4]), 0.85) == pytest.approx(2e-4, rel=1e-3)  # linear


def test_a_field_is_a_layer_of_its_cloudy_columns_and_levels():
    cells = np.zeros((4, 4, 6), np.float32)
    cells[:2, :2, 2:4] = 0.01
    layer = EvenLayer.of(CloudField(extinction=cells, spacing=(100.0, 100.0, 50.0), base=400.0))
    assert (layer.cover, layer.base, layer.depth) == (0.25, 500.0, 100.0)
    np.testing.assert_allclose(layer.optical_depths, 1.0, rtol=1e-6)


def test_a_planet_below_an_even_layer_has_its_optical_depth():
    optics = CloudOptics.of_particles(droplets(6e-6, 0.1), [440.0, 550.0])
    below = with_even_layer(_under(Stratus()), _even(4.0), optics)
    assert not below.clouds
    layer = Medium.from_planet(below, [440.0, 550.0]).vertical_optical_depth[-1]
    np.testing.assert_allclose(layer, 4.0 * optics.extinction, rtol=1e-6)
