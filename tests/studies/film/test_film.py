"""Film files: clock, paths into scene and planet, and errors of one line."""

from __future__ import annotations

import runpy
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import pytest

from airlight.errors import ParameterError
from airlight.studies.distribution.fingerprint import digest
from airlight.studies.film import Quality, load_film
from airlight.studies.film.frame_spec import PlanetFrameSpec, SystemFrameSpec

HOW = Quality(width=16, height=9, wavelengths=(680.0, 550.0, 440.0), quality="preview")
FILM = """
name = "Climb"
planet = "earth-atmosphere-plus"

[view]
latitude = "10 deg"
look_zenith = "80 deg"

[film]
frames = 5

[[film.keys]]
path = "view.altitude"
values = ["1 m", "10 km"]
law = "exponential"

[[film.keys]]
path = "ground.albedo"
values = [0.1, 0.5]
"""
SCENE = """
name = "Rock"
time = "2024-01-01T00:00Z"
[[bodies]]
name = "rock"
radius = "1 km"
position = ["0 km", "10 km", "0 km"]
[[bodies]]
name = "world"
planet = "mars-rayleigh"
position = ["90000 km", "0 km", "0 km"]
[[lights]]
star = { spectrum = "astm-g173" }
direction = [0.3, -1, 0.2]
[observer]
position = ["0 km", "0 km", "0 km"]
[camera]
look_at = "rock"
field_of_view = "20 deg"
"""


def written(folder: Path, text: str) -> Path:
    file = folder / "film.toml"
    file.write_text(text, encoding="utf-8")
    return file


def test_keys_reach_the_view_and_the_planet(tmp_path: Path) -> None:
    film = load_film(written(tmp_path, FILM))
    stills = [film.frame_spec(n, HOW) for n in range(film.plan.count)]
    assert all(isinstance(one, PlanetFrameSpec) for one in stills)
    assert [round(one.scene.altitude, 9) for one in stills] == [1.0, 10.0, 100.0, 1e3, 1e4]
    assert [one.planet.ground.albedo for one in stills] == [0.1, 0.2, 0.3, 0.4, 0.5]
    assert film.name == "Climb"
    assert stills[0].scene.camera.polariser is None
    turned = load_film(written(tmp_path, FILM), {"view.polariser": "30 deg"})
    assert turned.frame_spec(0, HOW).scene.camera.polariser == 30.0


def test_the_clock_runs_evenly_and_moves_the_sun() -> None:
    film = load_film("earth", {
        "film.frames": 3, "film.start": "2026-06-21T18:00Z", "film.end": "2026-06-21T20:00Z",
        "view.latitude": "59.33 deg", "view.longitude": "18.07 deg", "view.look_at": "NW",
    })  # fmt: skip
    scenes = [film.frame_spec(n, HOW).scene for n in range(3)]
    assert [one.time.hour for one in scenes] == [18, 19, 20]
    assert scenes[0].sun_zenith < scenes[1].sun_zenith < scenes[2].sun_zenith
    # the camera stays at its bearing while the sun moves on
    bearings = {round((one.camera.look_azimuth + one.sun_azimuth) % 360.0, 6) for one in scenes}
    assert bearings == {315.0}


def test_a_dome_keeps_its_front_while_the_sun_moves() -> None:
    # the camera's azimuth is at the bottom, the front of a dome master
    film = load_film("earth", {
        "film.frames": 3, "film.start": "2026-06-21T06:00Z", "film.end": "2026-06-21T14:00Z",
        "view.projection": "fisheye", "view.look_at": "S/90",
    })  # fmt: skip
    for number in range(3):
        scene = film.frame_spec(number, replace(HOW, height=16)).scene
        assert abs(scene.camera.look_zenith) < 1e-9
        assert abs((scene.camera.look_azimuth + scene.sun_azimuth) % 360.0 - 180.0) < 1e-6


def test_words_of_the_day_are_times_of_a_planets_film() -> None:
    film = load_film("earth", {"film.frames": 2, "film.start": "2026-03-20 sunset",
                               "film.end": "2026-03-20 civil-dusk"})  # fmt: skip
    scenes = [film.frame_spec(n, HOW).scene for n in range(2)]
    assert 90.5 < scenes[0].sun_zenith < 91.0
    assert abs(scenes[1].sun_zenith - 96.0) < 0.05


