"""Layers that are thin compared with the shell: against Monte Carlo, laws and warnings."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_less

from airlight import solve
from airlight.errors import AirlightWarning
from airlight.planets import Constituent, Planet, load_planet, replace
from airlight.planets.ground import Ground
from airlight.planets.matter.phases import HenyeyGreenstein, Rayleigh
from airlight.planets.matter.profiles import Exponential, Tabulated, Tent
from airlight.planets.star import Star
from airlight.solver.moments.energy_balance import energy_error
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.montecarlo.settings import MonteCarloSettings
from airlight.studies.observables import observe
from airlight.validation.plane_parallel import flat_cases, ground_share, references

RADIUS, TOP = 6371e3, 100e3
#: From the ground and from 400 km, sun high and low.
LINES = {
    "altitude": [2.0, 2.0, 4e5, 2.0, 2.0, 4e5],
    "sun_zenith": [30.0, 30.0, 30.0, 75.0, 75.0, 75.0],
    "view_zenith": [60.0, 85.0, 150.0, 60.0, 85.0, 110.5],
    "azimuth": [90.0] * 6,
}


def planet(
    profile: Any, depth: float, *, albedo: float = 1.0, g: float = 0.8, radius: float = RADIUS,
    top: float = TOP, gas: float = 1.2e-5,
) -> Planet:  # fmt: skip
    """Gas of 8 km scale height, or none, and one layer over a ground of albedo 0.1."""
    strength = depth / profile.column(top)
    layer = Constituent(
        name="layer", profile=profile, scattering=strength * albedo,
        absorption=strength * (1.0 - albedo), phase_function=HenyeyGreenstein(asymmetry=g),
    )  # fmt: skip
    air = Constituent(
        name="gas", profile=Exponential(scale_height=8e3), scattering=gas, phase_function=Rayleigh()
    )
    return Planet(
        name="layered", bottom_radius=radius, top_radius=radius + top, ground=Ground(albedo=0.1),
        star=Star(irradiance=1.0, angular_radius=0.0047), default_wavelengths=(550.0,),
        constituents=(air, layer) if gas > 0.0 else (layer,),
    )  # fmt: skip


def slab(low: float, high: float, ramp: float, top: float = TOP) -> Tabulated:
    """Cloud with ramps, from a hundredth of its density on."""
    inner = [low, low + 0.5 * ramp, low + ramp, high - ramp, high - 0.5 * ramp, high]
    return Tabulated(
        altitudes=(0.0, low - ramp, *inner, high + ramp, top),
        densities=(1e-30, 1e-30, 0.01, 0.5, 1.0, 1.0, 0.5, 0.01, 1e-30, 1e-30),
    )


LAYERS = {
    "tent of 100 m": planet(Tent(center=10e3, half_width=100.0), 0.3),
    "fog of 50 m": planet(Exponential(scale_height=50.0), 0.5),
    "cirrus without gas": planet(slab(10e3, 11e3, 50.0), 0.3, gas=0.0),
    "haze at the top": planet(slab(TOP - 300.0, TOP - 50.0, 20.0), 0.2, g=0.0),
    "absorber": planet(slab(15e3, 15.5e3, 50.0), 1.0, albedo=0.0),
}


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",  # the fog is the thinnest, haze the highest
    [
        one if one.startswith(("fog", "haze")) else pytest.param(one, marks=pytest.mark.validation)
        for one in LAYERS
    ],
)
def test_radiances_of_thin_layers_are_those_of_monte_carlo(name: str) -> None:
    # A second method. Bounds of 1 % (default) and 3 % (preview), and four standard errors.
    settings = MonteCarloSettings(relative_error=0.006, most_histories=300_000)
    judge = solve(LAYERS[name], quality=settings, solver="montecarlo", polarisation=False)
    truth = judge.estimate(**LINES)
    radiance, noise = truth.radiance.values[:, 0], truth.standard_error.values[:, 0]
    for quality, bound in (("default", 0.01), ("preview", 0.03)):
        solution = solve(LAYERS[name], quality=quality, polarisation=False, cache=False)
        got = solution.radiance(**LINES).values[:, 0]
        assert_array_less(np.abs(got / radiance - 1.0), bound + 4.0 * noise / radiance)


@pytest.mark.slow
@pytest.mark.parametrize(
    "quality", ["preview", pytest.param("default", marks=pytest.mark.validation)]
)
def test_a_deep_cloud_sends_back_what_it_does_not_let_through(quality: str) -> None:
    # Conservation: nothing in the air absorbs, so that the Bond albedo, by quadrature of marched
    # radiances, and what the ground keeps are all the light that meets the planet, 0.76 % more
    # than that on the ground's disc: the limb's gas and cloud.
    cloud = planet(slab(20e3, 20.5e3, 50.0), 20.0, g=0.85)
    solution = solve(cloud, quality=quality, polarisation=False, cache=False)
    assert isinstance(solution, MomentsSolution)
    nodes, weights = np.polynomial.legendre.leggauss(200)
    mu = 0.6 * (nodes + 1.0) - 0.2
    light = solution.irradiance(altitude=0.0, sun_zenith=np.degrees(np.arccos(mu)))
    kept = 0.9 * 2.0 * 0.6 * weights @ (light.direct + light.diffuse).values[:, 0]
    returned = float(observe(solution, "bond-albedo").bond_albedo)
    assert_allclose(returned + kept, 1.0076, rtol=0.03 if quality == "preview" else 0.01)
    # Plane-parallel two-stream: R = τ'/(τ' + 4/3) with τ' = (1 - g)τ, with ground and gas a little
    # above; it is good to 5 %.
    assert_allclose(returned, 0.70, rtol=0.05)
    assert abs(solution.report.energy[0]) < solution.settings.energy_tolerance


def test_the_balance_of_an_absorbing_earth_closes_and_a_false_field_does_not() -> None:
    # A law, and the same law broken: of 5 % more diffuse light, some 20 to 40 % of what the planet
    # takes up, 1 to 2 % of that is in excess.
    solution = solve("earth", [680.0, 550.0, 440.0], "preview")
    assert isinstance(solution, MomentsSolution)
    moments = solution.moments
    error = energy_error(solution.setup, moments.field)
    assert_allclose(error, 0.0, atol=2e-3)
    false = energy_error(solution.setup, np.float32(1.05) * moments.field)
    assert_array_less(5e-3, false)


def test_light_that_is_lost_is_reported() -> None:
    # A conservative layer of depth 20, 20 km above a planet of 100 km: light goes around it. The
    # grid of this quality loses 5 %, and says so.
    hard = planet(Tent(center=20e3, half_width=86.0), 20.0, g=0.6, radius=100e3, top=22e3)
    with pytest.warns(AirlightWarning, match=r"energy is not conserved: .* at 550 nm \(limit"):
        solution = solve(hard, quality="preview", polarisation=False, cache=False)
    assert "energy is not conserved" in str(solution.report)


def test_the_height_of_a_shell_does_not_matter() -> None:
    # Above 130 km there is no air: 1e-7 of it, and grids end a tenth above. The radius of the shell
    # is a convention; the suns of the grid follow the height that is left.
    low = load_planet("earth-atmosphere-plus")
    views = {"altitude": [0.0, 4e5], "sun_zenith": [[30.0], [88.0]], "view_zenith": [80.0, 110.0]}
    truth = solve(replace(low, top_radius=6360e3 + 142e3), quality="preview").radiance(**views)
    for height in (400e3, 57e6):
        high = solve(replace(low, top_radius=6360e3 + height), quality="preview", cache=False)
        assert high.medium.thickness < 150e3
        assert_allclose(high.radiance(**views), truth, rtol=5e-3)
        # The columns are those of the whole shell.
        depth = solve(low, quality="preview").medium.vertical_optical_depth
        assert_allclose(high.medium.vertical_optical_depth, depth, rtol=4e-6)


def test_ordinary_planets_have_one_step_a_cell_and_no_warning() -> None:
    # By definition: nothing on Mars changes within 50 m of altitude.
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        solution = solve("mars", [550.0], "preview", cache=False)
    first = solution.medium.density.first_nodes
    assert_allclose(np.diff(first), 1.0)


@pytest.mark.slow
@pytest.mark.parametrize(
    "room", [*(pytest.param(one, marks=pytest.mark.validation) for one in (1.0, 1.1)), 3.0]
)
def test_deep_clouds_that_fill_much_of_their_shell_are_resolved(room: float) -> None:
    # flat air, against discrete ordinates (``validation.plane_parallel``): its shell is cut. With
    # no room at all light converges slowly; the other two are solved once more on finer grids.
    case = next(one for one in flat_cases() if one.name.startswith("cloud of depth 30"))
    top = case.planet.bottom_radius + 8e3 * room
    cut = replace(case.planet, top_radius=top)
    solution = solve(cut, [case.wavelength], polarisation=False, cache=False)
    assert_allclose(ground_share(solution), references()[case.name].ground, rtol=1e-2)
    assert np.abs(solution.report.energy).max() < 5e-3
