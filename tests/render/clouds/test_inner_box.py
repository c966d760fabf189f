"""Place and cells of the finer box of a field."""

import numpy as np
import pytest

from airlight.clouds.cloud_field import CloudField
from airlight.render.clouds.higher_orders import MIXED, InnerSource, inner_place
from airlight.render.clouds.inner_box import PARTS, WIDTH, inner_field
from airlight.render.clouds.layer_geometry import seen_place
from airlight.scene import Camera, Scene

RADIUS = 6.36e6


def field_of(cells, **given):
    return CloudField(
        extinction=np.asarray(cells, np.float32),
        spacing=(200.0, 200.0, 50.0),
        base=1000.0,
        beyond="periodic",
        **given,
    )


@pytest.mark.parametrize(
    ("zenith", "azimuth", "place"),
    [
        (180.0, 0.0, (0.0, 0.0)),
        (130.0, 0.0, (0.0, 12800.0)),
        (130.0, 180.0, (0.0, -12800.0)),
        (90.0, 0.0, (0.0, 0.0)),
        (91.0, 0.0, (0.0, 0.0)),
    ],
)  # a line that is level, or leaves the field before it falls to the clouds
def test_the_box_is_where_the_picture_is(zenith, azimuth, place):
    """Sun in the north; (11 km - 1.2 km) tan 50° is 11.7 km: four steps."""
    camera = Camera(look_zenith=zenith, look_azimuth=azimuth)
    scene = Scene(altitude=11e3, sun_zenith=30.0, sun_azimuth=0.0, camera=camera)
    found = seen_place(field_of(np.ones((128, 128, 8))), scene, RADIUS)
    np.testing.assert_allclose(found, place, atol=1e-6)


@pytest.mark.parametrize("place", [(0.0, 0.0), (3200.0, -3200.0), (20e3, 20e3)])
def test_the_box_is_inside_the_field_and_has_its_clouds(place):
    random = np.random.default_rng(5).random((64, 64, 8))
    field = field_of(random, drift=(70.0, -30.0))
    found = inner_field(field, field, place)
    assert found.spacing[:2] == (200.0 / PARTS, 200.0 / PARTS)
    assert found.sides == (WIDTH, WIDTH)
    assert found.west >= field.west
    assert found.south + WIDTH <= field.south + field.sides[1] + 1e-6
    assert (found.west - field.west) % 200.0 == 0.0
    at = found.west + 150.0, found.south + 50.0, found.base + 25.0
    here = field.at(*(np.array([one]) for one in at))
    assert found.extinction[1, 0, 0] == pytest.approx(float(here[0]), rel=1e-5)


def test_a_small_field_has_no_finer_box():
    field = field_of(np.ones((16, 16, 4)))
    assert inner_field(field, field, (0.0, 0.0)) is None


def test_shares_fall_to_nothing_at_the_sides():
    """Also in copies of a field that repeats itself."""
    none = np.zeros((1, 1, 1, 1, 8), np.float32)
    inner = InnerSource(20.0, 20.0, 10.0, 10.0, 0, 0, none)
    share = [inner_place(x - 0.5, 24.5, 64, 64, inner, True)[2] for x in (20.0, 20.5, 25.0, 89.0)]
    assert share == pytest.approx([0.0, 0.05 / MIXED, 1.0, 1.0])
