"""Aerosols, grounds and stars of tables: the same planet from files and objects; normalisation."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from numpy.testing import assert_allclose

from airlight import AirlightError, AirlightWarning, import_table, load_planet
from airlight.physics.optics.phase_table import moments
from airlight.planets.constituent import Constituent
from airlight.planets.matter.phases.tabulated import TabulatedPhase

TABLES = Path(__file__).parents[2] / "examples" / "tables"
NM = np.array([440.0, 550.0, 680.0])
ANGLES = np.arange(0.0, 181.0)
HAZE = {"wavelength [nm]": NM, "aod": [0.3, 0.2, 0.1], "ssa": [0.9, 0.92, 0.94]}


def lobe(g: float) -> np.ndarray:
    """Henyey-Greenstein phase function. [sr⁻¹]"""
    mu = np.cos(np.radians(ANGLES))
    return np.asarray((1 - g * g) / (4 * np.pi * (1 + g * g - 2 * g * mu) ** 1.5))


def aerosol(*tables: Any, **options: Any) -> Constituent:
    made = import_table("aerosol", *tables, planet="earth-bruneton", **options).planet
    return next(one for one in made.constituents if one.name == options.get("name", "aerosol"))


def coefficients(one: Constituent, nm: Any = NM) -> tuple[np.ndarray, np.ndarray]:
    """Scattering and absorption where the profile is 1. [m⁻¹]"""
    column = one.profile.column(60e3)
    return (
        np.asarray(one.scattering_coefficients(nm, column)),
        np.asarray(one.absorption_coefficients(nm, column)),
    )


def phase_of(one: Constituent) -> TabulatedPhase:
    assert isinstance(one.phase_function, TabulatedPhase)
    return one.phase_function


def test_a_file_a_dataset_and_a_mapping_with_quantities_are_one_aerosol() -> None:
    # e ϖ and e (1 − ϖ) of the rows of the file.
    nm, extinction, albedo, g = np.loadtxt(TABLES / "dust.csv", delimiter=",", skiprows=2).T
    rows = ("wavelength",)
    data = xarray.Dataset(
        {
            "extinction": (rows, 1e-3 * extinction, {"units": "m-1"}),
            "ssa": (rows, albedo),
            "g": (rows, g),
        },
        {"wavelength": (rows, 1e-3 * nm, {"units": "um"})},
    )
    units = {"wavelength": "nm", "extinction": "1/km"}
    plain = {"wavelength": nm, "extinction": extinction, "ssa": albedo, "g": g}
    for table, given in ((TABLES / "dust.csv", None), (data, None), (plain, units)):
        scattering, absorption = coefficients(aerosol(table, units=given), nm)
        assert_allclose(scattering, 1e-3 * extinction * albedo, rtol=2e-6)
        assert_allclose(absorption, 1e-3 * extinction * (1 - albedo), rtol=2e-5)


def test_extinction_is_scaled_to_an_optical_depth_at_550_nm() -> None:
    made = import_table("aerosol", TABLES / "dust.csv", optical_depth=0.3).planet
    one = made.constituents[1]
    column = one.profile.column(made.thickness)
    assert_allclose(np.sum(coefficients(one, [550.0])) * column, 0.3, rtol=1e-3)


def test_phase_matrix_of_netcdf_keeps_its_polarisation() -> None:
    # P12/P11 = -(1 - μ²)/(1 + μ²)/2 by construction: -1/2 at 90°; integral 4π in the file.
    one = phase_of(aerosol(TABLES / "phase-matrix.nc", name="haze"))
    row = np.array(one.f12)[:, one.angles.index(90.0)]
    assert_allclose(row, -0.5, rtol=1e-4)
    assert_allclose(moments(np.array(one.angles), np.array(one.rows), 0), 1.0, rtol=1e-5)
    assert_allclose(one.moments(NM, 1)[:, 1], [0.6, 0.58, 0.55], rtol=2e-3)


@pytest.mark.parametrize("form", ["long", "wide", "array", "moments", "pmom"])
def test_all_forms_of_a_phase_function_have_its_mean_cosine(form: str) -> None:
    # Legendre moments of Henyey-Greenstein's function are g^l.
    g = [0.7, 0.65, 0.6]
    rows = np.stack([lobe(one) for one in g])
    tables: list[Any] = [HAZE]
    if form == "long":
        nm, angle = np.meshgrid(NM, ANGLES, indexing="ij")
        long = {"wavelength [nm]": nm.ravel(), "angle [deg]": angle.ravel(), "phase": rows.ravel()}
        tables.append(long)
    elif form == "wide":
        wide = {f"p_{nm:g}nm": row for nm, row in zip(NM, rows, strict=True)}
        tables.append({"angle [deg]": ANGLES} | wide)
    elif form == "array":
        tables = [HAZE | {"angle [deg]": ANGLES, "p11": rows}]
    else:
        degrees = np.arange(60)
        factor = 2 * degrees + 1 if form == "pmom" else 1.0
        series = np.array(g)[:, None] ** degrees * factor
        tables = [HAZE | {form: series}]
    found = phase_of(aerosol(*tables)).moments(NM, 2)
    assert_allclose(found[:, 1], g, rtol=3e-3)
    assert_allclose(found[:, 2], np.square(g), rtol=5e-3)


def test_normalisation_is_warned_of_and_refused() -> None:
    def table(factor: float) -> dict[str, Any]:
        return HAZE | {"angle [deg]": ANGLES, "p11": factor * np.stack([lobe(0.6)] * 3)}

    aerosol(table(4 * np.pi))
    with pytest.warns(AirlightWarning, match="is off 4π by 4"):
        aerosol(table(1.04 * 4 * np.pi))
    with pytest.raises(AirlightError, match=r"integral of the phase function at .*1 or 4π within"):
        aerosol(table(1.2))


def test_aeronet_files_complete_each_other_and_rows_without_a_retrieval_are_left_out() -> None:
    # By formula in the files: 0.3 (550/λ)^1.3 with an albedo of 0.97 - λ/40000, g = 0.74 - λ/10000.
    one = aerosol(TABLES / "aeronet-layout.all", TABLES / "aeronet-layout.pfn")
    nm = np.array([440.0, 675.0, 870.0, 1020.0])
    scattering, absorption = coefficients(one, nm)
    depth = (scattering + absorption) * one.profile.column(60e3)
    assert_allclose(depth, 0.3 * (550 / nm) ** 1.3, rtol=1e-5)
    assert_allclose(scattering / (scattering + absorption), 0.97 - nm / 4e4, rtol=1e-5)
    assert_allclose(phase_of(one).moments(nm, 1)[:, 1], 0.74 - nm / 1e4, rtol=5e-3)


def test_libradtran_mie_layout_takes_a_radius_and_a_depth(tmp_path: Path) -> None:
    # Variables of its mie tool; each wavelength has angles of its own, filled up at the end.
    theta = np.full((2, 2, 4, 181), np.nan)
    phase = np.full((2, 2, 4, 181), np.nan)
    for k, step in enumerate((1, 2)):
        for element, factor in enumerate((1.0, -0.2, 0.8, 0.05)):
            theta[k, :, element, : 180 // step + 1] = ANGLES[::step]
            phase[k, :, element, : 180 // step + 1] = 4 * np.pi * factor * lobe(0.6)[::step]
    axes = ("nlam", "nreff", "nphamat", "nthetamax")
    data = xarray.Dataset(
        {
            "wavelen": (("nlam",), [0.44, 0.55], {"units": "micrometer"}),
            "reff": (("nreff",), [5.0, 10.0], {"units": "micrometer"}),
            "ext": (axes[:2], [[300.0, 150.0], [296.0, 148.0]], {"units": "km^-1/(g/m^3)"}),
            "ssa": (axes[:2], np.ones((2, 2))),
            "theta": (axes, theta, {"units": "degrees"}),
            "phase": (axes, phase),
        }
    )
    data.to_netcdf(tmp_path / "wc.nc", engine="scipy")
    one = aerosol(tmp_path / "wc.nc", name="fog", select={"reff": 9.0}, optical_depth=5.0)
    assert_allclose(coefficients(one, [550.0])[0] * one.profile.column(60e3), 5.0, rtol=1e-3)
    assert_allclose(np.array(phase_of(one).f12), -0.2, rtol=1e-6)
    with pytest.raises(AirlightError, match=r"km\^-1/\(g/m\^3\)"):
        aerosol(tmp_path / "wc.nc", select={"reff": 9.0})


def test_lidar_profile_keeps_the_optical_depth() -> None:
    # The centroid of the rows of the file; the optical depth is that of the preset.
    made = import_table("profile", TABLES / "lidar.csv").planet
    own, other = made.constituents[1], load_planet("earth").constituents[1]
    nm = [550.0]

    def depth(one: Constituent) -> float:
        column = one.profile.column(100e3)
        return float((one.scattering_coefficients(nm, column)[0]) * column)

    assert_allclose(depth(own), depth(other), rtol=1e-6)
    z, extinction = np.loadtxt(TABLES / "lidar.csv", delimiter=",", skiprows=1).T
    share = np.trapezoid(extinction[z <= 2.0], z[z <= 2.0]) / np.trapezoid(extinction, z)
    assert_allclose(own.profile.column(2e3) / own.profile.column(100e3), share, rtol=5e-3)


def test_spectral_library_is_a_ground_without_a_map() -> None:
    # Per cent and descending micrometres: 12 + 25 (1 - e^-λ) by formula in the file.
    made = import_table("albedo", TABLES / "concrete.spectrum.txt").planet
    assert made.ground.map is None
    nm = np.array([440.0, 550.0, 1600.0])
    assert_allclose(made.ground.albedo.at(nm), 0.12 + 0.25 * -np.expm1(-nm / 1e3), atol=2e-3)


def test_usgs_spectrum_has_the_wavelengths_of_the_file_beside_it(tmp_path: Path) -> None:
    # Layout of splib07a: a title, then one number a line; -1.23e34 where there is none.
    folder = tmp_path / "ChapterS"
    folder.mkdir()
    (tmp_path / "splib07a_Wavelengths_XX_3_ch.txt").write_text(
        " splib07a Record=1: Wavelengths\n 0.4\n 0.5\n 0.6\n 0.7\n"
    )
    (folder / "splib07a_Sand.txt").write_text(
        " splib07a Record=2: Sand\n 0.1\n -1.23e34\n 0.3\n 0.35\n"
    )
    made = import_table("albedo", folder / "splib07a_Sand.txt").planet
    assert_allclose(made.ground.albedo.at([400.0, 500.0, 700.0]), [0.1, 0.2, 0.35])


def test_a_long_spectrum_of_a_star_is_saved_beside_its_planet(tmp_path: Path) -> None:
    # A noisy spectrum is not thinned; what is saved loads as the same star.
    nm = np.arange(300.0, 1000.0, 2.0)
    flux = 1.0 + 0.3 * np.random.default_rng(3).random(nm.size)
    rows = {"wavelength [nm]": nm[::-1], "flux [mW/m^2/nm]": 1e3 * flux[::-1]}
    made = import_table("star", rows, angular_radius="0.5 deg")
    files = made.save(tmp_path / "mine.toml")
    assert [one.name for one in files] == ["mine.toml", "mine-star.csv"]
    assert len((tmp_path / "mine.toml").read_text()) < 8000
    star = load_planet(tmp_path / "mine.toml").star
    assert_allclose(star.irradiances(nm), flux, rtol=2e-3)
    assert star.angular_radius_degrees == 0.5


def test_surface_flux_is_seen_at_the_angular_radius() -> None:
    # pi B of a black body at 5772 K over 0.1 to 3000 um through sin^2 of 0.2666 deg: 1361 W/m^2.
    nm = np.geomspace(1.0, 3e6, 3000)
    x = 6.62607015e-34 * 2.99792458e8 / (1.380649e-23 * 5772.0 * 1e-9 * nm)
    with np.errstate(over="ignore"):
        planck = 2.0 * 6.62607015e-34 * 2.99792458e8**2 / (1e-9 * nm) ** 5 / np.expm1(x)
    rows = {"wavelength [nm]": nm, "surface flux [W/m^2/nm]": 1e-9 * np.pi * planck}
    made = import_table("star", rows, planet="earth-bruneton", angular_radius="0.2666 deg")
    inside = nm[(nm >= 200.0) & (nm <= 1e5)]
    total = np.trapezoid(made.planet.star.irradiances(inside), inside)
    assert_allclose(total, 1361.0, rtol=2e-3)
    assert any("rows outside 10 nm to 1 mm left out" in one for one in made.notes)
