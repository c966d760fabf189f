"""Remake ``src/airlight/viewer/gallery/thumbnails/*.webp`` and ``docs/presets.md``.

Run with ``python builders/preset_thumbnails.py``, or with the names of the presets wanted; it needs
airlight itself and nothing else. Each preset is rendered in the view that
``viewer/gallery/presets.py`` declares for it, four times as many pixels as are kept, by the default
solver, renderer and display, with automatic exposure. With ``--page`` only the page is written.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

from PIL import Image

from airlight import load_planet, write_picture
from airlight.planets import Planet
from airlight.render.render_scene import render_scene
from airlight.viewer.gallery.presets import HEIGHT, PRESETS, WIDTH, Preset, families

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "src" / "airlight" / "viewer" / "gallery" / "thumbnails"
PAGE = ROOT / "docs" / "presets.md"
#: Largest file. [byte]
LARGEST = 8000
#: Pixels per side of the rendered picture for one that is kept.
FINER = 2
#: Words above the presets of a kind, on the page.
KINDS = {"reference": "", "variation": "", "literature": "Models of the literature"}


def rendered(preset: Preset, planet: Planet, quality: str) -> Image.Image:
    """Small picture of a preset."""
    scene = preset.look.scene(planet, FINER * WIDTH, FINER * HEIGHT)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "picture.png"
        frame = render_scene(planet, scene, quality=quality)
        write_picture(
            file, frame.rgb, exposure=frame.exposure, eye=True, pixel_angle=frame.pixel_angle
        )
        with Image.open(file) as picture:
            return picture.convert("RGB").resize((WIDTH, HEIGHT), Image.Resampling.BOX)


def keep(preset: Preset, picture: Image.Image) -> None:
    """Write the picture of a preset in the best quality that its size allows."""
    file = FOLDER / f"{preset.name}.webp"
    for quality in range(92, 20, -4):
        picture.save(file, quality=quality, method=6)
        if file.stat().st_size <= LARGEST:
            break
    print(f"{file.name}  {file.stat().st_size / 1e3:.1f} kB  quality {quality}", flush=True)


def page() -> str:
    """Text of ``docs/presets.md``."""
    lines = [
        "# Gallery of the presets",
        "",
        "All planets that come with airlight, as the window's gallery shows them (`G`). Pictures",
        "by `python builders/preset_thumbnails.py`, which writes this too; what each planet is:",
        "[planets that come with airlight](planets.md), `airlight show NAME`.",
    ]
    for family, presets in families().items():
        lines += ["", f"## {family}"]
        for kind, words in KINDS.items():
            some = [one for one in presets if one.kind == kind]
            if not some:
                continue
            lines += ["", *([f"### {words}", ""] if words and family == "Earth" else [])]
            lines += [
                "| | | |",
                "|---|---|---|",
                *(_row(some[at : at + 3]) for at in range(0, len(some), 3)),
            ]
    return "\n".join(lines) + "\n"


def _row(some: list[Preset]) -> str:
    cells = [
        f"![{one.label}](../src/airlight/viewer/gallery/thumbnails/{one.name}.webp)"
        f"<br>{one.label}<br>`{one.name}`"
        for one in some
    ]
    return f"| {' | '.join(cells + [''] * (3 - len(cells)))} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    names = [one.name for one in PRESETS]
    parser.add_argument("names", nargs="*", metavar="PRESET", help=", ".join(names))
    parser.add_argument("--page", action="store_true", help="only the page, no picture")
    parser.add_argument("--preview", action="store_true", help="quicker and coarser")
    chosen = parser.parse_args()
    quality = "preview" if chosen.preview else "default"
    PAGE.write_text(page(), encoding="utf-8")
    FOLDER.mkdir(parents=True, exist_ok=True)
    for preset in () if chosen.page else PRESETS:
        if preset.name in (chosen.names or names):
            keep(preset, rendered(preset, load_planet(preset.name), quality))


if __name__ == "__main__":
    main()
