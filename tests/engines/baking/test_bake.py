"""Baked tables: exact at texels, close between them, on Earth, Mars and a small dense planet."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.engines.baking.air_light import AirLight, lines_of_sight
from airlight.engines.baking.bake import Baked, bake
from airlight.engines.baking.look_up_code import texture_name
from airlight.engines.baking.table_errors import DIM, peaked_positions, random_positions, regions
from airlight.errors import Cancelled, ParameterError
from airlight.geometry.mappings.scattering import lowest_sun_cosine
from airlight.geometry.shell import horizon_cosine
from airlight.kernel import vectorized
from airlight.physics.optics.reflection import LAWS, cos_reflected, diffuse_reflectances
from airlight.planets import Constituent, Ground, Planet, Star, load_planet
from airlight.planets.matter.phases import HenyeyGreenstein, Rayleigh
from airlight.planets.matter.profiles import Exponential
from airlight.planets.medium import Medium
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.report import Report
from airlight.solver.single_scattering import single_scattering
from airlight.solver.solution import Solution
from airlight.solver.tables.layout import Positions

Solve = Callable[..., Any]
SMALL = (16, 32, 24, 8)
FLAT = (16, 48, 24)


@pytest.fixture(scope="module")
def earth(solved: Solve, reference_earth: Callable[..., Planet]) -> Any:
    return solved(reference_earth(albedo=0.3), quality="preview")


@pytest.fixture(scope="module")
def mars(solved: Solve) -> Any:
    return solved(load_planet("mars"), (680.0, 440.0), quality="preview")


@pytest.fixture(scope="module")
def pebble(solved: Solve) -> Any:
    """A made-up world of 50 km with 5 km of thick air: horizons far below level."""
    planet = Planet(
        name="Pebble",
        bottom_radius=50e3,
        top_radius=55e3,
        ground=Ground(albedo=0.2),
        star=Star(irradiance=1.0, angular_radius=0.3),
        constituents=(
            Constituent(name="gas", profile=Exponential(scale_height=600.0), scattering=4e-4,
                        phase_function=Rayleigh()),
            Constituent(name="haze", profile=Exponential(scale_height=400.0), scattering=3e-4,
                        absorption=5e-5, phase_function=HenyeyGreenstein(asymmetry=0.6)),
        ),
    )  # fmt: skip
    return solved(planet, (550.0,), quality="preview")


@pytest.fixture(scope="module")
def hazes(solved: Solve) -> Any:
    """Two hazes whose names differ by signs alone, one bright ahead and low, one even and high."""
    planet = Planet(
        name="Hazes",
        bottom_radius=500e3,
        top_radius=520e3,
        ground=Ground(albedo=0.2),
        star=Star(irradiance=1.0, angular_radius=0.3),
        constituents=(
            Constituent(name="haze 1", profile=Exponential(scale_height=600.0), scattering=3e-5,
                        phase_function=HenyeyGreenstein(asymmetry=0.7)),
            Constituent(name="haze (1)", profile=Exponential(scale_height=3e3), scattering=1e-5,
                        phase_function=HenyeyGreenstein(asymmetry=0.1)),
        ),
    )  # fmt: skip
    return solved(planet, (680.0, 550.0, 440.0), quality="preview")


@pytest.fixture(scope="module")
def bruneton(earth: Any) -> Baked:
    return bake(earth, size=SMALL, points=2000)


def texels(baked: Baked, count: int = 400) -> Positions:
    """Some of the table's own positions: not those on the ground or at the top, whose views have
    length 0, nor those whose angle is moved to a possible one."""
    layout = baked.tables["scattering"].layout
    p = layout.positions()
    own = (p.r > layout.bottom_radius * (1 + 1e-9)) & (p.r < layout.top_radius * (1 - 1e-9))
    if "nu" in [axis.name for axis in layout.axes]:
        nu = np.broadcast_to(np.linspace(-1.0, 1.0, layout.shape[-1]), layout.shape).ravel()
        own &= np.abs(nu - p.nu) < 1e-12
    rows = np.random.default_rng(1).choice(np.flatnonzero(own), count, replace=False)
    return p[rows]


@pytest.mark.parametrize(
    ("layout", "choice"),
    [
        ("bruneton", {"size": (6, 12, 8, 5)}),
        ("bruneton", {"size": (6, 12, 8, 5), "packing": "combined"}),
        ("bruneton", {"size": (6, 12, 8, 5), "order": 1}),
        ("atmosphere-plus", {"size": (6, 24, 8), "packing": "phase-included", "azimuth": 40.0}),
    ],
)
def test_texels_give_the_solver_s_own_light(
    earth: Any, layout: str, choice: dict[str, Any]
) -> None:
    # At its texels a table that knows the angle to the sun holds the solver's light, whatever
    # the packing: what is left is rounding to float32 and of the view's coordinate.
    exact_texels = {"balance": False} if layout == "bruneton" else {}
    baked = bake(earth, layout, points=50, **choice, **exact_texels)
    positions = texels(baked)
    exact = AirLight(earth, choice.get("order"))(lines_of_sight(positions, earth.medium))
    made = baked.light.relative_radiance(positions)
    assert (exact > 1e-9).mean() > 0.4
    assert_allclose(made, exact, rtol=2e-4, atol=1e-9)
    assert np.median(np.abs(made - exact)[exact > 1e-9] / exact[exact > 1e-9]) < 1e-6


def test_forward_light_of_dust_at_a_low_sun_is_between_texels_of_nu(
    mars: Any, tell: Callable[[str], None]
) -> None:
    # The sun at 85°, the view 0.2° above it and around: the place at which tables were wrong by
    # up to 16 times, since light of a wide forward peak lay between texels 44° apart.
    baked = bake(mars, size=(3, 128, 32, 8), points=20)
    mu, mu_s = np.cos(np.radians([84.8, 85.0]))
    around = np.cos(np.radians(np.linspace(0.0, 180.0, 91)))
    nu = mu * mu_s + np.sqrt((1.0 - mu**2) * (1.0 - mu_s**2)) * around
    positions = Positions.of(
        mars.medium.bottom_radius, mu, mu_s, nu, bottom_radius=mars.medium.bottom_radius
    )
    exact = AirLight(mars)(lines_of_sight(positions, mars.medium))
    error = np.abs(baked.light.relative_radiance(positions) / exact - 1.0)
    tell(
        f"Mars, sun 85°, view 84.8°: largest error {error.max():.1%}, median {np.median(error):.1%}"
    )
    assert error.max() < 0.2
    assert np.median(error) < 0.03


def test_a_table_by_rayleigh_s_phase_function_is_for_bruneton_s_look_up(earth: Any) -> None:
    # His shader multiplies by 3/16π (1 + ν²) alone: at texels it is the solver's light.
    baked = bake(earth, size=(6, 12, 8, 5), points=20, smooth_phase="rayleigh", balance=False)
    positions = texels(baked)
    assert baked.light.phases.names[0] == "rayleigh"
    light = baked.tables["scattering"].at(positions)
    light *= (3.0 / (16.0 * np.pi) * (1.0 + positions.nu**2))[:, None]
    for name in baked.light.phases.names[1:]:
        light += baked.tables[name].at(positions) * baked.light.phases.at(name, positions.nu)
    exact = AirLight(earth)(lines_of_sight(positions, earth.medium))
    assert_allclose(light, exact, rtol=2e-4, atol=1e-9)


def test_two_hazes_of_one_word_have_two_tables(hazes: Any) -> None:
    # One would stand for both: the sum over constituents is the solver's light at texels.
    baked = bake(hazes, size=(6, 12, 8, 5), points=20, balance=False)
    singles = [name for name in baked.tables if name.startswith("single-")]
    assert singles == ["single-haze-1", "single-haze-1-2"]
    assert len(set(baked.light.phases.names)) == 3
    positions = texels(baked)
    exact = AirLight(hazes)(lines_of_sight(positions, hazes.medium))
    assert_allclose(baked.light.relative_radiance(positions), exact, rtol=2e-4, atol=1e-9)
    assert len(set(shader_names(baked))) == len(baked.tables) + 1


def shader_names(baked: Baked) -> list[str]:
    """Names of the textures, of GLSL's letters and without its reserved pairs of underscores."""
    names = [texture_name(name) for name in (*baked.tables, "phase-functions")]
    assert all(name.isascii() and name.isidentifier() and "__" not in name for name in names)
    return names


