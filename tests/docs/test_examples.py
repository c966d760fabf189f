"""Each script of the gallery runs as it stands and ends with the picture that the site shows."""

from __future__ import annotations

import runpy
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_less
from numpy.typing import NDArray
from PIL import Image

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
PICTURES = ROOT / "docs" / "images" / "gallery"

#: Blocks of so many pixels are compared: the edges of letters and of the sun's disc may move by a
#: part of a pixel.
_BLOCK = 4
#: A block differs if it is off by more: pictures by the sky-view LUT are held to 2/255.
_MOST = 3.0
#: So many blocks may differ, in text that another version of matplotlib sets.
_SHARE = 0.01


def _blocks(path: Path) -> NDArray[np.float64]:
    pixels = np.asarray(Image.open(path).convert("RGB"), dtype=np.float64)
    height, width = (size - size % _BLOCK for size in pixels.shape[:2])
    cut = pixels[:height, :width].reshape(height // _BLOCK, _BLOCK, width // _BLOCK, _BLOCK, 3)
    return np.asarray(cut.mean(axis=(1, 3)))


def _share_off(made: NDArray[np.float64], shown: NDArray[np.float64]) -> float:
    assert made.shape == shown.shape
    return float((np.abs(made - shown).max(axis=-1) > _MOST).mean())


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::airlight.AirlightWarning")  # one shows it
@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_example_makes_the_picture_of_the_gallery(
    example: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # a second computation: the picture in the repository was made and looked at before
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    runpy.run_path(str(example), run_name="__main__")
    made = _blocks(tmp_path / f"{example.stem}.png")
    assert _share_off(made, _blocks(PICTURES / f"{example.stem}.png")) <= _SHARE


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_a_picture_two_per_cent_of_the_range_brighter_is_noticed(example: Path) -> None:
    # what the comparison is for: 5/255 everywhere is more than any bound on a picture allows
    shown = _blocks(PICTURES / f"{example.stem}.png")
    assert_array_less(_SHARE, _share_off(np.minimum(shown, 250.0) + 5.0, shown))


def test_every_example_has_a_place_in_the_gallery(tmp_path: Path) -> None:
    # the site's own builder refuses scripts that it does not list, and questions that are none
    import gallery_pages

    gallery_pages.write(tmp_path, ROOT / "examples", PICTURES)
    assert {path.stem for path in tmp_path.iterdir()} == {
        "index",
        *(path.stem for path in EXAMPLES),
    }
