"""Fits of synthetic skies: known parameters are found, files are read back, faults are refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Final

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from synthetic_sky import PLANET, clean_sky, noisy

from airlight.errors import Cancelled, ConflictError, ParameterError
from airlight.physics.spectra.sun import solar_irradiance
from airlight.planets import Medium, Planet, load_planet
from airlight.solver import solve
from airlight.solver.moments.delta_m import Optics
from airlight.solver.moments.settings import MomentsSettings, settings_for
from airlight.studies.fit import fit_sky
from airlight.studies.fit.fit_sky import SkyFit, fit_photograph, fit_radiances
from airlight.studies.fit.measurements import Measurements, turned
from airlight.studies.fit.parameter import Prior
from airlight.studies.fit.photograph import Shot, read_photograph
from airlight.studies.fit.report import fitted_file, html, result_lines, warnings_of
from airlight.studies.fit.settings import FitSettings
from airlight.studies.fit.sky_model import smooth, smooth_near

#: Wavelengths [nm] and view zenith angles [deg] of predictions.
NM: Final = np.array([440.0, 550.0, 680.0])
VIEW: Final = np.array([5.0, 35.0, 60.0, 80.0])
#: Truth that differs from the planet by factors.
CHANGES = {"aerosol.amount": 20.0, "ground.albedo": 0.3}


@pytest.fixture(scope="module")
def clean() -> Measurements:
    return clean_sky(CHANGES)


def fitted(data: Measurements, *free: str, **more: object) -> SkyFit:
    known = {} if "ground.albedo" in free else {"ground.albedo": CHANGES["ground.albedo"]}
    given = {"overrides": known, "quality": "preview", "keep": False, **more}
    return fit_radiances(PLANET, data, FitSettings(free=free, **given))  # type: ignore[arg-type]


def true_depth() -> float:
    medium = Medium.from_planet(load_planet(PLANET, CHANGES), [550.0])
    return float(medium.vertical_optical_depth[medium.names.index("aerosol"), 0])


def of_haze(amount: float) -> Planet:
    return load_planet(PLANET, {"aerosol.amount": amount})


def degree_at(amount: float, quality: str) -> int:
    medium = Medium.from_planet(of_haze(amount), NM)
    return Optics.chosen(medium, settings_for(quality)).degree


@pytest.mark.parametrize("quality", ["preview", pytest.param("default", marks=pytest.mark.slow)])
def test_predictions_do_not_jump_where_haze_becomes_thick(
    quality: str, tell: Callable[[str], None]
) -> None:
    # The degree of thick haze is higher, and differences of a fit reach across. Predictions are as
    # smooth there as a hundredth further: the change is 0.4 % of the haze's.
    low, high = 1.0, 50.0
    while high / low > 1.001:
        middle = float(np.sqrt(low * high))
        thick = degree_at(middle, quality) > degree_at(1.0, quality)
        low, high = (low, middle) if thick else (middle, high)

    def change(settings: MomentsSettings) -> float:
        seen = [
            solve(of_haze(low * factor), NM, settings, cache=False).radiance(
                altitude=0.0, sun_zenith=60.0, view_zenith=VIEW, azimuth=70.0
            ).values
            for factor in (0.998, 1.002)
        ]  # fmt: skip
        return float(np.abs(seen[1] / seen[0] - 1.0).max())

    strict = replace(settings_for(quality), tolerance=1e-4)
    jump, steady = change(strict), change(smooth_near(quality, of_haze(low), NM))
    tell(f"{quality}, haze {low:.1f} times as thick: {jump:.1e} by its degree, {steady:.1e} fitted")
    assert steady < 4e-3 < jump


@pytest.mark.slow
@pytest.mark.parametrize("start", [0.001, 1.0])
def test_known_parameters_are_found_from_distant_starts(clean: Measurements, start: float) -> None:
    # Without noise the truth is the least: what remains is the solver's own tolerance between
    # neighbouring solutions.
    found = fitted(
        clean, "aerosol.optical_depth", "ground.albedo",
        starts={"aerosol.optical_depth": start, "ground.albedo": 0.9},
    ).fitted  # fmt: skip
    assert_allclose(found.value("aerosol.optical_depth"), true_depth(), rtol=2e-3)
    assert_allclose(found.value("ground.albedo"), 0.3, rtol=5e-3)


@pytest.mark.slow
def test_scale_and_pointing_are_found_beside_the_air(clean: Measurements) -> None:
    # The instrument reads 7 % too much and points 1.5° and -0.8° beside what it says.
    view, azimuth = turned(clean.view_zenith, clean.azimuth, np.array(0.8), np.array(-1.5))
    off = replace(clean, view_zenith=view, azimuth=azimuth, radiance=1.07 * clean.radiance)
    sky = fitted(
        noisy(off, 4, 0.005), "aerosol.optical_depth", "scale", "pointing.zenith",
        "pointing.azimuth",
    )  # fmt: skip
    found = sky.fitted
    for name, truth in (
        ("aerosol.optical_depth", true_depth()), ("scale", 1.07), ("pointing.zenith", -0.8),
        ("pointing.azimuth", 1.5),
    ):  # fmt: skip
        assert abs(found.value(name) - truth) < 4.0 * found.error(name), name


#: Solar lines narrower than a band: Hβ, Mg b, Na D. [nm]
LINES: Final = (486.0, 517.0, 589.0)


def band_share(nm: float, width: float) -> float:
    """Mean of the tabulated spectrum over a band, over its value in the middle.

    The spectrum is linear between whole nanometres: the trapezoidal rule is exact.
    """
    x = np.arange(nm - 0.5 * width, nm + 0.5 * width + 0.5)
    return float(np.trapezoid(solar_irradiance(x), x) / (width * solar_irradiance(nm)))


@pytest.mark.slow
def test_solar_lines_are_averaged_over_the_instruments_bands() -> None:
    # Air without gases that absorb in lines: radiance in a band is that at its middle times the
    # band's share of sunlight. The lines change it by 4 to 17 %, which single wavelengths take for
    # another aerosol.
    clean, width = clean_sky(CHANGES, (40.0, 60.0, 75.0), LINES), 8.0
    share = np.array([band_share(nm, width) for nm in LINES])
    assert np.abs(share - 1.0).max() > 0.05
    column = np.searchsorted(LINES, clean.wavelength)
    seen = replace(clean, radiance=share[column] * clean.radiance)
    free = ("aerosol.optical_depth", "ground.albedo")
    banded = replace(seen, bandwidth=np.full(column.size, width))
    found = fitted(banded, *free).fitted
    assert_allclose(found.value("aerosol.optical_depth"), true_depth(), rtol=2e-3)
    assert_allclose(found.value("ground.albedo"), 0.3, rtol=5e-3)
    assert abs(fitted(seen, *free).fitted.value("aerosol.optical_depth") / true_depth() - 1) > 0.05


def test_sunlight_is_that_of_the_day_or_of_the_data() -> None:
    # The inverse square of the distance: perihelion and aphelion of 2013, 0.98329 and 1.01671 au
    # (Astronomical Almanac). Given irradiances replace the planet's.
    clean, planet = clean_sky({}, (40.0,)), load_planet(PLANET)
    dates = np.array(["2013-01-02", "2013-07-05"], "datetime64[D]")
    days = replace(clean, date=dates[np.arange(clean.radiance.size) % 2])
    light = fit_sky._light(planet, days)
    assert_allclose(light[:2], [0.98329**-2, 1.01671**-2], rtol=2e-4)
    assert_allclose(fit_sky._light(planet, clean), 1.0, rtol=0)
    given = replace(days, solar_irradiance=np.full(light.size, 1.5))
    assert_allclose(fit_sky._light(planet, given), 1.5, rtol=0)


def test_two_widths_at_one_wavelength_are_refused(clean: Measurements) -> None:
    # One band of the model at each wavelength.
    widths = np.where(np.arange(clean.radiance.size) < 3, 4.0, 5.0)
    with pytest.raises(ParameterError, match=r"bandwidth at 440 nm is '4 and 5 nm'"):
        fitted(replace(clean, bandwidth=widths), "ground.albedo")


@pytest.mark.slow
def test_parameter_at_its_bound_is_warned_of(clean: Measurements) -> None:
    # The truth, 0.3, lies beyond.
    data = noisy(clean, 9)
    sky = fitted(data, "ground.albedo", "aerosol.optical_depth", bounds={"ground.albedo": (0, 0.2)})
    assert warnings_of(sky)[0].startswith("ground.albedo ends at its bound, 0.2: ")


@pytest.mark.slow
def test_two_lobes_of_known_shape_are_found() -> None:
    # Without noise the truth is the least.
    lobes = {"asymmetry_1": 0.92, "asymmetry_2": 0.5, "weight": 0.3}
    haze = {"kind": "double-henyey-greenstein", **lobes}
    clean = clean_sky({"aerosol.amount": 20.0, "aerosol.phase_function": haze}, (20.0, 50.0, 70.0))
    found = fitted(clean, "aerosol.phase_function", "aerosol.optical_depth", overrides={}).fitted
    for name, truth in lobes.items():
        assert_allclose(found.value(f"aerosol.phase_function.{name}"), truth, rtol=0.01)
    assert_allclose(found.value("aerosol.optical_depth"), true_depth(), rtol=5e-3)


def test_two_lobes_start_with_the_mean_cosine_of_the_phase_function() -> None:
    # Of earth's Cornette-Shanks, g = 0.6468: 3g(4 + g²)/(5(2 + g²)) = 0.709. Droplets by Mie theory
    # have no other phase function than theirs.
    settings = FitSettings(free=["aerosol.phase_function"], keep=False)
    base = fit_sky._Base("earth", settings, None, None)
    assert base.settings.free[-1] == "aerosol.phase_function.weight"
    one = next(one for one in base.planet.constituents if one.name == "aerosol").phase_function
    cosine = one.weight * one.asymmetry_1 + (1.0 - one.weight) * one.asymmetry_2
    assert_allclose(cosine, 0.709, atol=5e-4)
    droplets = FitSettings(free=["dust.phase_function"], keep=False)
    with pytest.raises(ConflictError, match="requires a constituent with a phase function"):
        fit_sky._Base("mars", droplets, None, None)


@pytest.mark.slow
def test_each_scan_has_a_scale_of_its_own_if_asked(clean: Measurements) -> None:
    # Four scans, each with its own error of scale.
    factors = np.array([0.95, 1.0, 1.04, 1.1])
    off = replace(clean, radiance=clean.radiance * factors[clean.scan])
    found = fitted(noisy(off, 5, 0.005), "aerosol.optical_depth", per_scan=["scale"]).fitted
    assert [one.name for one in found.parameters][1] == "scale, sun 40°"
    assert (np.abs(found.values[1:] - factors) < 4.0 * found.errors.standard[1:]).all()


@pytest.mark.slow
def test_fitted_file_is_the_fitted_planet(clean: Measurements, tmp_path: Path) -> None:
    # Round trip: the file that is written, read again, has the radiance of the fit.
    sky = fitted(noisy(clean, 6), "aerosol.optical_depth", "aerosol.angstrom", "ground.albedo",
                 priors={"ground.albedo": Prior(mean=0.3, sigma=0.05)}, loss="huber")  # fmt: skip
    file = tmp_path / "fitted.toml"
    file.write_text(fitted_file(sky), encoding="utf-8")
    assert file.read_text().startswith(f"# {PLANET}, fitted to synthetic")
    again = solve(load_planet(file), [440.0, 550.0, 680.0], smooth("preview"), cache=False)
    seen = again.radiance(
        altitude=0.0, sun_zenith=clean.sun_zenith[::3], view_zenith=clean.view_zenith[::3],
        azimuth=clean.azimuth[::3],
    )  # fmt: skip
    assert_allclose(seen.values.ravel(), sky.fitted.predicted, rtol=1e-5)  # eight digits are kept
    assert len(result_lines(sky)) == 3
    assert "the data alone" in result_lines(sky)[2]


@pytest.mark.slow
def test_uncertainties_that_are_too_small_are_said(clean: Measurements) -> None:
    # The noise is four times what the file says.
    data = noisy(clean, 7)
    assert data.uncertainty is not None
    sky = fitted(replace(data, uncertainty=0.25 * data.uncertainty), "aerosol.optical_depth")
    assert any("does not reach the data" in one for one in warnings_of(sky))


@pytest.mark.slow
def test_same_fit_started_again_solves_nothing(
    clean: Measurements, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Every prediction is on disk; the numbers are the same to the last bit.
    monkeypatch.setenv("AIRLIGHT_CACHE", str(tmp_path))
    first = fitted(noisy(clean, 8), "aerosol.optical_depth", keep=True)
    again = fitted(noisy(clean, 8), "aerosol.optical_depth", keep=True)
    assert first.solves > 0
    assert (again.solves, again.rough_solves) == (0, 0)
    assert_allclose(again.fitted.values, first.fitted.values, rtol=0)


def test_cancelled_fit_stops(clean: Measurements) -> None:
    # Before the first solution.
    with pytest.raises(Cancelled):
        fit_radiances(
            PLANET, clean, FitSettings(free=["ground.albedo"], keep=False), cancel=lambda: True
        )


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (FitSettings(free=["aerosol.optical_dept"]), "'aerosol.optical_depth'"),
        (FitSettings(free=["scale"]), "a parameter of the planet"),
        (FitSettings(free=["ground.albedo", "ground.albedo"]), "each parameter once"),
        (FitSettings(free=["ground.albedo"], bounds={"ground.albedo": (-1.0, 0.5)}), "0 to 1"),
        (FitSettings(free=["ground.albedo"], bounds={"ground.albedo": (0.5, 0.2)}), "0 to 1"),
        (FitSettings(free=["ground.albedo"], starts={"ground.albedo": 2.0}),
         "start of ground.albedo"),
        (FitSettings(free=["ground.albedo"], priors={"scale": Prior(mean=1, sigma=1)}),
         "one of the free parameters"),
        (FitSettings(free=["ground.albedo"], per_scan=["ground.albedo"]), "each parameter once"),
        (FitSettings(free=["ground.albedo", "white_balance.red"]), "requires a photograph"),
    ],
)  # fmt: skip
def test_faults_of_the_request_are_said_in_one_line(
    clean: Measurements, settings: FitSettings, said: str
) -> None:
    # Refused before anything long is computed.
    with pytest.raises(ParameterError) as caught:
        fit_radiances(PLANET, clean, replace(settings, quality="preview", keep=False))
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_wavelength_beyond_the_planet_is_named_with_its_line(clean: Measurements) -> None:
    # The planet's lists end at 440 and 680 nm, ten more are held.
    far = clean.wavelength.copy()
    far[7] = 3000.0
    data = replace(clean, wavelength=far, line=np.arange(far.size) + 2)
    with pytest.raises(ParameterError, match=r"synthetic: line 9, wavelength is 3000\.0; allowed"):
        fitted(data, "ground.albedo")


# --- photographs ------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def frame() -> object:
    """Dome of a hazy planet, sun 50° from the zenith."""
    from airlight.render import render
    from airlight.scene import Camera, Scene
    from airlight.solver import solve

    planet = load_planet(PLANET, CHANGES)
    solution = solve(planet, quality=smooth("preview"), cache=False)
    scene = Scene(
        altitude=0.0, sun_zenith=50.0,
        camera=Camera(projection="fisheye", width=96, height=96),
    )  # fmt: skip
    return render(solution, scene, exact=True)


@pytest.mark.slow
@pytest.mark.parametrize(
    "kind", ["exr", "png", pytest.param("png16", marks=pytest.mark.validation)]
)
def test_photograph_of_unknown_exposure_gives_the_optical_depth(
    frame: object, tmp_path: Path, kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    # A picture of a known planet at the solver's own three wavelengths: linear to 2 %, or through
    # tone map and encoding of 8 or 16 bits, which are taken back, to 4 %.
    from airlight.render.picture import write_picture

    monkeypatch.setattr(fit_sky, "_COLOUR_WAVELENGTHS", 3)
    file = tmp_path / f"sky.{kind[:3]}"
    bits = 16 if kind == "png16" else 8
    write_picture(file, frame, bits=bits, glare=0.0)  # type: ignore[arg-type]
    photo = read_photograph(file, Shot(sun_zenith=50.0))
    assert photo.view_zenith.max() <= 85.0
    assert photo.angle_from_sun.min() >= 15.0
    sky = fit_photograph(
        PLANET, photo, FitSettings(free=["aerosol.optical_depth"], quality="preview", keep=False,
                               starts={"aerosol.optical_depth": 0.3},
                               overrides={"ground.albedo": 0.3}),
    )  # fmt: skip
    rtol = 0.02 if kind == "exr" else 0.04
    assert_allclose(sky.fitted.value("aerosol.optical_depth"), true_depth(), rtol=rtol)
    assert "photograph" in html(sky)


def test_photograph_without_sky_is_refused(tmp_path: Path) -> None:
    # White pixels are too bright to be linear.
    from PIL import Image

    file = tmp_path / "white.png"
    Image.new("RGB", (64, 64), "white").save(file)
    with pytest.raises(Exception, match="has no sky pixels of usable brightness"):
        read_photograph(file, Shot(sun_zenith=50.0))
    (tmp_path / "none.jpg").write_text("no picture")
    with pytest.raises(Exception, match="cannot be read as a picture"):
        read_photograph(tmp_path / "none.jpg", Shot(sun_zenith=50.0))


def test_pixels_of_a_photograph_that_are_no_numbers_are_left_out_and_counted(tmp_path):
    # a saturated half is infinite, a masked pixel NaN; neither has light to be fitted
    import OpenEXR

    from airlight.errors import AirlightWarning
    from airlight.studies.fit.photograph import _pixels

    rgb = np.full((2, 4, 3), 0.5, np.float32)
    rgb[0, 1, 2], rgb[1, 3, 0] = np.nan, np.inf
    about = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(about, {"RGB": rgb}).write(str(tmp_path / "a.exr"))
    with pytest.warns(AirlightWarning, match="2 pixels are not finite"):
        sound = _pixels(tmp_path / "a.exr", None)[1]
    wanted = np.ones((2, 4), bool)
    wanted[0, 1] = wanted[1, 3] = False
    assert_array_equal(sound, wanted)
