"""The browser's computations before and between the solver's passes agree with Python's."""

from __future__ import annotations

import dataclasses
from collections import deque
from collections.abc import Callable
from math import acos
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.planets import load_planet, planet_names
from airlight.planets.medium import Medium
from airlight.render.gpu.device.flat import read_flat
from airlight.render.gpu.solver.gpu_iteration import pooled_iteration
from airlight.render.gpu.solver.passes import ONCE
from airlight.render.gpu.solver.planning import plan_for
from airlight.solver.moments.acceleration import mixing_weights
from airlight.solver.moments.convergence import estimated_tail
from airlight.solver.moments.delta_m import Optics
from airlight.solver.moments.packing import level_weights, optically_thick_weights, pack
from airlight.solver.moments.settings import QUALITIES
from airlight.solver.moments.solve import solve
from airlight.solver.moments.stopping import Iteration, Stopping
from airlight.solver.moments.synthetic_acceleration import SyntheticAcceleration
from airlight.solver.refracted_geometry import RefractedGeometry
from airlight.viewer.browser.page_solver import MOST, page_settings, solver_data
from airlight.viewer.browser.tables_text import from_text
from airlight.viewer.parameters.amounts import AMOUNTS, amounts_of
from airlight.viewer.session.session import Session

WAVELENGTHS = (680.0, 550.0, 440.0)
#: Planet, factors of its constituents: thin, thick and no dust; air that bends light.
FACTORS = {
    "mars": (1.0, 0.1), "mars, a storm": (0.5, 4.0), "mars, clean": (2.0, 0.0),
    "earth": (0.7, 3.0, 2.0, 0.5),
}  # fmt: skip


@pytest.fixture(scope="module")
def pages() -> Callable[[str], tuple[Any, dict[str, Any]]]:
    """Solution of a planet and its data in a page."""
    kept: dict[str, Any] = {}

    def of(name: str) -> tuple[Any, dict[str, Any]]:
        if name not in kept:
            medium = Medium.from_planet(load_planet(name), WAVELENGTHS)
            solution = solve(medium, QUALITIES["preview"])
            kept[name] = solution, solver_data(solution)
        return kept[name]

    return of


@pytest.mark.parametrize("case", FACTORS)
def test_edited_air_is_that_of_an_edited_medium(
    case: str,
    pages: Callable[[str], tuple[Any, dict[str, Any]]],
    modules: Callable[..., Any],
) -> None:
    # a second method: the medium with other coefficients, by the solver's Python code
    amounts, ground = FACTORS[case], 1.7
    solution, data = pages(case.partition(",")[0])
    page = modules({"solving/edited_air": ("editedAir",)})
    got = page.evaluate(
        """([air, edit]) => Object.fromEntries(
          Object.entries(editedAir(air, edit)).map(([name, table]) => [name, [...table]]))""",
        [data["air"], {"amounts": amounts, "ground": ground}],
    )
    factors = np.array(amounts)[:, None]
    medium = dataclasses.replace(
        solution.medium,
        scattering=factors * solution.medium.scattering,
        absorption=factors * solution.medium.absorption,
        ground_albedo=ground * solution.medium.ground_albedo,
    )
    geometry = RefractedGeometry.of(medium)
    degree = int(data["plan"]["sizes"]["degree"])
    optics = Optics(geometry.medium, degree)
    air, depth = optics.air(slice(None)), optics.scattering_depth
    grid = solution.moments.grid  # the suns are the same for every degree
    dip = acos(grid.bottom_radius / grid.top_radius)
    # float32, to which both are rounded, after sums in different orders
    tables = {
        "extinction": air.extinction, "moments": air.moments,
        "polarised_moments": air.polarised_moments, "albedo": air.ground.albedo,
        "unscaled_extinction": pack(geometry.medium.extinction),
    }  # fmt: skip
    for name, table in tables.items():
        wanted = table.reshape(-1, 8)[:, :4].reshape(-1)
        assert_allclose(got[name], wanted, rtol=1e-5, atol=1e-6 * abs(wanted).max(), err_msg=name)
    wanted = level_weights(grid.sun_cosines, dip, depth)
    assert_allclose(np.reshape(got["level"], (-1, 4))[:, :3], wanted, rtol=1e-6, atol=1e-7)
    assert_allclose(got["thick"][:3], optically_thick_weights(depth), rtol=1e-6)
    assert_allclose(got["strongest"], geometry.medium.extinction.max(axis=1), rtol=1e-6)
    assert_allclose(got["brightest"], geometry.medium.scattering.max(axis=1), rtol=1e-6)


def test_air_that_is_too_thick_is_refused_in_one_line(
    pages: Callable[[str], tuple[Any, dict[str, Any]]], modules: Callable[..., Any]
) -> None:
    # ten times Earth's air has a vertical depth of 2.4 at 440 nm, ten times its aerosol 0.2 more
    page = modules({"solving/edited_air": ("editedAir",)})
    got = page.evaluate(
        """([air, edit]) => {
          try { editedAir(air, edit); return null; } catch (error) { return error.message; }
        }""",
        [pages("earth")[1]["air"], {"amounts": [10.0, 10.0, 10.0], "ground": 1.0}],
    )
    assert got == "so much air is too thick to be solved here; the desktop viewer solves it"


