"""Attributes of results: complete by the CF conventions, and equal for equal computations."""

from __future__ import annotations

from pathlib import Path

import pytest
import xarray

import airlight
from airlight.planets import load_planet
from airlight.solver import solve
from airlight.studies.observables import observe

WHERE = {"altitude": 0.0, "sun_zenith": [30.0, 60.0], "view_zenith": 10.0}


@pytest.mark.parametrize("solver", ["moments", "montecarlo"])
def test_identical_computations_are_identical(solver: str) -> None:
    # by definition of ``identical``: values, coordinates and all attributes; cached or not
    planet = load_planet("earth-atmosphere-plus")
    first, second = (
        solve(planet, [550.0], "preview", solver=solver, cache=cached) for cached in (False, True)
    )
    xarray.testing.assert_identical(first.radiance(**WHERE), second.radiance(**WHERE))
    xarray.testing.assert_identical(
        first.irradiance(altitude=0.0, sun_zenith=30.0),
        second.irradiance(altitude=0.0, sun_zenith=30.0),
    )


def test_results_say_planet_version_settings_and_conventions(tmp_path: Path) -> None:
    # attributes and standard names of the CF conventions 1.10, and what was computed
    planet = load_planet("earth-atmosphere-plus")
    solution = solve(planet, [550.0], "preview")
    light = solution.radiance(**WHERE)
    for attributes in (
        light.attrs,
        solution.irradiance(altitude=0.0, sun_zenith=30.0).attrs,
        solution.transmittance(altitude=0.0, view_zenith=0.0).attrs,
        observe(solution, "geometric-albedo").attrs,
    ):
        assert attributes["planet"] == planet.name
        assert attributes["version"] == airlight.__version__
        assert attributes["settings"] == solution.report.settings
        assert attributes["Conventions"] == "CF-1.10"
        assert " s (" not in attributes["solver"]
        assert "cache" not in attributes["solver"]
    assert light.sun_zenith.standard_name == "solar_zenith_angle"
    assert (light.wavelength.units, light.wavelength.standard_name) == (
        "nm", "radiation_wavelength",
    )  # fmt: skip
    light.to_netcdf(tmp_path / "light.nc", engine="scipy")
    with xarray.open_dataarray(tmp_path / "light.nc") as read:
        xarray.testing.assert_identical(read.load(), light)
