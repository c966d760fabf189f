"""What a newcomer meets at the Python prompt: names, text with units, and what things say."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

import airlight
from airlight.solver.moments.solution import MomentsSolution


def test_the_package_lists_its_public_names_and_nothing_else() -> None:
    assert dir(airlight) == sorted(airlight.__all__)
    for name in airlight.__all__:
        assert getattr(airlight, name) is not None
    assert {"bake", "load_tables", "solve", "render"} <= set(dir(airlight))


def test_solve_takes_a_preset_by_name_and_a_file_by_path(tmp_path: Path) -> None:
    named = airlight.solve("earth-bruneton", [550.0], "preview")
    assert named.planet == airlight.load_planet("earth-bruneton")
    with pytest.raises(airlight.AirlightError, match="no-such-planet"):
        airlight.solve("no-such-planet")
    with pytest.raises(airlight.AirlightError, match=r"gone\.toml"):
        airlight.solve(tmp_path / "gone.toml")
    with pytest.raises(airlight.ParameterError, match=r"planet is 5; allowed: a Planet"):
        airlight.solve(5)  # type: ignore[call-overload]


def test_scenes_and_cameras_take_text_with_a_unit() -> None:
    scene = airlight.Scene(altitude="400 km", camera=airlight.Camera(field_of_view="1 rad"))
    assert scene.altitude == 400e3
    assert scene.camera.field_of_view == pytest.approx(57.29578)
    with pytest.raises(airlight.ParameterError, match=r"scene\.altitude"):
        airlight.Scene(altitude="400 deg")


def test_things_say_what_they_are_on_one_line(
    solved: Callable[..., MomentsSolution],
) -> None:
    planet = airlight.load_planet("earth-bruneton")
    solution = solved(planet, (680.0, 550.0, 440.0), "preview")
    scene = airlight.Scene(camera=airlight.Camera(width=8, height=4))
    frame = airlight.render(solution, scene)
    for thing, words in (
        (planet, ("Planet", planet.name, "6360 km")),
        (solution, ("MomentsSolution", planet.name, "3 wavelengths", "440 to 680 nm")),
        (solution.medium, ("Medium", *solution.medium.names)),
        (frame, ("Frame", "8 x 4")),
    ):
        text = repr(thing)
        assert "\n" not in text
        assert len(text) < 200
        for word in words:
            assert word in text
