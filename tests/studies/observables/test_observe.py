"""The catalogue of observables: what each gives, what it refuses, what it says."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from spheres import RADIUS, sphere

from airlight import ParameterError
from airlight.planets import Star
from airlight.solver.moments.solution import MomentsSolution
from airlight.studies.observables import KINDS, observe

Solved = Callable[..., MomentsSolution]
TWO = (680.0, 440.0)
#: A star whose size and distance are known.
NEAR = Star(temperature=3000.0, radius=1e8, distance=5e9)


@pytest.fixture
def solution(solved: Solved) -> MomentsSolution:
    return solved(sphere(0.2, 0.3, star=NEAR), TWO, "preview")


@pytest.mark.parametrize("of", list(KINDS))
def test_every_observable_says_what_it_is_and_its_units(of: str, solution: MomentsSolution) -> None:
    few: dict[str, Any] = {"phase-curve": {"phase_angles": [0.0, 90.0]}, "limb": {
        "tangent_heights": [0.0, 20e3]}}.get(of, {})  # fmt: skip
    data = observe(solution, of, **few)
    assert data["wavelength"].values.tolist() == list(TWO)
    assert data.attrs["observable"] == of
    assert data.attrs["planet"] == "sphere"
    assert data.attrs["notes"]
    for one in data.data_vars.values():
        assert one.attrs["units"]
        assert one.attrs["long_name"]
        assert np.isfinite(one.values).all()
        assert (one.values >= 0.0).all()


def test_the_disc_beside_its_star(solution: MomentsSolution) -> None:
    # contrast = A (R/a)²; the mean radiance of a white disc at full phase is E/π
    data = observe(solution, "disc", phase_angles=[0.0, 60.0])
    assert_allclose(data["contrast"], data["reflectance"] * (RADIUS / 5e9) ** 2)
    sun = solution.lights[0].irradiance
    assert_allclose(data["radiance"], data["reflectance"].values * sun / np.pi)
    curve = observe(solution, "phase-curve", phase_angles=[60.0])
    assert_allclose(curve["reflectance"].values[0], data["reflectance"].values[1])
    albedo = observe(solution, "geometric-albedo")["geometric_albedo"]
    assert_allclose(albedo, data["reflectance"].values[0])
    assert_allclose(curve["phase_function"], curve["reflectance"] / albedo)


def test_a_larger_reference_disc_has_a_smaller_albedo(solution: MomentsSolution) -> None:
    own = observe(solution, "geometric-albedo")["geometric_albedo"]
    other = observe(solution, "geometric-albedo", radius=2.0 * RADIUS)
    assert_allclose(other["geometric_albedo"], own / 4.0)
    assert "12720 km" in other.attrs["notes"]


def test_the_bond_albedo_is_the_mean_over_the_stars_light(solution: MomentsSolution) -> None:
    data = observe(solution, "bond-albedo")
    sun = solution.lights[0].irradiance
    wanted = (sun * data["spherical_albedo"].values).sum() / sun.sum()  # two wavelengths: trapezia
    assert_allclose(float(data["bond_albedo"]), wanted)
    assert "other wavelengths are not included" in data.attrs["notes"]


def test_what_is_not_known_of_the_star_is_left_out_and_said(solved: Solved) -> None:
    alone = solved(sphere(0.2, 0.3), TWO, "preview")
    assert "contrast" not in observe(alone, "disc")
    assert "contrast omitted" in observe(alone, "disc").attrs["notes"]
    transit = observe(alone, "transmission")
    assert "transit_depth" not in transit
    assert "transit depth omitted" in transit.attrs["notes"]
    known = observe(solved(sphere(0.2, 0.3, star=NEAR), TWO, "preview"), "transmission")
    assert_allclose(known["transit_depth"], (known["effective_radius"] / 1e8) ** 2)


@pytest.mark.parametrize(
    ("of", "settings", "field"),
    [
        ("colour", {}, "of"),
        ("disc", {"phase_angles": [181.0]}, "phase_angles"),
        ("disc", {"phase_angles": []}, "phase_angles"),
        ("disc", {"phase_angles": "half"}, "phase_angles"),
        ("disc", {"tangent_heights": [1e3]}, "tangent_heights"),
        ("transmission", {"radius": 1e6}, "radius"),
        ("geometric-albedo", {"radius": 0.0}, "radius"),
        ("limb", {"tangent_heights": [121e3]}, "tangent_heights"),
        ("limb", {"sun_zenith": np.nan}, "sun_zenith"),
        ("limb", {"azimuth": 500.0}, "azimuth"),
    ],
)
def test_settings_that_make_no_sense_are_refused(
    of: str, settings: dict[str, Any], field: str, solution: MomentsSolution
) -> None:
    with pytest.raises(ParameterError) as caught:
        observe(solution, of, **settings)
    assert caught.value.field == field
    assert "\n" not in str(caught.value)
