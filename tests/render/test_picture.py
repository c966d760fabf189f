"""A frame to a file: the suffix decides, EXR stays linear."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from PIL import Image

from airlight.engines.baking import write_picture
from airlight.errors import AirlightError, FileError
from airlight.image.exr import read_exr
from airlight.image.png import read_png_metadata

RAMP = np.linspace(0.0, 40.0, 8 * 16 * 3, dtype=np.float32).reshape(8, 16, 3)


def test_exr_ignores_exposure_and_tone_map(tmp_path: Path) -> None:
    written = write_picture(tmp_path / "a.exr", RAMP, exposure=3.0, tone_map="aces")
    assert written.exposure is None
    assert_array_equal(read_exr(tmp_path / "a.exr")[0], RAMP)


def test_png_says_how_it_was_made_visible(tmp_path: Path) -> None:
    written = write_picture(tmp_path / "a.png", RAMP, {"altitude": "0 m"}, exposure=-1.5)
    assert written.exposure == -1.5
    assert written.size == (tmp_path / "a.png").stat().st_size
    texts = read_png_metadata(tmp_path / "a.png")
    assert texts["airlight.exposure"] == "-1.5 EV"
    assert texts["airlight.tone_map"] == "natural"
    assert texts["airlight.encoding"] == "srgb"
    assert texts["airlight.altitude"] == "0 m"


def test_automatic_exposure_makes_a_picture_independent_of_its_brightness(tmp_path: Path) -> None:
    # a law by day: light four times as strong is exposed two EV less
    ramp = 100.0 * (RAMP + 1.0)
    dim = write_picture(tmp_path / "a.png", ramp, exposure="auto")
    bright = write_picture(tmp_path / "b.png", ramp * 4.0, exposure="auto")
    assert dim.exposure is not None
    assert bright.exposure is not None
    # the log-average is formed in float32 at worst
    assert abs(dim.exposure - bright.exposure - 2.0) < 1e-3
    first, second = (np.asarray(Image.open(tmp_path / name)) for name in ("a.png", "b.png"))
    assert np.abs(first.astype(int) - second.astype(int)).max() <= 1


@pytest.mark.parametrize("name", ["a.jpg", "a", "a.png.gz", "no/such/a.png"])
def test_a_name_that_cannot_be_written_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(FileError) as refusal:
        write_picture(tmp_path / name, RAMP)
    assert "\n" not in str(refusal.value)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("wrong", [{"tone_map": "sepia"}, {"encoding": "pq"}, {"exposure": np.nan}])
def test_an_unknown_display_is_refused_and_nothing_written(
    tmp_path: Path, wrong: dict[str, object]
) -> None:
    with pytest.raises(AirlightError) as refusal:
        write_picture(tmp_path / "a.png", RAMP, **wrong)  # type: ignore[arg-type]
    assert "\n" not in str(refusal.value)
    assert not list(tmp_path.iterdir())
