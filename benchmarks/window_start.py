"""Time from the start of the window's process to its first frame and to its pictures.

    python benchmarks/window_start.py             # warm: code and solution are on disk
    python benchmarks/window_start.py --cold      # with an empty AIRLIGHT_CACHE
    python benchmarks/window_start.py mars --runs 5

Each run is a process of its own; the window is drawn offscreen, in the size of a new window.
``frame`` is the first that shows anything, the preset's small picture; ``picture`` is the first
of this planet and view, ``whole`` the first of the window's size, ``finished`` the last, ``rest``
when no shader is compiled any more either. All since the start of the process, with its CPU time
(without that of a second process that compiles) and its resident memory (Linux). Medians of the
runs.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from statistics import median

SIZE = (1280, 720)
STAGES = ("frame", "picture", "whole", "finished", "rest")
#: What runs in the new process, with the time of the request as its first argument.
CHILD = f"""
import json, sys, threading, time
from pathlib import Path
asked, planet = float(sys.argv[1]), sys.argv[2]
from airlight.viewer.window import start as starting
from airlight.viewer.window.canvas import OffscreenCanvas
from airlight.viewer.window.window import Window
said = {{}}
def say(stage):
    status = Path("/proc/self/status")
    kilobytes = status.read_text().split("VmRSS:")[1].split()[0] if status.exists() else "nan"
    said.setdefault(stage, (time.time() - asked, time.process_time(), float(kilobytes) / 1024.0))
start = starting.Start(planet=planet, size={SIZE})
session, canvas = starting.opened(start), OffscreenCanvas(start.size)
window = starting.window_of(start, session, canvas)
lines = []
while not window.settled or canvas.wanted:
    if not canvas.wanted:
        time.sleep(0.02)
        continue
    canvas.run(window.draw)
    say("frame")
    shown = window.shown()
    if shown is None:
        line = window.progress
        if not lines or lines[-1][1] != line:
            lines.append((round(time.time() - asked, 1), line))
    else:
        say("picture")
        if shown.width > 0.6 * start.size[0]:
            say("whole")
say("finished")
while any(one.name == "airlight-compiling" for one in threading.enumerate()):
    time.sleep(0.05)
    if canvas.wanted:
        canvas.run(window.draw)
say("rest")
window.close()
print(json.dumps({{"said": said, "lines": lines}}))
"""


def run(planet: str, cold: bool, verbose: bool) -> dict[str, tuple[float, float, float]]:
    """Times of one start by the clock and of the CPU [s], and resident memory [MiB]."""
    environment = dict(os.environ)
    folder = tempfile.mkdtemp() if cold else ""
    if cold:
        environment["AIRLIGHT_CACHE"] = folder
    try:
        done = subprocess.run(
            [sys.executable, "-P", "-c", CHILD, str(time.time()), planet], env=environment,
            check=True, stdout=subprocess.PIPE, text=True,
        )  # fmt: skip
    finally:
        if cold:
            shutil.rmtree(folder, ignore_errors=True)
    answer = json.loads(done.stdout)
    for at, line in answer["lines"] if verbose else ():
        print(f"{at:7.1f}  {line}")
    said: dict[str, tuple[float, float, float]] = answer["said"]
    return said


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("planet", nargs="?", default="earth")
    parser.add_argument("--cold", action="store_true", help="with nothing on disk")
    parser.add_argument("--runs", type=int, default=1)
    parser.add_argument("--verbose", action="store_true", help="with the lines of progress")
    asked = parser.parse_args()
    times = [run(asked.planet, asked.cold, asked.verbose) for _ in range(asked.runs)]
    for stage in STAGES:
        clock, processor, size = (median(one[stage][k] for one in times) for k in (0, 1, 2))
        print(f"{stage:10} {clock:7.2f} s   processor {processor:7.2f} s   {size:6.0f} MiB")


if __name__ == "__main__":
    main()
