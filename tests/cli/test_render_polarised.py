"""``airlight render``: filters, maps of degree and angle with a legend, layers of an EXR."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import OpenEXR
import pytest
from numpy.testing import assert_allclose, assert_array_equal, assert_array_less
from PIL import Image

pytest.importorskip("matplotlib")

from airlight.cli import main
from airlight.image.exr import read_exr
from airlight.image.png import read_png_metadata
from airlight.image.xyz import luminance
from airlight.solver.stokes_frame import degree_of_polarisation
from airlight.studies.plots.polarised_picture import color_map

PLANET = "earth-atmosphere-plus"
QUICK = ["--quality", "preview", "--wavelengths", "rgb", "--altitude", "2m", "--sun-zenith", "75"]
DOME = ["--projection", "fisheye", "--size", "240"]


def rendered(path: Path, *words: str) -> Path:
    assert main(["render", PLANET, "-o", str(path), *QUICK, *words]) == 0
    return path


def channels(path: Path) -> dict[str, np.ndarray]:
    with OpenEXR.File(str(path), separate_channels=True) as image:
        return {name: np.array(one.pixels) for name, one in image.channels().items()}


def test_layers_and_a_map_of_the_degree_are_of_one_light(tmp_path: Path) -> None:
    found = channels(rendered(tmp_path / "a.exr", *DOME, "--show", "dolp"))
    colors = [f"{layer}{letter}" for layer in ("", "Q.", "U.") for letter in "RGB"]
    assert sorted(found) == sorted([*colors, "dolp"])
    light = np.stack([found[name] for name in colors], axis=-1).reshape(240, 240, 3, 3)
    stokes = luminance(np.moveaxis(light, 2, 0).astype(np.float64))
    assert_allclose(found["dolp"], degree_of_polarisation(stokes), atol=1e-6)
    assert 0.4 < found["dolp"].max() < 0.9
    texts = read_exr(tmp_path / "a.exr")[1]
    assert texts["airlight.stokes"].startswith("I in R, G, B; Q and U in the layers Q and U")

    picture = rendered(tmp_path / "a.png", *DOME, "--show", "dolp")
    with Image.open(picture) as image:
        pixels = np.asarray(image)
    assert pixels.shape[1:] == (240, 3)
    sky, legend = pixels[:240], pixels[240:]
    lit = stokes[0] > 0.0
    # the layer is rounded to 32 bits: next to a step of the map it may stand on either side
    sides = [color_map("dolp")(found["dolp"][lit] + step)[..., :3] for step in (-1e-6, 0.0, 1e-6)]
    off = np.abs(sky[lit] - 255.0 * np.asarray(sides)).max(axis=-1).min(axis=0)
    assert_array_less(off, 0.51 + 1e-3)
    assert_array_equal(sky[~lit], 0)
    assert len(np.unique(legend.reshape(-1, 3), axis=0)) > 100  # a bar of colours
    assert read_png_metadata(picture)["airlight.shown"] == "degree of linear polarisation [%]"


def test_a_filter_shows_and_its_file_says_so(tmp_path: Path) -> None:
    # 90° from the sun, beside it: light swings nearly upright there
    look = ["--look", "80,90", "--size", "4x4", "--fov", "2"]
    bright, dark = (
        read_exr(rendered(tmp_path / f"{angle}.exr", *look, "--polariser", f"{angle}deg"))
        for angle in (-15, 75)
    )
    plain = read_exr(rendered(tmp_path / "plain.exr", *look))[0]
    assert np.all(dark[0] < 0.6 * bright[0])
    # what one filter stops the other lets through
    assert_allclose(dark[0] + bright[0], plain, rtol=1e-5)
    assert dark[1]["airlight.polariser"] == "75 deg"


@pytest.mark.parametrize(
    ("planet", "words", "part"),
    [
        (PLANET, ["-o", "a.png", "--stokes"], "--stokes requires an .exr file"),
        (PLANET, ["-o", "a.png", "--polariser", "500"], "polariser is 500.0; allowed: -360 to"),
        (
            PLANET,
            ["-o", "a.png", "--polariser", "30", "--show", "dolp"],
            "cannot be combined with --show",
        ),
        (
            PLANET,
            ["-o", "a.exr", "--polariser", "30", "--stokes"],
            "--polariser cannot be combined with --stokes",
        ),
        (
            PLANET,
            ["-o", "a.png", "--polariser", "30", "--no-polarisation"],
            "cannot be combined with --no-pol",
        ),
        (
            PLANET,
            ["-o", "a.png", "--show", "dolp", "--exposure", "3"],
            "cannot be combined with --show",
        ),
        (PLANET, ["-o", "a.png", "--show", "aolp", "--size", "64x36", *QUICK], "240 pixels or"),
        (
            "lunar-eclipse",
            ["-o", "a.png", "--sun-zenith", "30"],
            "--sun-zenith is not available for scene files",
        ),
        (
            "lunar-eclipse",
            ["-o", "a.png", "--show", "dolp"],
            "--show is not available for scene files",
        ),
    ],
)
def test_what_cannot_be_shown_is_one_line(
    planet: str,
    words: list[str],
    part: str,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["render", planet, *words]) == 2
    error = capsys.readouterr().err
    assert part in error
    assert error.count("\n") == 1
    assert list(tmp_path.iterdir()) == []
