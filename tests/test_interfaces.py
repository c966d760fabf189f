"""What functions take for a planet, a bearing and an observer: the same everywhere."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray
from numpy.testing import assert_allclose, assert_array_equal

import airlight
from airlight.cli import main
from airlight.cli.place_options import PlaceOptions
from airlight.engines.composition.placement import Placement
from airlight.errors import ParameterError
from airlight.image.exr import read_exr
from airlight.planets.reading.reader import planet_text
from airlight.planets.schema.toml_table import TomlTable
from airlight.render.render_scene import render_scene
from airlight.scene.compass import POINTS
from airlight.scene.system.viewpoint import View
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.montecarlo.settings import settings_for
from airlight.studies.film.view import PlanetView
from airlight.studies.sweep import Grid

NAME = "earth-bruneton"
SMALL = airlight.Scene(camera=airlight.Camera(width=6, height=4))


@pytest.fixture(scope="module")
def sky(solved: Callable[..., MomentsSolution]) -> MomentsSolution:
    return solved(airlight.load_planet(NAME), (680.0, 550.0, 440.0), "preview")


def test_a_picture_of_a_preset_is_that_of_its_planet_its_file_and_its_solution(
    tmp_path: Path,
) -> None:
    # a second method: solving and drawing by render_scene
    file = tmp_path / "mine.toml"
    file.write_text(planet_text(NAME)[0], encoding="utf-8")
    planet = airlight.load_planet(NAME)
    expected = render_scene(planet, SMALL).rgb
    for given in (NAME, file, str(file), planet):
        assert_array_equal(airlight.render(given, SMALL).rgb, expected)
        assert_array_equal(render_scene(given, SMALL).rgb, expected)


def test_functions_take_presets_planets_and_solutions_alike(sky: MomentsSolution) -> None:
    planet = airlight.load_planet(NAME)
    assert sky.planet is not None
    for given in (NAME, planet, sky):
        assert airlight.load_planet(given) == planet
        assert airlight.local_ground(given, latitude=10.0, longitude=0.0) == planet
        assert airlight.solve(given, [550.0], "preview").planet == planet
        grid = Grid(planets=[given], sun_zenith=[0.0], view_zenith=[0.0], wavelengths=[550.0])
        assert grid.planet((0,)) == planet
    noon = "2026-06-21T12:00Z"
    scenes = [
        airlight.Scene.at(given, latitude=0.0, longitude=0.0, time=noon) for given in (NAME, planet)
    ]
    assert scenes[0] == scenes[1]


def test_an_observable_of_a_preset_is_solved_at_its_own_wavelengths() -> None:
    named = airlight.observe(NAME, "geometric-albedo")
    solved = airlight.observe(airlight.solve(NAME), "geometric-albedo")
    assert_array_equal(named.geometric_albedo, solved.geometric_albedo)


@pytest.mark.parametrize("wrong", [5, None, 3.5, ["earth"]])
def test_what_is_no_planet_is_refused_in_one_line(wrong: object) -> None:
    calls: list[Callable[[], object]] = [
        lambda: airlight.render(wrong, SMALL),  # type: ignore[arg-type]
        lambda: airlight.observe(wrong, "bond-albedo"),  # type: ignore[arg-type]
        lambda: airlight.bake(wrong),  # type: ignore[arg-type]
        lambda: airlight.load_planet(wrong),  # type: ignore[arg-type]
        lambda: render_scene(wrong, SMALL),  # type: ignore[arg-type]
    ]
    for call in calls:
        with pytest.raises(ParameterError, match=r"planet is .* allowed: a Planet, a solution"):
            call()


def test_a_scene_that_is_none_is_refused() -> None:
    with pytest.raises(ParameterError, match="scene is 3; allowed: a Scene"):
        airlight.render(NAME, 3)  # type: ignore[arg-type]


def test_a_planet_without_file_takes_no_overrides() -> None:
    with pytest.raises(ParameterError, match=r"overrides do not apply to a Planet"):
        airlight.load_planet(airlight.load_planet(NAME), {"ground.albedo": 0.3})


def test_results_of_monte_carlo_have_their_standard_errors() -> None:
    # those of the estimate, which scatter as they say: tests/solver/montecarlo/test_answers.py
    where = {"altitude": 0.0, "sun_zenith": 60.0, "view_zenith": [0.0, 70.0]}
    settings = replace(settings_for("preview"), relative_error=0.05)
    solution = airlight.solve(NAME, [550.0], settings, solver="montecarlo")
    found, estimate = solution.radiance(**where), solution.estimate(**where)
    assert_array_equal(found.values, estimate.radiance.values)
    assert_array_equal(found.standard_error, estimate.standard_error)
    assert found.standard_error.shape == found.shape
    assert found.standard_error.attrs["units"] == "W m-2 sr-1 nm-1"


def test_polarised_and_received_light_of_monte_carlo_have_errors() -> None:
    solution = airlight.solve(NAME, [550.0], "preview", solver="montecarlo")
    where = {"altitude": 0.0, "sun_zenith": 60.0, "view_zenith": 40.0}
    stokes = solution.radiance(**where, stokes=True)
    estimate = solution.estimate(**where, stokes=True)
    # the same question has the same histories
    assert_array_equal(stokes.values, estimate.stokes_radiance.values)
    assert_array_equal(stokes.standard_error, estimate.stokes_standard_error)
    second = solution.radiance(**where, order=2)
    assert 0.0 < second.standard_error.item() < second.item()
    received = solution.irradiance(altitude=0.0, sun_zenith=60.0)
    assert 0.0 < received.diffuse_standard_error.item() < 0.1 * received.diffuse.item()


def test_shapes_that_do_not_broadcast_are_told_how_to(sky: MomentsSolution) -> None:
    suns, views = np.array([10.0, 20.0, 30.0]), np.array([0.0, 40.0])
    with pytest.raises(ParameterError, match=r"sun_zenith\[:, None\].*DataArray"):
        sky.radiance(altitude=0.0, sun_zenith=suns, view_zenith=views)
    # the advice is right: both ways give the same grid
    grid = sky.radiance(altitude=0.0, sun_zenith=suns[:, None], view_zenith=views)
    named = sky.radiance(
        altitude=0.0, sun_zenith=xarray.DataArray(suns, dims="sun_zenith"),
        view_zenith=xarray.DataArray(views, dims="view_zenith"),
    )  # fmt: skip
    assert_allclose(named.transpose(*grid.dims), grid, rtol=1e-12)


@pytest.mark.parametrize(("number", "point"), list(enumerate(POINTS)))
def test_points_of_the_compass_are_bearings_everywhere(number: int, point: str) -> None:
    # sixteen points, 22.5° apart, clockwise from north
    degrees = 22.5 * number
    assert airlight.Scene(sun_azimuth=point).sun_azimuth == degrees
    placed = Placement(heading=point, sun_azimuth=point.lower())
    assert (placed.heading, placed.sun_azimuth) == (degrees, degrees)
    assert PlaceOptions(sun_azimuth=point).scene(airlight.load_planet(NAME)).sun_azimuth == degrees


def test_files_of_scenes_and_films_take_points_of_the_compass() -> None:
    # 45° and 225°, and the same as angles with their unit
    for north_east, south_west in (("NE", "sw"), ("45 deg", "225 deg")):
        view = View.read(TomlTable({"look_zenith": "80 deg", "look_bearing": north_east}))
        assert view.look_bearing == 45.0
        assert PlanetView.read(TomlTable({"sun_azimuth": south_west})).sun_azimuth == 225.0
    with pytest.raises(ParameterError, match="look_bearing is 'NEX'"):
        View.read(TomlTable({"look_zenith": "80 deg", "look_bearing": "NEX"}))


def test_an_angle_that_is_no_bearing_takes_no_point_of_the_compass() -> None:
    for name in ("sun_zenith", "latitude"):
        with pytest.raises(ParameterError, match=f"scene.{name} is 'N'"):
            airlight.Scene(**{name: "N"})  # type: ignore[arg-type]
    with pytest.raises(ParameterError, match="point of the compass such as SW"):
        airlight.Scene(sun_azimuth="SSX")


def test_the_command_answers_lists_and_ranges_as_a_table(
    sky: MomentsSolution, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["radiance", NAME, "--sun-zenith", "60", "--view-zenith", "0:80:40"]
    words += ["--altitude", "0m,2km", "--wavelengths", "rgb", "--quality", "preview"]
    assert main(words) == 0
    header, *rows = capsys.readouterr().out.splitlines()
    assert header.startswith("altitude_m,sun_zenith_deg,view_zenith_deg,azimuth_deg,radiance_680nm")
    table = np.array([[float(cell) for cell in row.split(",")] for row in rows])
    assert_array_equal(table[:, 0], [0.0, 0.0, 0.0, 2e3, 2e3, 2e3])
    assert_array_equal(table[:, 2], [0.0, 40.0, 80.0, 0.0, 40.0, 80.0])
    altitude, sun, view, azimuth = table[:, :4].T
    expected = sky.radiance(altitude=altitude, sun_zenith=sun, view_zenith=view, azimuth=azimuth)
    assert_allclose(table[:, 4:], expected, rtol=1e-8)  # nine digits are written


def test_commands_begin_with_the_observer_of_a_scene(tmp_path: Path) -> None:
    default = airlight.Scene()
    placed = PlaceOptions().scene(airlight.load_planet(NAME))
    for name in ("altitude", "latitude", "longitude", "sun_zenith", "sun_azimuth"):
        assert getattr(placed, name) == getattr(default, name)
    quick = ["--quality", "preview", "--wavelengths", "rgb"]
    assert main(["render", NAME, "-o", str(tmp_path / "a.exr"), "--size", "8x6", *quick]) == 0
    _, texts = read_exr(tmp_path / "a.exr")
    for name in ("altitude", "latitude", "longitude", "sun_zenith", "sun_azimuth"):
        assert texts[f"airlight.{name}"] == default.metadata()[name]
    sky = ["sky", NAME, "-o", str(tmp_path / "s.exr"), "--for", "blender", "--size", "16", *quick]
    assert main(sky) == 0
    reported = json.loads((tmp_path / "s.json").read_text(encoding="utf-8"))
    assert reported["observer"]["altitude_m"] == default.altitude
