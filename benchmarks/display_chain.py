"""Time of the display chain, from linear light to 8 bits: ``python benchmarks/display_chain.py``.

Frames are as skies are, by formula, at 1280 × 720. Wall time is of all threads, the other of one
thread's processor for a pixel, which other work on the machine does not change.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray

from airlight.color.display import display_of, display_rows, to_display
from airlight.color.exposure import automatic_exposure
from airlight.color.tone_maps import TONE_MAPS

WIDTH, HEIGHT = 1280, 720
REPEATS = 7


def frames() -> dict[str, NDArray[np.float32]]:
    """Linear frames: a blue sky, a sunset, a limb before space, light beyond sRGB."""
    x, y = np.meshgrid(np.linspace(-1.0, 1.0, WIDTH), np.linspace(1.0, 0.0, HEIGHT))
    sky = (0.4 + np.exp(-4.0 * y))[..., None] * np.array([3.0, 5.0, 9.0])
    sky += np.exp(-8.0 * y)[..., None] * np.array([8.0, 6.0, 2.0])
    glow = np.exp(-3.0 * np.hypot(x, y))[..., None] * np.array([60.0, 18.0, 1.0])
    sunset = glow + (0.3 + y)[..., None] * np.array([0.5, 0.8, 1.6])
    limb = np.where(y[..., None] > 0.4, 0.0, 1.0) * sky
    deep = (0.5 + y)[..., None] * np.array([-0.3, 1.0, 5.0])
    found = {"sky": sky, "sunset": sunset, "limb": limb, "beyond sRGB": deep}
    return {name: frame.astype(np.float32) for name, frame in found.items()}


def shortest(work: Callable[[], object], clock: Callable[[], float]) -> float:
    """Shortest time of several runs. [s]"""
    times = []
    for _ in range(REPEATS):
        began = clock()
        work()
        times.append(clock() - began)
    return min(times)


def main() -> None:
    """Print a line for each frame, and for each tone map."""
    made = frames()
    print(f"{WIDTH} x {HEIGHT}, {os.cpu_count()} processors")
    for name, rgb in made.items():
        exposure = automatic_exposure(rgb)
        wall = shortest(partial(to_display, rgb, exposure), time.perf_counter)
        display = display_of(exposure)
        picture = np.empty(rgb.shape, np.uint8)
        own = shortest(partial(display_rows, rgb, picture, 0, 255.0, display), time.thread_time)
        print(f"{name:12s} {1e3 * wall:6.1f} ms  {1e9 * own / rgb[..., 0].size:5.0f} ns a pixel")
    sky = made["sky"]
    metering = shortest(partial(automatic_exposure, sky), time.perf_counter)
    print(f"exposure of the sky: {1e3 * metering:.1f} ms")
    for tone_map in TONE_MAPS:
        wall = shortest(partial(to_display, sky, -4.0, tone_map), time.perf_counter)
        print(f"{tone_map:18s} {1e3 * wall:6.1f} ms")


if __name__ == "__main__":
    main()
