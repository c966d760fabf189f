"""The moments solver on the GPU against the CPU's: the same functions, another host."""

from __future__ import annotations

import json

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import load_planet
from airlight.errors import Cancelled, ParameterError
from airlight.planets import replace
from airlight.planets.medium import Medium
from airlight.render.gpu.device.device import BROWSER_LIMITS
from airlight.render.gpu.device.flat import read_flat
from airlight.render.gpu.device.fragment_pass import declared_bindings
from airlight.render.gpu.emit.shader_types import FLAT_WIDTH
from airlight.render.gpu.solver import planning as solver_planning
from airlight.render.gpu.solver import solver
from airlight.render.gpu.solver.gpu_iteration import pooled_iteration
from airlight.render.gpu.solver.passes import PASSES, shader
from airlight.render.gpu.solver.planning import plan_for
from airlight.render.gpu.solver.solver import ThickAir, fields_on, solve_on
from airlight.solver.moments.first_order import first_order_radius
from airlight.solver.moments.harmonics import POLARISED
from airlight.solver.moments.iterate import gather
from airlight.solver.moments.packing import pack_light
from airlight.solver.moments.settings import settings_for
from airlight.solver.moments.setup import Setup
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.moments.solve import solve
from airlight.solver.moments.sweep import sweep_radius
from airlight.solver.refracted_geometry import RefractedGeometry

WAVELENGTHS = [450.0, 530.0, 600.0, 680.0]
PREVIEW = settings_for("preview")
#: Its grids, converged further than it.
STRICT = replace(PREVIEW, tolerance=0.1 * PREVIEW.tolerance)
#: Sun elevations, from the zenith to deep dusk. [°]
ELEVATIONS = (90.0, 45.0, 20.0, 5.0, 1.0, 0.0, -1.0, -3.0, -6.0)
#: Altitudes from the ground to space, in thicknesses of the shell.
ALTITUDES = (0.0, 0.02, 0.1, 0.3, 0.7, 1.5, 10.0)


def medium_of(name: str, wavelengths=WAVELENGTHS, **changes) -> Medium:
    planet = load_planet(name)
    return Medium.from_planet(replace(planet, **changes) if changes else planet, wavelengths)


def bright(values, least):
    """Mask of values (r, s, w) that are not dark."""
    return values > least * values.max(axis=(0, 1))


def assert_moments_agree(field, expected, least, rtol):
    """Compare moments (r, s, k, w), relative to the mean radiance where that is not dark."""
    mean = expected[:, :, 0]
    scale = np.where(bright(mean, least), mean, np.inf)[:, :, None]
    assert_allclose(field / scale, expected / scale, rtol=0, atol=rtol)


def light_of(plan, iteration, texture):
    """Moments and irradiances in a light's texture."""
    n = plan.sizes
    moments = plan.nodes * n["terms"]
    flat = read_flat(iteration.device, iteration.texture(texture), moments + plan.nodes)
    shape = (n["radii"], n["sun_angles"])
    return flat[:moments].reshape(*shape, n["terms"], 4), flat[moments:].reshape(*shape, 4)


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("earth", {}),
        ("mars-standard", {}),
        ("early-earth", {}),
        ("earth", {"refraction": "bouguer"}),
    ],
    ids=["earth", "mars", "thick", "bent"],
)
def test_each_order_is_that_of_the_cpu(device, name, changes):
    # The same functions on the same tables; the differences are single precision of radii (0.5 m),
    # cosines and look-ups: 3e-4 of the mean radiance, where that is above 1e-4 of the largest.
    geometry = RefractedGeometry.of(medium_of(name, **changes))
    plan = plan_for(geometry, PREVIEW)
    batch = Setup(geometry=geometry, settings=PREVIEW).batch(slice(None))
    first, first_sky = gather(
        batch,
        first_order_radius,
        batch.setup.column_rows,
        batch.setup.star_ratios,
        geometry.refraction_table,
    )
    packed = pack_light(first, first_sky[:1], batch.level, batch.setup.refinement)
    second, second_sky = gather(batch, sweep_radius, *packed, batch.all_degrees)
    with pooled_iteration(device) as gpu:
        gpu.load(plan)
        gpu.begin()
        got, got_sky = light_of(plan, gpu, "first")
        assert_moments_agree(got, first[..., :4], 1e-4, 3e-4)
        lit = bright(first_sky[..., :4], 1e-4)
        assert_allclose(got_sky[lit], first_sky[..., :4][lit], rtol=3e-4)
        gpu.sweep()
        got, got_sky = light_of(plan, gpu, "iterate")
        assert_moments_agree(got, (first + second)[..., :4], 1e-4, 3e-4)
        sky = (first_sky + second_sky)[..., :4]
        lit = bright(sky, 1e-4)
        assert_allclose(got_sky[lit], sky[lit], rtol=3e-4)


