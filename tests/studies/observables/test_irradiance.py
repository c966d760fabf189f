"""Irradiance of planes: sums, limits, published illuminance, and what wavelengths do not reach."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import AirlightWarning, Scene, load_planet, solve
from airlight.errors import ParameterError
from airlight.physics.constants import ASTRONOMICAL_UNIT
from airlight.solver.moments.solution import MomentsSolution
from airlight.studies.observables import irradiance
from airlight.studies.observables.plane_irradiance import Plane
from airlight.studies.observables.spectral_integrals import (
    WEIGHTED,
    SpectralIntegrals,
    irradiance_wavelengths,
)
from airlight.validation.published.twilight import illuminance_seidelmann1992

NM = tuple(float(nm) for nm in range(380, 701, 20))


@pytest.fixture
def earth(solved: Callable[..., MomentsSolution]) -> MomentsSolution:
    return solved(load_planet("earth"), NM, "preview")


def test_level_plane_receives_what_the_ground_does(earth: MomentsSolution) -> None:
    # a level plane is the ground's own; its parts are the direct and the diffuse light
    scenes = [Scene(altitude=0.0, sun_zenith=zenith) for zenith in (0.0, 60.0, 89.9, 94.0)]
    found = irradiance(earth, scenes, plane=Plane(tilt=0.0))
    assert_allclose(found.poa, found.ghi, rtol=1e-5)
    assert_allclose(found.poa_sky, found.dhi, rtol=1e-5)
    assert_allclose(found.poa_ground, 0.0, atol=1e-9)


def test_spectral_light_is_that_of_the_solution(earth: MomentsSolution) -> None:
    # the solution counts light near the sun as direct; the sum is the same
    found = irradiance(earth, Scene(altitude=3e3, sun_zenith=50.0), spectral=True)
    own = earth.irradiance(altitude=3e3, sun_zenith=50.0)
    assert_allclose(found.ghi, own.direct + own.diffuse, rtol=1e-6)
    assert (found.dni * np.cos(np.radians(50.0)) <= own.direct * 1.001).all()


def test_radiance_over_the_sky_adds_up_to_diffuse_light(earth: MomentsSolution) -> None:
    # A second way to the same light: the sky's radiance by the midpoint rule in sin², without what
    # is scattered by less than a step; 1.5 % is the solver's at this quality.
    found = irradiance(earth, Scene(altitude=0.0, sun_zenith=40.0), spectral=True)
    count = 60
    sine = np.sqrt((np.arange(count) + 0.5) / count)
    azimuth = 180.0 * (np.arange(count) + 0.5) / count
    light = earth.radiance(
        altitude=0.0,
        sun_zenith=40.0,
        view_zenith=np.degrees(np.arcsin(sine))[:, None],
        azimuth=azimuth[None, :],
    )
    assert_allclose(np.pi * light.mean(light.dims[:2]), found.dhi, rtol=0.015)


def test_plane_that_faces_the_sun_receives_its_direct_light(earth: MomentsSolution) -> None:
    # cos i = 1; refraction raises the sun by 0.03 degrees at most
    scene = Scene(altitude=0.0, sun_zenith=60.0, sun_azimuth=120.0)
    found = irradiance(earth, scene, plane=Plane(tilt=60.0, azimuth=120.0))
    assert_allclose(found.poa_direct, found.dni, rtol=1e-4)
    away = irradiance(earth, scene, plane=Plane(tilt=60.0, azimuth="WNW"))
    assert away.poa_direct < 0.1 * found.poa_direct


def test_plane_that_faces_down_receives_reflected_light(earth: MomentsSolution) -> None:
    # a Lambert ground returns its albedo of what it receives
    scene = Scene(altitude=0.0, sun_zenith=30.0)
    down = irradiance(earth, scene, plane=Plane(tilt=180.0), spectral=True)
    assert earth.planet is not None
    albedo = earth.planet.ground.albedos(NM)
    assert_allclose(down.poa, albedo * down.ghi, rtol=1e-3)
    assert_allclose(down.poa_sky, 0.0, atol=1e-9)


def test_weights_of_flat_light_are_those_of_their_definitions(earth: MomentsSolution) -> None:
    # 1 W/m²/nm everywhere: the integrals are those of the weights
    integrals = SpectralIntegrals(earth)
    integrals.star[:] = 1.0
    flat = np.ones((1, len(NM)))
    assert_allclose(integrals.broadband(flat), 320.0)
    assert_allclose(integrals.weighted(WEIGHTED["par"], flat), 300.0)
    # 106.857 nm: the sum of the luminous efficiency (Wyszecki & Stiles 1982); 0.1 % of it lies
    # beyond the solution's wavelengths
    assert_allclose(integrals.weighted(WEIGHTED["illuminance"], flat), 683.0 * 106.857, rtol=2e-3)
    # the mean photon of 400 to 700 nm is that of 550 nm: 4.598 µmol/J (CODATA)
    assert_allclose(integrals.weighted(WEIGHTED["par_photons"], flat), 300.0 * 4.598, rtol=1e-4)


def test_overhead_sun_gives_the_published_illuminance(earth: MomentsSolution) -> None:
    # Seidelmann's fit (twilight.illuminance_seidelmann1992): 10^5.11 lx of an average clear day, of
    # more aerosol than the preset; textbooks: 100 to 130 klx
    found = irradiance(earth, Scene(altitude=0.0, sun_zenith=0.0))
    assert 100e3 < found.illuminance < 130e3
    assert_allclose(found.illuminance, illuminance_seidelmann1992(90.0), rtol=0.15)


def test_a_series_is_lit_from_the_distance_of_each_time(earth: MomentsSolution) -> None:
    # 1/d² of the ephemeris; the preset's sun is at 1 au
    times = [datetime(2026, month, 4, 12, tzinfo=UTC) for month in (1, 7)]
    scenes = [
        Scene.at(load_planet("earth"), latitude=0.0, longitude=0.0, time=one) for one in times
    ]
    found = irradiance(earth, scenes)
    assert found.ghi.dims == ("time",)
    assert found.time.values[1] == np.datetime64("2026-07-04T12:00")
    planet = load_planet("earth")
    factors = [(ASTRONOMICAL_UNIT / planet.lit_at(one).star.known_distance) ** 2 for one in times]
    same = irradiance(earth, scenes, true_distance=False)
    assert_allclose(found.extraterrestrial / same.extraterrestrial, factors, rtol=1e-12)
    assert_allclose(found.ghi / same.ghi, factors, rtol=1e-12)


def test_integrals_beyond_the_wavelengths_are_not_given(earth: MomentsSolution) -> None:
    found = irradiance(earth, Scene(altitude=0.0, sun_zenith=30.0))
    assert np.isnan(found.uv_index)
    assert "do not reach for uv_index" in found.attrs["notes"]
    assert found.ghi.attrs["wavelength_range"] == "380 to 700 nm"
    assert "380 to 700 nm" in found.ghi.attrs["long_name"]


def test_too_few_wavelengths_are_warned_of(solved: Callable[..., MomentsSolution]) -> None:
    # between 280 and 400 nm lies the edge of ozone's band, which two wavelengths do not show
    solution = solved(load_planet("earth"), (280.0, 400.0), "preview")
    with pytest.warns(AirlightWarning, match="too few wavelengths: estimated errors of ghi"):
        irradiance(solution, Scene(altitude=0.0, sun_zenith=30.0))
    one = solved(load_planet("earth"), (550.0,), "preview")
    with pytest.raises(ParameterError, match="two or more, or spectral"):
        irradiance(one, Scene(altitude=0.0))


def test_default_wavelengths_resolve_ozone_and_the_planets_range() -> None:
    # steps of 20 nm where the air is smooth, and the estimate of the error that they were chosen by
    nm = np.array(irradiance_wavelengths(load_planet("earth")))
    assert (nm[0], nm[-1]) == (280.0, 2500.0)
    assert np.diff(nm[nm <= 1000.0]).max() <= 21.0
    assert np.diff(nm).max() <= 101.0
    assert np.diff(nm[nm > 400.0]).min() > 15.0
    assert np.diff(nm[(nm > 300.0) & (nm < 325.0)]).max() <= 4.0
    mars = irradiance_wavelengths(load_planet("mars"))
    assert (mars[0], mars[-1]) == load_planet("mars").wavelength_limits


@pytest.mark.slow
def test_direct_light_is_that_of_astm_g173() -> None:
    # ASTM G173-03: 900.1 W m⁻² at air mass 1.5, 280 to 4000 nm, of which 4.4 lie above 2500 nm,
    # with 2.5° of the aureole; its turbidity 0.084 at 500 nm takes 1 % more than the preset's, its
    # 14.2 mm of water are the preset's.
    found = irradiance("earth", Scene(altitude=0.0, sun_zenith=48.19))
    assert found.ghi.attrs["wavelength_range"] == "280 to 2500 nm"
    assert_allclose(found.dni, 900.1 - 4.4, rtol=0.02)
    assert found.extraterrestrial > 0.96 * 1347.9


def test_bands_keep_their_means() -> None:
    # the sum of bands is that of the spectrum, whatever is between their middles
    planet = load_planet("earth")
    nm, widths = np.array([740.0, 760.0, 780.0]), np.full(3, 20.0)
    solution = solve(planet, nm, "preview", bandwidth=widths, cache=False)
    scene = Scene(altitude=0.0, sun_zenith=40.0)
    whole = irradiance(solution, scene)
    parts = irradiance(solution, scene, spectral=True)
    assert whole.dni.attrs["wavelength_range"] == "730 to 790 nm"
    assert_allclose(whole.dni, 20.0 * parts.dni.sum(), rtol=2e-3)


def test_overlapping_bands_are_interpolated() -> None:
    # exponential light has exponential light between bands of 20 nm every 5 nm; the mean of any one
    # of them would be a step
    nm = np.arange(450.0, 651.0, 5.0)
    planet = load_planet("earth-bruneton")
    integrals = SpectralIntegrals(solve(planet, nm, "preview", bandwidth=20.0, cache=False))
    found = integrals.spectra(np.exp(-nm / 100.0)[None])[0] / integrals.star
    inside = (integrals.dense >= 450.0) & (integrals.dense <= 650.0)
    assert_allclose(found[inside], np.exp(-integrals.dense[inside] / 100.0), rtol=1e-9)


@pytest.mark.slow
def test_uv_index_is_that_of_madronich(solved: Callable[..., MomentsSolution]) -> None:
    # Madronich (2007), Photochem. Photobiol. 83, 1537: 12.5 μ^2.42 (Ω/300)^-1.23 of clean air over
    # dark ground. The preset has aerosol, 3 to 5 % less light, and ozone's cross-section at 293 K,
    # 10 % above that of the ozone layer: down to 25 % less.
    planet = load_planet("earth", {"aerosol.optical_depth": 0.0})
    nm = tuple(one for one in irradiance_wavelengths(planet) if one <= 420.0)
    scenes = [Scene(altitude=0.0, sun_zenith=zenith) for zenith in (0.0, 30.0, 50.0)]
    found = irradiance(solved(planet, nm, "preview"), scenes).uv_index
    published = 12.5 * np.cos(np.radians([0.0, 30.0, 50.0])) ** 2.42 * (345.0 / 300.0) ** -1.23
    ratio = found / published
    assert ((ratio > 0.75) & (ratio < 1.05)).all()


def test_clouds_are_the_mean_of_columns() -> None:
    # independent columns: cover times the light below clouds, and the rest below clear air
    cloudy = load_planet("earth", {"clouds": [{"kind": "cumulus", "cover": 0.4}]})
    solution = solve(cloudy, (500.0, 600.0), "preview", cache=False)
    scene = Scene(altitude=0.0, sun_zenith=40.0)
    parts = [irradiance(one.solution, scene, spectral=True) for one in solution.columns]
    fractions = [one.fraction for one in solution.columns]
    whole = irradiance(solution, scene, spectral=True)
    for name in ("ghi", "dni", "dhi"):
        mean = sum(f * one[name] for f, one in zip(fractions, parts, strict=True))
        assert_allclose(whole[name], mean, rtol=1e-6)