@pytest.mark.parametrize("points", [1, 2, 3])
@pytest.mark.parametrize("layout", ["bruneton", "atmosphere-plus"])
def test_errors_at_a_single_point_are_of_where_it_looks(
    earth: Any, layout: str, points: int
) -> None:
    # A point looks to the sky or to the ground; of what no point saw nothing is said.
    size = (3, 8, 5, 4)[: 4 if layout == "bruneton" else 3]
    for seed in (1, 2):
        found = bake(earth, layout, size=size, points=points, seed=seed).errors
        views = [name for name in ("sky", "air before the ground") if name in found]
        assert 1 <= len(views) <= min(points, 2)
        assert found["transmittance"].points == points * earth.wavelengths.size


def test_a_table_ends_at_the_lowest_sun_asked_for(earth: Any) -> None:
    # The first texel along mu_s is the limit itself, and cos 120° is lower than the planet's own.
    size = (4, 8, 6, 4)
    own = bake(earth, size=size, points=20).tables["scattering"].layout
    asked = bake(earth, size=size, points=20, mu_s_min=-0.5).tables["scattering"].layout
    for layout, lowest in ((own, lowest_sun_cosine(6360e3, 6460e3)), (asked, -0.5)):
        suns = layout.positions().mu_s
        assert_allclose([suns.min(), suns.max()], [lowest, 1.0], rtol=1e-9)
        assert_allclose(layout.axes[2].parameters["lowest_mu_s"], lowest, rtol=1e-12)


