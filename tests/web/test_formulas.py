"""Formulas emitted as JavaScript give Python's numbers in a page."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.vectors import Vec3
from airlight.solver.moments.acceleration import mixing_weights
from airlight.viewer.browser import formulas
from airlight.viewer.browser.formulas import emitted_formulas

COUNT = 60
RNG = np.random.default_rng(5)


def numbers(low: float, high: float) -> np.ndarray:
    return RNG.uniform(low, high, COUNT)


ANGLES = (numbers(0.0, 180.0), numbers(-360.0, 360.0), numbers(-360.0, 360.0))
BOTTOM, TOP = 6360e3, 6460e3
STAR = (numbers(BOTTOM, TOP), numbers(-0.1, 1.0), BOTTOM, TOP, RNG.uniform(0.0, 0.01, (8, 12, 1)))
LATITUDES, BEARINGS, ZENITHS = numbers(-90.0, 90.0), numbers(0.0, 360.0), numbers(0.0, 180.0)
ALTITUDES, SPEEDS = RNG.lognormal(9.0, 6.0, COUNT), (numbers(-1.0, 1.0), numbers(-1.0, 1.0))
DATES = (RNG.integers(1950, 2051, COUNT), RNG.integers(1, 367, COUNT), numbers(0.0, 24.0))
WAY = (BEARINGS[::-1], numbers(0.0, 2.0))
PIXELS = (numbers(64.0, 2000.0), numbers(64.0, 2000.0), numbers(0.01, 2.9))
#: Points of a picture of 120 by 20 pixels, and directions in the camera's frame.
POINTS = (numbers(1.0, 119.0), numbers(1.0, 19.0), 120.0, 20.0, numbers(0.01, 2.9))
SUN = Vec3(*(numbers(-0.5, 0.5) for _ in "xyz"))
VECTORS = tuple(Vec3(*(numbers(-1.0, 1.0) for _ in "xyz")) for _ in range(2))
POSITIVE = np.geomspace(1e-8, 10.0, COUNT)
STEPS = 4
TEMPERATURES = np.geomspace(2000.0, 25000.0, COUNT)
#: Formulas that write to an array, which are compared in a separate test.
FILLING = {"combine", "delta_m_scaling", "factorise", "substitute", "lateral_diffusion_equations"}


def field(*shape: int) -> np.ndarray:
    return RNG.uniform(0.5, 1.5, shape).astype(np.float32)


#: Arguments of loops over fields: the last receives the result, or the first if `IN_PLACE`.
#: Those of loops over lanes have eight wavelengths.
LOOPS: dict[str, tuple[Any, ...]] = {
    "counted_changes": (
        field(3, 5, 4), field(3, 5, 4), np.array([0.0, 0.2, 0.7, 1.0]), 0.25, 1.5 * np.ones(4),
        np.zeros((15, 4)), np.zeros(4),
    ),
    "accelerate_nodes": (
        *(field(5, 8, 4) for _ in range(3)), 8.0 * field(5, 8, 4), field(5, 4), field(5), 0.7,
        np.zeros((5, 8, 4), np.float32),
    ),
    "fill_quantities": (
        field(2, 3, 8, 4), field(2, 3, 8, 4), 3, *(np.zeros((2, 3, 6, 4), np.float32),) * 2,
    ),
    "add_weighted": (field(2, 3, 5, 4), field(2, 3, 5, 4), field(4)),
    "damp_towards": (field(2, 3, 5, 4), field(2, 3, 5, 4), field(2, 3, 4)),
    "replace_unsound": (field(2, 3, 5, 4), field(2, 3, 5, 4), field(2, 3, 4) > 1.0),
    "take_terms": (field(4, 7, 15, 8), field(4, 7, 8), 0, 2, 2, np.zeros((13, 3, 8), np.float32)),
    "spread_onto": (
        field(7, 7), field(3, 7, 8), np.array([1, 4, 2]), 1, field(7, 8),
        np.zeros((7, 6, 8), np.float32),
    ),
    "multiply": (field(4, 6, 8), field(6, 5, 8), np.zeros((4, 5, 8), np.float32)),
    "gather_levels": (
        field(9, 3) * (RNG.uniform(size=(9, 3)) > 0.5).astype(np.float32), field(4, 9, 5, 8),
        np.zeros((4, 3, 5, 8), np.float32),
    ),
    "project_radii": (
        field(2, 4).astype(float), field(4, 3, 7, 8), 2, 3, np.zeros((2, 9, 8), np.float32),
    ),
}  # fmt: skip
FILLING |= set(LOOPS)
#: Those that change their first argument.
IN_PLACE = {"add_weighted", "damp_towards", "replace_unsound"}
#: Arguments of each function: numbers, or tables, which are the same for all calls.
CASES: dict[str, tuple[Any, ...]] = {
    "black_body_x": (TEMPERATURES,),
    "black_body_y": (TEMPERATURES,),
    "mccamy_temperature": (numbers(0.25, 0.5), numbers(0.25, 0.45)),
    "white_gains": (
        RNG.integers(0, 6, COUNT), TEMPERATURES, numbers(0.25, 0.5), numbers(0.25, 0.45),
        numbers(0.25, 0.5), numbers(0.25, 0.45), 2.0 ** numbers(-8.0, 12.0),
    ),
    "dusk_share": (2.0 ** numbers(-8.0, 12.0),),
    "warm_share": (2.0 ** numbers(11.0, 16.0),),
    "scene_weight": (*(numbers(-0.1, 2.0) for _ in "rgb"), 0.3),
    "days_of_date": DATES,
    "date_after": (*DATES, numbers(-500.0, 500.0)),
    "orbit_of": (RNG.integers(0, 3, COUNT), numbers(-0.5, 0.5)),
    "spin_of": (RNG.integers(0, 3, COUNT), numbers(-20000.0, 20000.0)),
    "point_below_sun": (RNG.integers(0, 3, COUNT), numbers(-20000.0, 20000.0)),
    "sun_on_date": (RNG.integers(0, 3, COUNT), LATITUDES, BEARINGS, *DATES),
    "turns": (numbers(-3000.0, 3000.0),),
    "moon_place": (numbers(-20000.0, 20000.0),),
    "moon_at": (LATITUDES, BEARINGS, numbers(-20000.0, 20000.0)),
    "moon_on_date": (LATITUDES, BEARINGS, *DATES),
    "grain_phase": (numbers(-1.0, 1.0), numbers(0.0, 0.6), numbers(-1.0, 1.0)),
    "multiple_scattering": (numbers(0.0, 1.0), numbers(0.01, 1.0)),
    "tilted": (numbers(0.0, 1.0), numbers(0.1, 1.0)),
    "moon_reflectance": (numbers(0.0, 1.0), numbers(0.0, 1.0), numbers(-1.0, 1.0)),
    "moon_disc": (ZENITHS,),
    "earthlight": (ZENITHS,),
    "moon_phase_factor": (ZENITHS,),
    "bright_limb": (ZENITHS, BEARINGS, ZENITHS[::-1]),
    "phase_shading": (0.9 * ZENITHS, BEARINGS, numbers(0.0, 1.0), numbers(-1.0, 1.0)),
    "light_visibility": (
        ZENITHS, ZENITHS[::-1], numbers(0.0, 2.0), numbers(-1e-6, 2e-5), ALTITUDES, BOTTOM, 1e5
    ),
    "horizon_nadir": (ALTITUDES, BOTTOM),
    "horizon_kept": (ZENITHS, ALTITUDES, ALTITUDES[::-1], BOTTOM),
    "turns_planet": (ALTITUDES, BOTTOM),
    "planet_hidden": (ZENITHS, ALTITUDES, BOTTOM, 60.0),
    "angle_dragged": (ALTITUDES, BOTTOM, numbers(1.0, 90.0), numbers(0.0, 1.0)),
    "sky_magnitude": (10.0 ** numbers(-6.0, 3.0),),
    "direction_of": ANGLES[:2],
    "camera_frame": ANGLES,
    "rolled": (*VECTORS, ANGLES[0]),
    "dot": VECTORS,
    "cross": VECTORS,
    "minus": VECTORS,
    "ground_axes": ANGLES,
    "observer_uniforms": (
        numbers(BOTTOM, TOP), BOTTOM, numbers(-1.0, 1.0), numbers(-1.0, 1.0), numbers(-1.0, 1.0),
        np.maximum(numbers(-0.005, 0.005), 0.0),
    ),
    "horizon_cosine": (numbers(BOTTOM, TOP), BOTTOM),
    "refraction_table_index": STAR,
    "apparent_sun_cosine": STAR,
    "luminance_of": (numbers(0.0, 9.0), numbers(0.0, 9.0), numbers(0.0, 9.0)),
    "exposure_of": (
        np.sort(RNG.lognormal(-3.0, 3.0, 500)), RNG.uniform(0.0, 1.0, 500),
        RNG.uniform(0.0, 1.0, 500), numbers(0.0, 900.0),
        numbers(0.0, 60.0) * RNG.integers(0, 2, COUNT),
    ),
    "exposure_with_stars": (
        np.sort(RNG.lognormal(-3.0, 3.0, 500)), RNG.uniform(0.0, 1.0, 500) * (np.arange(500) < 400),
        RNG.uniform(0.0, 1.0, 500) * (np.arange(500) >= 400), RNG.integers(0, 2, 500),
        RNG.uniform(0.0, 1.0, 500), RNG.integers(0, 3, COUNT), numbers(0.0, 900.0),
        numbers(250.0, 1000.0), numbers(0.0, 60.0) * RNG.integers(0, 2, COUNT),
    ),
    "cool_share": (numbers(0.0, 9.0), numbers(0.0, 9.0), numbers(0.1, 9.0)),
    "cool_limit": (
        np.sort(RNG.lognormal(-3.0, 3.0, 500)), RNG.uniform(0.0, 1.0, 500),
        RNG.uniform(0.0, 1.0, 500), numbers(100.0, 9000.0),
    ),
    "metered_light": (numbers(0.0, 9.0), numbers(0.0, 9.0), numbers(0.0, 9.0)),
    "full_light_factor": (numbers(-2.0, 9.0),),
    "lit_share": (POSITIVE, numbers(-1.0, 9.0)),
    "lit_end": (
        np.sort(RNG.lognormal(-3.0, 3.0, 500)), RNG.uniform(0.0, 1.0, 500),
        RNG.integers(0, 90, COUNT),
    ),
    "brightest_light": (
        np.sort(RNG.lognormal(-3.0, 3.0, 500)), RNG.uniform(0.0, 1.0, 500), numbers(0.0, 200.0),
    ),
    "lamps_shorter": (POSITIVE, numbers(1.0, 4.0)),
    "unlit_exposure": (numbers(0.0, 60.0) * RNG.integers(0, 2, COUNT),),
    "star_limited": (numbers(-20.0, 20.0), POSITIVE, POSITIVE[::-1], numbers(0.1, 10.0)),
    "weighted_index": (
        np.sort(RNG.lognormal(-3.0, 3.0, 500)), RNG.uniform(0.0, 1.0, 500),
        RNG.integers(0, 90, COUNT), numbers(-1.0, 9.0), numbers(0.0, 1.0),
    ),
    "adapted_key": (np.geomspace(1e-6, 1e5, COUNT),),
    "shown_key": (np.geomspace(1e-6, 1e5, COUNT),),
    "eased": (*SPEEDS, numbers(0.0, 1.0), numbers(-0.1, 0.5)),
    "disc_factor": (numbers(1e-5, 1.0),),
    "light_left": (numbers(1e-3, 0.1), numbers(0.0, 0.3), numbers(1e-3, 0.1)),
    "covered_half_arc": (numbers(1e-3, 0.1), numbers(1e-3, 0.3), numbers(1e-3, 0.1)),
    "left_out": (numbers(0.0, 0.1), numbers(0.0, 0.1)),
    "clouds_shown": (numbers(0.0, 2e5), True, True),
    "dehazed_exposure": (
        numbers(-9.0, 9.0), numbers(0.0, 60.0), numbers(-1.0, 1.0), numbers(0.0, 1.0),
        numbers(0.0, 2e5),
    ),
    "metering_weight": (RNG.integers(0, len(formulas.PROJECTIONS), COUNT), *POINTS, SUN, 0.9),
    "projected_ray": (RNG.integers(0, len(formulas.PROJECTIONS), COUNT), *POINTS),
    "perspective_ray": POINTS,
    "fisheye_ray": POINTS,
    "panorama_ray": POINTS,
    "cube_ray": POINTS,
    "octahedral_ray": POINTS,
    "orthographic_ray": POINTS,
    "glare_levels": (numbers(-1e-3, 1e-2), numbers(1.0, 8192.0)),
    "glare_share": (RNG.integers(1, 13, COUNT), numbers(1e-5, 1e-2), numbers(4.0, 8192.0)),
    "compass": (numbers(-2000.0, 2000.0),),
    "finest_cell": (numbers(1e6, 1e8), numbers(512.0, 4096.0)),
    "lattice_origin": (numbers(-1.0, 1.0), numbers(1e6, 1e8), numbers(0.05, 2.0)),
    "within": (numbers(-5.0, 5.0),),
    "climbed": (ALTITUDES, ZENITHS, *SPEEDS, numbers(0.0, 0.4)),
    "course_of": (ZENITHS, BEARINGS, *SPEEDS),
    "angle_flown": (ALTITUDES, ALTITUDES[::-1], ZENITHS, *SPEEDS, numbers(0.0, 0.4), BOTTOM),
    "bearing_of": (*SPEEDS, BEARINGS),
    "travelled": (LATITUDES, numbers(-180.0, 180.0), *WAY),
    "carried_star": (ZENITHS, BEARINGS, *WAY, numbers(0.0, 360.0)),
    "turned": (LATITUDES, numbers(-180.0, 180.0), numbers(0.0, 360.0), ZENITHS, BEARINGS, *WAY),
    "looked": (ZENITHS, BEARINGS, numbers(-90.0, 90.0), numbers(-200.0, 200.0)),
    "risen": (ALTITUDES, numbers(-20.0, 20.0)),
    "sun_dragged": (ZENITHS, BEARINGS, numbers(-90.0, 90.0), numbers(-200.0, 200.0)),
    "sun_at": (LATITUDES, numbers(-90.0, 90.0), numbers(0.0, 24.0)),
    "time_of": (LATITUDES, ZENITHS, BEARINGS),
    "pixel_angle_perspective": PIXELS,
    "pixel_angle_fisheye": PIXELS,
    "pixel_angle_equirectangular": PIXELS,
    "pixel_angle_cubemap": PIXELS,
    "pixel_angle_octahedral": PIXELS,
    "pixel_angle_orthographic": PIXELS,
    "stricter_tolerance": (POSITIVE, numbers(0.0, 1.0), numbers(0.0, 1.0)),
    "is_converged": (RNG.integers(0, 4, COUNT), 2, POSITIVE, POSITIVE[::-1]),
    "logarithmic_progress": (POSITIVE, 1e-3),
    "tail_steps": (RNG.integers(1, 8, COUNT),),
    "is_positive": (POSITIVE, POSITIVE[::-1]),
    "lateral_threshold_of": (10.0 * POSITIVE, numbers(0.0, 1.0)),
    "change_at": (POSITIVE, POSITIVE[::-1], 10.0),
    "count_at": (POSITIVE, 10.0, numbers(0.0, 1.0)),
    "geometric_tail": (POSITIVE, POSITIVE[::-1], RNG.integers(0, 3, COUNT)),
    "is_near": (POSITIVE, POSITIVE[::-1], 10.0),
    "acceleration_weight": (POSITIVE, POSITIVE[::-1]),
    "floor_below": (POSITIVE,),
    "node_value": (
        numbers(BOTTOM, TOP), BOTTOM, TOP, np.cumsum([0, *RNG.integers(1, 4, 32)]),
        RNG.uniform(0.0, 1.0, 100),
    ),
    "altitude_node": (
        numbers(BOTTOM, TOP), BOTTOM, TOP - BOTTOM, np.cumsum([0, *RNG.integers(1, 4, 32)])
    ),
    "squared": (numbers(-3.0, 3.0),),
    "cubed": (numbers(-3.0, 3.0),),
    "is_peaked": (numbers(-2e-6, 2e-6),),
    "delta_m_weight": (POSITIVE,),
    "truncated_fraction": (numbers(-1.0, 1.2), numbers(0.0, 1.0)),
    "polarised_truncated_fraction": (numbers(-1.0, 1.2), numbers(0.0, 1.0)),
    "turbidity_of": (POSITIVE, POSITIVE[::-1]),
    "haze_of": (1.0 + POSITIVE, POSITIVE[::-1]),
    "optically_thick_weight": (POSITIVE,),
    "level_weight": (numbers(0.0, 1.0), POSITIVE),
}  # fmt: skip


def functions() -> dict[str, Callable[..., Any]]:
    """Python function by the name of the emitted function."""
    return {one.name: one.function for one in emitted_formulas().emitted.values()}


def is_table(argument: Any) -> bool:
    """Whether an argument is passed as a whole."""
    return isinstance(argument, np.ndarray) and argument.shape != (COUNT,)


def rows_of(arguments: tuple[Any, ...]) -> list[list[Any]]:
    """Arguments of each call."""
    columns = [
        [one] * COUNT if is_table(one)
        else [Vec3(*values) for values in np.transpose(one).tolist()] if isinstance(one, Vec3)
        else np.broadcast_to(one, COUNT).tolist()
        for one in arguments
    ]  # fmt: skip
    return [list(row) for row in zip(*columns, strict=True)]


def in_javascript(argument: Any) -> Any:
    """Table in the page's format."""
    if not is_table(argument):
        return argument
    return {"values": argument.ravel().tolist(), "shape": list(argument.shape)}


