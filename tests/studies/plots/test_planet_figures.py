"""The plotted data of figures that need no solution."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from airlight import load_planet
from airlight.errors import ParameterError
from airlight.planets import Constituent, Medium, Planet, Star, replace
from airlight.planets.matter.profiles import Exponential
from airlight.studies.plots.density import density
from airlight.studies.plots.mapping_regions import TEXELS, mapping_regions, regions
from airlight.studies.plots.optical_depth import optical_depth
from airlight.studies.plots.phase_functions import phase_functions
from airlight.studies.plots.solar_spectrum import solar_spectrum
from airlight.studies.plots.spectral_to_rgb import spectral_to_rgb
from airlight.studies.plots.transmittance import (
    horizon_zenith,
    mean_transmittance,
    transmittance_map,
    transmittance_surface,
)

#: Transmittance of AP2's air at 680, 550, 440 nm (physics.md, section 11), by zenith angle [deg].
GOLDEN = {
    0.0: (0.940359, 0.867616, 0.762310),
    60.0: (0.884784, 0.753858, 0.582282),
    80.0: (0.712941, 0.459379, 0.221627),
    90.0: (0.106429, 0.00957976, 5.20709e-5),
}


def line(axes: object, label: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """x and y of the curve whose label begins so."""
    (found,) = [one for one in axes.get_lines() if str(one.get_label()).startswith(label)]  # type: ignore[attr-defined]
    return np.asarray(found.get_xdata(), float), np.asarray(found.get_ydata(), float)


def test_the_suns_curve_has_the_printed_value_at_550_nm() -> None:
    # ASTM G-173-03 prints 1.863 W m⁻² nm⁻¹ outside the air
    axes = solar_spectrum(load_planet("earth")).axes[0]
    nm, irradiance = line(axes, "spectrum")
    assert_allclose(irradiance[nm == 550.0], 1.863, rtol=1e-12)
    (marks,) = [one for one in axes.collections if one.get_label() == "marks"]
    assert_allclose(marks.get_offsets()[1], [550.0, 1.863], rtol=1e-12)  # type: ignore[index]


def test_a_black_bodys_curve_peaks_where_wien_says(planet: Planet) -> None:
    # Wien's displacement: 2.897771955e6 nm K (CODATA 2018); points stand 1 nm apart
    star = Star(temperature=5000.0, radius=6.957e8, distance=1.495978707e11)
    nm, irradiance = line(solar_spectrum(replace(planet, star=star)).axes[0], "spectrum")
    assert abs(nm[irradiance.argmax()] - 2.897771955e6 / 5000.0) <= 0.5


def test_spectral_to_rgb_obeys_its_normalisations() -> None:
    # none: ȳ(555 nm) = 1 by definition; sum: X + Y + Z = 1; peak: the largest channel is 1.
    # Matrix of sRGB to XYZ from its primaries and white, IEC 61966-2-1, rounded to 4 digits.
    to_xyz = np.array(
        [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    )
    curves = [spectral_to_rgb().axes[2 * k] for k in range(3)]
    none, total, peak = (np.stack([line(one, name)[1] for name in "RGB"]) for one in curves)
    nm = line(curves[0], "R")[0]
    assert_allclose((to_xyz @ none)[1, nm == 555.0], 1.0, atol=1e-3)
    assert_allclose((to_xyz @ total).sum(axis=0), 1.0, atol=1e-3)
    assert_allclose(peak.max(axis=0), 1.0, rtol=1e-12)


def test_density_falls_by_e_in_a_scale_height_and_ozone_peaks_at_25_km(planet: Planet) -> None:
    # AP2, section 1.5: exp(-h/8 km), exp(-h/1.2 km), 1 - |h - 25 km|/15 km; 100 m between points
    linear, logarithmic = density(planet).axes
    for axes in (linear, logarithmic):
        for name, height in (("air", 8.0), ("aerosol", 1.2)):
            values, altitude = line(axes, name)
            at = np.abs(altitude - height) < 1e-9
            assert_allclose(values[at], [math.exp(-1.0)], rtol=1e-12)
    values, altitude = line(linear, "ozone")
    assert_allclose(
        np.interp([10.0, 17.5, 25.0, 40.0], altitude, values), [0, 0.5, 1, 0], atol=1e-12
    )


@pytest.mark.parametrize("name", ["earth-atmosphere-plus", "mars"])
def test_every_plotted_phase_function_integrates_to_one(name: str) -> None:
    # a law; the trapezoid over the plotted points errs by less than 1e-3
    polar, cartesian = phase_functions(load_planet(name)).axes[:2]
    assert len(cartesian.get_lines()) >= 2
    for axes, whole in ((cartesian, 1.0), (polar, 2.0)):
        for curve in axes.get_lines():
            angle = np.asarray(curve.get_xdata(), float)
            theta = np.radians(angle) if axes is cartesian else angle
            value = np.asarray(curve.get_ydata(), float)
            integral = np.trapezoid(2.0 * np.pi * value * np.abs(np.sin(theta)), theta)
            assert_allclose(integral, whole, rtol=1e-3)  # the polar curve runs over both halves


def test_the_legend_gives_the_mean_cosine_of_cornette_shanks(planet: Planet) -> None:
    # 3g(4 + g²)/(5(2 + g²)) = 0.8436 at g = 0.8
    curves = phase_functions(planet).axes[1].get_lines()
    assert "aerosol, g = 0.844" in [str(one.get_label()) for one in curves]


def test_a_planet_that_only_absorbs_has_no_phase_functions(planet: Planet) -> None:
    only = Constituent(name="soot", profile=Exponential(scale_height=1e3), absorption=1e-5)
    with pytest.raises(ParameterError, match="a planet with a scattering constituent"):
        phase_functions(replace(planet, constituents=(only,)))


def test_optical_depth_of_the_air_is_its_column_times_its_coefficient(planet: Planet) -> None:
    # AP2's coefficients; column 7999.9702 m; all together the golden zenith transmittance
    axes = optical_depth(planet).axes[0]
    nm, depth = line(axes, "air")
    assert_allclose(np.interp(550.0, nm, depth), 13.558e-6 * 7999.9702, rtol=1e-4)
    nm, depth = line(axes, "all")
    at = np.interp([680.0, 550.0, 440.0], nm, depth)
    assert_allclose(np.exp(-at), GOLDEN[0.0], rtol=2e-4)  # linear between points 0.5 nm apart


def test_the_map_holds_the_golden_transmittances(planet: Planet) -> None:
    # 0° and 90° are on the map's grid exactly; the others are asked of its function
    for zenith, rgb in GOLDEN.items():
        medium = Medium.from_planet(planet, (680.0, 550.0, 440.0))
        expected = np.mean(rgb)
        # half the last printed digit
        assert_allclose(mean_transmittance(medium, 0.0, zenith), expected, rtol=0, atol=5e-7)
    above = transmittance_map(planet).axes[0].collections[0]
    assert_allclose(above.get_array()[0, 0], np.mean(GOLDEN[0.0]), rtol=0, atol=5e-7)  # type: ignore[index]
    assert_allclose(above.get_array()[0, -1], np.mean(GOLDEN[90.0]), rtol=0, atol=5e-7)  # type: ignore[index]


def test_looking_down_from_the_top_is_looking_up_from_the_ground(planet: Planet) -> None:
    # reciprocity of the vertical ray
    below = transmittance_map(planet).axes[0].get_children()
    meshes = [one for one in below if type(one).__name__ == "QuadMesh"]
    assert len(meshes) == 2
    assert_allclose(meshes[1].get_array()[-1, -1], np.mean(GOLDEN[0.0]), rtol=0, atol=5e-7)


def test_the_black_line_is_the_horizon(planet: Planet) -> None:
    # golden cos φ_H at 0, 1, 10, 30, 100 km, printed to six decimals
    medium = Medium.from_planet(planet, [550.0])
    cosines = np.cos(np.radians(horizon_zenith(medium, [0.0, 1e3, 1e4, 3e4, 1e5])))
    golden = [0.0, -0.017731, -0.056011, -0.096787, -0.175272]
    assert_allclose(cosines, golden, rtol=0, atol=5e-7)
    drawn = transmittance_map(planet).axes[0].get_lines()[-1]
    assert_allclose(drawn.get_xdata()[[0, -1]], np.degrees(np.arccos([0.0, -0.175272])), atol=5e-5)  # type: ignore[index]


def test_the_surface_has_its_valley_along_the_horizon(planet: Planet) -> None:
    # AP2, section 1.8.2; of all directions at one altitude the horizon's has the longest way
    axes = transmittance_surface(planet).axes[0]
    (drawn,) = axes.get_lines()
    zenith, altitude, value = (np.asarray(one, float) for one in drawn.get_data_3d())  # type: ignore[attr-defined]
    medium = Medium.from_planet(planet, planet.wavelengths)
    for k in (0, 20, 40, 80):
        around = zenith[k] + np.array([-3.0, -1.0, 1.0, 3.0]) * (1.0 if k else -1.0)
        beside = mean_transmittance(medium, 1e3 * altitude[k], around[around < zenith[k] + 4.0])
        if k == 0:
            beside = beside[1:2]  # on the ground, below the horizon, there is no way at all
        assert (beside > value[k] - 0.005).all()
    assert len(axes.collections) == 2


def test_mapping_regions_have_the_golden_weights_and_borders(planet: Planet) -> None:
    # physics.md, section 11
    heights = [0.0, 1e3, 1e4, 3e4, 1e5]
    found = [regions(planet, height) for height in heights]
    assert_allclose([one.lower for one in found], [0, 0.0625, 0.198, 0.342, 0.625], atol=5e-4)
    assert_allclose([one.surface for one in found], [0.125, 0.1375, 0.165, 0.193, 0.25], atol=5e-4)
    assert_allclose(
        [one.horizon for one in found], [0.0, -0.017731, -0.056011, -0.096787, -0.175272], atol=5e-7
    )
    for one in found:
        assert_allclose(one.upper + one.lower + one.surface, 1.0, rtol=1e-15)


def test_wedges_and_bars_span_what_the_mapping_says(planet: Planet) -> None:
    # at the top: U to 90°, L to the horizon at arccos(-0.175272), S to 180°; w = 4/32, 20/32, 8/32
    figure = mapping_regions(planet)
    wedges = [axes for axes in figure.axes if axes.name == "polar"]
    bars = [axes for axes in figure.axes if "view coordinate" in axes.get_xlabel()]
    borders = [[np.degrees(one.get_x()) for one in axes.patches] for axes in wedges]  # type: ignore[attr-defined]
    widths = [[np.degrees(one.get_width()) for one in axes.patches] for axes in wedges]  # type: ignore[attr-defined]
    horizon = math.degrees(math.acos(-0.175272))
    assert_allclose(borders, [[0, 90, 90], [0, 90, horizon]], atol=1e-4)
    assert_allclose(np.sum(widths, axis=1), 180.0, rtol=1e-12)
    shares = [[one.get_width() for one in axes.patches] for axes in bars]  # type: ignore[attr-defined]
    assert_allclose(shares, [[4 / 32, 0, 28 / 32], [8 / 32, 20 / 32, 4 / 32]], rtol=1e-12)
    lefts = [[one.get_x() for one in axes.patches] for axes in bars]  # type: ignore[attr-defined]
    assert_allclose(lefts, [[0, 4 / 32, 4 / 32], [0, 8 / 32, 28 / 32]], rtol=1e-12)
    # of 33 texels at the top 8 lie below the horizon, which has v = 8/32 and belongs to the air
    drawn = [np.degrees(one.get_xdata()[0]) for one in wedges[1].get_lines()]  # type: ignore[index]
    assert np.sum(np.array(drawn[:TEXELS]) > horizon + 1e-3) == 8


def test_mapping_regions_of_an_altitude_outside_the_air_are_refused(planet: Planet) -> None:
    with pytest.raises(ParameterError, match=r"altitude is 200000.0; allowed: 0 to 100000 m"):
        mapping_regions(planet, 2e5)