def assert_solutions_agree(gpu: MomentsSolution, cpu: MomentsSolution, rtol: float):
    """Compare mean radiances, irradiances and radiances from ground to space, sun 90° to -6°."""
    grid = cpu.moments.grid
    seen = np.degrees(np.arcsin(grid.sun_cosines)) >= -6.0
    mean, expected = gpu.moments.field[:, seen, 0], cpu.moments.field[:, seen, 0]
    lit = bright(expected, 1e-6)
    assert_allclose(mean[lit], expected[lit], rtol=rtol)
    polarised, wanted = (one.moments.field[:, seen, -POLARISED:] for one in (gpu, cpu))
    scale = np.where(lit, expected, np.inf)[:, :, None]
    assert np.abs(wanted / scale).max() > 0.01
    assert_allclose(polarised / scale, wanted / scale, rtol=0, atol=rtol)
    lit = bright(cpu.moments.sky[:, seen], 1e-6)
    assert_allclose(gpu.moments.sky[:, seen][lit], cpu.moments.sky[:, seen][lit], rtol=rtol)
    thickness = grid.top_radius - grid.bottom_radius
    zenith = np.array([0.0, 40.0, 70.0, 85.0, 89.0, 90.5, 92.0, 96.0, 100.0, 120.0, 180.0])
    zenith, azimuth = np.meshgrid(zenith, [0.0, 90.0, 180.0])
    for altitude in ALTITUDES:
        for elevation in ELEVATIONS:
            lines = {
                "altitude": altitude * thickness,
                "sun_zenith": 90.0 - elevation,
                "view_zenith": zenith,
                "azimuth": azimuth,
            }
            expected = np.asarray(cpu.radiance(**lines))
            got = np.asarray(gpu.radiance(**lines))
            lit = expected > 1e-6
            message = f"at {altitude} thicknesses, sun at {elevation}°"
            assert_allclose(got[lit], expected[lit], rtol=rtol, err_msg=message)


@pytest.mark.parametrize(
    "name",
    [
        "earth-atmosphere-plus",
        "mars-standard",
        *(pytest.param(one, marks=pytest.mark.validation) for one in ("earth", "early-earth")),
    ],
)
def test_a_preview_agrees_with_the_cpu(device, name):
    # Both stop at a remaining change of the mean radiance, here small, so that what differs is the
    # device: 0.5 % at most. The last is thick: it has levels between the radii.
    medium = medium_of(name)
    cpu = solve(medium, STRICT, cache=False)
    gpu = solve_on(device, medium, STRICT)
    assert gpu.moments.sweeps > 1
    assert gpu.moments.residual.max() <= STRICT.tolerance
    assert_solutions_agree(gpu, cpu, 5e-3)


def test_ground_of_rock_is_solved_as_by_the_cpu(device):
    # Tolerances as above: the law's two factors, of its own uniform, in every order.
    ground = replace(load_planet("earth-atmosphere-plus").ground, law="lommel-seeliger", albedo=0.4)
    medium = medium_of("earth-atmosphere-plus", ground=ground)
    cpu, gpu = solve(medium, STRICT, cache=False), solve_on(device, medium, STRICT)
    assert_solutions_agree(gpu, cpu, 5e-3)


def test_scalar_transfer_is_that_of_the_cpu(device):
    # Tolerances as above; no polarised light anywhere, and another light than with it.
    scalar = replace(STRICT, polarisation=False)
    medium = medium_of("earth-atmosphere-plus")
    cpu, gpu = solve(medium, scalar, cache=False), solve_on(device, medium, scalar)
    assert_array_equal(gpu.moments.field[:, :, -POLARISED:], 0.0)
    assert_allclose(gpu.moments.sky[0, -8:], cpu.moments.sky[0, -8:], rtol=2e-3)
    polarised = solve_on(device, medium, STRICT)
    overhead = {"altitude": 0.0, "sun_zenith": 5.0, "view_zenith": [0.0, 80.0], "azimuth": 0.0}
    change = polarised.radiance(**overhead) / gpu.radiance(**overhead) - 1.0
    assert np.abs(change).max() > 3e-3


@pytest.mark.validation
def test_a_default_solution_agrees_with_the_cpu(device):
    # The tolerance between them is 0.5 %; 2e-3 is the tolerance of both.
    medium = medium_of("earth")
    settings = settings_for("default")
    cpu = solve(medium, settings, cache=False)
    assert_solutions_agree(solve_on(device, medium, settings), cpu, 2e-3)


def test_the_field_stays_on_the_device(device):
    # The texture holds what a march reads of the solution on the CPU, packed there.
    solution = solve_on(device, medium_of("earth"), PREVIEW)
    texture = fields_on(device, solution)
    parts = (solution.tables.field, solution.tables.sky)
    expected = np.concatenate([one.reshape(-1, 8)[:, :4] for one in parts])
    got = read_flat(device, texture, expected.shape[0])
    # s and M_00·s everywhere; the other moments relative to s, since they may be close to 0.
    block = 1 + solution.moments.field.shape[2]
    moments = solution.tables.field.size // 8
    got, sky = got[:moments].reshape(-1, block, 4), got[moments:]
    expected, expected_sky = expected[:moments].reshape(-1, block, 4), expected[moments:]
    assert_allclose(got[:, :2], expected[:, :2], rtol=2e-5)
    assert_allclose(got / got[:, 1:2], expected / expected[:, 1:2], rtol=2e-5, atol=1e-5)
    assert_allclose(sky, expected_sky, rtol=2e-5)


