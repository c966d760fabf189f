"""Remake ``docs/images/options``: what options of ``airlight render`` change.

Run with ``python builders/option_pictures.py`` and look at the pictures. The page of commands shows
each beside its option.
"""

from __future__ import annotations

import shlex
import sys
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "docs" / "_site"))

from command_pictures import BASES, FOLDER, OPTIONS  # noqa: E402

from airlight.cli import main as airlight  # noqa: E402


def main() -> None:
    """Render all, or those of the options named."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        for (command, option), words in OPTIONS.items():
            if sys.argv[1:] and option not in sys.argv[1:]:
                continue
            pictures = []
            for change in ("", words):
                path = Path(folder) / f"{len(pictures)}.png"
                line = f"{command} {BASES[command]} {change} --quality preview -o {path}"
                airlight(shlex.split(line))
                pictures.append(Image.open(path).convert("RGB"))
            height = pictures[0].height
            wide = [one.resize((one.width * height // one.height, height)) for one in pictures]
            both = Image.new("RGB", (sum(one.width for one in wide) + 4, height), "white")
            both.paste(wide[0], (0, 0))
            both.paste(wide[1], (wide[0].width + 4, 0))
            both.save(FOLDER / f"{command}{option}.jpg", quality=85)


if __name__ == "__main__":
    main()
