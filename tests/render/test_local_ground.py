"""Pictures of a planet with a map are solved for the ground around their observer."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import Camera, Scene, load_planet, local_ground, render, solve
from airlight.cli import main
from airlight.image.png import read_png_metadata
from airlight.render.render_scene import render_scene

NM = (680.0, 550.0, 440.0)
#: A dome above Greenland's inland ice.
DOME = Scene(
    camera=Camera(projection="fisheye", width=16, height=16, look_zenith=0.0),
    altitude=2.0,
    sun_zenith=60.0,
    latitude=72.0,
    longitude=-40.0,
)
OPTIONS = {"wavelengths": NM, "quality": "preview"}


@pytest.fixture(scope="module")
def snowy() -> np.ndarray:
    return render_scene(load_planet("earth"), DOME, **OPTIONS).rgb


def test_a_picture_shows_the_sky_that_is_solved_for_its_observer(snowy: np.ndarray) -> None:
    # One policy: the picture is that of the solution a query of the same observer reads.
    there = local_ground(load_planet("earth"), latitude=72.0, longitude=-40.0, altitude=2.0)
    solution = solve(there, NM, "preview")
    assert_array_equal(render(solution, DOME).rgb, snowy)
    zenith = solution.radiance(altitude=2.0, sun_zenith=60.0, view_zenith=0.0)
    plain = solve(load_planet("earth"), NM, "preview")
    darker = plain.radiance(altitude=2.0, sun_zenith=60.0, view_zenith=0.0)
    # the zenith is a tenth brighter above snow and more: seen, and computed
    whole = render_scene(load_planet("earth"), DOME, **OPTIONS, local=False)
    middle = (slice(7, 9), slice(7, 9))
    seen = snowy[middle].mean(axis=(0, 1)) / whole.rgb[middle].mean(axis=(0, 1))
    assert_allclose(seen[2], float(zenith[2] / darker[2]), rtol=0.02)
    assert seen[2] > 1.1
    assert "solved_ground" not in whole.metadata


def test_the_file_of_a_picture_says_which_ground_was_solved(tmp_path) -> None:
    words = ["--size", "16x9", "--quality", "preview", "--wavelengths", "rgb", "--altitude", "2m"]
    place = ["--latitude", "72", "--longitude", "-40"]
    for name, more in (("a.png", []), ("b.png", ["--ground-albedo", "0.3"])):
        assert main(["render", "earth", "-o", str(tmp_path / name), *words, *place, *more]) == 0
    local, given = (read_png_metadata(tmp_path / name) for name in ("a.png", "b.png"))
    assert "ground of 72°N 40°W" in local["airlight.solved_ground"]
    assert "airlight.solved_ground" not in given
    assert given["airlight.ground_albedo"] == "0.3"


def test_the_given_albedo_lights_the_sky(capsys: pytest.CaptureFixture[str]) -> None:
    # brighter ground, brighter sky; the option is the same as the key of the file
    words = [
        "radiance",
        "earth",
        "--sun-zenith",
        "60",
        "--view-zenith",
        "0",
        "--quality",
        "preview",
    ]
    printed = []
    for more in (
        ["--ground-albedo", "0.3"],
        ["--set", "ground.albedo=0.3"],
        ["--latitude", "72", "--longitude", "-40"],
        [],
    ):
        assert main([*words, *more]) == 0
        out, err = capsys.readouterr()
        printed.append([float(line.split()[2]) for line in out.splitlines()])
        assert ("ground of 72°N 40°W" in err) == ("--latitude" in more)
    assert printed[0] == printed[1]
    assert printed[2] > printed[0] > printed[3]  # snow, 0.3, the planet's 0.1