@pytest.mark.parametrize("packing", ["separate", "combined"])
def test_higher_orders_are_the_light_less_the_first_order(earth: Any, packing: str) -> None:
    # A law: all light is the first order and the others, by the solver itself, at the texels. Its
    # first order is delta-M scaled: 4e-4 more than unscaled single scattering.
    baked = bake(
        earth, size=(6, 12, 8, 5), points=20, higher_orders=True, packing=packing, balance=False
    )
    positions = texels(baked)
    every, first = AirLight(earth).with_first(lines_of_sight(positions, earth.medium))
    higher = baked.tables["higher-order"].at(positions)
    by_rayleigh = 3.0 / (16.0 * np.pi) * (1.0 + positions.nu**2)
    assert_allclose(higher * by_rayleigh[:, None], every - first, rtol=1e-3, atol=1e-9)


@pytest.mark.parametrize("smooth_phase", ["own", "rayleigh"])
def test_higher_orders_are_no_more_than_the_smooth_light(earth: Any, smooth_phase: str) -> None:
    # A part is no more than the whole, though both are shifted to be right between texels, and
    # where the sun sets on the first order the whole is shifted by more.
    size = (6, 12, 16, 5)
    baked = bake(earth, size=size, points=20, higher_orders=True, smooth_phase=smooth_phase)
    angles = np.linspace(-1.0, 1.0, size[3])
    whole = baked.tables["scattering"].physical
    whole = whole * baked.light.phases.at(baked.light.phases.names[0], angles)
    part = baked.tables["higher-order"].physical
    part = part * (3.0 / (16.0 * np.pi) * (1.0 + angles**2))[:, None]
    assert (part <= whole * (1.0 + 1e-5)).all()
    mu_s = baked.tables["scattering"].layout.positions().mu_s.reshape(size)
    twilight = (mu_s < -0.05) & (whole[..., 0] > 1e-6)
    assert np.median(part[twilight] / whole[twilight]) > 0.1


def test_first_order_agrees_with_quadrature(earth: Any) -> None:
    # Second method: S¹ = Σ p_i S_i by adaptive quadrature, at the table's texels. The moments
    # solver marches with 16 points in preview quality: a few thousandths by day.
    baked = bake(earth, size=(6, 12, 8, 5), order=1, points=50, balance=False)
    positions = texels(baked)
    positions = positions[positions.mu_s > 0.1][:40]
    lines = lines_of_sight(positions, earth.medium)
    phase = earth.medium.phase_function(positions.nu)
    exact = (phase * single_scattering(earth.medium, lines)).sum(axis=1)
    assert_allclose(baked.light.relative_radiance(positions), exact, rtol=0.01, atol=1e-7)


