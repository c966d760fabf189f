"""The plotted data of figures that show a solution."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.image.spectral import rgb_weights, sun_color
from airlight.planets import Constituent, Ground, Planet, replace
from airlight.planets.matter.phases import HenyeyGreenstein
from airlight.planets.matter.profiles import Exponential
from airlight.solver.solution import Solution
from airlight.studies.observables.limb import limb_radiance
from airlight.studies.plots.chromaticity import cie, sky_chromaticities
from airlight.studies.plots.limb import limb
from airlight.studies.plots.mapping_comparison import (
    atlas,
    mapping_comparison,
    table_lines,
    table_rgb,
)
from airlight.studies.plots.order_convergence import convergence, order_convergence
from airlight.studies.plots.sky_profile import sky_profile

Known = Callable[..., Any]


def test_the_limb_fades_with_the_scale_height(solution: Solution) -> None:
    # High up the air is thin and lit evenly: radiance ∝ exp(-h/H) √(R + h) erf √((h_top - h)/H),
    # the part of the chord's column below the top (H ≪ R). Multiply scattered light comes from
    # below and hardly depends on height: 3 % of the slope. Here H is 8 km of Rayleigh's air.
    height = np.array([50e3, 75e3])
    radiance = limb_radiance(solution, height, 40.0)
    column = [
        math.exp(-h / 8e3) * math.sqrt(6360e3 + h) * math.erf(math.sqrt((100e3 - h) / 8e3))
        for h in height
    ]
    slope = np.log(radiance[0] / radiance[1])
    assert_allclose(slope, math.log(column[0] / column[1]), rtol=0.03)


def test_limb_sights_are_tangent_with_the_sun_where_it_was_asked_for(known_light: Known) -> None:
    # geometry: r sin(z) is the tangent radius, the sun is at right angles to the line, and its
    # zenith angle at the tangent point follows from that at the observer
    light = known_light(lambda lines, order: np.ones(lines.r.size))
    height = np.array([[-5e3], [0.0], [20e3], [90e3], [100e3]])
    sun = np.array([0.0, 60.0, 90.0, 96.0])
    limb_radiance(light, height, sun)
    lines = light.asked[0]
    sine = np.sqrt((1.0 - lines.mu) * (1.0 + lines.mu))
    tangent = np.broadcast_to(6360e3 + height, (5, 4)).ravel()
    assert_allclose(lines.r * sine, tangent, rtol=1e-9)  # 6 mm
    assert_allclose(lines.nu, 0.0, atol=1e-9)
    expected = np.broadcast_to(np.cos(np.radians(sun)), (5, 4)).ravel()
    assert_allclose(lines.r * lines.mu_s / tangent, expected, atol=1e-9)
    assert_allclose(lines.to_ground.reshape(5, 4)[:, 0], [True, False, False, False, False])


def test_limb_curves_are_the_radiance_over_kilometres(solution: Solution) -> None:
    # a second way to the same number: the public door, at one point of one curve
    figure = limb(solution, (60.0,))
    curve = figure.axes[1].get_lines()[0]
    at = 150
    height = 1e3 * float(curve.get_ydata()[at])  # type: ignore[index]
    expected = limb_radiance(solution, height, 60.0)[1]
    assert_allclose(curve.get_xdata()[at], expected, rtol=1e-6)  # type: ignore[index]
    assert figure.axes[1].get_title() == "550 nm"


def test_sky_profiles_cut_the_sky_where_they_say(known_light: Known) -> None:
    # for light e^ν the plane holds exp(cos(view - sun)), and the circle the cosine rule's value
    figure = sky_profile(known_light(lambda lines, order: np.exp(lines.nu)), sun_zenith=50.0)
    star = known_light(lambda lines, order: lines.nu).medium.solar_irradiance[0]
    plane, circle = (axes.get_lines()[0] for axes in figure.axes)
    view = np.asarray(plane.get_xdata(), float)
    expected = star * np.exp(np.cos(np.radians(view - 50.0)))
    assert_allclose(np.asarray(plane.get_ydata(), float), expected, rtol=1e-12)
    around = np.radians(np.asarray(circle.get_xdata(), float))
    sun = math.radians(50.0)
    nu = math.cos(sun) ** 2 + math.sin(sun) ** 2 * np.cos(around)
    assert_allclose(np.asarray(circle.get_ydata(), float), star * np.exp(nu), rtol=1e-12)


def test_with_the_sun_down_the_circle_stays_in_the_sky(known_light: Known) -> None:
    light = known_light(lambda lines, order: np.ones(lines.r.size))
    figure = sky_profile(light, sun_zenith=94.0)
    assert_allclose(light.asked[1].mu, math.cos(math.radians(85.0)), rtol=1e-12)
    assert figure.axes[1].get_title("left").endswith("85°")


def test_sky_of_grey_air_has_the_colour_of_the_sun(
    planet: Planet, solved: Callable[..., Solution]
) -> None:
    # an exact limit: nothing depends on wavelength but the star
    grey = Constituent(
        name="grey",
        profile=Exponential(scale_height=8e3),
        scattering=2e-5,
        phase_function=HenyeyGreenstein(asymmetry=0.3),
    )
    world = replace(
        planet, constituents=(grey,), ground=Ground(albedo=0.0), default_wavelengths=None
    )
    found = sky_chromaticities(solved(world, (450.0, 500.0, 550.0, 600.0), "preview"), (30.0, 80.0))
    xyz = np.linalg.solve(
        [[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560],
         [0.0556434, -0.2040259, 1.0572252]],
        sun_color(),
    )  # fmt: skip
    expected = np.broadcast_to(xyz[:2] / xyz.sum(), found.shape)
    assert_allclose(found, expected, atol=1e-5)  # single precision of the solution


def test_the_diagram_has_the_standards_primaries_and_white(solution: Solution) -> None:
    # IEC 61966-2-1: red, green, blue, and D65 to four decimals
    whole = cie(solution).axes[1]
    triangle, white = (
        np.array(one.get_xydata())
        for one in whole.get_lines()
        if one.get_label() in ("sRGB", "D65 white")
    )
    assert_allclose(triangle[:3], [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]], atol=1e-4)
    assert_allclose(white, [[0.3127, 0.3290]], atol=1e-4)


def test_matching_functions_peak_where_the_standard_says(solution: Solution) -> None:
    # ISO/CIE 11664-1: ȳ has its maximum 1 at 555 nm, z̄ its own at 446 nm, x̄ at 599 nm
    curves = cie(solution).axes[0].get_lines()
    peaks = [np.asarray(one.get_xdata())[np.argmax(one.get_ydata())] for one in curves]
    assert peaks == [599.0, 555.0, 446.0]


@pytest.mark.parametrize("mapping", ["linear", "weighted-power"])
def test_texels_of_the_table_are_where_the_mapping_puts_them(
    solution: Solution, mapping: Any
) -> None:
    # linear: AP2, section 3.1.2; weighted power: its ends and the golden border at the top
    lines = table_lines(solution, mapping, (5, 9, 5))
    mu = lines.mu.reshape(5, 9, 5)[0]
    altitude = lines.r.reshape(5, 9, 5)[0, 0] - 6360e3
    mu_s = lines.mu_s.reshape(5, 9, 5)[:, 0, 0]
    assert_allclose(mu[[0, -1]], [[-1.0] * 5, [1.0] * 5], atol=1e-12)
    assert not lines.to_ground.any()
    if mapping == "linear":
        assert_allclose(altitude, [0.0, 25e3, 50e3, 75e3, 100e3], atol=1e-6)
        assert_allclose(mu[:, 2], np.linspace(-1.0, 1.0, 9), atol=1e-12)
        assert_allclose(mu_s, np.linspace(-1.0, 1.0, 5), atol=1e-12)
    else:
        assert_allclose(altitude, [0.0, 6.25e3, 25e3, 56.25e3, 100e3], atol=1e-6)
        # w_S = 8/32 at the top: the third of nine texels is the horizon, the eighth (7/8) is 90°
        assert_allclose(mu[[2, 7], -1], [-0.175272, 0.0], atol=5e-7)
        assert_allclose(mu_s, [-1.0, -0.25, 0.0, 0.25, 1.0], atol=1e-12)


def test_the_table_is_the_sky_seen_along_its_texels(solution: Solution) -> None:
    # a second way: the public door in degrees, for texels that look above the horizontal
    shape = (3, 9, 5)
    lines = table_lines(solution, "weighted-power", shape, 30.0)
    rgb = table_rgb(solution, lines, shape)
    picked = np.ravel_multi_index((4, 7, 1), (5, 9, 3))
    radiance = solution.radiance(
        altitude=lines.r[picked] - 6360e3,
        sun_zenith=math.degrees(math.acos(lines.mu_s[picked])),
        view_zenith=math.degrees(math.acos(lines.mu[picked])),
        azimuth=30.0,
    )
    assert lines.mu[picked] > 0.0
    assert solution.planet is not None
    weights = rgb_weights(solution.wavelengths, solution.planet.star.irradiances)
    assert_allclose(rgb[4, 7, 1], np.asarray(radiance) @ weights, rtol=1e-5)
    # at ground level there is no air when looking down (AP2, section 3.1.4)
    assert_allclose(rgb[:, 0, 0], 0.0, atol=1e-12)


def test_atlas_lays_tiles_from_the_upper_left_with_their_first_row_below() -> None:
    tiles = np.arange(3 * 2 * 2 * 1).reshape(3, 2, 2, 1)
    expected = [[2, 3, 6, 7], [0, 1, 4, 5], [10, 11, 0, 0], [8, 9, 0, 0]]
    assert_allclose(atlas(tiles, columns=2)[..., 0], expected, atol=0)


def test_both_mappings_are_shown_with_one_exposure(solution: Solution) -> None:
    # both tables hold the sky straight up from the ground with the sun overhead: same colour
    figure = mapping_comparison(solution, shape=(4, 8, 8))
    linear, weighted = (np.asarray(axes.images[0].get_array()) for axes in figure.axes)
    assert linear.shape == weighted.shape == (8, 32, 3)
    corner = (0, 28)  # last tile: sun at the zenith; upper left: ground, straight up
    assert linear[corner].max() > 20
    assert_allclose(linear[corner].astype(float), weighted[corner].astype(float), atol=1)


def test_orders_of_a_geometric_series_leave_its_own_rest(known_light: Known) -> None:
    # q + q² + … : after order k the rest is q^k of the whole, at every order, tail included
    q = 0.3
    light = known_light(lambda lines, order: np.full(lines.r.size, q ** (order or 1)), orders=7)
    figure = order_convergence(light)
    upper, lower = figure.axes[0], figure.axes[3]
    orders = np.arange(1, 8)
    star = light.medium.solar_irradiance[0]
    assert_allclose(upper.get_lines()[0].get_ydata(), star * q**orders, rtol=1e-12)
    assert_allclose(lower.get_lines()[0].get_ydata(), q**orders, rtol=1e-9)
    # the dotted line goes on where the curve ends
    dotted = lower.get_lines()[1]
    assert_allclose(dotted.get_ydata(), q ** np.asarray(dotted.get_xdata(), float), rtol=1e-9)


def test_orders_that_vanish_leave_no_rest() -> None:
    # no division by 0: a line into black space
    found = convergence(np.zeros((3, 1, 1)))
    assert_allclose(found.rest, 0.0, atol=0)
    assert_allclose(found.tail, 0.0, atol=0)


def test_a_solution_without_orders_is_refused(solution: Solution) -> None:
    if solution.highest_order > 1:
        pytest.skip("the moments keep their orders")
    with pytest.raises(ParameterError, match="a solution with scattering orders"):
        order_convergence(solution)
