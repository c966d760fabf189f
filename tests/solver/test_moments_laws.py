"""Laws that any solution obeys, whatever the planet."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import load_planet, planet_names, replace, solve
from airlight.errors import ConvergenceError
from airlight.physics.optics.reflection import LAWS
from airlight.planets import Constituent, Ground, Planet, Star
from airlight.planets.matter.phases import HenyeyGreenstein, Rayleigh
from airlight.planets.matter.profiles import Exponential, Uniform
from airlight.solver.moments.settings import QUALITIES
from airlight.solver.moments.solution import MomentsSolution


def random_lines(count: int, seed: int, highest: float = 100e3) -> dict[str, np.ndarray]:
    """Random observers in the air, suns from the zenith to 96°, all directions."""
    rng = np.random.default_rng(seed)
    return {
        "altitude": highest * rng.random(count) ** 2,
        "sun_zenith": rng.uniform(0.0, 96.0, count),
        "view_zenith": rng.uniform(0.0, 180.0, count),
        "azimuth": rng.uniform(0.0, 180.0, count),
    }


def test_the_first_order_is_less_than_all_orders(
    reference_earth: Callable[..., Planet], solved: Callable[..., MomentsSolution]
) -> None:
    # Every order adds light.
    solution = solved(reference_earth(albedo=0.3))
    where = random_lines(3000, 10)
    first, whole = (solution.radiance(**where, order=order).values for order in (1, None))
    assert (first <= whole * (1.0 + 1e-5)).all()
    day = where["sun_zenith"] < 85.0
    assert (first[day] < whole[day]).all()


def test_the_residual_keeps_its_promise(
    reference_earth: Callable[..., Planet], solved: Callable[..., MomentsSolution]
) -> None:
    # Second method: the same grids iterated a hundred times further. The last change was below
    # the tolerance and each order of clear air is about a third of the one before, so what is
    # missing is of the tolerance's size.
    planet = reference_earth(albedo=0.3)
    usual = QUALITIES["preview"]
    rough = solve(planet, None, usual, cache=False)  # type: ignore[arg-type]
    sharp = solve(planet, None, replace_settings(usual, 1e-5), cache=False)  # type: ignore[arg-type]
    assert max(rough.report.residual) <= usual.tolerance
    assert max(sharp.report.residual) <= 1e-5
    assert sharp.report.sweeps > rough.report.sweeps
    where = random_lines(2000, 11)
    where["sun_zenith"] = np.minimum(where["sun_zenith"], 88.0)
    got, truth = rough.radiance(**where).values, sharp.radiance(**where).values
    assert_allclose(got, truth, rtol=usual.tolerance)


def replace_settings(settings: object, tolerance: float) -> object:
    from dataclasses import replace as replace_field

    return replace_field(settings, tolerance=tolerance)  # type: ignore[type-var]


@pytest.mark.parametrize("threads", ["2", "5"])
def test_the_number_of_threads_changes_no_bit(
    threads: str, reference_earth: Callable[..., Planet], monkeypatch: pytest.MonkeyPatch
) -> None:
    planet = reference_earth(albedo=0.1)
    where = random_lines(5000, 12)
    results = []
    for named in ("1", threads):
        monkeypatch.setenv("AIRLIGHT_THREADS", named)
        solution = solve(planet, quality="preview", cache=False)
        results.append((solution.moments.field, solution.radiance(**where).values))
    for one, other in zip(*results, strict=True):
        assert_array_equal(one, other)


@pytest.mark.parametrize("count", [1, 3, 8, 9, 17])
def test_each_wavelength_has_its_answer_in_any_company(
    count: int, reference_earth: Callable[..., Planet], solved: Callable[..., MomentsSolution]
) -> None:
    # Wavelengths do not know each other. They share the number of sweeps with their seven
    # neighbours, so that what is missing may differ by the tolerance of the iteration.
    planet = reference_earth(albedo=0.1)
    nm = tuple(np.linspace(440.0, 680.0, count))
    where = random_lines(500, 13)
    where["sun_zenith"] = np.minimum(where["sun_zenith"], 90.0)
    together = solved(planet, nm, "preview").radiance(**where)
    for one in {nm[0], nm[count // 2], nm[-1]}:
        alone = solved(planet, (one,), "preview").radiance(**where)
        assert_allclose(
            together.sel(wavelength=one).values, alone.values[:, 0],
            rtol=QUALITIES["preview"].tolerance,
        )  # fmt: skip
    assert together.sizes["wavelength"] == count


def test_halving_a_gas_into_two_changes_nothing(
    reference_earth: Callable[..., Planet], solved: Callable[..., MomentsSolution]
) -> None:
    # Two constituents with half of the coefficients each are the same air.
    whole = reference_earth(albedo=0.1, aerosol=None)
    air = whole.constituents[0]
    gas = air.scattering
    half = replace(gas, values=tuple(x / 2 for x in gas.values))
    parts = tuple(replace(air, name=name, scattering=half) for name in ("half", "other half"))
    split = replace(whole, constituents=(*parts, *whole.constituents[1:]))
    where = random_lines(2000, 14)
    a, b = (solved(planet, quality="preview").radiance(**where).values for planet in (whole, split))
    # Sums of float32 in another order.
    assert_allclose(b, a, rtol=2e-5, atol=1e-12)


def test_halving_a_haze_into_two_changes_little(
    solved: Callable[..., MomentsSolution], tell: Callable[[str], None]
) -> None:
    # The cut of the forward peak is faded in with each constituent's own optical depth; what a
    # half of it does less must stay within the accuracy of the default quality.
    def hazy(*shares: float) -> Planet:
        return Planet(
            name="hazy",
            bottom_radius=6360e3,
            top_radius=6460e3,
            ground=Ground(albedo=0.1),
            star=Star(irradiance=1.0, angular_radius=0.0),
            constituents=tuple(
                Constituent(
                    name=f"haze {k}", profile=Exponential(scale_height=2e3),
                    scattering=share * 5e-5, phase_function=HenyeyGreenstein(asymmetry=0.75),
                )
                for k, share in enumerate(shares)
            ),
            default_wavelengths=(550.0,),
        )  # fmt: skip

    where = random_lines(3000, 15, highest=20e3)
    where["sun_zenith"] = np.minimum(where["sun_zenith"], 80.0)
    a, b = (solved(hazy(*shares)).radiance(**where).values for shares in ((1.0,), (0.5, 0.5)))
    change = np.abs(b / a - 1.0)
    tell(
        f"haze of depth 0.1 in two halves: median change {100 * np.median(change):.3f} %, 95 % "
        f"{100 * np.quantile(change, 0.95):.3f} %, max {100 * change.max():.2f} %"
    )
    assert np.median(change) <= 3e-3
    assert np.quantile(change, 0.95) <= 2e-2


@pytest.mark.parametrize("law", LAWS)
def test_light_goes_both_ways_alike_on_a_flat_planet(
    law: str, solved: Callable[..., MomentsSolution], tell: Callable[[str], None]
) -> None:
    # Helmholtz reciprocity of a flat layer: L(view, sun)/mu_s is symmetric in view and sun, all
    # orders and the ground included, whose laws are symmetric themselves. The planet is a thousand
    # Earths wide.
    flat = Planet(
        name="flat",
        bottom_radius=6.36e9,
        top_radius=6.36e9 + 60e3,
        ground=Ground(albedo=0.3, law=law),
        star=Star(irradiance=1.0, angular_radius=0.0),
        constituents=(
            Constituent(
                name="gas", profile=Exponential(scale_height=8e3), scattering=3e-5,
                absorption=3e-6, phase_function=Rayleigh(),
            ),
        ),
        default_wavelengths=(550.0,),
    )  # fmt: skip
    solution = solved(flat)
    a, b, phi = (
        x.ravel() for x in np.meshgrid([10.0, 35.0, 60.0], [20.0, 50.0, 75.0], [0, 70, 180])
    )

    def reflected(sun: np.ndarray, view: np.ndarray) -> np.ndarray:
        radiance = solution.radiance(
            altitude=60e3, sun_zenith=sun, view_zenith=180.0 - view, azimuth=phi
        )
        return radiance.values[:, 0] / np.cos(np.radians(sun))

    one, other = reflected(a, b), reflected(b, a)
    tell(f"reciprocity: largest difference {100 * np.abs(one / other - 1.0).max():.3f} %")
    # The sky counts as uniform where a law needs its directions: that is not symmetric.
    # Water, which mirrors most of it near the horizon, is off by 2.0 %, regolith, which returns
    # light towards the star, by 1.4 %.
    bounds = {"lambert": 5e-3, "water": 2e-2, "hapke": 2e-2}
    assert_allclose(one, other, rtol=bounds.get(law, 1e-2))


QUALITY_OF = {"earth": "default", "mars": "default"}


@pytest.mark.filterwarnings("ignore:.*without rings")
@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.slow) if name in ("mars", "titan", "venus") else name
        for name in planet_names()
    ],
)
def test_nothing_is_negative_or_nan_anywhere(
    name: str, solved: Callable[..., MomentsSolution]
) -> None:
    # From the ground to a hundred thousand kilometres, sun from the zenith to 110°, everywhere
    # to look, the axes of all coordinates included.
    solution = solved(load_planet(name), quality=QUALITY_OF.get(name, "preview"))
    rng = np.random.default_rng(16)
    n = 20_000
    altitude = np.concatenate([[0.0, 1e8], 10.0 ** rng.uniform(-2.0, 8.0, n - 2)])
    altitude[2:n:5] = solution.medium.thickness
    altitude[3:n:5] = 0.0
    sun = rng.uniform(0.0, 110.0, n)
    view = rng.uniform(0.0, 180.0, n)
    azimuth = rng.uniform(-180.0, 360.0, n)
    sun[::7] = rng.choice([0.0, 90.0, 110.0], sun[::7].size)
    view[::11] = rng.choice([0.0, 90.0, 180.0], view[::11].size)
    azimuth[::3] = rng.choice([0.0, 90.0, 180.0], azimuth[::3].size)
    down_to_planet = np.degrees(np.arcsin(1.0 / (1.0 + altitude / solution.medium.bottom_radius)))
    view[5::6] = 180.0 - down_to_planet[5::6] * rng.uniform(0.9, 1.03, view[5::6].size)
    view = np.clip(view, 0.0, 180.0)
    radiance = solution.radiance(
        altitude=altitude, sun_zenith=sun, view_zenith=view, azimuth=azimuth
    )
    assert np.isfinite(radiance.values).all()
    assert (radiance.values >= 0.0).all()
    inside = np.minimum(altitude, solution.medium.thickness)
    transmittance = solution.transmittance(altitude=altitude, view_zenith=view).values
    assert ((transmittance >= 0.0) & (transmittance <= 1.0)).all()
    light = solution.irradiance(altitude=inside, sun_zenith=sun)
    for part in ("direct", "diffuse"):
        assert np.isfinite(light[part].values).all()
        assert (light[part].values >= 0.0).all()


def test_who_looks_past_the_shell_sees_nothing(
    reference_earth: Callable[..., Planet], solved: Callable[..., MomentsSolution]
) -> None:
    # Empty space scatters nothing; the limb of the shell is where the tangent touches it.
    solution = solved(reference_earth(albedo=0.3))
    altitude = np.array([100e3 + 1.0, 400e3, 1e6, 1e8])
    edge = 180.0 - np.degrees(np.arcsin(6460e3 / (6360e3 + altitude)))
    options = {"altitude": altitude, "sun_zenith": 30.0, "azimuth": 60.0}
    assert_array_equal(solution.radiance(view_zenith=edge - 1e-6, **options).values, 0.0)
    assert (solution.radiance(view_zenith=edge + 0.1, **options).values > 0.0).all()
    clear = solution.transmittance(altitude=altitude, view_zenith=edge - 1e-6).values
    assert_array_equal(clear, 1.0)


def test_the_top_of_the_shell_cannot_be_seen(
    reference_earth: Callable[..., Planet], solved: Callable[..., MomentsSolution]
) -> None:
    # A centimetre more or less of air that is 4e-6 as dense as the ground's changes nothing; it
    # moves a line of sight by as much, 1e-5 of the aerosol's scale height.
    solution = solved(reference_earth(albedo=0.3))
    where = random_lines(2000, 17)
    where["view_zenith"] = np.random.default_rng(17).uniform(90.5, 180.0, 2000)
    where["sun_zenith"] = np.minimum(where["sun_zenith"], 90.0)
    below, above = (
        solution.radiance(**{**where, "altitude": altitude}).values
        for altitude in (100e3 - 0.01, 100e3 + 0.01)
    )
    assert_allclose(above, below, rtol=1e-4)


@pytest.mark.parametrize("altitude", [2.0, 1e3, 35e3, 400e3])
def test_light_settles_on_both_sides_of_the_horizon(
    altitude: float, reference_earth: Callable[..., Planet],
    solved: Callable[..., MomentsSolution],
) -> None:  # fmt: skip
    # At the horizon itself the light leaps, from the ground to the air behind it. On each side it
    # is continuous: the last steps towards the horizon change little, and less than the first.
    solution = solved(reference_earth(albedo=0.1))
    horizon = 180.0 - np.degrees(np.arcsin(6360e3 / (6360e3 + altitude)))
    for side in (-1.0, 1.0):
        steps = np.array([1e-7, 1e-6, 1e-5, 1e-4])
        radiance = solution.radiance(
            altitude=altitude, sun_zenith=[[30.0], [85.0]], view_zenith=horizon + side * steps,
            azimuth=40.0,
        ).values  # fmt: skip
        first = np.abs(radiance[:, 3] - radiance[:, 2])
        last = np.abs(radiance[:, 1] - radiance[:, 0])
        assert (last <= np.maximum(first, 1e-4 * radiance[:, 0])).all()
        # From 2 m, 1e-6 degree below the horizon brings the ground nearer by 0.6 % of 5 km.
        assert_allclose(radiance[:, 1], radiance[:, 0], rtol=6e-3)


def test_dusk_falls_smoothly(
    reference_earth: Callable[..., Planet], solved: Callable[..., MomentsSolution]
) -> None:
    # The sky at the zenith falls e-fold within a degree, without steps: the second difference of
    # its logarithm over 0.1° stays small beside the first.
    solution = solved(reference_earth(albedo=0.1))
    sun = np.arange(80.0, 100.0, 0.1)
    radiance = solution.radiance(altitude=0.0, sun_zenith=sun, view_zenith=0.0).values
    fall = np.diff(np.log(radiance), axis=0)
    assert (fall < 0.0).all()
    assert np.abs(np.diff(fall, axis=0)).max() < 0.05


@pytest.mark.validation
@pytest.mark.parametrize(
    ("name", "largest", "bearable"), [("mars-standard", 0.05, 0.05), ("mars", 0.25, 0.05)]
)
def test_default_agrees_with_fine_on_dusty_mars(
    name: str,
    largest: float,
    bearable: float,
    solved: Callable[..., MomentsSolution],
    tell: Callable[[str], None],
) -> None:
    # A second solution of half as high a degree again, with finer grids and quadratures (a little
    # coarser than "fine", to save time); the bar is that of the solvers' text. Of exact Mie dust,
    # what is scattered twice forwards is sharper than degree 16: three lines in a thousand, most
    # within 30° of the star, are off by more than 5 %, none by more than a quarter.
    from dataclasses import replace as replace_field

    finer = replace_field(
        QUALITIES["fine"], radii=32, sun_angles=80, zenith_angles=16, azimuths=16, tolerance=1e-3
    )
    mars = load_planet(name)
    mars = replace(
        mars,
        star=replace(
            mars.star, spectrum=None, irradiance=1.0, angular_radius=0.0, distance=None, radius=None
        ),
    )
    where = random_lines(4000, 18, highest=60e3)
    default, fine = (
        solved(mars, (680.0, 440.0), q).radiance(**where).values for q in ("default", finer)
    )
    bright = fine > 1e-6
    error = np.abs(default / fine - 1.0)[bright]
    tell(
        f"dusty Mars, default against fine: n {bright.sum()}, "
        f"median {100 * np.median(error):.3f} %, "
        f"95 % {100 * np.quantile(error, 0.95):.2f} %, max {100 * error.max():.1f} %"
    )
    assert np.median(error) <= 0.003
    assert np.quantile(error, 0.95) <= 0.02
    assert np.quantile(error, 0.995) <= bearable
    assert error.max() <= largest


@pytest.mark.parametrize("depth", [1.0, pytest.param(5.0, marks=pytest.mark.slow)])
def test_a_dust_storm_converges(
    depth: float, solved: Callable[..., MomentsSolution], tell: Callable[[str], None]
) -> None:
    # Each order keeps less than 1 - e^-τ of the last; the iteration must end in bounded time.
    mars = load_planet("mars")
    dust = mars.constituents[1]
    dust = replace(dust, matter=replace(dust.matter, optical_depth=depth))  # type: ignore[type-var]
    solution = solved(replace(mars, constituents=(mars.constituents[0], dust)))
    tell(f"Mars with dust of depth {depth}: {solution.report}"[:118])
    assert solution.report.sweeps < 60
    sky = solution.radiance(altitude=0.0, sun_zenith=40.0, view_zenith=[0.0, 60.0]).values
    assert (sky > 0.0).all()


def test_what_does_not_converge_says_so(reference_earth: Callable[..., Planet]) -> None:
    # A cloud of depth 800 needs half a million plain orders; with two allowed, one line says so.
    from dataclasses import replace as replace_field

    planet = reference_earth(albedo=1.0, aerosol=None, ozone=False)
    cloud = Constituent(
        name="cloud", profile=Uniform(), scattering=8e-3,
        phase_function=HenyeyGreenstein(asymmetry=0.85),
    )  # fmt: skip
    settings = replace_field(QUALITIES["preview"], max_sweeps=2)
    with pytest.raises(ConvergenceError, match=r"after 2 sweeps") as caught:
        solve(replace(planet, constituents=(cloud,)), [550.0], settings, cache=False)  # type: ignore[arg-type]
    assert "\n" not in str(caught.value)


def test_air_that_only_absorbs_shows_the_ground_through_itself() -> None:
    # Beer's law: L = T_view · albedo/π · mu_s · T_sun, nothing else.
    gas = Constituent(name="gas", profile=Exponential(scale_height=8e3), absorption=2e-5)
    planet = Planet(
        name="absorber", bottom_radius=6360e3, top_radius=6460e3, ground=Ground(albedo=0.4),
        star=Star(irradiance=2.0, angular_radius=0.0), constituents=(gas,),
        default_wavelengths=(550.0,),
    )  # fmt: skip
    solution = solve(planet, quality="preview", cache=False)
    down = solution.radiance(altitude=100e3, sun_zenith=[0.0, 50.0], view_zenith=180.0).values[:, 0]
    mu_s = np.cos(np.radians([0.0, 50.0]))
    sun = solution.transmittance(altitude=0.0, view_zenith=[0.0, 50.0]).values[:, 0]
    view = solution.transmittance(altitude=0.0, view_zenith=0.0).values[0]
    assert_allclose(down, 2.0 * 0.4 / np.pi * mu_s * sun * view, rtol=1e-3)
    sky = solution.radiance(altitude=0.0, sun_zenith=40.0, view_zenith=[0.0, 80.0]).values
    assert_array_equal(sky, 0.0)