def test_air_s_light_does_not_depend_on_the_ground_in_first_order(
    solved: Solve, reference_earth: Callable[..., Planet]
) -> None:
    # Light scattered once by air has not met the ground: black and white ground give the same,
    # though the solution's own first order holds the sun reflected by the ground.
    black = solved(reference_earth(albedo=0.0), quality="preview")
    white = solved(reference_earth(albedo=1.0), quality="preview")
    positions = random_positions(black.medium, 400, 7)
    lines = lines_of_sight(positions, black.medium)
    dark, bright = AirLight(black, 1)(lines), AirLight(white, 1)(lines)
    whole = white.relative_radiance(lines, order=1)
    assert (whole[positions.to_ground] > 2.0 * bright[positions.to_ground]).mean() > 0.3
    # Two solutions of float32 moments; nothing is subtracted.
    assert_allclose(bright, dark, rtol=1e-5, atol=1e-9)


class Closed(Solution):
    """A solution of which only the interface is known."""

    def __init__(self, solution: Solution) -> None:
        self.medium, self.report, self.inner = solution.medium, solution.report, solution

    def relative_radiance(self, lines: LinesOfSight, *, order: int | None = None) -> np.ndarray:
        return self.inner.relative_radiance(lines, order=order)

    def relative_sky_irradiance(self, r: np.ndarray, mu_s: np.ndarray) -> np.ndarray:
        return self.inner.relative_sky_irradiance(r, mu_s)

    def relative_direct_irradiance(self, r: np.ndarray, mu_s: np.ndarray) -> np.ndarray:
        return self.inner.relative_direct_irradiance(r, mu_s)


@pytest.mark.parametrize("order", [None, 1])
def test_the_ground_s_light_is_taken_off_any_solver_s(earth: Any, order: int | None) -> None:
    # Second method: the march of the air alone, against all light less the ground's by
    # quadrature. What preview's transmittance errs by is left of the ground's light: 2e-3
    # where a ray passes the corners of the ozone's tent (2.6e-4 in default quality).
    lines = lines_of_sight(random_positions(earth.medium, 400, 7), earth.medium)
    alone, subtracted = AirLight(earth, order)(lines), AirLight(Closed(earth), order)(lines)
    whole = earth.relative_radiance(lines, order=order)
    # In twilight the sky on the ground is interpolated between suns: 1e-6 of the star.
    off = np.abs(alone - subtracted) - 4e-3 * whole
    assert off.max() <= 3e-6
    low = lines.to_ground & (lines.mu < -0.3) & (lines.mu_s > 0.3)
    assert (whole[low] > 2.0 * alone[low]).mean() > 0.5


@pytest.mark.parametrize("planet", ["earth", "mars", "pebble"])
@pytest.mark.parametrize("precision", [pytest.param("single", marks=pytest.mark.slow), "half"])
def test_tables_are_close_to_the_solver_between_texels(
    planet: str, precision: str, request: pytest.FixtureRequest, tell: Callable[[str], None]
) -> None:
    # Bounds for tables of this small size, twilight included; limits come from the planet, so
    # that none is clipped.
    solution = request.getfixturevalue(planet)
    baked = bake(solution, size=SMALL, points=1500, precision=precision)
    for table in baked.tables.values():
        assert np.isfinite(table.values).all()
        assert (table.values >= 0.0).all()
    sky, ground = baked.errors["sky"], baked.errors["air before the ground"]
    tell(
        f"bruneton {SMALL}, {planet}, {precision}: sky {sky.median:.1%}, 95 % "
        f"{sky.percentile_95:.1%}; before the ground {ground.median:.1%}, 95 % "
        f"{ground.percentile_95:.1%}"
    )
    assert sky.median < 0.06
    assert sky.percentile_95 < 0.25
    assert ground.median < 0.03
    assert ground.percentile_95 < 0.15
    assert baked.errors["transmittance"].maximum < 0.01
    assert baked.errors["irradiance on the ground"].median < 0.01


def test_balanced_values_halve_the_error_and_leave_no_bias(
    earth: Any, tell: Callable[[str], None]
) -> None:
    # Linear interpolation of light that falls exponentially errs to one side only.
    size = (12, 32, 16, 8)
    exact = bake(earth, size=size, points=3000, balance=False).errors["sky"]
    made = bake(earth, size=size, points=3000).errors["sky"]
    tell(f"{size}, sky: bias {exact.bias:.1%} to {made.bias:.1%}")
    tell(f"  95 % {exact.percentile_95:.1%} to {made.percentile_95:.1%}")
    assert abs(made.bias) < 0.6 * abs(exact.bias)
    assert made.percentile_95 < 0.8 * exact.percentile_95
    assert made.rms < exact.rms


