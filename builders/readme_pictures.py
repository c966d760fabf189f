"""Remake the pictures of the README and the front page of the docs: ``docs/images/*.png``.

Run with ``python builders/readme_pictures.py``, or with the names of the pictures wanted; it needs
airlight alone. Each is what one ``airlight render`` draws; ``earth`` is the README's first command,
kept as JPEG, and ``gpu-pictures`` the five of docs/live.md on one sheet, which need a graphics
device.
"""

from __future__ import annotations

import argparse
import subprocess
import tempfile
from pathlib import Path
from shutil import which

from PIL import Image

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "docs" / "images"
_EGYPT = "--latitude 25 --longitude 30 --sun-azimuth"
_LOW_SUN = (
    "--altitude 2m --look 89.7,0 --fov 2 --sun-zenith 90.2 --exposure -6 --size 480x270 "
    f"{_EGYPT} 105"
)
#: Arguments of ``airlight render`` by the picture's name.
PICTURES = {
    "earth-terminator": "earth --altitude 400km --look 108,-62 --fov 75 --sun-zenith 91 "
    "--latitude 25 --longitude 45 --sun-azimuth 265 --size 960x540",
    "sunset": "earth --altitude 2m --look 84,12 --fov 65 --sun-zenith 88.6 "
    "--latitude 43.5 --longitude 8 --sun-azimuth 240 --size 960x540",
    "limb-35km": "earth --altitude 35km --look 93,-110 --fov 80 --sun-zenith 65 "
    "--latitude 33 --longitude -104 --sun-azimuth 120 --size 960x540",
    "mars": "mars --altitude 2m --look 88,84 --fov 60 --sun-zenith 65 --size 960x540",
    "stockholm": "earth --at 59.33N,18.07E --time 2026-06-21T22:10+02:00 --look-at sun "
    "--size 960x540",
    "gale": "mars --at 4.59S,137.44E --ls 250 --time sunset --look-at sun --fov 50 --size 960x540",
    "cumulus": "earth --clouds cumulus --altitude 2m --sun-zenith 60 --size 960x540",
    "cumulus-evening": "earth --clouds cumulus --altitude 2m --sun-zenith 85 --size 960x540",
    "sunset-straight": f"earth {_LOW_SUN} --set refraction=none",
    "sunset-bent": f"earth {_LOW_SUN}",
}
#: Picture of README's first command.
EARTH = (
    "earth --altitude 1200km --look 129,-58 --sun-zenith 74 "
    "--latitude 34 --longitude 14 --sun-azimuth 110"
)
#: The five of docs/live.md, row by row.
DEVICE = (
    "earth --altitude 2m --look 82,-60 --sun-zenith 60 --latitude 43 --longitude 12",
    f"earth --altitude 35km --look 93,-40 --sun-zenith 75 {_EGYPT} 105",
    f"earth --altitude 400km --sun-zenith 80 {_EGYPT} 105",
    f"earth --altitude 20000km --look 180,180 --sun-zenith 50 --fov 60 {_EGYPT} 180",
    "mars --altitude 2m --look 80,0 --sun-zenith 86 --fov 70 --exposure -4",
)
#: Columns of that sheet, size of a picture there, and the gap between two. [pixel]
COLUMNS, SIZE, GAP = 2, (400, 225), 4


def rendered(arguments: str, file: Path) -> None:
    """Draw one picture by the command line."""
    program = which("airlight")
    assert program is not None, "airlight is not on the path"
    subprocess.run([program, "render", *arguments.split(), "-o", str(file)], check=True)


def device_sheet(folder: Path) -> Image.Image:
    """Sheet of the pictures of the graphics device."""
    (width, height), rows = SIZE, -(-len(DEVICE) // COLUMNS)
    across, down = COLUMNS * (width + GAP) - GAP, rows * (height + GAP) - GAP
    sheet = Image.new("RGB", (across, down), "white")
    for at, arguments in enumerate(DEVICE):
        file = folder / f"{at}.png"
        rendered(f"{arguments} --device gpu --size 480x270", file)
        row, column = divmod(at, COLUMNS)
        one = Image.open(file).convert("RGB").resize(SIZE, Image.Resampling.LANCZOS)
        alone = at == len(DEVICE) - 1 and column == 0
        left = (across - width) // 2 if alone else column * (width + GAP)
        sheet.paste(one, (left, row * (height + GAP)))
    return sheet


def main() -> None:
    """Draw the pictures wanted."""
    names = [*PICTURES, "earth", "gpu-pictures"]
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"{', '.join(names)} (all)")
    wanted = parser.parse_args().names or names
    unknown = sorted(set(wanted) - set(names))
    if unknown:
        parser.error(f"no picture is named {', '.join(unknown)}")
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for name in wanted:
            if name in PICTURES:
                rendered(PICTURES[name], FOLDER / f"{name}.png")
            elif name == "earth":
                rendered(EARTH, folder / "earth.png")
                Image.open(folder / "earth.png").convert("RGB").save(
                    FOLDER / "earth.jpg", quality=95
                )
            else:
                device_sheet(folder).save(FOLDER / "gpu-pictures.png")
            print(name)


if __name__ == "__main__":
    main()
