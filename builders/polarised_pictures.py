"""Draw the pictures of docs/polarisation.md: ``docs/images/polarisation``.

Run with ``python builders/polarised_pictures.py``, or with the names of the pictures wanted. Each
is what ``airlight render`` or ``airlight plot`` draws, one or two side by side; needs matplotlib.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path
from shutil import which

from PIL import Image

FOLDER = Path(__file__).parents[1] / "docs" / "images" / "polarisation"
_PLACE = "--latitude 25 --longitude 30 --sun-azimuth 105"
_DOME = f"render earth --altitude 2m {_PLACE} --projection fisheye --size 460 --show"
_BESIDE = (
    f"render earth --altitude 2m {_PLACE} --sun-zenith 80 --look 78,90 --fov 70 --size 480x360"
)
_SPACE = (
    f"render earth --altitude 20000km {_PLACE} --look-at nadir --fov 33 --sun-zenith 55 "
    "--size 460x460"
)
#: Arguments of ``airlight`` by the name of the file.
PICTURES: dict[str, tuple[str, ...]] = {
    "domes.png": (f"{_DOME} dolp --sun-zenith 60", f"{_DOME} dolp --sun-zenith 90"),
    "angle.png": (f"{_DOME} aolp --sun-zenith 60", f"{_DOME} aolp --sun-zenith 90"),
    "filter.jpg": tuple(f"{_BESIDE} --exposure -3.6 --polariser {a}deg" for a in (0, 90)),
    "space.png": (f"{_SPACE} --show dolp", _SPACE),
    "neutral-points.png": (
        "plot earth polarisation-plane --sun-zenith 70 --wavelengths 680,550,440 --dpi 110",
    ),
    "sky.png": ("plot earth polarisation-dome --sun-zenith 60 --dpi 110",),
}
#: Space between two pictures. [pixel]
GAP = 8


def drawn(arguments: str, file: Path) -> Image.Image:
    """Picture that a command draws."""
    program = which("airlight")
    assert program is not None, "airlight is not on the path"
    subprocess.run([program, *arguments.split(), "-o", str(file)], check=True)
    with Image.open(file) as image:
        return image.convert("RGB")


def side_by_side(pictures: list[Image.Image]) -> Image.Image:
    """Pictures in a row, on black."""
    width = sum(one.width for one in pictures) + GAP * (len(pictures) - 1)
    whole = Image.new("RGB", (width, max(one.height for one in pictures)))
    left = 0
    for one in pictures:
        whole.paste(one, (left, 0))
        left += one.width + GAP
    return whole


if __name__ == "__main__":
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[1:] or PICTURES:
        with tempfile.TemporaryDirectory() as folder:
            found = [
                drawn(arguments, Path(folder) / f"{number}.png")
                for number, arguments in enumerate(PICTURES[name])
            ]
        side_by_side(found).save(FOLDER / name, quality=90)
