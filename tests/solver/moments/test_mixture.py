"""Clear air lit by a partly cloudy sky."""

from dataclasses import replace

import numpy as np
import pytest

import airlight
from airlight.errors import ParameterError
from airlight.planets.constituent import Constituent
from airlight.planets.matter.phases import HenyeyGreenstein
from airlight.planets.matter.profiles import Layer, Layered
from airlight.solver.moments.mixture import under_clouds

_SIGHT = {"altitude": 0.0, "sun_zenith": 40.0, "view_zenith": [0.0, 60.0, 85.0], "azimuth": 90.0}


def _cloudy(depth):
    planet = airlight.load_planet("earth-atmosphere-plus")
    cloud = Constituent(
        name="cloud",
        profile=Layered(
            layers=(Layer(width=1000.0), Layer(width=500.0, constant_term=1.0), Layer())
        ),
        scattering=depth / 500.0,
        phase_function=HenyeyGreenstein(asymmetry=0.85),
    )
    return replace(planet, constituents=(*planet.constituents, cloud))


@pytest.fixture(scope="module")
def clear():
    return airlight.solve("earth-atmosphere-plus", quality="preview")


@pytest.fixture(scope="module")
def cloudy():
    return airlight.solve(_cloudy(10.0), quality="preview")


def test_no_cover_is_clear_air(clear, cloudy):
    mixed = under_clouds(clear, cloudy, 0.0)
    np.testing.assert_array_equal(mixed.radiance(**_SIGHT), clear.radiance(**_SIGHT))


def test_clouds_of_no_depth_are_clear_air(clear):
    mixed = under_clouds(clear, airlight.solve(_cloudy(1e-6), quality="preview"), 1.0)
    np.testing.assert_allclose(mixed.radiance(**_SIGHT), clear.radiance(**_SIGHT), rtol=0.01)


def test_light_is_linear_in_cover(clear, cloudy):
    mixed = [under_clouds(clear, cloudy, cover) for cover in (0.5, 1.0)]
    below = {"altitude": 0.0, "sun_zenith": 40.0}
    none, half, full, layer = (one.irradiance(**below) for one in (clear, *mixed, cloudy))
    # but for rational interpolation between sun angles, which is not linear
    np.testing.assert_allclose(half["diffuse"], 0.5 * (none + full)["diffuse"], rtol=1e-3)
    np.testing.assert_allclose(half["direct"], none["direct"])
    np.testing.assert_allclose(full["diffuse"], layer["diffuse"], rtol=1e-4)


def test_foreign_solutions_are_rejected(clear, cloudy):
    with pytest.raises(ParameterError, match="cover"):
        under_clouds(clear, cloudy, 1.5)
    with pytest.raises(ParameterError, match="the same shell"):
        under_clouds(clear, airlight.solve("mars", quality="preview"), 0.5)
