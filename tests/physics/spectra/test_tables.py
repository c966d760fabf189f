"""Tables against their sources and the door against bad wavelengths."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.errors import ParameterError
from airlight.physics.spectra.color_matching import cie_1931
from airlight.physics.spectra.sun import SPECTRA, solar_irradiance
from airlight.physics.spectra.tables import Spectrum, read_spectrum, spectrum_names


def test_every_table_names_its_quantity_unit_source_and_licence():
    # The header is the only place where a table's origin stands.
    coarse = {"earth-albedo": 10.0, "methane-bands": 10.0}
    for name in spectrum_names():
        table = read_spectrum(name)
        assert table.unit
        assert len(table.source) > 20
        assert table.licence
        steps = np.diff(table.wavelengths[table.wavelengths <= 1000.0])
        if not name.endswith("-transmission"):  # those: only where the gas absorbs
            assert_array_equal(steps, {**coarse, "sao2010": 0.5}.get(name, 1.0))
        assert np.all(np.isfinite(table.values))
        assert np.all(table.values >= 0.0)


def test_earth_albedo_is_the_mean_of_the_map():
    # Second path: the spectrum, seen in the sun's light, has the mean colour of the packaged map,
    # and what its water mirrors without colouring it.
    from airlight.image.spectral import sun_color
    from airlight.physics.optics.water import mean_specular
    from airlight.scene.surface_map import surface_map

    eye = np.arange(360.0, 831.0)
    reflected = sun_color(solar_irradiance(eye) * read_spectrum("earth-albedo").at(eye))
    earth = surface_map("earth")
    wanted = earth.mean_rgb + earth.mean_water * mean_specular(5.0)
    assert_allclose(reflected / sun_color(), wanted, rtol=2e-3)


def test_solar_spectrum_is_astm_g173_as_pvlib_ships_it():
    # The second copy is the one installed with pvlib; the table keeps every printed digit.
    spectrum = pytest.importorskip("pvlib.spectrum").get_reference_spectra()
    table = read_spectrum("astm-g173")
    assert_array_equal(table.values, spectrum["extraterrestrial"].loc[table.wavelengths])


@pytest.mark.filterwarnings("ignore::Warning")  # of colour-science, about its own extras
def test_colour_matching_functions_are_those_of_colour_science():
    with np.printoptions():  # colour-science changes how NumPy prints, for everyone
        colour = pytest.importorskip("colour")
    functions = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    assert_array_equal(cie_1931().wavelengths, functions.wavelengths)
    assert_allclose(cie_1931().values, functions.values, rtol=1e-12)


def test_colour_matching_functions_have_the_printed_values():
    # CIE 15, table T.4, at 450, 555 and 600 nm, all printed digits.
    printed = [[0.33620, 0.038, 1.77211], [0.5120501, 1.0, 0.00575], [1.0622, 0.631, 0.0008]]
    assert_allclose(cie_1931().at([450.0, 555.0, 600.0]), printed, rtol=0, atol=5e-8)


def test_the_three_functions_have_equal_areas():
    # Equal energy is white by definition; the 1 nm table, interpolated by the CIE from 5 nm, keeps
    # that to 3.4e-4.
    areas = cie_1931().values.sum(axis=0)
    assert_allclose(areas / areas[1], 1.0, rtol=4e-4)


def test_sun_at_the_printed_wavelengths():
    # ASTM G173-03, column extraterrestrial, at 300, 500, 800 nm, and half-way in between rows.
    assert_allclose(solar_irradiance([300.0, 500.0, 800.0]), [0.45794, 1.916, 1.1248], rtol=1e-12)
    assert_allclose(
        solar_irradiance(500.5), 0.5 * (solar_irradiance(500.0) + solar_irradiance(501.0))
    )


def test_sun_adds_up_to_the_solar_constant_of_its_standard():
    # ASTM E-490 and G173 (Gueymard 2004): 1366.1 W/m² over all wavelengths, of which G173's own,
    # 280 to 4000 nm, are 1348 (98.7 %)
    table = read_spectrum("astm-g173")
    assert_allclose(np.trapezoid(table.values, table.wavelengths), 1348.0, atol=0.5)


def test_the_two_spectra_of_the_sun_agree_where_lines_are_averaged():
    # Both are measured, to 2 or 3 %: Chance & Kurucz (2010), ASTM G173-03 (Gueymard 2004).
    for low in range(300, 1000, 50):
        nm = np.arange(low, low + 50.1, 0.25)
        both = (np.trapezoid(solar_irradiance(nm, one), nm) for one in SPECTRA)
        assert_allclose(next(both), next(both), rtol=0.03)


def test_half_nanometres_resolve_the_lines_of_calcium():
    # Fraunhofer's K and H, 393.48 and 396.96 nm in vacuum (NIST): narrower than G173's rows show
    at = solar_irradiance([391.5, 393.5, 395.0, 397.0], "sao2010")
    assert (at[1::2] < 0.5 * at[::2]).all()
    assert (at[1::2] < solar_irradiance([393.5, 397.0])).all()


def test_end_values_stand_for_ten_nanometres_and_no_further():
    assert_array_equal(solar_irradiance(4010.0), solar_irradiance(4000.0))
    assert_array_equal(cie_1931().at(350.0), cie_1931().values[0])
    for beyond in (269.9, 4010.1, np.nan, np.inf, -550.0):
        with pytest.raises(ParameterError, match="270 to 4010 nm"):
            solar_irradiance([550.0, beyond])


def test_the_error_names_the_field_that_the_caller_gives():
    with pytest.raises(ParameterError, match=r"constituents\[2\]\.wavelengths is 100\.0"):
        read_spectrum("astm-g173").at(100.0, field="constituents[2].wavelengths")


def test_shapes_follow_the_wavelengths():
    assert solar_irradiance(550.0).shape == ()
    assert solar_irradiance(np.full((2, 5), 550.0)).shape == (2, 5)
    assert cie_1931().at(np.full((2, 5), 550.0)).shape == (2, 5, 3)


def test_an_unknown_table_is_refused_with_the_known_names():
    known = (
        "astm-g173, carbon-dioxide-transmission, cie-1931, earth-albedo, methane-bands, "
        "methane-transmission, oxygen-bands, oxygen-pairs, oxygen-transmission, ozone-293k, "
        "ozone-temperature, sao2010, water-vapour-bands, water-vapour-transmission$"
    )
    with pytest.raises(ParameterError, match=known):
        read_spectrum("../../planets/earth")


def test_shipped_tables_cannot_be_written_to():
    with pytest.raises(ValueError, match="read-only"):
        read_spectrum("astm-g173").values[0] = 1.0


def test_a_user_s_own_spectrum_interpolates_linearly():
    ramp = Spectrum("ramp", np.array([400.0, 500.0]), np.array([0.0, 1.0]), "1", "a line", ("r",))
    assert_allclose(ramp.at([395.0, 425.0, 505.0]), [0.0, 0.25, 1.0])
