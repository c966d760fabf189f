"""Scene files: presets, keys, and one line for everything that cannot be."""

from __future__ import annotations

import runpy
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import FileError, ParameterError
from airlight.planets.reading.reader import nested_tables
from airlight.scene.system import is_scene_file, load_system, system_names
from airlight.scene.system.reading import changed_system
from airlight.scene.system.system import System

WHOLE = """
name = "Two"
[[bodies]]
name = "earth"
planet = "earth"
[[bodies]]
name = "moon"
radius = "1737.4 km"
position = ["384400 km", "0 km", "0 km"]
[[lights]]
star = { spectrum = "astm-g173" }
direction = [0, 1, 0]
[observer]
body = "earth"
latitude = "0 deg"
longitude = "0 deg"
altitude = "2 m"
[camera]
look_at = "moon"
"""


def read_system(text: str, file: str) -> System:
    return changed_system(nested_tables(text, file), file, None, {})


@pytest.mark.parametrize("name", system_names())
def test_presets_can_be_drawn(name: str) -> None:
    system = load_system(name)
    system.check_distances()
    axes = system.camera_axes
    assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
    assert system.description


def test_the_observer_stands_where_latitude_and_longitude_say() -> None:
    system = read_system(WHOLE, "two.toml")
    radius = system.planets["earth"].bottom_radius
    assert_allclose(system.eye, [radius + 2.0, 0.0, 0.0])
    assert_allclose(system.camera_axes[2], [1.0, 0.0, 0.0], atol=1e-12)
    east = read_system(WHOLE.replace('longitude = "0 deg"', 'longitude = "90 deg"'), "x")
    assert_allclose(east.eye, [0.0, radius + 2.0, 0.0], atol=1e-6)


def test_a_compass_bearing_is_clockwise_from_north() -> None:
    text = WHOLE.replace('look_at = "moon"', 'look_zenith = "90 deg"\nlook_bearing = "90 deg"')
    # At latitude and longitude 0, x is up, z north and y east.
    assert_allclose(read_system(text, "x").camera_axes[2], [0.0, 1.0, 0.0], atol=1e-12)


def test_a_moon_faces_its_planet() -> None:
    system = read_system(WHOLE.replace('"1737.4 km"', '"1737.4 km"\nfaces = "earth"'), "x")
    assert_allclose(system.axes(system.body("moon"))[0], [-1.0, 0.0, 0.0], atol=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ('radius = "1737.4 km"', "", r"bodies\[1\].radius is missing; allowed: a length"),
        ('"1737.4 km"', '"-1 km"', r"bodies\[1\].radius is -1000.0; allowed: 1 to 1e\+10 m"),
        ('"1737.4 km"', '"1 km"\nalbedo = 2', r"bodies\[1\].albedo is 2.0; allowed: 0 to 1"),
        ('planet = "earth"', 'planet = "earth"\nradius = "1 km"', "cannot be combined with planet"),
        ('look_at = "moon"', 'look_at = "sunn"', "camera.look_at is 'sunn'; allowed: earth, moon"),
        ('look_at = "moon"', "", "camera.look_at is missing; allowed: one of look_at, direction"),
        ("direction = [0, 1, 0]", "direction = [0, 0, 0]", "three numbers that are not all 0"),
        ("direction = [0, 1, 0]", "", r"lights\[0\].direction is missing"),
        ('name = "moon"', 'name = "earth"', "name is 'earth'; allowed: unique names of bodies"),
        ('altitude = "2 m"', 'altitud = "2 m"', "did you mean 'altitude'"),
        ('"384400 km"', '"6800 km"', "at least 8"),
        ('body = "earth"', 'body = "mars"', "observer.body is 'mars'; allowed: earth, moon"),
        ('position = ["384400 km", "0 km", "0 km"]', 'position = ["1 km"]', "three lengths"),
        ('[camera]', '[camera]\nfield_of_view = "400 deg"', "camera.field_of_view is 400.0"),
        ("[[lights]]", '[[lights]]\nbody = "moon"\n[[lights]]', None),
        ("[[lights]]", '[[lights]]\nbody = "phobos"\n[[lights]]', r"lights\[0\].body is 'phobos'"),
        ('radius = "1737.4 km"', 'radius = "1737.4 km"\nfaces = "phobos"', r"bodies\[1\].faces"),
    ],
)  # fmt: skip
def test_errors_name_file_field_value_and_range(old: str, new: str, line: str | None) -> None:
    assert old in WHOLE
    text = WHOLE.replace(old, new, 1)
    if line is None:
        read_system(text, "two.toml").check_distances()
        return
    with pytest.raises(ParameterError, match=line):
        read_system(text, "two.toml").check_distances()


def test_an_observer_inside_a_body_is_refused() -> None:
    head, _, rest = WHOLE.partition('body = "earth"')
    inside = 'position = ["384000 km", "0 km", "0 km"]\n[camera]' + rest.partition("[camera]")[2]
    with pytest.raises(ParameterError, match=r"outside all bodies"):
        _ = read_system(head + inside, "x").eye


def test_files_are_told_apart(tmp_path: Path) -> None:
    file = tmp_path / "two.toml"
    file.write_text(WHOLE, encoding="utf-8")
    assert is_scene_file(file)
    assert load_system(file).name == "Two"
    planet = tmp_path / "planet.toml"
    planet.write_text('name = "x"\n', encoding="utf-8")
    assert not is_scene_file(planet)
    assert not is_scene_file(tmp_path / "none.toml")
    with pytest.raises(ParameterError, match=r"did you mean 'earth-moon'"):
        load_system("earth-mon")
    with pytest.raises(FileError):
        load_system(tmp_path / "none.toml")


def test_the_tables_of_the_page_are_those_of_the_declarations() -> None:
    # written by builders/file_keys.py
    root = Path(__file__).parents[3]
    page = (root / "docs" / "scenes.md").read_text(encoding="utf-8")
    builder = runpy.run_path(str(root / "builders" / "file_keys.py"))
    assert all(f"<!-- keys: {kind} -->" in page for kind in builder["PAGES"]["scenes.md"])
    assert builder["filled"]("scenes.md") == page
    assert all(f"`{name}`" in page for name in system_names())