def test_a_page_completes_orders_along_the_vertical_as_the_cpu_does(
    gpu: Any, modules: Callable[..., Any]
) -> None:
    # A second method: the operator that the CPU's loops assemble from the same rays, for any
    # residual. The page's is assembled from textures in single precision: 3e-4 of the largest.
    settings = dataclasses.replace(
        page_settings(), radii=5, sun_angles=7, zenith_angles=3, degree=4
    )
    settings = dataclasses.replace(settings, thick_degree=4)
    medium = Medium.from_planet(load_planet("titan"), WAVELENGTHS)
    data = solver_data(SimpleNamespace(medium=medium), settings)  # type: ignore[arg-type]
    geometry = RefractedGeometry.of(medium)
    plan = plan_for(geometry, settings)
    assert plan.sizes["refinement"] > 1
    assert plan.setup.optics.transport_depth.max() > data["synthetic"]["thicker"]
    rays = {}
    with pooled_iteration(gpu) as sweeper:
        sweeper.load(plan)
        sweeper.run(ONCE)
        for name in ("factors", "shares", "bounces", "projections"):
            texels = plan.textures[name]
            rays[name] = read_flat(gpu, sweeper.texture(name), texels).ravel().tolist()
    nodes, terms = plan.nodes, int(plan.sizes["terms"])
    change = np.random.default_rng(3).uniform(size=nodes * (terms + 1) * 4).astype(np.float32)
    tables = {
        name: {"values": table.ravel().tolist(), "shape": list(table.shape)}
        for name, table in {
            "start": plan.batch.rays.start, "radius": plan.batch.rays.radius,
            "first_nodes": plan.setup.grid.first_nodes, "row": plan.setup.grid.row,
            "sun_cosines": plan.setup.grid.sun_cosines,
        }.items()
    }  # fmt: skip
    cubics = from_text(data["synthetic"]["cubics"]).tolist()
    page = modules({"solving/synthetic_acceleration": ("SyntheticAcceleration",)})
    got = page.evaluate(
        """async ([plan, tables, fixed, rays, diffusion, change]) => {
          const arrays = Object.fromEntries(
            Object.entries(rays).map(([name, values]) => [name, Float32Array.from(values)]));
          const light = Float32Array.from(change);
          const found = [];
          for (const deep of [false, true]) {
            const synthetic = new SyntheticAcceleration(
              plan, (name) => tables[name], fixed, arrays, { ...diffusion, deep });
            await synthetic.eliminate(async () => {});
            found.push([...synthetic.apply(light)], [...synthetic.apply(light, light)]);
          }
          return found;
        }""",
        [
            {"sizes": {name: float(value) for name, value in plan.sizes.items()}},
            tables,
            {**data["synthetic"], "cubics": cubics},
            rays,
            {
                "diffusion_length": plan.batch.diffusion_length,
                "grid_diffusion": plan.batch.grid_diffusion,
            },
            change.tolist(),
        ],
    )
    shape = (int(plan.sizes["radii"]), int(plan.sizes["sun_angles"]))
    field = change[: nodes * terms * 4].reshape(*shape, terms, 4)
    sky = change[nodes * terms * 4 :].reshape(*shape, 4)
    both = [np.concatenate([one, one], axis=-1) for one in (field, sky)]
    cases = [
        (deep, light) for deep in (False, True) for light in (None, (both[0][:, :, 0], both[1]))
    ]
    for found, (deep, light) in zip(got, cases, strict=True):
        synthetic = SyntheticAcceleration(dataclasses.replace(plan.batch, deep=deep))
        moments, irradiances = synthetic.apply(*both, light)
        assert abs(moments[..., :4] - field).max() > 1.0  # acceleration adds much light
        parts = np.split(np.array(found, np.float32), [field.size])
        for part, expected in zip(parts, (moments, irradiances), strict=True):
            wanted = expected[..., :4].ravel()
            assert_allclose(part, wanted, rtol=0, atol=3e-4 * abs(wanted).max())


def test_a_page_and_a_window_declare_the_same_amounts() -> None:
    # one declaration: the page's are those of the session, up to ten times the planet's
    for name in planet_names():
        window = [one for one in Session(name).parameters if one.group == AMOUNTS]
        page = amounts_of(load_planet(name), MOST)
        assert [(one.path, one.label, one.unit) for one in page] == [
            (one.path, one.label, one.unit) for one in window
        ]
        for one in page:
            assert one.checked(one.present) == one.present