@pytest.mark.slow
def test_errors_fall_with_the_square_of_the_step(earth: Any) -> None:
    # Linear interpolation is of second order: twice the texels, a quarter of the error; a little
    # less, since the light is not smooth everywhere.
    coarse = bake(earth, size=(9, 18, 13, 5), points=2000).errors["sky"]
    fine = bake(earth, size=(17, 34, 25, 9), points=2000).errors["sky"]
    assert 3.0 < coarse.median / fine.median < 5.0


@pytest.mark.slow
def test_half_precision_costs_next_to_nothing(earth: Any, bruneton: Baked) -> None:
    # Eleven bits are 5e-4, against interpolation's per cents; twilight is not lost to zeros.
    half = bake(earth, size=SMALL, points=2000, precision="half")
    assert half.tables["transmittance"].precision == "single"
    assert half.tables["scattering"].precision == "half"
    assert half.errors["sky"].median < bruneton.errors["sky"].median + 1e-3
    assert half.errors["sky"].percentile_95 < bruneton.errors["sky"].percentile_95 + 2e-3


def test_weighted_power_beats_linear_near_the_horizon(
    earth: Any, tell: Callable[[str], None]
) -> None:
    # The purpose of the mapping (Atmosphere Plus notes, 3.1.6), in views within 3° of the
    # horizon, at the table's azimuth.
    medium = earth.medium
    rng = np.random.default_rng(8)
    positions = random_positions(medium, 3000, 8, 90.0)
    horizon = np.arccos(vectorized(horizon_cosine)(positions.r, medium.bottom_radius))
    mu = np.cos(np.clip(horizon + np.radians(rng.uniform(-3.0, 3.0, 3000)), 0.0, np.pi))
    spread = np.sqrt((1.0 - mu**2) * (1.0 - positions.mu_s**2))
    nu = mu * positions.mu_s + spread * np.cos(np.pi / 2.0)
    positions = Positions.of(
        positions.r, mu, positions.mu_s, nu, bottom_radius=medium.bottom_radius
    )
    exact = AirLight(earth)(lines_of_sight(positions, medium))
    bright = exact > 1e-5
    rms = {}
    for mapping in ("linear", "power", "weighted-power"):
        baked = bake(earth, "atmosphere-plus", mapping=mapping, packing="phase-included",
                     azimuth=90.0, size=(32, 64, 32), points=50)  # fmt: skip
        error = baked.light.relative_radiance(positions)[bright] / exact[bright] - 1.0
        rms[mapping] = float(np.median(np.abs(error)))
        tell(f"within 3° of the horizon, {mapping}: median error {rms[mapping]:.1%}")
    assert rms["weighted-power"] < 0.5 * rms["linear"]
    assert rms["weighted-power"] < rms["power"]


@pytest.mark.slow
def test_packing_states_its_error_and_more_channels_do_not_lose(
    earth: Any, tell: Callable[[str], None]
) -> None:
    # Two numbers per wavelength fit at least as well as one shared grey number; both are far
    # better at all azimuths than a table of one azimuth.
    errors = {}
    for packing in ("rgba", "separate", "phase-included"):
        baked = bake(earth, "atmosphere-plus", packing=packing, size=FLAT, points=1500)
        errors[packing] = baked.errors["sky"]
        tell(
            f"atmosphere-plus {FLAT}, {packing}: sky median {errors[packing].median:.1%}, "
            f"95 % {errors[packing].percentile_95:.1%}"
        )
    assert errors["separate"].median <= errors["rgba"].median * 1.02
    assert errors["rgba"].median < 0.06
    assert errors["phase-included"].percentile_95 > 2.0 * errors["rgba"].percentile_95


def test_factored_light_is_exact_for_the_first_order_where_azimuth_does_not_matter(
    earth: Any,
) -> None:
    # physics: RGB p_R + A p_M is exact for S¹ but for the way's own dependence on the azimuth,
    # which is none under a sun at the zenith.
    baked = bake(earth, "atmosphere-plus", packing="separate", order=1, size=(8, 24, 9), points=50)
    layout = baked.tables["scattering"].layout
    p = layout.positions()
    overhead = (p.mu_s == 1.0) & (p.r > layout.bottom_radius) & (p.r < layout.top_radius)
    positions = p[overhead]
    exact = AirLight(earth, 1)(lines_of_sight(positions, earth.medium))
    made = baked.light.relative_radiance(positions)
    bright = exact > 1e-5
    assert_allclose(made[bright], exact[bright], rtol=5e-3)