def test_keys_reach_scene_bodies_and_their_planets(tmp_path: Path) -> None:
    keys = """
[film]
frames = 2
start = "2024-01-01T00:00Z"
end = "2024-01-01T02:00Z"
[[film.keys]]
path = "camera.field_of_view"
values = ["20 deg", "40 deg"]
[[film.keys]]
path = "rock.radius"
values = ["1 km", "2 km"]
[[film.keys]]
path = "world.ground.albedo"
values = [0.1, 0.9]
"""
    film = load_film(written(tmp_path, SCENE + keys))
    last = film.frame_spec(1, HOW)
    assert isinstance(last, SystemFrameSpec)
    assert last.system.view.field_of_view == 40.0
    assert last.system.body("rock").radius == 2000.0
    assert last.system.planets["world"].ground.albedo == 0.9
    assert last.system.time == datetime(2024, 1, 1, 2, tzinfo=UTC)


def test_a_scene_is_drawn_by_render_with_its_film_left_aside(tmp_path: Path) -> None:
    from airlight.scene.system import load_system

    assert load_system(written(tmp_path, SCENE + "[film]\nframes = 2\n")).name == "Rock"


def test_a_fingerprint_changes_with_what_the_frame_shows_and_with_nothing_else(
    tmp_path: Path,
) -> None:
    def of(changes: dict, number: int = 1) -> str:
        still = load_film(written(tmp_path, FILM), changes).frame_spec(number, HOW)
        return digest(still.defined_by, still.files)

    same = of({})
    assert of({}) == same
    assert of({"film.rate": 25}) == same
    for changes in ({"film.frames": 6}, {"view.roll": "1 deg"}, {"ground.brightness": 0.5},
                    {"view.look_zenith": "81 deg"}, {"shell.top_radius": "6470 km"}):  # fmt: skip
        assert of(changes) != same


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("frames = 5", "frames = 0", "film.frames is 0.0; allowed: 1 to 99999"),
        ("frames = 5", "frames = 2.5", "film.frames is 2.5; allowed: a whole number"),
        ("frames = 5", "farmes = 5", "did you mean 'frames'"),
        ("frames = 5", "start = '2026-01-01T00:00Z'", "film.start requires end"),
        ('"view.altitude"', '"view.altitud"', "allowed: view.latitude, view.longitude"),
        ('"ground.albedo"', '"grund.albedo"', "did you mean 'ground.albedo'"),
        ("[0.1, 0.5]", "[0.1, 1.5]", "ground.albedo is 1.5; allowed: 0 to 1"),
        ('latitude = "10 deg"', 'latitude = "100 deg"', "view.latitude is 100.0; allowed: -90"),
        ('planet = "', 'plant = "', "planet is missing; allowed: one of planet"),
        ('path = "ground.albedo"', 'path = "view.altitude"', "allowed: each path once"),
        ('law = "exponential"', 'law = "exponental"', "did you mean 'exponential'"),
    ],
)
def test_a_wrong_film_is_refused_in_one_line(tmp_path: Path, old: str, new: str, line: str) -> None:
    assert old in FILM
    with pytest.raises(ParameterError) as caught:
        film = load_film(written(tmp_path, FILM.replace(old, new)))
        film.frame_spec(film.plan.count - 1, HOW)
    assert line in str(caught.value)
    assert "\n" not in str(caught.value)


def test_display_settings_of_a_film_are_those_of_its_file(tmp_path: Path) -> None:
    text = FILM + "\n[display]\nwhite_balance = '4000 K'\ntone_map = 'agx'\n"
    film = load_film(written(tmp_path, text), {"display.glare": 0.5})
    assert film.display == {"white_balance": "4000 K", "tone_map": "agx", "glare": 0.5}
    for wrong, line in (("bits = 16", "display is 'bits'"), ("glare = 20", "display.glare is 20")):
        with pytest.raises(ParameterError, match=line):
            load_film(written(tmp_path, f"{FILM}\n[display]\n{wrong}\n"))


def test_the_tables_of_the_page_are_those_of_the_declarations() -> None:
    # written by builders/file_keys.py
    root = Path(__file__).parents[3]
    page = (root / "docs" / "films.md").read_text(encoding="utf-8")
    builder = runpy.run_path(str(root / "builders" / "file_keys.py"))
    assert all(f"<!-- keys: {kind} -->" in page for kind in builder["PAGES"]["films.md"])
    assert builder["filled"]("films.md") == page
