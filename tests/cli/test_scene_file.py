"""``airlight render`` with a scene file."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from airlight.cli import main
from airlight.cli.camera_options import CameraOptions
from airlight.cli.place_options import PlaceOptions
from airlight.cli.planet_options import PlanetOptions
from airlight.cli.scene_file import load_scene
from airlight.planets.reading.reader import file_text, nested_tables
from airlight.scene.system.reading import changed_system

SCENE = """
name = "Rock"
[[bodies]]
name = "rock"
radius = "1 km"
position = ["0 km", "10 km", "0 km"]
[[lights]]
star = { spectrum = "astm-g173" }
direction = [0.3, -1, 0.2]
[observer]
position = ["0 km", "0 km", "0 km"]
[camera]
look_at = "rock"
field_of_view = "20 deg"
"""

ECLIPSE = PlanetOptions(planet="solar-eclipse-2017")


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    file = tmp_path / "rock.toml"
    file.write_text(SCENE, encoding="utf-8")
    return file


def test_a_scene_file_becomes_a_picture(
    scene: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "rock.png"
    assert main(["render", str(scene), "--size", "48x32", "-o", str(out)]) == 0
    assert "48x32" in capsys.readouterr().out
    pixels = np.asarray(Image.open(out).convert("L"), float)
    assert pixels[16, 24] > 60.0
    assert pixels[0, 0] < 10.0


@pytest.mark.parametrize(
    ("options", "line"),
    [
        (["--altitude", "3km"], "--altitude requires a scene whose observer is above a body"),
        (["--at", "5N,3E"], "--at requires a scene whose observer is above a body"),
        (["--time", "2026-08-12T18:13Z"], "--time requires a scene with an ephemeris"),
        (["--look-at", "roc"], "--look-at is 'roc'; allowed: rock, sun: the observer is above no"),
        (["--look", "80,0"], "--look is not available for scene files"),
        (["--set", "rock.colour=3"], "--set is 'rock.colour'; allowed: a key of the body rock"),
        (["--set", "camera.colour=3"], "camera"),
        (["--wavelengths", "rgb"], "--wavelengths does not apply to a scene without air"),
        (["--exact"], "--exact is not available for scene files"),
        (["--samples", "99"], "samples is 99; allowed: 1 to 16"),
        (["--star-temperature", "3000K"], "--star-temperature is not available for scene files"),
    ],
)
def test_options_that_a_scene_answers_are_refused(
    scene: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    options: list[str],
    line: str,
) -> None:
    out = tmp_path / "rock.png"
    assert main(["render", str(scene), "-o", str(out), *options]) != 0
    assert line in capsys.readouterr().err
    assert not out.exists()


def test_what_options_change_is_what_films_change(scene: Path, tmp_path: Path) -> None:
    # two ways to the same scene: options of render, and changed paths as of animate
    by_paths = changed_system(
        nested_tables(file_text(scene), "rock"), "rock", scene.parent,
        {"camera.look_at": "sun", "camera.field_of_view": "3 deg", "camera.roll": "10 deg",
         "rock.radius": "2 km"},
    )  # fmt: skip
    planet = PlanetOptions(planet=str(scene), set_=["rock.radius=2 km"])
    camera = CameraOptions(look_at="sun", fov="3", roll="10deg")
    assert load_scene(planet, camera=camera) == by_paths
    assert by_paths.body("rock").radius == 2e3
    assert by_paths.view.look_at == "sun"


def test_a_roll_of_zero_replaces_that_of_the_scene(scene: Path) -> None:
    scene.write_text(f'{SCENE}roll = "10 deg"\n', encoding="utf-8")
    planet = PlanetOptions(planet=str(scene))
    assert load_scene(planet).view.roll == 10.0
    assert load_scene(planet, camera=CameraOptions(roll="0deg")).view.roll == 0.0


def test_a_preset_is_seen_from_another_place_and_time() -> None:
    # 12 August 2026 from Burgos: totality at 18:29 UT (IMCCE), 8° high in the west; the Moon then
    # covers the sun, seen from the scene's observer too, on its spherical Earth
    place = PlaceOptions(at="42.35N,3.7W,900m", time_="2026-08-12T18:29:20Z")
    scene = load_scene(ECLIPSE, place, CameraOptions(look_at="sun", fov="2deg"))
    assert scene.observer.altitude == 900.0
    assert scene.time == datetime(2026, 8, 12, 18, 29, 20, tzinfo=UTC)
    sun = scene.lights[0].towards(scene.eye)
    moon = scene.body("moon").centre - scene.eye
    apart = np.degrees(np.arccos(sun @ moon / np.linalg.norm(moon)))
    radius = np.degrees(np.arcsin(scene.body("moon").radius / np.linalg.norm(moon)))
    assert apart < radius - scene.lights[0].star_at(scene.eye).angular_radius_degrees + 0.01
    # a word of the day, at the new place: sunset, 0.83° below the horizontal (almanacs)
    scene = load_scene(ECLIPSE, PlaceOptions(at="0N,10E", time_="2026-03-21 sunset"))
    up = scene.eye / np.linalg.norm(scene.eye)
    altitude = np.degrees(np.arcsin(scene.lights[0].towards(scene.eye) @ up))
    assert altitude == pytest.approx(-0.83, abs=0.05)


@pytest.mark.parametrize(
    ("word", "zenith", "bearing"),
    [("NE/20", 70.0, 45.0), ("zenith", 0.0, None), ("S", 90.0, 180.0)],
)
def test_a_scene_s_camera_looks_to_bearings(
    word: str, zenith: float, bearing: float | None
) -> None:
    # bearings by definition, whatever the sun's
    view = load_scene(ECLIPSE, camera=CameraOptions(look_at=word)).view
    assert view.look_zenith == pytest.approx(zenith, abs=0.05)
    if bearing is not None:
        assert view.look_bearing == pytest.approx(bearing, abs=1e-9)


def test_a_scene_is_described(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    # its numbers by hand: a sphere of 1 km 10 km away is 2 asin 0.1 wide
    assert main(["show", str(scene)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    for words in ("Rock", "at 0 m, 0 m, 0 m", "looks at rock, 20° wide", "1 km 10 km 11.48°",
                  "without air, lommel-seeliger", "sun star, astm-g173 0.5329°"):  # fmt: skip
        assert words in said
    assert main(["show", str(scene), "--latitude", "3"]) != 0
    assert "--latitude is not available for scene files" in capsys.readouterr().err