def test_turbidity_of_a_page_is_that_of_the_session(modules: Callable[..., Any]) -> None:
    # the session is the second method, edit by edit
    session = Session("earth-volcanic")
    page = modules({"state/state": ("State",)})
    shown = [one for one in session.parameters if one.group == AMOUNTS]
    page.evaluate(
        "([parameters, values]) => { window.state = new State(parameters, values); }",
        [[one.as_json() for one in shown], {one.path: session.value(one.path) for one in shown}],
    )
    for path, value in (
        ("air.turbidity", 5.0), ("air.amounts[0]", 2.0), ("air.amounts[2]", 0.05),
        ("air.turbidity", 1.0), ("air.turbidity", 2.5), ("air.ground", 0.4),
    ):  # fmt: skip
        session.set(path, value)
        got = page.evaluate(
            "([path, value]) => { state.set({ [path]: value }); return state.values; }",
            [path, value],
        )
        for one in shown:
            wanted = session.value(one.path)
            assert_allclose(got[one.path], wanted, rtol=1e-7, atol=1e-12, err_msg=one.path)
    # one edit, one step of undo; a link carries factors, without what follows from them
    page.evaluate("() => { state.planet = 'p'; state.undo(); state.undo(); }")
    assert page.evaluate("state.canRedo")
    before = page.evaluate("state.values")
    assert_allclose(before["air.amounts[2]"], 0.05)
    assert before["air.amounts[0]"] == 2.0
    link = page.evaluate("JSON.parse(decodeURI(state.asFragment()))")
    assert set(link["air"]) == {f"air.amounts[{index}]" for index in (0, 1, 2)}
    assert link["air"]["air.amounts[0]"] == 2.0
    assert page.evaluate("state.takeFragment(state.asFragment())") == []
    after = page.evaluate("state.values")
    for path, value in before.items():
        assert_allclose(after[path], value, rtol=1e-8, err_msg=path)


@pytest.mark.parametrize("path", ["air.amounts[1]", "air.amounts[3]", "air.turbidity"])
def test_a_reset_brings_each_of_two_hazes_back(path: str, modules: Callable[..., Any]) -> None:
    # Turbidity is reset with them, and moves all haze in proportion: not where haze is reset too.
    session = Session("earth")
    shown = [one for one in session.parameters if one.group == AMOUNTS]
    assert [one.path for one in shown if one.matter == "haze"] == [
        "air.amounts[1]",
        "air.amounts[3]",
    ]
    values = {one.path: session.value(one.path) for one in shown}
    page = modules({"state/state": ("State",)})
    got = page.evaluate(
        """([parameters, values, path]) => {
          const state = new State(parameters, values);
          state.set({ [path]: 3 * values[path] });
          state.reset();
          const after = { ...state.values };
          state.undo();
          const back = state.get(path);
          state.redo();
          return [after, back / values[path], state.values];
        }""",
        [[one.as_json() for one in shown], values, path],
    )
    for found in (got[0], got[2]):
        for one, value in values.items():
            assert_allclose(found[one], value, rtol=1e-12, err_msg=one)
    assert_allclose(got[1], 3.0, rtol=1e-12)


def test_the_next_guess_is_weighed_as_on_the_cpu(modules: Callable[..., Any]) -> None:
    # a second method: the solver's Python code, with its eight lanes
    rng = np.random.default_rng(4)
    shape = (3, 5, 4)
    means = np.exp(rng.normal(scale=4.0, size=(2, *shape))).astype(np.float32)
    thick = np.array([0.0, 0.2, 0.7, 1.0])
    stopping = Stopping.of_passes(page_settings())
    shrinking = 0.4 ** np.arange(4)[:, None, None] * rng.normal(size=(4, 15, 4))
    page = modules({"solving/convergence": ("Iteration",)})
    got = page.evaluate(
        """([before, mean, thick, stopping, residuals]) => {
          const iteration = new Iteration(stopping, thick);
          iteration.update(Float32Array.from(before), Float32Array.from(mean));
          const first = [[...iteration.residuals[0]], iteration.remainingError];
          iteration.residuals = residuals.map((one) => Float64Array.from(one));
          const lanes = [0, 1, 2, 3];
          return [...first, lanes.map((lane) => iteration.tail(lane)), iteration.weights()
            .map((one) => [...one]), iteration.tolerance];
        }""",
        [
            means[0].ravel().tolist(),
            means[1].ravel().tolist(),
            thick.tolist(),
            dataclasses.asdict(stopping),
            [one.ravel().tolist() for one in shrinking],
        ],
    )
    # rounding errors of float64
    iteration = Iteration(stopping, thick, 4)
    iteration.update(*means)
    changes, remaining, tail, weights, tolerance = got
    assert_allclose(changes, iteration._residuals[0].ravel(), rtol=1e-6)
    assert_allclose(remaining, iteration.remaining_error.max(), rtol=1e-6)
    assert_allclose(tolerance, iteration.tolerance)
    assert_allclose(tail, estimated_tail(deque(shrinking)), rtol=1e-12)
    for lane in range(4):
        wanted = mixing_weights(shrinking[..., lane])
        assert_allclose(np.array(weights)[:, lane], wanted, rtol=1e-8)
