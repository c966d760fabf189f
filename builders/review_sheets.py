"""Contact sheets of about a hundred scenes by default settings, of one version or of two.

    python builders/review_sheets.py after
    PYTHONPATH=../old/src python builders/review_sheets.py before
    python builders/review_sheets.py after --against before --seed 7

Renders the scenes of ``review_scenes.toml`` that the folder lacks, by ``airlight render``, and
writes one sheet per subject. ``--against`` writes sheets of pairs in random order instead, for
readers who must not know which version is which, and ``key.json``, which says it. ``--only``
renders the named subjects or scenes again.
"""

from __future__ import annotations

import argparse
import json
import random
import shlex
import time
import tomllib
from pathlib import Path

from PIL import Image, ImageDraw

from airlight.cli.app import main as airlight

#: Subjects, names and arguments of the scenes.
SOURCE = Path(__file__).with_name("review_scenes.toml")
SCENES = tomllib.loads(SOURCE.read_text("utf-8"))
#: Pictures in a row of a sheet, their height there, and the height of a label. [pixel]
COLUMNS, HIGH, LABEL = 3, 360, 22
#: Size of a picture whose scene states none.
SIZE = "960x540"


def render(arguments: str, target: Path, size: str) -> None:
    """Render one scene.

    Parameters
    ----------
    arguments : str
        Arguments of ``airlight render``.
    target : Path
        PNG to write.
    size : str
        Size of a picture whose scene states none.
    """
    words = shlex.split(arguments)
    if "--size" not in words:
        words += ["--size", size]
    if airlight(["render", *words, "-o", str(target)]):
        print(f"{target.stem}: not rendered")


def scaled(file: Path) -> Image.Image:
    """Picture in the height of a sheet's row."""
    picture = Image.open(file).convert("RGB")
    wide = round(picture.width * HIGH / picture.height)
    return picture.resize((wide, HIGH), Image.Resampling.LANCZOS)


def sheet(rows: list[list[tuple[str, Path]]], target: Path) -> None:
    """Sheet of labelled pictures.

    Parameters
    ----------
    rows : list of lists of (str, Path)
        Labels and pictures.
    target : Path
        PNG to write.
    """
    pictures = [[(label, scaled(file)) for label, file in row] for row in rows]
    wide = max(sum(picture.width + 4 for _, picture in row) for row in pictures)
    page = Image.new("RGB", (wide, len(rows) * (HIGH + LABEL)), (24, 24, 24))
    pen = ImageDraw.Draw(page)
    for number, row in enumerate(pictures):
        left, top = 0, number * (HIGH + LABEL)
        for label, picture in row:
            page.paste(picture, (left, top))
            pen.text((left + 6, top + HIGH + 5), label, (220, 220, 220))
            left += picture.width + 4
    page.save(target)


def main() -> None:
    """Render the scenes and write the sheets."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", nargs="*", default=[], help="subjects, or scenes as SUBJECT-NAME")
    parser.add_argument("--size", default=SIZE, help="of pictures whose scene states none")
    parser.add_argument("--against", type=Path, help="folder of the other version's pictures")
    parser.add_argument("--seed", type=int, default=0, help="of the random order")
    given = parser.parse_args()
    known = {*SCENES, *(f"{subject}-{name}" for subject, some in SCENES.items() for name in some)}
    if unknown := set(given.only) - known:
        parser.error(f"--only: unknown {', '.join(sorted(unknown))}; see {SOURCE.name}")
    given.folder.mkdir(parents=True, exist_ok=True)
    order, key = random.Random(given.seed), {}
    for subject, scenes in SCENES.items():
        shown = []
        for name, arguments in scenes.items():
            label = f"{subject}-{name}"
            file = given.folder / f"{label}.png"
            anew = {subject, label} & set(given.only)
            if anew or not (file.is_file() or given.only):
                started = time.perf_counter()
                render(arguments, file, given.size)
                print(f"{label}: {time.perf_counter() - started:.1f} s", flush=True)
            other = given.against / file.name if given.against else file
            if not (file.is_file() and other.is_file()):
                continue
            if given.against is None:
                shown.append((label, file))
                continue
            pair = [("after", file), ("before", other)]
            order.shuffle(pair)
            key[label] = [version for version, _ in pair]
            shown += [(f"{label}, {side}", at) for side, (_, at) in zip("AB", pair, strict=True)]
        columns = COLUMNS if given.against is None else 2
        rows = [shown[at : at + columns] for at in range(0, len(shown), columns)]
        if rows:
            sheet(rows, given.folder / f"{'pairs' if given.against else 'sheet'}-{subject}.png")
    if key:
        (given.folder / "key.json").write_text(json.dumps(key, indent=1), "utf-8")


if __name__ == "__main__":
    main()
