"""Clouds of planets: fields, optical properties, ice, and clouds above the air."""

from dataclasses import replace

import numpy as np
import pytest

from airlight.clouds import planet_clouds
from airlight.clouds.cloud_optics import CloudOptics, droplets
from airlight.clouds.cloud_types import cloud_field
from airlight.clouds.planet_clouds import Box, clouds_of, field_of
from airlight.errors import ParameterError
from airlight.planets import load_planet
from airlight.planets.clouds import Cirrus, CumulusHumilis

NM = [440.0, 550.0, 680.0]
#: Small droplets, whose Mie series are short.
CUMULUS = {"kind": "cumulus", "effective_radius": "1.5 um"}
SMALL = Box(latitude=47.0, longitude=11.0, size=3200.0, spacing=200.0, levels=8)


def _earth(*tables):
    return load_planet("earth-atmosphere-plus", {"clouds": list(tables)})


def test_every_cloud_has_a_field_at_the_place_and_its_optical_properties():
    found = clouds_of(_earth(CUMULUS, {"kind": "cirrus"}), NM, SMALL)
    assert [field.base for field, _ in found] == [1000.0, 8800.0]
    for field, optics in found:
        assert field.extinction.shape == (16, 16, 8)
        assert (field.latitude, field.longitude, field.beyond) == (47.0, 11.0, "periodic")
        np.testing.assert_array_equal(optics.wavelengths, NM)
    assert clouds_of(_earth(), NM) == ()


def test_fields_are_kept():
    (first, _), (second, _) = (clouds_of(_earth(CUMULUS), nm, SMALL)[0] for nm in ([550.0], NM))
    assert first is second


def test_edits_that_leave_shapes_generate_nothing(monkeypatch):
    # Reference: fields generated for themselves, to the rounding of single precision.
    shape = CumulusHumilis(seed=7.0, depth=700.0, shear=2e-3)
    edits = {"base": 1800.0, "optical_depth": 4.0, "wind_speed": 9.0, "effective_radius": 9e-6}
    moved = replace(shape, **edits, latitude=10.0, longitude=20.0)
    box = {"size": SMALL.size, "spacing": SMALL.spacing, "levels": SMALL.levels}
    fields = [cloud_field(one, **box) for one in (shape, moved)]
    known, _ = field_of(shape, SMALL, 6.4e6)
    monkeypatch.setattr(planet_clouds, "cloud_field", None)  # no more of them
    for one, expected in zip((shape, moved), fields, strict=True):
        found, radius = field_of(one, SMALL, 6.4e6)
        np.testing.assert_allclose(found.extinction, expected.extinction, rtol=2.5e-7)
        assert (found.spacing, found.base) == (expected.spacing, one.base)
        assert (found.beyond, radius) == (expected.beyond, one.effective_radius)
    assert (known.latitude, found.latitude, found.longitude) == (SMALL.latitude, 10.0, 20.0)
    with pytest.raises(TypeError):
        field_of(replace(shape, shear=0.0), SMALL, 6.4e6)  # which tilts clouds


def test_droplets_are_those_of_the_clouds():
    # a second way: exact Mie theory of one distribution
    clouds = CumulusHumilis(effective_radius=1.5e-6)
    optics = CloudOptics.of_clouds(clouds, NM)
    exact = droplets(1.5e-6, 1.0 / 9.0).asymmetries(NM)
    np.testing.assert_allclose(optics.phase.moments(NM, 1)[:, 1], exact, atol=2e-3)
    assert 0.75 < exact[1] < 0.85


def test_ice_scatters_half_into_the_peak_of_diffraction():
    optics = CloudOptics.of_clouds(Cirrus(), NM)
    moments = optics.phase.moments(NM, 1)
    np.testing.assert_allclose(moments, [[1.0, 0.75]] * 3, rtol=1e-6)
    # half of the light is diffracted, almost all within 5 degrees; little of the rest goes there
    angles = np.radians(np.linspace(0.0, 5.0, 20001))
    ring = 2.0 * np.pi * np.sin(angles)
    within = np.trapezoid(optics.phase.values(np.cos(angles), NM)[:, 1] * ring, angles)
    assert 0.44 < within < 0.51
    # an Airy disc of the radius falls to a half at x sin θ = 1.616
    half = np.array([1.0, np.cos(1.616 * 550e-9 / (2.0 * np.pi * 30e-6))])
    peak, there = optics.phase.values(half, NM)[:, 1]
    np.testing.assert_allclose(there / peak, 0.5, atol=0.01)


def test_crystals_smaller_than_wavelengths_are_refused():
    with pytest.raises(ParameterError, match="effective_radius"):
        CloudOptics.of_clouds(Cirrus(effective_radius=1e-6), NM)


def test_clouds_above_the_air_are_refused():
    planet = _earth({"kind": "cirrus", "base": "99 km"})
    with pytest.raises(
        ParameterError, match=r"clouds\[0\] is '100800 m'; allowed: tops of at most"
    ):
        clouds_of(planet, NM, SMALL)


def test_generated_clouds_may_have_a_place_of_their_own():
    storm = {"kind": "cumulonimbus", "latitude": "3 deg", "longitude": "-4 deg"}
    fields = [
        field for field, _ in clouds_of(_earth(storm, {"kind": "cirrus"}), [550.0], Box(10.0, 20.0))
    ]
    assert [(one.latitude, one.longitude) for one in fields] == [(3.0, -4.0), (10.0, 20.0)]
    assert [one.beyond for one in fields] == ["clear", "periodic"]
