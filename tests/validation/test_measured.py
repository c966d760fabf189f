"""Measured skies: the score and its floor, the inputs of both rows, the fits, the suite."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.errors import Cancelled, FileError
from airlight.physics.spectra.sun import solar_irradiance
from airlight.planets.medium import Medium
from airlight.solver.solve import solve
from airlight.studies.fit.fit_sky import smooth
from airlight.studies.fit.scans import Scans
from airlight.validation.kider import planets as kider_planets
from airlight.validation.kider import scans as kider_scans
from airlight.validation.kider.fits import AerosolModel, fit_pointing
from airlight.validation.kider.planets import (
    AERONET_AEROSOL,
    BEST,
    PUBLISHED_INPUTS,
    AngstromLaw,
    band_irradiance,
    penndorf_scattering,
    planet,
    read_aeronet_phase,
    steps,
)
from airlight.validation.kider.scans import (
    best_factor,
    read_scans,
    rmse_per_scan,
    symmetric_part,
    total_rmse,
)
from airlight.validation.measured import PUBLISHED, compute, suite_of
from airlight.validation.measured_days import measured_days
from airlight.validation.suite import SuiteRun


def made_up(sky: Callable[[np.ndarray, np.ndarray], np.ndarray]) -> Scans:
    """Two scans of three rings and the zenith; the axis of symmetry lies between directions."""
    zenith, azimuth = [0.0], [3.0]
    for height, count in ((20.0, 8), (40.0, 16), (60.0, 24)):
        zenith += [height] * count
        azimuth += (3.0 + 360.0 / count * np.arange(count)).tolist()
    view, around = np.tile(zenith, (2, 1)), np.tile(azimuth, (2, 1))
    return Scans(
        time=("10:00", "11:00"),
        sun_zenith=np.array([40.0, 30.0]),
        view_zenith=view,
        azimuth=around,
        wavelengths=np.array([450.0, 650.0]),
        radiance=sky(view, around),
        solar_irradiance=np.ones(2),
        ground_albedo=np.zeros(2),
    )


def cosine(view: np.ndarray, around: np.ndarray) -> np.ndarray:
    bright = 2.0 + np.sin(np.radians(view)) * np.cos(np.radians(around))
    return bright[..., None] * np.array([1.0, 0.5])


@pytest.fixture(scope="module")
def scans(reference_data: Path) -> Scans:
    return read_scans(reference_data)


def test_score_of_a_constant_error_is_that_error() -> None:
    # By definition: every square is the same. Scans of 3 and 4 mW give sqrt((9 + 16) / 2).
    known = made_up(cosine).radiance
    wrong = known + np.array([0.003, -0.004])[:, None, None]
    assert_allclose(rmse_per_scan(wrong, known), [3.0, 4.0], rtol=1e-12)
    assert_allclose(total_rmse(wrong, known), np.sqrt(12.5), rtol=1e-12)


def test_best_factor_undoes_a_wrong_scale() -> None:
    # By definition: a model that is the measurement but for a factor.
    known = made_up(cosine).radiance
    assert_allclose(best_factor(0.8 * known, known), 1.25, rtol=1e-12)


def test_angle_from_the_sun_is_that_of_the_sphere() -> None:
    # In the sun's vertical the angle is the difference of zenith angles, behind the zenith the sum.
    flat = made_up(cosine)
    line = replace(
        flat,
        view_zenith=np.tile([10.0, 70.0, 25.0], (2, 1)),
        azimuth=np.tile([0.0, 0.0, 180.0], (2, 1)),
    )
    assert_allclose(line.angle_from_sun, [[30.0, 30.0, 65.0], [20.0, 40.0, 55.0]], atol=1e-9)


def test_symmetric_sky_has_no_floor_and_antisymmetric_part_is_all_of_it() -> None:
    # cos(azimuth) is its own mirror image, sin(azimuth) the negative of it. Catmull and Rom's
    # cubic errs by 3e-3 of an eighth of a turn's cosine at most, less on the finer rings.
    even = made_up(cosine)
    assert_allclose(symmetric_part(even), even.radiance, rtol=4e-3)
    odd = made_up(
        lambda view, around: (
            cosine(view, around)
            + 0.3 * (np.sin(np.radians(view)) * np.sin(np.radians(around)))[..., None]
        )
    )
    assert_allclose(symmetric_part(odd), even.radiance, atol=4e-3 * 3.0)


#: Asymmetries of two lobes and the weight of the first.
LOBES = (0.87, 0.5, 0.3)


def day(load: AngstromLaw, seed: int = 0, count: int = 6, **inputs: Any) -> Scans:
    """Made-up day of some scans by the planet of a load, with 1 % of noise."""
    sun = np.linspace(35.0, 55.0, count)
    view, azimuth = np.meshgrid([12.0, 40.0, 65.0, 77.0], [20.0, 100.0, -150.0])
    nm = np.array([400.0, 480.0, 560.0, 640.0, 700.0])
    shape = (sun.size, view.size)
    empty = Scans(
        time=tuple(f"1{k}:00" for k in range(count)), sun_zenith=sun,
        view_zenith=np.broadcast_to(view.ravel(), shape),
        azimuth=np.broadcast_to(azimuth.ravel(), shape), wavelengths=nm,
        radiance=np.ones((*shape, nm.size)), solar_irradiance=np.full(nm.size, 1.8),
        ground_albedo=np.full(nm.size, 0.1), date="2013-05-27",
    )  # fmt: skip
    air = planet(replace(BEST, load=load, aeronet_phase=False, **inputs), empty, Path())
    clean = empty.seen(solve(air, nm, smooth("preview"), cache=False))
    noise = np.random.default_rng(seed).standard_normal(clean.shape)
    return replace(empty, radiance=clean * (1.0 + 0.01 * noise))


@pytest.mark.slow
def test_load_is_found_again_and_predicts_the_scan_left_out() -> None:
    # The day was made with a load; the fit starts from another, and its error bars say how near it
    # comes. A scan that is left out is predicted to the noise, 1 % of a mean square.
    truth = AngstromLaw(beta=0.05, alpha=1.4)
    scans = day(truth)
    model = AerosolModel(
        SuiteRun(quality="preview"),
        lambda inputs: planet(inputs, scans, Path()),
        scans,
        replace(BEST, aeronet_phase=False),
        with_scale=True,
    )
    found = model.fitted()
    errors = found.fitted.errors.standard
    depth = float(truth.optical_depth(550.0))
    off = np.abs(found.fitted.values - [depth, truth.alpha, 1.0])
    assert (off < 4.0 * errors).all()
    assert_allclose(float(found.load.optical_depth(550.0)), found.fitted.values[0], rtol=1e-9)
    noise = 0.01 * np.sqrt(np.square(scans.radiance).mean())
    left_out = model.left_out(found)
    assert_allclose(np.sqrt(np.square(left_out - scans.radiance).mean()), noise, rtol=0.15)
    # Predicted by other fits than the one to all scans.
    assert (np.abs(left_out - found.predicted).max(axis=(1, 2)) > 0.0).all()


@pytest.mark.slow
def test_one_newton_step_predicts_the_scan_left_out_as_a_fit_does() -> None:
    # The second method is a fit to the other scans: the two differ by 1 % of what they change.
    scans = day(AngstromLaw(beta=0.05, alpha=1.4))
    start = replace(BEST, aeronet_phase=False)
    model = AerosolModel(
        SuiteRun(quality="preview"), lambda inputs: planet(inputs, scans, Path()), scans, start
    )
    found = model.fitted()
    assert found.fitted.left_out is not None
    linear = found.fitted.left_out.reshape(scans.radiance.shape)
    change = linear - found.predicted
    assert np.abs(linear - model.left_out(found)).max() < 0.05 * np.abs(change).max()


@pytest.mark.validation
def test_every_day_of_a_folder_has_its_rows_and_pictures(tmp_path: Path) -> None:
    # Two made-up days under the names of measured ones: rows whose parameters stand before their
    # scores, thresholds by the row that was left out. From five scans on the lobes are found too.
    pytest.importorskip("matplotlib")
    for k, name in enumerate(("kider2013-05-27.npz", "kider2013-06-01.npz")):
        scans = day(AERONET_AEROSOL, k, 5 - 3 * k, lobes=LOBES if k == 0 else None)
        np.savez(
            tmp_path / name, time=np.array([f"{name[5:15]} {one}" for one in scans.time]),
            sun_zenith_deg=scans.sun_zenith, view_zenith_deg=scans.view_zenith,
            relative_azimuth_deg=scans.azimuth, wavelength_nm=scans.wavelengths,
            radiance=scans.radiance, solar_irradiance=scans.solar_irradiance,
            ground_albedo=scans.ground_albedo,
        )  # fmt: skip
    phase = "scattering_angle_deg,p_442nm,p_674nm\n0,1,1\n90,1,1\n180,1,1\n"
    (tmp_path / kider_planets.FILE).write_text(phase)
    suite = measured_days(SuiteRun(data=tmp_path, quality="preview"))
    assert [threshold.name[:10] for threshold in suite.thresholds] == ["2013-05-27", "2013-06-01"]
    titles = [part.title for part in suite.parts]  # type: ignore[union-attr]
    for date in ("2013-05-27", "2013-06-01"):
        mine = [title for title in titles if title.startswith(date)]
        assert len(mine) == 5
        assert "parameters of each row" in mine[0]
        assert "scores" in mine[1]
    first = [part for part in suite.parts if "2013-05-27: parameters" in part.title]  # type: ignore[union-attr]
    assert first[0].rows[6][4].startswith("lobes of g 0.8")  # type: ignore[union-attr]
    second = [part for part in suite.parts if "2013-06-01: parameters" in part.title]  # type: ignore[union-attr]
    assert second[0].rows[1][4] == "Cornette-Shanks, g 0.7"  # type: ignore[union-attr]


def test_sun_is_farthest_in_july() -> None:
    # The Astronomical Almanac 2013: perihelion 2 January, 0.98329 au; aphelion 5 July, 1.01671 au.
    au = kider_planets.ASTRONOMICAL_UNIT
    distances = [kider_planets.sun_distance(date) / au for date in ("2013-01-02", "2013-07-05")]
    assert_allclose(distances, [0.98329, 1.01671], atol=1e-4)


def test_pointing_is_found_again() -> None:
    # A scan taken 2° off in azimuth sees the sky 2° off: the turn about the vertical is known.
    truth = np.array([[0.0, 0.0, 2.0], [0.0, 0.0, -1.0]])

    def sky(view: np.ndarray, around: np.ndarray) -> np.ndarray:
        return (
            np.exp(3.0 * cosine(view, around)) * (1.0 + 0.2 * np.cos(np.radians(view)))[..., None]
        )

    taken = made_up(lambda view, around: sky(view, around + truth[:, 2:]))
    turns, got = fit_pointing(sky, taken)
    # Four steps leave less than a thousandth of a degree.
    assert_allclose(turns, truth, atol=1e-3)
    assert_allclose(got, taken.radiance, rtol=1e-4)


def test_scattering_is_penndorfs() -> None:
    # Penndorf (1957), Table III, 0 °C, times 273.16/288.16: [1e-6 m⁻¹]. Printed to four digits;
    # his form of the cross-section, the limit n → 1 of ours, is 4e-4 larger.
    nm = [360.0, 400.0, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0]
    table = np.array([70.45, 45.40, 27.89, 18.10, 12.26, 8.604, 6.217, 4.605])
    got = 1e6 * penndorf_scattering(nm).coefficients(nm) * 288.16 / 273.16
    assert_allclose(got, table, rtol=1e-3)


def test_bands_spread_the_suns_light_and_lose_none_of_it() -> None:
    # A law: bands of unit area at every nanometre add up to the spectrum, but for the ends, which
    # are a hundredth of it; the light thins with the square of the distance.
    nm = np.arange(360.0, 721.0)
    assert_allclose(band_irradiance(nm).sum(), solar_irradiance(nm).sum() / 1.0133**2, rtol=1e-3)


def test_band_of_a_line_is_narrower_than_means_over_twelve_nanometres() -> None:
    # At the Ca II lines near 393.4 and 396.8 nm the sun is dark: 6 nm bands fill them in, but not
    # as far as 11.75 nm means do.
    line = float(band_irradiance([393.5])[0]) * 1.0133**2
    assert solar_irradiance(393.5) < line < solar_irradiance(387.5 + np.arange(12.0)).mean()


def test_site_air_weighs_as_its_pressure_says() -> None:
    # U.S. Standard Atmosphere 1976, Table I: 989.45 hPa at 200 m, 977.73 at 300 m; between them
    # the logarithm is linear to 1e-6.
    expected = 989.45e2 ** (1.0 - 0.7) * 977.73e2**0.7
    assert_allclose(kider_planets.SITE, expected, rtol=1e-4)


def test_ladder_goes_from_everybodys_inputs_to_the_best() -> None:
    # Otherwise the league table and the ladder would tell of different planets.
    ladder = steps()
    assert ladder[0][1] == PUBLISHED_INPUTS
    assert ladder[-1][1] == BEST


def test_published_inputs_have_their_optical_depths(scans: Scans, reference_data: Path) -> None:
    # Bruneton (2017): τ = 0.04 λ^-0.8 and albedo 0.8; the shells end at 7.5 and 50 scale heights,
    # which cuts off 6e-4 of the gas.
    medium = Medium.from_planet(planet(PUBLISHED_INPUTS, scans, reference_data), scans.wavelengths)
    assert medium.names == ("air", "aerosol")
    depth = 0.04 * (scans.wavelengths / 1e3) ** -0.8
    assert_allclose(medium.vertical_optical_depth[1], depth, rtol=1e-9)
    assert_allclose(medium.single_scattering_albedo[1], 0.8, rtol=1e-12)
    coefficients = penndorf_scattering(scans.wavelengths).coefficients(scans.wavelengths)
    assert_allclose(medium.vertical_optical_depth[0], 8000.0 * coefficients, rtol=1e-3)


def test_aeronet_phase_is_the_files_where_it_was_measured(reference_data: Path) -> None:
    # The csv is normalised to 4π, within the per cent that its angles leave open.
    phase = read_aeronet_phase(reference_data, [442.0, 674.0])
    lines = (reference_data / kider_planets.FILE).read_text().splitlines()
    row = next(line for line in lines if line.startswith("44.16,")).split(",")
    got = phase.values(np.cos(np.radians([44.16])), [442.0, 674.0])[0]
    assert_allclose(4.0 * np.pi * got, [float(row[1]), float(row[2])], rtol=0.01)


def test_floor_and_signal_are_the_published_ones(scans: Scans) -> None:
    # The data's own description: floor 3.4, signal 68 to 78, both rounded to the last digit.
    assert_allclose(total_rmse(symmetric_part(scans), scans.radiance), 3.4, atol=0.05)
    signal = rmse_per_scan(np.zeros_like(scans.radiance), scans.radiance)
    assert_allclose([signal.min(), signal.max()], [68.0, 78.0], atol=0.5)


def test_damaged_scans_are_refused_in_one_line(tmp_path: Path) -> None:
    # Each fault is named with its file: not there, no archive, an array missing, a shape wrong.
    with pytest.raises(FileError, match=r"kider2013-05-27\.npz: cannot be read"):
        read_scans(tmp_path)
    file = tmp_path / kider_scans.FILE
    file.write_bytes(b"PK\x03\x04 broken")
    with pytest.raises(FileError, match="cannot be read"):
        read_scans(tmp_path)
    whole = {
        "time": np.array(["2013-05-27 09.30.00"]),
        "sun_zenith_deg": np.array([40.0]),
        "view_zenith_deg": np.zeros((1, 3)),
        "relative_azimuth_deg": np.zeros((1, 3)),
        "wavelength_nm": np.array([400.0, 500.0]),
        "radiance": np.ones((1, 3, 2)),
        "solar_irradiance": np.ones(2),
        "ground_albedo": np.zeros(2),
    }
    np.savez(file, **whole)
    assert read_scans(tmp_path).time == ("09:30",)
    for name, fault, said in (
        ("radiance", None, "has no array"),
        ("view_zenith_deg", np.zeros((1, 4)), "view_zenith is"),
        ("radiance", np.full((1, 3, 2), np.nan), "radiance contains"),
    ):
        arrays = {key: value for key, value in whole.items() if key != name}
        np.savez(file, **arrays, **({} if fault is None else {name: fault}))
        with pytest.raises(FileError, match=said) as caught:
            read_scans(tmp_path)
        assert len(str(caught.value).splitlines()) == 1


def test_damaged_phase_functions_are_refused_in_one_line(tmp_path: Path) -> None:
    # Not there; a word for a number; a phase function of isotropic 1.2, not 1, over 4π.
    with pytest.raises(FileError, match="cannot be read"):
        read_aeronet_phase(tmp_path, [500.0])
    file = tmp_path / kider_planets.FILE
    for body, said in (
        ("0,1,x\n180,1,1\n", "not a table of numbers"),
        ("0,1\n180,1\n", "rows that do not match"),
        ("0,-1,1\n180,1,1\n", "not above 0"),
        ("0,1.2,1.2\n180,1.2,1.2\n", "integrates to 15.080"),
    ):
        file.write_text("# comment\nscattering_angle_deg,p_442nm,p_674nm\n" + body)
        with pytest.raises(FileError, match=said):
            read_aeronet_phase(tmp_path, [500.0])
    file.write_text("scattering_angle_deg,p_442nm,p_674nm\n0,1,1\n90,1,1\n180,1,1\n")
    assert_allclose(read_aeronet_phase(tmp_path, [500.0]).values([0.3], [500.0]), 1 / (4 * np.pi))


def test_asking_to_stop_stops(reference_data: Path) -> None:
    # Before the first solution: nothing is computed after a cancellation.
    with pytest.raises(Cancelled):
        compute(SuiteRun(data=reference_data, cancel=lambda: True))


@pytest.mark.validation
@pytest.mark.filterwarnings("ignore:.*absorption bands of O2 are omitted")  # the report says so
def test_measured_skies_are_met_as_the_league_table_says(
    reference_data: Path, tell: Callable[[str], None]
) -> None:
    # Published scores (Bruneton 2017) are the authority for the first row: with his inputs an
    # exact solution stands between his table (11.3 on two scans more) and Haber's (14.7); below
    # his it cannot be expected, for what limits there are the inputs. 8 is the aim for the best
    # physics, fitted or not; no model symmetric about the sun's vertical can be under the floor.
    pytest.importorskip("matplotlib")
    seen: list[tuple[int, int]] = []
    rows = compute(
        SuiteRun(
            data=reference_data,
            quality="preview",
            progress=lambda done, of, _: seen.append((done, of)),
        )
    )
    scores = {
        "same inputs": rows.score(rows.same),
        "AERONET's load": rows.score(rows.known),
        "fitted load": rows.score(rows.fitted),
    }
    for name, score in scores.items():
        tell(f"Kider 2013-05-27, {name}: {score:.2f} mW m⁻² sr⁻¹ nm⁻¹")
    assert rows.floor < scores["same inputs"] < PUBLISHED["Haber 2005"]
    assert rows.floor < scores["fitted load"] <= scores["AERONET's load"] < 8.0
    assert rows.score(rows.turned) <= scores["AERONET's load"]
    # Progress grows by one from 0 and ends below the total.
    assert_array_equal([done for done, _ in seen], np.arange(len(seen)))
    assert {of for _, of in seen} == {len(seen)}

    suite = suite_of(rows)
    assert suite.passed
    league = next(part for part in suite.parts if "League" in part.title)  # type: ignore[union-attr]
    numbers = [float(row[1]) for row in league.rows]  # type: ignore[union-attr]
    assert numbers == sorted(numbers, reverse=True)
    assert list(league.marks).count("ours") == 3  # type: ignore[union-attr]
    pictures = [part.png for part in suite.parts if hasattr(part, "png")]
    assert [png[:8] for png in pictures] == [b"\x89PNG\r\n\x1a\n"] * 2
    # Small enough to be committed.
    assert max(map(len, pictures)) < 100_000
