"""``airlight view``: its help, its refusals in one line, and a picture of the window."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from airlight.cli import main


def error_line(capsys: pytest.CaptureFixture[str]) -> str:
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("airlight: ")
    assert captured.err.count("\n") == 1
    return captured.err


def test_help_names_every_option_of_the_view(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["view", "--help"]) == 0
    out = capsys.readouterr().out
    for option in ("--altitude", "--look-at", "--sun-zenith", "--fov", "--projection", "--size",
                   "--exposure", "--tone-map", "--compare", "--screenshot", "--set"):  # fmt: skip
        assert option in out
    assert "$ airlight view earth" in out


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (["nowhere"], "nowhere"),
        (["earth", "--size", "10x10"], "--size is '10x10'; allowed: sides of 320 to 8192 pixels"),
        (
            ["earth", "--look", "85,0", "--look-at", "sun"],
            "--look cannot be combined with --look-at",
        ),
        (["earth", "--altitude", "5 kg"], "--altitude"),
        (["earth", "--sun-zenith", "200"], "view.sun_zenith is 200.0; allowed: 0 to 180 deg"),
        (["earth", "--tone-map", "rosy"], "--tone-map is 'rosy'; allowed: natural"),
        (["earth", "--set", "air.colour=1"], "a key of constituents[0] is 'colour'"),
        (["earth", "--screenshot", "window.jpg"], "window.jpg: the name of a screenshot ends in"),
        (["earth", "--screenshot", "no/such/window.png"], "no/such"),
    ],
)
def test_mistakes_are_refused_in_one_line(
    words: list[str], part: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["view", *words]) == 2
    assert part in error_line(capsys)


def test_without_the_extra_one_line_says_what_to_install(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("glfw", "rendercanvas", "rendercanvas.glfw"):
        monkeypatch.setitem(sys.modules, name, None)
    assert main(["view", "earth"]) == 2
    assert "pip install 'airlight[view]'" in error_line(capsys)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="DISPLAY is X11's")
def test_without_a_display_one_line_says_so(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("glfw")
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "XDG_RUNTIME_DIR"):
        monkeypatch.delenv(name, raising=False)
    assert main(["view", "earth"]) == 2
    assert "no display for a window: is DISPLAY set?" in error_line(capsys)


def test_a_screenshot_shows_panel_and_planet(
    tmp_path: Path, device: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    # From 400 km, looking at the horizon: dark space above, the lit planet below, panel at left.
    pytest.importorskip("imgui_bundle")
    file = tmp_path / "window.png"
    words = ["view", "earth-atmosphere-plus", "--altitude", "400km", "--quality", "preview"]
    assert main([*words, "--size", "900x500", "--screenshot", str(file)]) == 0
    assert capsys.readouterr().out.startswith(f"{file}  900x500  ")
    pixels = np.asarray(Image.open(file).convert("RGB")).astype(float)
    assert pixels.shape == (500, 900, 3)
    space, planet, panel = pixels[20:60, 500:], pixels[380:460, 500:], pixels[100:450, 20:360]
    assert space.mean() < 3.0
    assert planet.mean() > 60.0
    assert planet[..., 2].mean() > planet[..., 0].mean()  # blue air
    assert 20.0 < panel.mean() < 80.0
    assert panel.max() > 200.0  # text
