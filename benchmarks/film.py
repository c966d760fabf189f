"""Time of a film of a sunset, from the start of the command to its last frame.

    python benchmarks/film.py                    # 60 frames of 960 x 540, a process for each core
    python benchmarks/film.py --workers 1 4      # in one process, then with four
    python benchmarks/film.py --frames 20 --size 480x270 --cold

The compiled code is on disk, and so is the solution unless ``--cold`` takes it away. Each run is a
process of its own with its own folder of frames. The machine's load before the run is said, and the
CPU time of the command and its processes, which other work on the machine lengthens less.
The frames of all runs are compared byte by byte.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

CODE = "import sys; from airlight.cli import main; sys.exit(main(sys.argv[1:]))"


def run(
    folder: Path, frames: int, size: str, workers: int | None, quality: str
) -> tuple[float, float]:
    """Clock and CPU time of one film. [s]"""
    words = [
        "animate", "earth", "--frames", str(frames), "--size", size, "--quality", quality,
        "--key", "view.sun_zenith=84deg,97deg", "--set", "view.look_zenith=85deg",
        "--set", "view.look_azimuth=20deg", "-o", str(folder),
    ]  # fmt: skip
    words += [] if workers is None else ["--workers", str(workers)]
    before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(
        [sys.executable, "-P", "-c", CODE, *words], check=True, stdout=subprocess.DEVNULL
    )
    seconds = time.perf_counter() - started
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds, used


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--frames", type=int, default=60)
    parser.add_argument("--size", default="960x540")
    parser.add_argument("--quality", default="default")
    parser.add_argument("--workers", type=int, nargs="*", default=[None])
    parser.add_argument("--cold", action="store_true", help="without the solution on disk")
    given = parser.parse_args()
    from airlight.kernel import cache_folder

    digests = set()
    for workers in given.workers:
        with tempfile.TemporaryDirectory() as folder:
            if given.cold:
                shutil.rmtree(cache_folder() / "solutions", ignore_errors=True)
            load = os.getloadavg()[0]
            frames = Path(folder) / "frames"
            seconds, used = run(frames, given.frames, given.size, workers, given.quality)
            again, _ = run(frames, given.frames, given.size, workers, given.quality)
            files = sorted(frames.glob("*.png"))
            content = hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()
            digests.add(content)
            print(
                f"workers {workers or 'by default'}: {len(files)} frames of {given.size} in "
                f"{seconds:.1f} s, {used:.1f} s of CPU, {used / given.frames:.2f} a frame; "
                f"started again {again:.1f} s; load before {load:.1f}; {content[:12]}",
                flush=True,
            )
    if len(digests) > 1:
        raise SystemExit("the frames of these runs differ")


if __name__ == "__main__":
    main()
