"""Three-dimensional clouds in a real window, by mouse and keys."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NoReturn

import numpy as np
import pytest
from driven_window import missing, opened_window

COVER = "clouds[0].cover"


@pytest.mark.slow
def test_clouds_follow_a_slider_are_those_of_the_cpu_and_go_away(
    tmp_path: Path, lacking: Callable[[str], NoReturn]
) -> None:
    # Reference: the still picture of the CPU, within the bounds of pictures from the ground by a
    # device (tests/render/gpu/test_cloudy_pictures.py): 94 % within 2/255, 12/255 at most.
    reason = missing()
    if reason:
        lacking(reason)
    kinds = ("clouds=[{kind='stratus', cover=0.5}]",)
    with opened_window(tmp_path, "earth-atmosphere-plus", (640, 300), kinds) as driven:
        assert driven.ask("clouds") == {"cover": 0.5, "detail": "live", "by": "CPU"}
        before = driven.picture_pixels()
        (left, top, right, bottom), _ = driven.ask("located", "cover", COVER)
        middle, width = 0.5 * (top + bottom), right - left
        driven.press(left + 0.5 * width, middle)
        driven.mouse("mousemove", int(left + 0.7 * width), int(middle), "sleep", 0.2)
        driven.mouse("mousemove", int(left + 0.9 * width), int(middle), "sleep", 0.2)
        driven.mouse("mouseup", 1, "mousemove", int(right), 290)  # no tooltip over the picture
        driven.until(lambda: driven.ask("value", COVER) > 0.8)
        assert driven.ask("settled", 240.0), driven.ask("error")
        cover = driven.ask("value", COVER)
        assert driven.ask("clouds") == {"cover": cover, "detail": "live", "by": "CPU"}
        driven.ask("draws", 3)
        seen = driven.picture_pixels()
        assert np.abs(seen - before).max(axis=2).mean() > 5.0
        assert driven.ask("cpu_picture", str(tmp_path / "cpu.npy"))
        wanted = np.load(tmp_path / "cpu.npy").astype(int)
        assert seen.shape == wanted.shape
        off = np.abs(seen - wanted).max(axis=2)
        assert (off <= 2).mean() >= 0.94
        assert off.max() <= 12
        # an undo is one step; then without clouds
        driven.leave_the_field()
        driven.mouse("key", "ctrl+z")
        driven.until(lambda: abs(driven.ask("value", COVER) - 0.5) < 1e-6)
        driven.ask("put", "clouds[0].kind", "none")
        assert driven.ask("settled", 240.0), driven.ask("error")
        assert driven.ask("clouds") == {}
