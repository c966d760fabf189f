"""Scales of frames of the page, of devices whose time is proportional to the pixels."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

#: Scales and numbers of strips of frames at rest until the full one, and the scale of a moving one.
RESTING = """(whole) => {
  const scale = new FrameScale(), frames = [];
  do {
    const next = scale.next(true);
    frames.push([next, scale.strips(next, 400)]);
    scale.measured(next, whole * next ** 2);
  } while (scale.drawn < 1);
  return [frames, scale.next(false)];
}"""


@pytest.mark.parametrize(
    ("whole", "frames", "moving"),
    [
        # coarse, then whole at once: 40 ms are allowed while something moves
        (10.0, [[0.2, 1], [1, 1]], 1.0),
        # 0.2 × 2.5 × 2.5 > 1, half a second a strip
        (60_000.0, [[0.2, 1], [0.5, 31], [1, 121]], 0.2),
        # as many strips as rows at most; no time at all is one strip
        (1e6, [[0.2, 1], [0.5, 400], [1, 400]], 0.2),
        (0.0, [[0.2, 1], [1, 1]], 1.0),
    ],
)
def test_frames_at_rest_get_finer_as_the_device_allows(
    whole: float, frames: list[list[float]], moving: float, modules: Callable[..., Any]
) -> None:
    page = modules({"ui/frame_scale": ("FrameScale",)})
    assert page.evaluate(RESTING, whole) == [frames, moving]