def test_spans_of_radii_do_not_change_the_result(device, monkeypatch):
    # The division into spans must not matter: the same texels by the same functions, bit for bit.
    medium = medium_of("earth")
    whole = solve_on(device, medium, PREVIEW)
    monkeypatch.setattr(solver_planning, "_SPAN", 1 << 15)
    assert len(plan_for(RefractedGeometry.of(medium), PREVIEW).spans) > 3
    cut = solve_on(device, medium, PREVIEW)
    assert_array_equal(cut.moments.field, whole.moments.field)
    assert_array_equal(cut.moments.sky, whole.moments.sky)


def test_fewer_wavelengths_are_solved_alike(device):
    # Wavelengths are independent, except that they end the iteration together: its tolerance.
    four = solve_on(device, medium_of("earth"), PREVIEW)
    one = solve_on(device, medium_of("earth", [530.0]), PREVIEW)
    assert one.moments.field.shape == (*four.moments.field.shape[:3], 1)
    seen = np.degrees(np.arcsin(four.moments.grid.sun_cosines)) >= -6.0
    # The grid of radii follows the depth of the bluest: compare the ground's sky.
    assert_allclose(one.moments.sky[0, seen, 0], four.moments.sky[0, seen, 1], rtol=1e-2)


def test_thick_air_is_left_to_the_cpu(device):
    # Light is scattered in it for hundreds of orders: refused before any computation, in one line.
    with pytest.raises(ThickAir) as refused:
        solve_on(device, medium_of("titan"), PREVIEW)
    assert "too thick" in str(refused.value)
    assert "CPU" in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_solution_that_makes_light_is_left_to_the_cpu(device, monkeypatch):
    # The balance of energy is judged by the same function as on the CPU: only its answer is needed.
    monkeypatch.setattr(solver, "violates_energy_balance", lambda energy, tolerance: True)
    with pytest.raises(ThickAir, match="not resolved by the GPU's grid; the CPU solves it"):
        solve_on(device, medium_of("earth"), PREVIEW)


def test_more_wavelengths_than_a_texel_holds_are_refused(device):
    # A texel has four numbers.
    with pytest.raises(ParameterError, match="wavelengths"):
        solve_on(device, medium_of("earth", np.linspace(400.0, 700.0, 5)), PREVIEW)


def test_a_cancelled_solve_leaves_the_next_one_whole(device):
    # The same medium gives the same numbers, whatever the textures held before.
    medium = medium_of("mars-standard")
    before = solve_on(device, medium, PREVIEW)
    asked = []

    def cancel():
        asked.append(1)
        return len(asked) == 3

    with pytest.raises(Cancelled):
        solve_on(device, medium_of("earth"), PREVIEW, cancel=cancel)
    done = []
    after = solve_on(device, medium, PREVIEW, progress=lambda *what: done.append(what[0]))
    assert_array_equal(after.moments.field, before.moments.field)
    assert done[-1] == 100


@pytest.mark.parametrize("name", sorted(PASSES))
def test_a_pass_keeps_a_browsers_limits(name):
    # WebGPU's defaults and WebGL2: 16 textures to read, two targets of 16 bytes.
    assert len(PASSES[name].targets) <= 2
    textures = [one for one in declared_bindings(shader(name)) if "texture" in one.layout]
    assert len(textures) <= BROWSER_LIMITS["max-sampled-textures-per-shader-stage"]


@pytest.mark.parametrize("name", ["earth", "mars-standard"])
def test_the_plan_can_be_run_by_another_host(name):
    # JSON preserves it, every texture is named in it, and none is higher than browsers allow.
    plan = plan_for(RefractedGeometry.of(medium_of(name)), settings_for("default"))
    written = json.loads(json.dumps(plan.as_dict()))
    assert written["sizes"]["degree"] == plan.setup.degree
    assert len(written["uniform"]) == plan.solve.shape[0]
    known = {*written["textures"], "scalars", "spectra", "iterate"}
    for part in written["passes"].values():
        for one in part:
            assert set(one["targets"]) <= known
            reads = declared_bindings(written["shaders"][one["shader"]])
            assert {two.name for two in reads if "texture" in two.layout} <= known
    for texels in (*map(len, plan.tables.values()), *written["textures"].values()):
        assert texels <= FLAT_WIDTH * BROWSER_LIMITS["max-texture-dimension-2d"]
    # Spans fill each texel of a ray's radiance once.
    spans = [one["span"] for one in written["passes"]["sweep"] if one["targets"] == ["radiances"]]
    assert [one[0] for one in spans[1:]] == [one[1] for one in spans[:-1]]
    assert spans[-1][1] == written["textures"]["radiances"]
    # Tables are at their recorded positions.
    air = plan.setup.optics.air(slice(None))
    for table in ("extinction", "polarised_moments"):
        places = written["tables"][table]
        wanted = getattr(air, table)[..., :4].reshape(-1, 4)
        assert_array_equal(plan.tables["spectra"][places["start"] :][: len(wanted)], wanted)