def test_errors_are_those_of_the_tables(bruneton: Baked, earth: Any) -> None:
    # The same comparison by hand: same seed, same positions.
    error = bruneton.errors["sky"]
    positions = random_positions(earth.medium, 2000, error.seed)
    positions = positions[~positions.to_ground]
    exact = AirLight(earth)(lines_of_sight(positions, earth.medium))
    judged = exact > error.floor
    off = (bruneton.light.relative_radiance(positions) / np.where(judged, exact, 1.0) - 1.0)[judged]
    assert error.points == judged.sum()
    assert_allclose(error.rms, np.sqrt(np.mean(off**2)), rtol=1e-9)
    assert_allclose(error.maximum, np.abs(off).max(), rtol=1e-9)
    assert_allclose(error.median, np.median(np.abs(off)), rtol=1e-9)
    worst = error.worst
    assert_allclose(abs(worst["table"] / worst["solver"] - 1.0), error.maximum, rtol=1e-9)


def test_no_scan_finds_much_worse_than_the_errors_that_are_written(
    bruneton: Baked, earth: Any
) -> None:
    # Another sample, of thirty times as many points as the search started from, in every region.
    medium = earth.medium
    shell = (medium.bottom_radius, medium.top_radius)
    positions = peaked_positions(*shell, 60_000, 99)
    lines = lines_of_sight(positions, medium)
    exact, whole = AirLight(earth).path_and_total_radiance(lines)
    off = np.abs(bruneton.light.relative_radiance(positions) - exact) / np.maximum(whole, DIM)
    off = np.where(whole > DIM, off, 0.0).max(axis=-1)
    found = regions(positions, shell[0])
    assert set(found) <= set(bruneton.errors)
    for name, rows in found.items():
        error = bruneton.errors[name]
        assert rows.sum() > 2000
        assert off[rows].max() < 1.25 * error.maximum, name
        assert error.percentile_95 < error.maximum
        assert error.worst["table"] > 0.0


@pytest.mark.parametrize(
    ("layout", "packing"),
    [("bruneton", "separate"), ("bruneton", "combined"), ("atmosphere-plus", "rgba"),
     ("atmosphere-plus", "separate")],
)  # fmt: skip
def test_air_without_particles_has_no_particles_light(
    layout: str, packing: str, solved: Solve, reference_earth: Callable[..., Planet]
) -> None:
    # A limit: alpha is black, no further table is made, and look-up works.
    clear = solved(reference_earth(albedo=0.3, aerosol=None), quality="preview")
    size = (9, 18, 13, 5) if layout == "bruneton" else (9, 18, 13)
    baked = bake(clear, layout, packing=packing, size=size, points=200)
    assert set(baked.tables) == {"transmittance", "irradiance", "scattering"}
    values = baked.tables["scattering"].values
    if values.shape[-1] == 4:
        assert_allclose(values[..., 3], 0.0, atol=0)
    assert baked.errors["sky"].median < 0.15


class UniformSky(Solution):
    """Light whose order 1 is a uniform sky, whose order 2 is its reflection and a glow."""

    highest_order = 2
    SKY, GLOW = 0.02, 0.003

    def __init__(self, medium: Medium) -> None:
        self.medium = medium
        self.report = Report(solver="made up", settings="", sweeps=2, residual=(0.0,), seconds=0.0)

    def relative_radiance(self, lines: LinesOfSight, *, order: int | None = None) -> np.ndarray:
        up = np.full((lines.r.size, self.wavelengths.size), self.SKY)
        if order == 1:
            return up
        from airlight.solver.tables.columns import columns

        depth = columns(lines.r, lines.mu, lines.length, self.medium.bottom_radius,
                        self.medium.density)  # fmt: skip
        # A uniform sky of radiance L sends π L down, of which the sky's factor times L comes back.
        ground = np.empty(depth.shape[:1] + self.wavelengths.shape)
        mu_r = vectorized(cos_reflected)(lines.r, lines.mu, self.medium.bottom_radius)
        diffuse_reflectances(self.medium.ground, mu_r, ground)
        back = np.exp(-(depth @ self.medium.extinction)) * ground * self.SKY
        return self.GLOW + np.where(lines.to_ground[:, None], back, 0.0)

    def relative_sky_irradiance(self, r: np.ndarray, mu_s: np.ndarray) -> np.ndarray:
        return np.full((r.size, self.wavelengths.size), np.pi * self.SKY)

    def relative_direct_irradiance(self, r: np.ndarray, mu_s: np.ndarray) -> np.ndarray:
        return np.zeros((r.size, self.wavelengths.size))