def test_every_formula_of_a_page_is_compared() -> None:
    # A new formula of the page needs a case here; ``moon_reflectance`` is Hapke's.
    assert set(functions()) == set(CASES) | FILLING | {"hapke_reflectance"}


def test_a_projection_s_name_may_have_a_hyphen(monkeypatch: pytest.MonkeyPatch) -> None:
    forms = {"equal-area": formulas.PROJECTIONS["fisheye"]}
    monkeypatch.setattr(formulas, "PROJECTIONS", forms)
    monkeypatch.setattr(formulas, "emitted_formulas", formulas.emitted_formulas.__wrapped__)
    text = formulas.formulas_text.__wrapped__()
    assert "function pixel_angle_equal_area(" in text
    assert 'PIXEL_ANGLES = { "equal-area": pixel_angle_equal_area }' in text


@pytest.fixture(scope="module")
def calls(chromium: Any) -> Any:
    """``calls(name, rows)``: values that the emitted function returns, or fills, for each row."""
    from airlight.viewer.browser.modules import join_modules, web_file

    names = ", ".join(functions())
    entry = f'import {{ {names} }} from "./generated/formulas.js";\n'
    entry += f"Object.assign(window, {{ {names} }});"
    script = join_modules("test.js", lambda file: entry if file == "test.js" else web_file(file))
    page = chromium.new_page()
    page.evaluate(f"() => {{ {script} }}")
    call = """([name, rows, filled]) => rows.map((row) => {
      const result = window[name](...row);
      const given = filled === null ? result : row[filled];
      return [given.shape ? given.values : given].flat(Infinity).map(Number);
    })"""
    yield lambda name, rows, filled=None: page.evaluate(call, [name, rows, filled])
    page.close()


