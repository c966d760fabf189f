"""``airlight render`` with a scene file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from airlight.cli import main

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
        (["--altitude", "3km"], "--altitude is '3km'; allowed: none beside a scene file"),
        (["--projection", "fisheye"], "--projection is 'fisheye'; allowed: none beside"),
        (["--wavelengths", "rgb"], "--wavelengths is 'rgb'; allowed: none for a scene without air"),
        (["--exact"], "--exact is True"),
        (["--samples", "99"], "samples is 99; allowed: 1 to 16"),
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
