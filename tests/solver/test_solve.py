"""Public interface: degrees and metres in, labelled arrays out, one line for every refusal."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import Cancelled, ParameterError, load_planet, replace, solve
from airlight.planets import Planet
from airlight.solver.moments.solution import MomentsSolution


@pytest.fixture
def solution(
    reference_earth: Callable[..., Planet], solved: Callable[..., MomentsSolution]
) -> MomentsSolution:
    return solved(reference_earth(albedo=0.3), quality="preview")


def test_arrays_broadcast_and_carry_their_labels(solution: MomentsSolution) -> None:
    # The rules of NumPy; wavelength is the last axis, units are those of the style guide.
    sky = solution.radiance(
        altitude=[[0.0], [1e3]], sun_zenith=60.0, view_zenith=[10.0, 50.0, 85.0], azimuth=20.0
    )
    assert sky.shape == (2, 3, 3)
    assert sky.dims == ("altitude", "view_zenith", "wavelength")
    assert_array_equal(sky.coords["wavelength"].values, [680.0, 550.0, 440.0])
    assert sky.coords["wavelength"].attrs["units"] == "nm"
    assert sky.coords["view_zenith"].attrs["units"] == "degree"
    assert_array_equal(sky.coords["view_zenith"].values, [10.0, 50.0, 85.0])
    assert_array_equal(sky.coords["sun_zenith"].values, 60.0)
    assert sky.attrs["units"] == "W m-2 sr-1 nm-1"
    assert sky.name == "radiance"


def test_one_by_one_and_all_at_once_give_the_same(solution: MomentsSolution) -> None:
    # A line of sight does not know its neighbours.
    rng = np.random.default_rng(20)
    where = {
        "altitude": 10.0 ** rng.uniform(0.0, 7.0, 12), "sun_zenith": rng.uniform(0, 100, 12),
        "view_zenith": rng.uniform(0, 180, 12), "azimuth": rng.uniform(0, 180, 12),
    }  # fmt: skip
    together = solution.radiance(**where).values
    alone = [
        solution.radiance(**{name: float(values[k]) for name, values in where.items()}).values
        for k in range(12)
    ]
    assert_array_equal(together, alone)


def test_no_lines_of_sight_give_no_radiances(solution: MomentsSolution) -> None:
    empty = solution.radiance(altitude=[], sun_zenith=60.0, view_zenith=30.0)
    assert empty.shape == (0, 3)


def test_azimuths_on_either_side_of_the_sun_are_alike(solution: MomentsSolution) -> None:
    # The air is symmetric about the plane of zenith and star, and a turn is a turn.
    options = {"altitude": 10.0, "sun_zenith": 70.0, "view_zenith": 60.0}
    right, left, around = (
        solution.radiance(azimuth=azimuth, **options).values for azimuth in (50.0, -50.0, 310.0)
    )
    assert_allclose(left, right, rtol=1e-6)
    assert_allclose(around, right, rtol=1e-6)


def test_radiance_scales_with_the_stars_irradiance(reference_earth: Callable[..., Planet]) -> None:
    # Light does not act on light.
    planet = reference_earth(albedo=0.3, aerosol=None)
    brighter = replace(planet, star=replace(planet.star, irradiance=7.0))
    one, seven = (
        solve(p, [550.0], "preview", cache=False).radiance(
            altitude=0.0, sun_zenith=60.0, view_zenith=[0.0, 80.0]
        )
        for p in (planet, brighter)
    )
    assert_allclose(seven.values, 7.0 * one.values, rtol=1e-12)


REFUSALS = [
    ({"altitude": -1.0}, "altitude"), ({"altitude": np.nan}, "altitude"),
    ({"altitude": np.inf}, "altitude"), ({"sun_zenith": 181.0}, "sun_zenith"),
    ({"sun_zenith": -0.1}, "sun_zenith"), ({"view_zenith": 200.0}, "view_zenith"),
    ({"view_zenith": [30.0, np.nan]}, "view_zenith"), ({"azimuth": 1e9}, "azimuth"),
    ({"azimuth": "north"}, "azimuth"),
    ({"altitude": [1.0, 2.0], "azimuth": [1.0, 2.0, 3.0]}, "shapes"),
    ({"order": 2}, "order"), ({"order": 0}, "order"),
]  # fmt: skip


@pytest.mark.parametrize(("wrong", "field"), REFUSALS)
def test_what_cannot_be_is_refused_in_one_line(
    wrong: dict, field: str, solution: MomentsSolution
) -> None:
    good = {"altitude": 0.0, "sun_zenith": 60.0, "view_zenith": 30.0, "azimuth": 0.0}
    with pytest.raises(ParameterError) as caught:
        solution.radiance(**{**good, **wrong})
    assert caught.value.field == field
    assert "\n" not in str(caught.value)
    assert "allowed" in str(caught.value)


def test_irradiance_and_transmittance_refuse_as_well(solution: MomentsSolution) -> None:
    with pytest.raises(ParameterError, match="altitude"):
        solution.irradiance(altitude=100.001e3, sun_zenith=10.0)
    with pytest.raises(ParameterError, match="sun_zenith"):
        solution.irradiance(altitude=0.0, sun_zenith=-1.0)
    with pytest.raises(ParameterError, match="distance"):
        solution.transmittance(altitude=0.0, view_zenith=10.0, distance=-1.0)


@pytest.mark.parametrize(
    ("wavelengths", "field"),
    [([], "wavelengths"), ([200.0], "wavelengths"), ([[550.0], [440.0]], "wavelengths"),
     (["green"], "wavelengths"), ([np.nan], "wavelengths"), ([550.0, 550.0], "wavelengths")],
)  # fmt: skip
def test_wavelengths_that_cannot_be_are_refused(wavelengths: list, field: str) -> None:
    with pytest.raises(ParameterError) as caught:
        solve(load_planet("earth-atmosphere-plus"), wavelengths, "preview", cache=False)
    assert field in caught.value.field
    assert "\n" not in str(caught.value)


def test_an_unknown_quality_names_the_known_ones() -> None:
    with pytest.raises(ParameterError, match="preview, default, fine"):
        solve(load_planet("earth-atmosphere-plus"), quality="best", cache=False)


def test_transmittance_to_a_distance_multiplies_up(solution: MomentsSolution) -> None:
    # T(a, c) = T(a, b)·T(b, c), through the public door: from 10 km level to 200 km and on.
    bottom = solution.medium.bottom_radius
    r, way = bottom + 10e3, 200e3
    r_there = np.hypot(r, way)
    there = {"altitude": r_there - bottom, "view_zenith": np.degrees(np.arccos(way / r_there))}
    near = solution.transmittance(altitude=10e3, view_zenith=90.0, distance=way).values
    far = solution.transmittance(**there).values
    whole = solution.transmittance(altitude=10e3, view_zenith=90.0).values
    assert_allclose(near * far, whole, rtol=1e-6)
    assert_array_equal(solution.transmittance(altitude=10e3, view_zenith=90.0, distance=0.0), 1.0)


def test_transmittance_ends_at_the_ground(solution: MomentsSolution) -> None:
    # Space cannot be seen through the ground; what stands on the ground can.
    options = {"altitude": 20e3, "view_zenith": 180.0}
    assert_array_equal(solution.transmittance(**options).values, 0.0)
    assert (solution.transmittance(**options, distance=19_999.0).values > 0.5).all()
    assert_array_equal(solution.transmittance(**options, distance=20_001.0).values, 0.0)
    up = solution.transmittance(altitude=0.0, view_zenith=0.0, distance=20e3).values
    assert_allclose(solution.transmittance(**options, distance=20e3 - 1e-3).values, up, rtol=1e-6)


def test_an_observer_outside_sees_what_stands_where_the_sight_enters(
    solution: MomentsSolution,
) -> None:
    # Space is empty: going back along the line of sight changes nothing.
    r, mu = solution.medium.top_radius, np.cos(np.radians(120.0))
    sun, around = np.radians(50.0), np.radians(40.0)
    nu = mu * np.cos(sun) + np.sin(np.radians(120.0)) * np.sin(sun) * np.cos(around)
    at_top = solution.radiance(
        altitude=r - 6360e3, sun_zenith=50.0, view_zenith=120.0, azimuth=40.0
    )
    for back in (10.0, 1e5, 1e7):
        r_out = np.sqrt(r * r + back * back - 2 * r * back * mu)
        mu_out, sun_out = (r * mu - back) / r_out, (r * np.cos(sun) - back * nu) / r_out
        spread = np.sqrt((1 - mu_out**2) * (1 - sun_out**2))
        azimuth = np.degrees(np.arccos(np.clip((nu - mu_out * sun_out) / spread, -1, 1)))
        outside = solution.radiance(
            altitude=r_out - 6360e3, sun_zenith=np.degrees(np.arccos(sun_out)),
            view_zenith=np.degrees(np.arccos(mu_out)), azimuth=azimuth,
        )  # fmt: skip
        assert_allclose(outside.values, at_top.values, rtol=1e-4)


def test_progress_rises_to_its_total(reference_earth: Callable[..., Planet]) -> None:
    reported: list[tuple[int, int, str]] = []
    nm = np.linspace(440.0, 680.0, 9)
    solve(
        reference_earth(albedo=0.3), nm, "preview", cache=False,
        progress=lambda done, total, message: reported.append((done, total, message)),
    )  # fmt: skip
    done = [one[0] for one in reported]
    assert done == sorted(done)
    assert done[-1] == reported[-1][1]
    assert len({one[1] for one in reported}) == 1
    assert all("\n" not in message and message for _, _, message in reported)


def test_cancel_stops_within_a_moment(reference_earth: Callable[..., Planet]) -> None:
    # Asked between blocks of a sweep, each a small part of a second: of the CPU's time, which
    # other work on the machine does not lengthen.
    planet = reference_earth(albedo=0.3)
    solve(planet, quality="default", cache=False)  # compiled by now
    asked_to_stop = time.process_time() + 0.1
    with pytest.raises(Cancelled):
        solve(
            planet, quality="fine", cache=False, cancel=lambda: time.process_time() > asked_to_stop
        )
    assert time.process_time() - asked_to_stop < 3.0
    with pytest.raises(Cancelled):
        solve(planet, quality="preview", cache=False, cancel=lambda: True)


def test_the_report_says_how_on_one_line(solution: MomentsSolution) -> None:
    text = str(solution.report)
    assert "\n" not in text
    assert f"{solution.report.sweeps} sweeps" in text
    assert "moments" in text
    assert len(solution.report.residual) == 3


@pytest.mark.parametrize("solver", ["moments", "direct", "montecarlo"])
@pytest.mark.parametrize("quality", ["best", 3, None, object()])
def test_every_solver_refuses_what_is_no_quality_of_its_own(solver: str, quality: object) -> None:
    # Another solver's settings, numbers and unknown names would fail later and in other words.
    with pytest.raises(ParameterError, match="quality"):
        solve(load_planet("earth"), [550.0], quality, solver=solver)
