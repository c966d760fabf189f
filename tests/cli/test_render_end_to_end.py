"""``airlight render`` with the real solver and renderer: files that are whole, lit and finite."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from PIL import Image

from airlight.cli import main
from airlight.image.exr import read_exr
from airlight.image.png import read_png_metadata

solvers = pytest.importorskip("airlight.solver")
renderer = pytest.importorskip("airlight.render")
pytestmark = pytest.mark.skipif(
    not (hasattr(solvers, "solve") and hasattr(renderer, "render")),
    reason="there is no solver or no renderer yet",
)

PLANET = "earth-atmosphere-plus"
QUICK = ["--quality", "preview", "--wavelengths", "rgb"]


def rendered(path: Path, *words: str) -> np.ndarray:
    assert main(["render", PLANET, "-o", str(path), *QUICK, *words]) == 0
    assert [file.name for file in path.parent.iterdir()] == [path.name]
    if path.suffix == ".exr":
        return read_exr(path)[0]
    with Image.open(path) as image:
        return np.asarray(image)


def test_a_picture_is_written_and_reported_in_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rendered(tmp_path / "a.png", "--size", "64x36")  # compiled, which has a line of its own
    capsys.readouterr()
    pixels = rendered(tmp_path / "a.png", "--size", "64x36")
    assert pixels.shape == (36, 64, 3)
    assert pixels.max() > 0
    captured = capsys.readouterr()
    pattern = r"\S+a\.png  64x36  \d+ kB  \d+\.\d s  exposure [+-]\d+\.\d\d EV\n"
    assert re.fullmatch(pattern, captured.out)
    assert captured.err == ""


def test_the_picture_says_how_it_was_made(tmp_path: Path) -> None:
    words = ["--size", "32x18", "--altitude", "35km", "--sun-zenith", "88deg", "--exposure", "-1"]
    rendered(tmp_path / "a.png", *words)
    texts = read_png_metadata(tmp_path / "a.png")
    assert texts["airlight.altitude"] == "35000 m"
    assert texts["airlight.sun_zenith"] == "88 deg"
    assert texts["airlight.exposure"] == "-1 EV"
    assert "planet" in " ".join(texts)


@pytest.mark.parametrize(
    ("projection", "size", "shape"),
    [
        ("perspective", "48x27", (27, 48)),
        ("fisheye", "32", (32, 32)),
        ("equirectangular", "64", (32, 64)),
        ("cubemap", "16", (16, 96)),
        ("octahedral", "24", (24, 24)),
    ],
)
@pytest.mark.parametrize("altitude", ["0m", "400km", "1e8m"])
def test_every_projection_is_finite_and_never_negative(
    tmp_path: Path, projection: str, size: str, shape: tuple[int, int], altitude: str
) -> None:
    words = ["--projection", projection, "--size", size, "--altitude", altitude]
    if altitude != "0m":  # the planet is in sight, with the light it reflects
        words += ["--look-at", "nadir"]
    rgb = rendered(tmp_path / "a.exr", *words, "--sun-zenith", "70")
    assert rgb.shape == (*shape, 3)
    assert np.isfinite(rgb).all()
    # a saturated colour may lie outside sRGB, but never its luminance below 0
    luminance = rgb @ np.array([0.2126, 0.7152, 0.0722], dtype=np.float32)
    assert luminance.min() >= 0.0
    if altitude != "1e8m":  # from there the planet may fall between pixels of 5.6 degrees
        assert luminance.max() > 0.0


def test_the_sky_is_symmetric_about_the_sun_s_vertical(tmp_path: Path) -> None:
    # a law: air knows no left and right; decoration of the ground does, up to 3° above the horizon
    words = ["--altitude", "0m", "--projection", "fisheye", "--size", "32", "--sun-zenith", "50"]
    rgb = rendered(tmp_path / "a.exr", *words)
    # mirrored sample points differ by rounding only, where the sun's disc is not cut
    middle = np.arange(32) - 15.5
    high = np.hypot(middle, middle[:, None]) < 16.0 * 84.0 / 90.0
    assert_allclose(rgb[:, ::-1][high], rgb[high], rtol=1e-4, atol=1e-4 * float(np.median(rgb)))


def test_the_sun_s_side_is_at_the_bottom_of_a_dome(tmp_path: Path) -> None:
    words = ["--altitude", "0m", "--projection", "fisheye", "--size", "32", "--sun-zenith", "80"]
    rgb = rendered(tmp_path / "a.exr", *words)
    # the aerosol scatters forward; the disc itself falls between pixels of 5.6 degrees
    assert rgb[24:].sum() > 1.2 * rgb[:8].sum()


@pytest.mark.parametrize(
    ("words", "white"),
    [
        # a dome in space: the sun, its glow; its disc, darker at the rim
        (["--altitude", "400km", "--projection", "fisheye", "--size", "128"], 0.02),
        (["--altitude", "400km", "--look-at", "sun", "--fov", "1", "--size", "96x54"], 0.0),
        (["--altitude", "2m", "--look-at", "sun", "--fov", "3", "--size", "96x54"], 0.06),
        (["--altitude", "2m", "--sun-zenith", "120", "--moon", "60,10,20", "--look", "60,10",
          "--fov", "1", "--size", "96x54"], 0.0),
    ],
)  # fmt: skip
def test_no_picture_of_a_star_or_moon_is_blank(
    words: list[str], white: float, tmp_path: Path
) -> None:
    # a law of photographs: something is seen, and what is white is no more than a disc of 0.53°
    # in the picture, or its glow on a 25th of it
    pixels = rendered(tmp_path / "a.png", *words)
    assert pixels.max() > 100
    assert np.mean(pixels.min(axis=2) >= 253) <= white
    assert np.mean(pixels.max(axis=2) < 60) > 0.3  # space, or the night


def test_the_same_command_gives_the_same_pixels(tmp_path: Path) -> None:
    # results must not depend on the order in which threads finish, nor on the cache
    first, second, third = (tmp_path / name for name in ("1", "2", "3"))
    for folder in (first, second, third):
        folder.mkdir()
    words = ["--size", "48x27"]
    a = rendered(first / "a.exr", *words)
    b = rendered(second / "a.exr", *words)
    c = rendered(third / "a.exr", *words, "--no-cache")
    assert_array_equal(a.view(np.uint32), b.view(np.uint32))
    assert_array_equal(a.view(np.uint32), c.view(np.uint32))


def test_automatic_exposure_says_what_it_used(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rendered(tmp_path / "a.png", "--size", "32x18", "--exposure", "auto")
    match = re.search(r"exposure ([+-]\d+\.\d\d) EV", capsys.readouterr().out)
    assert match is not None
    said = float(read_png_metadata(tmp_path / "a.png")["airlight.exposure"].removesuffix(" EV"))
    assert_allclose(said, float(match[1]), atol=0.0051)


def test_show_prints_optical_depths_and_a_swatch(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", PLANET]) == 0
    out = capsys.readouterr().out
    # coefficient times column: 5.802e-6 · 7999.97 m of air, 0.65e-6 · 15000 m of the ozone tent
    assert "0.04642" in out
    assert "0.00975" in out
    # a clear noon sky is blue: the last pair of digits is the largest
    codes = re.findall(r"#([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})", out)
    assert len(codes) == 3
    red, _, blue = (int(pair, 16) for pair in codes[0])
    assert blue > red


def test_planets_lists_every_preset(capsys: pytest.CaptureFixture[str]) -> None:
    import airlight

    assert main(["planets"]) == 0
    out = capsys.readouterr().out
    assert all(name in out for name in airlight.planet_names())