@pytest.mark.parametrize("law", LAWS)
def test_second_order_s_reflection_of_the_first_order_s_sky_is_taken_off(
    law: str,
    reference_earth: Callable[..., Planet],
) -> None:
    # A law: a uniform sky of radiance L sends π L to the ground. What is left is the glow.
    planet = reference_earth(albedo=0.4)
    planet = replace(planet, ground=replace(planet.ground, law=law))
    solution = UniformSky(Medium.from_planet(planet, planet.wavelengths))
    positions = random_positions(solution.medium, 200, 9)
    lines = lines_of_sight(positions, solution.medium)
    # Columns with fewer points: 1e-5.
    assert_allclose(AirLight(solution, 2)(lines), UniformSky.GLOW, rtol=1e-4)
    both = AirLight(solution, 2, cumulative=True)(lines)
    assert_allclose(both, UniformSky.GLOW + UniformSky.SKY, rtol=1e-4)


def test_a_table_of_one_order_says_so_and_any_solver_can_fill_it(
    reference_earth: Callable[..., Planet],
) -> None:
    # Interface only: nothing of the moments solver is asked for.
    planet = reference_earth(albedo=0.5)
    solution = UniformSky(Medium.from_planet(planet, planet.wavelengths))
    baked = bake(solution, size=(4, 16, 16, 16), order=2, points=200)
    assert baked.about["orders"] == "2"
    assert set(baked.tables) == {"transmittance", "irradiance", "scattering"}
    positions = random_positions(solution.medium, 200, 9)
    # The glow is the same everywhere; divided by p_R and interpolated: 1 + ν² bends, most where
    # texels stand for angles that are not possible.
    off = np.abs(baked.light.relative_radiance(positions) / UniformSky.GLOW - 1.0)
    assert np.median(off) < 0.01
    assert off.max() < 0.3
    with pytest.raises(ParameterError, match="order is 3; allowed: 1 to 2"):
        bake(solution, order=3)


@pytest.mark.parametrize(
    ("choice", "said"),
    [
        ({"layout": "cube"}, "layout is 'cube'; allowed: bruneton, atmosphere-plus"),
        ({"packing": "rgba"}, "packing is 'rgba'; allowed: separate, combined for bruneton"),
        ({"layout": "atmosphere-plus", "packing": "combined"}, "rgba, separate, phase-included"),
        ({"layout": "atmosphere-plus", "mapping": "log"}, "mapping is 'log'"),
        ({"size": (4, 4)}, "size is .*4 numbers of texels: r, mu, mu_s, nu"),
        ({"precision": "quarter"}, "precision is 'quarter'"),
        ({"mu_s_min": 0.3}, "mu_s_min is 0.3; allowed: -1 to 0"),
        ({"smooth_phase": "gas"}, "smooth_phase is 'gas'; allowed: own, rayleigh"),
        ({"layout": "atmosphere-plus", "smooth_phase": "rayleigh"}, "requires layout bruneton"),
        ({"layout": "atmosphere-plus", "mu_s_min": -0.3}, "requires layout bruneton"),
        ({"layout": "atmosphere-plus", "higher_orders": True}, "requires layout bruneton"),
        ({"points": 0}, "points is 0"),
    ],
)
def test_impossible_choices_are_named(earth: Any, choice: dict[str, Any], said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        bake(earth, **choice)


def test_baking_reports_progress_and_can_be_cancelled(earth: Any) -> None:
    seen: list[tuple[int, int, str]] = []
    bake(earth, size=(4, 8, 4, 4), points=50, progress=lambda *step: seen.append(step))
    assert {message for _, _, message in seen} == {"scattering", "errors"}
    assert all(0 < done <= total for done, total, _ in seen)
    with pytest.raises(Cancelled):
        bake(earth, size=(4, 8, 4, 4), cancel=lambda: True)
