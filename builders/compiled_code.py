"""Compile what first commands, windows and notebooks need, so that a wheel brings it along.

``python builders/compiled_code.py`` fills ``src/airlight/compiled``, in a few minutes; then
``python -m build --wheel`` makes a wheel for this system, this version of Python and processors
with the features of ``airlight.kernel.prebuilt_cache``. A changed source file, and another version
of Numba, leave code unused: the folder is made anew each time.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from airlight.kernel.prebuilt_cache import PREBUILT, copy_machine_code, target

#: Code of pictures that are drawn, and that a window draws.
LOOPS = (
    "from airlight.render.background_compilation import compile_cloudy_loops, compile_loops\n"
    "from airlight.image.exposure import eased\n"
    "compile_loops()\n"
    "compile_cloudy_loops()\n"
    "eased(0.0, 1.0, 0.1, 0.4)\n"
)
#: Commands, of small size, whose code is shipped.
COMMANDS = (
    "render earth --size 32x18 -o a.png",
    "render earth --size 32x18 --exact -o a.png",
    "render mars --size 32x18 --altitude 400km -o a.png",
    "render titan --size 32x18 --quality preview -o a.png",
    "render venus --size 32x18 --quality preview -o a.png",
    "render earth-hazy --size 32x18 --quality preview --polariser 30 -o a.png",
    "render earth --size 320x180 --clouds cumulus --altitude 2m -o a.png",
    "plot earth sky-profile --quality preview -o a.png",
    "export-page earth --quality preview -o a.html",
    "radiance earth --quality preview --sun-zenith 60 --view-zenith 30 --stokes",
    "sky earth --quality preview --size 64 --for blender -o a.exr",
    "bake earth --quality preview --layout bruneton --size 8x16x8x4 -o tables",
)


def main() -> None:
    """Compile in an empty cache, for the target's features, and copy what Python calls."""
    made_for = target()
    if made_for is None:
        sys.exit("no target in airlight.kernel.prebuilt_cache runs on this CPU")
    shutil.rmtree(PREBUILT, ignore_errors=True)
    with tempfile.TemporaryDirectory() as place:
        cache = Path(place) / "cache"
        own = {
            "AIRLIGHT_CACHE": str(cache),
            "NUMBA_CPU_NAME": made_for.cpu,
            "NUMBA_CPU_FEATURES": made_for.written,
            "NUMBA_DISABLE_INTEL_SVML": "1",  # a library that others need not have
        }
        home = {"cwd": place, "env": {**os.environ, **own}, "check": True}
        subprocess.run([sys.executable, "-P", "-c", LOOPS], **home)
        for words in COMMANDS:
            print(f"airlight {words}", flush=True)
            command = "from airlight.cli import run_process; raise SystemExit(run_process())"
            subprocess.run([sys.executable, "-P", "-c", command, *words.split()], **home)
        count = copy_machine_code(cache / "kernels", PREBUILT)
    size = sum(file.stat().st_size for file in PREBUILT.rglob("*") if file.is_file())
    print(f"{PREBUILT}: {count} functions, {size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