@pytest.mark.parametrize("name", CASES)
def test_a_formula_in_javascript_is_python_s(name: str, calls: Callable[..., Any]) -> None:
    # a second method: Python; both in double precision, whose sines differ by a rounding or two.
    plain = getattr(functions()[name], "py_func", functions()[name])
    rows = rows_of(CASES[name])
    wanted = [np.ravel(plain(*row)) for row in rows]
    seen = calls(name, [[in_javascript(one) for one in row] for row in rows])
    assert_allclose(seen, wanted, rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize("name", LOOPS)
def test_a_loop_over_fields_in_javascript_is_python_s(name: str, calls: Callable[..., Any]) -> None:
    # a second method: compiled code in single precision, of eight wavelengths or four at once
    arguments, lane = LOOPS[name], 3
    lanes = name in ("take_terms", "spread_onto", "multiply", "gather_levels", "project_radii")
    row = [
        {
            "values": one.ravel().tolist(), "shape": list(one.shape[:-1]), "step": 8, "at": lane
        } if lanes and isinstance(one, np.ndarray) and one.shape[-1] == 8
        else {"values": one.ravel().tolist(), "shape": list(one.shape)}
        if isinstance(one, np.ndarray) else one
        for one in arguments
    ]  # fmt: skip
    place = 0 if name in IN_PLACE else len(arguments) - 1
    seen = np.reshape(calls(name, [row], place)[0], arguments[place].shape)
    given = [one.copy() if isinstance(one, np.ndarray) else one for one in arguments]
    next(one for one in formulas.FORMULAS if one.__name__ == name)(*given)
    kept = np.s_[..., lane] if lanes else np.s_[...]
    assert_allclose(seen[kept], given[place][kept], rtol=2e-6)


def test_the_weights_of_the_next_guess_are_python_s(calls: Callable[..., Any]) -> None:
    # Elimination in the same order: a few roundings of float64; none in the singular case.
    residuals = RNG.normal(size=(STEPS, 12))
    for values in (residuals, np.zeros_like(residuals)):
        changes = np.diff(values, axis=0)
        products = np.hstack([changes @ changes.T, (changes @ values[-1])[:, None]])
        seen = calls("combine", [[products.ravel().tolist(), STEPS, [0.0] * STEPS]], 2)
        assert_allclose(seen[0], mixing_weights(values), rtol=1e-9)


def test_lateral_diffusion_is_python_s(calls: Callable[..., Any]) -> None:
    # Sums in the same order, cosines of float64.
    cosines = np.sort(np.concatenate([[-1.0, 1.0], RNG.uniform(-1.0, 1.0, 9)]))
    table = {"values": cosines.tolist(), "shape": [cosines.size]}
    spread, measure = np.zeros(cosines.size**2), np.zeros(cosines.size)
    functions()["lateral_diffusion_equations"](cosines, 0.02, 0.3, spread, measure)
    row = [table, 0.02, 0.3, [0.0] * spread.size, [0.0] * measure.size]
    assert_allclose(
        calls("lateral_diffusion_equations", [row], 3)[0], spread, rtol=1e-9, atol=1e-12
    )
    assert_allclose(
        calls("lateral_diffusion_equations", [row], 4)[0], measure, rtol=1e-9, atol=1e-12
    )


def test_elimination_in_javascript_solves_equations(calls: Callable[..., Any]) -> None:
    # Second method: LAPACK. Rows of K sum to less than 1; the size is not a multiple of a block.
    size, columns = 19, 3
    matrix = np.eye(size) - RNG.uniform(size=(size, size)) / (size + 2)
    right = RNG.uniform(size=(size, columns))
    factors = calls("factorise", [[matrix.ravel().tolist(), size]], 0)[0]
    row = [factors, size, right.ravel().tolist(), columns]
    solved = calls("substitute", [row], 2)[0]
    assert_allclose(solved, np.linalg.solve(matrix, right).ravel(), rtol=1e-10)


def test_optics_without_forward_peaks_are_python_s(calls: Callable[..., Any]) -> None:
    # Sums in the same order: a few roundings. One constituent has no peak, one does not scatter.
    wavelengths, degree = 4, 5
    g = np.array([0.0, 0.85, 0.7])[:, None, None]
    phases = np.broadcast_to(g ** np.arange(degree + 2), (3, wavelengths, degree + 2)).copy()
    scattering, absorption = RNG.uniform(1e-6, 1e-4, (2, 3, wavelengths))
    scattering[2] = 0.0
    columns = np.array([8e3, 1e3, 2e3])
    polarised_elements = RNG.uniform(-1.0, 1.0, (3, wavelengths, 4))
    tables = (scattering, absorption, phases, polarised_elements, columns)
    parts = (1, degree + 1, 4, 1)
    sizes = [3 * wavelengths * part for part in parts]
    filled = [np.zeros(size) for size in sizes]
    functions()["delta_m_scaling"](*tables, degree, *filled)
    row = [
        *({"values": one.ravel().tolist(), "shape": list(one.shape)} for one in tables),
        degree,
        *([0.0] * size for size in sizes),
    ]
    for index, wanted in enumerate(filled, start=6):
        assert np.ptp(wanted) > 0.0
        assert_allclose(calls("delta_m_scaling", [row], index)[0], wanted, rtol=1e-12)
