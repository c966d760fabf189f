"""Window on a scene of several bodies: flown, edited, saved by mouse and keys, and closed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NoReturn

import numpy as np
import pytest
from driven_window import Driven, missing, opened_window
from numpy.testing import assert_allclose
from PIL import Image


@pytest.fixture(scope="module")
def scene(
    tmp_path_factory: pytest.TempPathFactory, lacking: Callable[[str], NoReturn]
) -> Iterator[Driven]:
    reason = missing()
    if reason:
        lacking(reason)
    folder = tmp_path_factory.mktemp("scene")
    # without LLVM's optimisation: the shaders of two devices are compiled, for some small pictures
    with opened_window(folder, "mars-phobos", GALLIVM_PERF="nopt") as driven:
        yield driven


def pressed(window: Driven, key: str, path: str) -> float:
    """New value after a key is down until the value changes."""
    before = window.ask("value", path)
    window.mouse("mousemove", 600, 200, "sleep", 0.1, "keydown", key)
    window.until(lambda: window.ask("value", path) != before, of=key)
    window.mouse("keyup", key)
    return float(window.ask("value", path))


def shown(window: Driven) -> np.ndarray:
    """Displayed picture at rest. [1/255]"""
    window.mouse("mousemove", 100, 475)
    assert window.ask("settled", 240.0), window.ask("error")
    assert window.ask("draws", 3)
    assert window.ask("error") == ""
    return window.picture_pixels()


def test_a_scene_is_flown_edited_and_undone(scene: Driven) -> None:
    first = shown(scene)
    assert first.max() > 60
    heading = scene.ask("value", "view.heading")
    pressed(scene, "l", "view.heading")
    assert np.abs(shown(scene) - first).max() > 20  # another part of the scene
    scene.mouse("key", "ctrl+z")
    scene.until(lambda: scene.ask("value", "view.heading") == heading)
    assert_allclose(shown(scene), first, atol=1)

    altitude = scene.ask("value", "view.altitude")
    scene.mouse("mousemove", 600, 200, "sleep", 0.2, "click", 5)
    scene.until(lambda: scene.ask("value", "view.altitude") > altitude)
    scene.mouse("key", "ctrl+z")
    scene.until(lambda: scene.ask("value", "view.altitude") == altitude)

    depth = scene.ask("picture")["depth"]
    (left, top, right, bottom), before = scene.ask("located", "air.ground", "air.ground")
    scene.press(left + 0.9 * (right - left), 0.5 * (top + bottom))
    scene.mouse("mouseup", 1)
    scene.until(lambda: scene.ask("value", "air.ground") != before)
    scene.ask("find", "")
    brighter = shown(scene)
    assert np.abs(brighter - first).max() > 5
    assert scene.ask("picture")["depth"] == depth
    scene.mouse("mousemove", 600, 200, "sleep", 0.1, "key", "ctrl+z")
    scene.until(lambda: scene.ask("value", "air.ground") == before)
    assert_allclose(shown(scene), first, atol=1)


def test_the_saved_picture_of_a_scene_is_the_displayed_one(scene: Driven, tmp_path: Path) -> None:
    # The CPU's picture of the same solutions; of the pixels on the edges of bodies some differ.
    scene.mouse("mousemove", 600, 200, "sleep", 0.1, "key", "minus")
    scene.until(lambda: scene.ask("value", "display.exposure") != 0.0)
    displayed, path = shown(scene), tmp_path / "scene.png"
    scene.mouse("mousemove", 600, 200, "sleep", 0.1, "key", "ctrl+s")
    scene.until(lambda: scene.ask("typing"))
    scene.mouse("key", "ctrl+a", "type", "--delay", 30, str(path))
    scene.mouse("key", "Return")
    scene.until(path.exists, 120.0)
    saved = np.asarray(Image.open(path).convert("RGB"), int)
    assert saved.shape == displayed.shape
    off = np.abs(saved - displayed).max(axis=2)
    assert np.mean(off > 2) < 0.01, np.percentile(off, [50, 90, 99, 100])


def test_a_window_on_a_scene_ends_with_all_its_threads(scene: Driven) -> None:
    scene.mouse("mousemove", 600, 200, "sleep", 0.2, "key", "ctrl+q")
    reply = scene.answer()
    assert reply == {"ended": True, "threads": [name for name in reply["threads"] if "_" in name]}
    assert scene.process.wait(timeout=60) == 0
    assert "Traceback" not in scene.log.read_text()
