"""``airlight plot``: kinds, refusals, whole and reproducible files."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from airlight.cli import main
from airlight.errors import Cancelled
from airlight.studies.plots import KINDS


def error_line(capsys: pytest.CaptureFixture[str]) -> str:
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("airlight: ")
    assert captured.err.count("\n") == 1
    return captured.err


def test_list_and_help_say_every_kind_with_its_sentence(capsys: pytest.CaptureFixture[str]) -> None:
    for words in (["plot", "--list"], ["plot", "--help"]):
        assert main(words) == 0
        out = " ".join(capsys.readouterr().out.split())
        for name, kind in KINDS.items():
            assert name in out
            assert kind.sentence in out


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (["histogram", "-o", "a.png"], "KIND is 'histogram'; allowed: solar-spectrum, "),
        (["density", "-o", "a.jpg"], "a.jpg: the name of a plot ends in .png, .svg, .pdf"),
        (["density", "-o", "no/such/a.png"], "there is no folder"),
        (["density"], "--output"),
        (["density", "-o", "a.png", "--dpi", "5"], "--dpi is 5.0; allowed: 20 to 1200"),
        (
            ["density", "-o", "a.png", "--sun-zenith", "4"],
            "--sun-zenith does not apply to density, which takes nothing",
        ),
        (
            ["limb", "-o", "a.png", "--altitude", "4m"],
            "limb, which takes wavelengths, sun-zenith, quality",
        ),
        (["phase", "-o", "a.png", "--wavelengths", "9000"], "wavelengths is 9000.0"),
        (["sky-profile", "-o", "a.png", "--sun-zenith", "200"], "0 to 180 deg"),
    ],
)
def test_what_cannot_be_drawn_is_one_line_and_leaves_nothing(
    words: list[str],
    part: str,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    if "limb" not in words and "sky-profile" not in words:
        import airlight.solver

        monkeypatch.setattr(airlight.solver, "solve", None)
    assert main(["plot", "earth", *words, *(["--quality", "preview"] * ("200" in words))]) == 2
    assert part in error_line(capsys)
    assert not list(tmp_path.iterdir())


def test_without_matplotlib_one_line_says_how_to_get_it(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert main(["plot", "earth", "density", "-o", str(tmp_path / "a.png")]) == 2
    assert error_line(capsys) == "airlight: plots need matplotlib: pip install 'airlight[plots]'\n"
    assert not list(tmp_path.iterdir())


def test_a_picture_has_the_pixels_asked_for(tmp_path: Path) -> None:
    # density is 8 by 5 inches
    from PIL import Image

    place = tmp_path / "a.png"
    assert main(["plot", "earth", "density", "-o", str(place), "--dpi", "50"]) == 0
    with Image.open(place) as picture:
        assert picture.size == (400, 250)
        assert np.asarray(picture.convert("L")).min() < 60  # ink, not only paper


@pytest.mark.parametrize("suffix", ["png", "svg", "pdf"])
def test_the_same_command_writes_the_same_file(
    suffix: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # no date, no random name: two years give the same bytes
    files = [tmp_path / f"{k}.{suffix}" for k in range(2)]
    for year, file in enumerate(files):
        monkeypatch.setenv("SOURCE_DATE_EPOCH", str(year * 31_557_600))
        assert main(["plot", "mars", "sky-profile", "-o", str(file), "--quality", "preview"]) == 0
    starts = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}
    assert files[0].read_bytes().startswith(starts[suffix])
    assert files[0].read_bytes() == files[1].read_bytes()


@pytest.mark.parametrize("interruption", [KeyboardInterrupt, Cancelled])
def test_an_interrupted_plot_leaves_nothing(
    interruption: type[BaseException], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*arguments: object, **options: object) -> None:
        raise interruption

    import airlight.studies.plots.figure

    monkeypatch.setattr(airlight.studies.plots.figure, "write_figure", interrupted)
    assert main(["plot", "earth", "density", "-o", str(tmp_path / "a.png")]) == 130
    assert not list(tmp_path.iterdir())
