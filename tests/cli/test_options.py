"""From the texts of options to numbers."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.cli import options
from airlight.cli.display_options import ToneOptions
from airlight.cli.planet_options import LocalGroundOptions, load, with_ground_albedo
from airlight.errors import ParameterError
from airlight.image.camera_exposure import camera_exposure


class Known:
    """A planet known between two wavelengths."""

    wavelength_limits = (430.0, 690.0)


KNOWN: Any = Known()


@pytest.mark.parametrize(
    ("text", "metres"),
    [("400km", 4e5), ("10 m", 10.0), ("0", 0.0), ("1e8m", 1e8), ("1 au", 149_597_870_700.0)],
)
def test_lengths_carry_their_unit(text: str, metres: float) -> None:
    # the astronomical unit: IAU 2012 resolution B2
    assert_allclose(options.length(text, "--altitude"), metres, rtol=1e-12)


@pytest.mark.parametrize(
    ("text", "part"),
    [("10", "such as '10 m'"), ("1.5 R_earth", "the unit 'R_earth' is not known"), ("5 Pa", "Pa")],
)
def test_a_length_without_a_unit_of_length_is_refused(text: str, part: str) -> None:
    with pytest.raises(ParameterError, match=part):
        options.length(text, "--altitude")


@pytest.mark.parametrize(
    ("text", "degrees"), [("85deg", 85.0), ("85", 85.0), ("85°", 85.0), ("-0.5 rad", -28.64788976)]
)
def test_angles_are_degrees_unless_they_say_otherwise(text: str, degrees: float) -> None:
    # half a radian: 90/pi, printed to ten digits
    assert_allclose(options.angle(text, "--fov"), degrees, rtol=1e-9)


@pytest.mark.parametrize(
    ("text", "projection", "size"),
    [
        ("1920x1080", "perspective", (1920, 1080)),
        ("1920 × 1080", "perspective", (1920, 1080)),
        ("512", "perspective", (512, 512)),
        ("512", "fisheye", (512, 512)),
        ("512", "equirectangular", (512, 256)),
        ("512", "cubemap", (3072, 512)),
        ("3072x512", "cubemap", (3072, 512)),
        (None, "perspective", (1280, 720)),
    ],
)
def test_sizes(text: str | None, projection: str, size: tuple[int, int]) -> None:
    assert options.picture_size(text, projection) == size


@pytest.mark.parametrize("projection", ["perspective", "fisheye", "equirectangular", "cubemap"])
def test_the_size_that_is_not_told_suits_the_projection(projection: str) -> None:
    from airlight.scene import Camera

    width, height = options.picture_size(None, projection)
    Camera(projection=projection, width=width, height=height)


@pytest.mark.parametrize("text", ["", "x", "10x", "10x10x10", "-5x5", "1.5x2", "auto", "9999999"])
def test_a_size_that_is_none_is_refused(text: str) -> None:
    with pytest.raises(ParameterError, match="--size is"):
        options.picture_size(text, "perspective")


def test_rgb_means_the_three_wavelengths_of_the_specification() -> None:
    assert options.wavelengths("rgb", KNOWN) == (680.0, 550.0, 440.0)


def test_a_list_of_wavelengths_keeps_its_order_and_takes_units() -> None:
    assert options.wavelengths("440, 680,550", KNOWN) == (440.0, 680.0, 550.0)
    assert_allclose(options.wavelengths("0.44, 0.55 um", KNOWN), (440.0, 550.0), rtol=1e-12)
    assert options.wavelengths("550", KNOWN) == (550.0,)


@pytest.mark.parametrize("count", [1, 8, 16, 40])
def test_a_count_of_wavelengths_stays_where_the_planet_is_known(count: int) -> None:
    values = np.array(options.wavelengths(str(count), KNOWN))
    assert len(values) == count
    assert values.min() >= 430.0
    assert values.max() <= 690.0


def test_exposure_is_a_number_or_auto() -> None:
    assert options.exposure("-2.5") == -2.5
    assert options.exposure("+1 EV") == 1.0
    assert options.exposure("AUTO") == "auto"
    assert ToneOptions().ev == "auto"
    assert ToneOptions(exposure="-2.5").ev == -2.5


def test_exposure_is_a_camera_s_too() -> None:
    wanted = camera_exposure(iso=100.0, aperture=8.0, shutter=1.0 / 250.0)
    for aperture in ("8", "f/8", "F/8"):
        for shutter in ("1/250", "1/250s", "4ms", "0.004 s"):
            snap = ToneOptions(iso=100.0, aperture=aperture, shutter=shutter)
            assert snap.ev == pytest.approx(wanted)


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        (("auto", 100.0, "8", "1s"), "--exposure cannot be combined with --iso"),
        ((None, 100.0, None, "1s"), "--iso requires --aperture"),
        ((None, 0.0, "8", "1s"), "--iso is 0.0; allowed: above 0"),
        ((None, 100.0, "8", "0s"), "--shutter is 0.0; allowed: above 0"),
        ((None, 100.0, "8", "1/0s"), "--shutter"),
    ],
)
def test_a_camera_that_cannot_be_is_refused(arguments: tuple[Any, ...], field: str) -> None:
    names = ("exposure", "iso", "aperture", "shutter")
    with pytest.raises(ParameterError) as refusal:
        _ = ToneOptions(**dict(zip(names, arguments, strict=True))).ev
    assert str(refusal.value).startswith(field)


def test_keys_of_a_planet_file_are_set_from_their_text() -> None:
    planet = load("earth", ["ground.albedo=0.3", "ground.map=", "air.name=gas"])
    assert planet.ground.albedo == 0.3
    assert planet.ground.map is None
    assert planet.constituents[0].name == "gas"


@pytest.mark.parametrize("text", ["grond.albedo=0.3", "ground.albedo"])
def test_a_key_that_is_none_is_blamed_on_the_option(text: str) -> None:
    with pytest.raises(ParameterError, match="--set is"):
        load("earth", [text])


def test_the_albedo_of_the_solved_ground_is_a_number_pairs_or_a_table() -> None:
    earth = load("earth")
    for text, albedos in (
        ("0.3", [0.3, 0.3]),
        (" 440:0.2,680:0.3 ", [0.2, 0.3]),
        ("earth-albedo", earth.ground.albedos([440.0, 680.0])),
    ):
        given = with_ground_albedo(earth, text)
        assert_allclose(given.ground.albedos([440.0, 680.0]), albedos)
        assert given.ground.map == "earth"


@pytest.mark.parametrize("text", ["1.2", "-0.1", "grass", "440:0.2,680", "440:2", "0,3", "nan", ""])
def test_an_albedo_that_is_none_is_refused(text: str) -> None:
    with pytest.raises(ParameterError, match=r"^--ground-albedo is "):
        with_ground_albedo(load("earth"), text)


@pytest.mark.parametrize(
    ("words", "error"),
    [
        ((None, "10", None), "--latitude requires --longitude"),
        ((None, None, "10"), "--longitude requires --latitude"),
        (("0.3", "10", "20"), "--latitude cannot be combined with --ground-albedo"),
        ((None, "100", "20"), "--latitude is 100.0; allowed: -90 to 90 deg"),
    ],
)
def test_the_solved_ground_is_asked_for_in_one_way(
    words: tuple[str | None, ...], error: str
) -> None:
    albedo, latitude, longitude = words
    options = LocalGroundOptions(
        planet="earth", ground_albedo=albedo, latitude=latitude, longitude=longitude
    )
    with pytest.raises(ParameterError) as refusal:
        options.local(options.load())
    assert str(refusal.value).startswith(error)
