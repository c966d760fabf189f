"""Quantities at the public door: the same numbers as plain ones, or one line."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pint
import pytest
import xarray
from numpy.testing import assert_allclose, assert_array_equal

import airlight
from airlight.engines.composition.placement import Placement
from airlight.errors import ParameterError
from airlight.geometry.ephemeris.sky import Place
from airlight.physics.spectra.blackbody import planck_radiance
from airlight.solver.moments.solution import MomentsSolution
from airlight.studies.fit.measurements import Measurements
from airlight.studies.fit.parameter import FitParameter
from airlight.studies.fit.settings import FitSettings
from airlight.studies.sweep import Grid

UNIT = pint.UnitRegistry()
EARTH = airlight.load_planet("earth-bruneton")


@pytest.fixture(scope="module")
def sky(solved: Callable[..., MomentsSolution]) -> MomentsSolution:
    return solved(EARTH, (680.0, 550.0, 440.0), "preview")


def test_lines_of_sight_in_other_units_have_the_same_light(sky: MomentsSolution) -> None:
    # definitions of the units: pi/3 is 60°; a labelled array in km
    plain = sky.radiance(altitude=2e3, sun_zenith=60.0, view_zenith=[0.0, 45.0], azimuth=90.0)
    quantities = sky.radiance(
        altitude=2.0 * UNIT.km, sun_zenith=math.pi / 3 * UNIT.rad,
        view_zenith=UNIT.Quantity([0.0, math.pi / 4], "rad"), azimuth="90 deg",
    )  # fmt: skip
    labelled = sky.radiance(
        altitude=xarray.DataArray(2.0, attrs={"units": "km"}), sun_zenith=60.0,
        view_zenith=xarray.DataArray([0.0, 45.0], dims="view_zenith", attrs={"units": "degree"}),
        azimuth=90.0,
    )  # fmt: skip
    for other in (quantities, labelled):
        assert_allclose(other.values, plain.values, rtol=1e-12)
        assert_allclose(other.view_zenith, [0.0, 45.0], rtol=1e-15)
        assert other.altitude.item() == 2000.0


def test_ranges_are_lines_of_sight(sky: MomentsSolution) -> None:
    found = sky.radiance(altitude="2 km", sun_zenith=60.0, view_zenith="0:80:40")
    assert found.dims == ("view_zenith", "wavelength")
    assert_array_equal(found.view_zenith, [0.0, 40.0, 80.0])


def test_stretches_and_irradiances_take_quantities(sky: MomentsSolution) -> None:
    plain = sky.transmittance(altitude=0.0, view_zenith=80.0, distance=5e3)
    other = sky.transmittance(altitude=0.0 * UNIT.km, view_zenith="80 deg", distance=5.0 * UNIT.km)
    assert_allclose(other.values, plain.values, rtol=1e-14)
    received = sky.irradiance(altitude=1.0 * UNIT.km, sun_zenith=0.0 * UNIT.rad)
    assert_allclose(received.direct, sky.irradiance(altitude=1e3, sun_zenith=0.0).direct)


def test_observables_take_quantities_and_the_attribute_units(sky: MomentsSolution) -> None:
    heights = xarray.DataArray([1.0, 20.0], dims="h", attrs={"units": "km"})
    limb = airlight.observe(sky, "limb", tangent_heights=heights, sun_zenith=math.pi / 3 * UNIT.rad)
    plain = airlight.observe(sky, "limb", tangent_heights=[1e3, 20e3], sun_zenith=60.0)
    assert_array_equal(limb.tangent_height, [1e3, 20e3])
    assert_allclose(limb.radiance, plain.radiance, rtol=1e-12)
    with pytest.raises(ParameterError, match=r"sun_zenith is .* something else"):
        airlight.observe(sky, "limb", sun_zenith=1.0 * UNIT.km)


def test_wavelengths_are_lengths_of_any_unit() -> None:
    # definitions: 10 ångström are a nanometre
    micrometres = xarray.DataArray([0.55], dims="wavelength", attrs={"units": "micrometer"})
    for given in (UNIT.Quantity([5500.0], "angstrom"), "0.55 um", micrometres):
        assert_allclose(airlight.solve(EARTH, given, "preview").wavelengths, 550.0, rtol=1e-14)
    with pytest.raises(ParameterError, match=r"wavelengths is .* something else"):
        airlight.solve(EARTH, UNIT.Quantity([18181.8], "1/cm"), "preview")
    for given in (550.0 * UNIT.nm, "0.55 um"):
        assert_allclose(
            planck_radiance(given, 5772.0 * UNIT.K), planck_radiance(550.0, 5772.0), rtol=1e-14
        )


def test_scenes_cameras_and_places_take_quantities() -> None:
    half = 0.5 * math.pi * UNIT.rad
    camera = airlight.Camera(field_of_view=half, look_zenith=half, roll=10.0 * UNIT.deg)
    assert (camera.field_of_view, camera.look_zenith, camera.roll) == (90.0, 90.0, 10.0)
    scene = airlight.Scene(
        altitude=400.0 * UNIT.km, sun_zenith=half, latitude=45.0 * UNIT.deg, camera=camera,
        secondary_lights=(airlight.MoonLight(zenith=half, phase=half),),
    )  # fmt: skip
    assert (scene.altitude, scene.sun_zenith, scene.latitude) == (400e3, 90.0, 45.0)
    assert (scene.secondary_lights[0].zenith, scene.secondary_lights[0].phase) == (90.0, 90.0)  # type: ignore[attr-defined]
    place = Place(latitude=half, longitude=0.0, altitude=2.0 * UNIT.km)  # type: ignore[arg-type]
    assert (place.latitude, place.altitude) == (90.0, 2000.0)
    assert Placement(altitude=2.0 * UNIT.km, heading=half).heading == 90.0
    zenith, _ = airlight.look_at(
        "W/20", altitude=1.0 * UNIT.km, sun_zenith=half, bottom_radius=6360.0 * UNIT.km
    )
    assert zenith == 70.0
    with pytest.raises(ParameterError, match=r"scene.altitude is .* something else"):
        airlight.Scene(altitude=3.0 * UNIT.rad)


def test_overrides_and_planets_take_quantities() -> None:
    changed = airlight.load_planet(
        "earth",
        {
            "shell.top_radius": 6500.0 * UNIT.km,
            "wavelengths": UNIT.Quantity([0.4, 0.7], "um"),
            "ozone.absorption.ozone": 0.1338 * UNIT.mol / UNIT.m**2,
            "ground.albedo": np.float32(0.25),
        },
    )
    assert changed.top_radius == 6500e3
    assert_allclose(changed.wavelengths, [400.0, 700.0], rtol=1e-14)
    assert changed.ground.albedo == 0.25
    # Avogadro's number of molecules in a mole
    absorption: Any = changed.constituents[2].absorption
    assert_allclose(absorption.column, 0.1338 * 6.02214076e23, rtol=1e-12)
    higher = airlight.replace(EARTH, top_radius=6450.0 * UNIT.km)
    assert higher.top_radius == 6450e3
    for wrong in (3.0 * UNIT.s, UNIT.Quantity([1.0, 2.0], "km")):
        with pytest.raises(ParameterError, match="top_radius is "):
            airlight.load_planet("earth", {"shell.top_radius": wrong})
        with pytest.raises(ParameterError, match="top_radius is "):
            airlight.replace(EARTH, top_radius=wrong)


def test_grids_and_measurements_take_quantities() -> None:
    grid = Grid(
        planets="earth-bruneton", sun_zenith="0:60:30", view_zenith=[0.0 * UNIT.rad, "60 deg"],
        altitude=UNIT.Quantity([0.0, 2.0], "km"), wavelengths="0.5, 0.6 um",
        vary={"ground.albedo": "0.1:0.3:0.1", "shell.top_radius": [6430.0 * UNIT.km]},
    )  # fmt: skip
    assert grid.shape == (1, 3, 1, 2, 3, 2, 1, 2)
    assert (grid.altitude, grid.view_zenith) == ((0.0, 2000.0), (0.0, 60.0))
    assert_allclose(grid.nm, [500.0, 600.0], rtol=1e-14)
    assert grid.planet((0, 2, 0)).ground.albedo == pytest.approx(0.3)
    assert grid.planet((0, 0, 0)).top_radius == 6430e3
    one = np.zeros(1, np.int64)
    data = Measurements(
        source="-", wavelength=UNIT.Quantity([0.5], "um"), altitude=UNIT.Quantity([1.0], "km"),
        sun_zenith=UNIT.Quantity([math.pi], "rad"), view_zenith=[0.0], azimuth=[0.0],
        radiance=UNIT.Quantity([2.0], "W/m**2/sr/um"), uncertainty=None, scan=one, scans=("a",),
    )  # type: ignore[arg-type] # fmt: skip
    assert_allclose(data.wavelength, 500.0, rtol=1e-14)
    assert (data.altitude[0], data.sun_zenith[0]) == (1000.0, 180.0)
    assert_allclose(data.radiance, 2e-3, rtol=1e-14)


def test_starts_and_bounds_of_a_fit_are_read_in_the_parameter_s_unit() -> None:
    # 300 DU are 0.3 atm-cm, by definition
    ozone = FitParameter(name="o", unit="DU", start=300.0, low=0.0, high=900.0, least_step=1.0)
    assert_allclose(ozone.number("0.3 atm-cm", "start"), 300.0, rtol=1e-12)
    assert ozone.number(250, "start") == 250.0
    height = FitParameter(name="h", unit="km", start=1.0, low=0.1, high=9.0, least_step=0.1)
    assert height.number(1500.0 * UNIT.m, "start") == 1.5
    with pytest.raises(ParameterError, match=r"start of h is .* something else"):
        height.number(3.0 * UNIT.s, "start of h")
    assert FitSettings(free=["h"], uncertainty=3.0 * UNIT.percent).uncertainty == pytest.approx(
        0.03
    )


@pytest.mark.parametrize("of", ["rgb", "depth"])
def test_pictures_with_units_are_refused(of: str) -> None:
    # depth counts in units of its scene, whatever they are
    camera = airlight.Pinhole(width=2, height=1, focal_x=1.0, focal_y=1.0, to_world=np.eye(4))
    arrays: dict[str, Any] = {"rgb": np.ones((1, 2, 3)), "depth": np.ones((1, 2))}
    arrays[of] = arrays[of] * UNIT.km
    with pytest.raises(ParameterError, match=f"{of} is .* without a unit"):
        airlight.compose(**arrays, camera=camera, solution=EARTH, place=Placement())
