"""``airlight animate``: options that contradict each other, in one line each."""

from __future__ import annotations

from pathlib import Path

import pytest

from airlight.cli import main


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (["-o", "a.mp4"], "one folder of frames, and at most one .mp4"),
        (["-o", "a", "-o", "b"], "one folder of frames"),
        (["-o", "a.png"], "a folder without a suffix, or an .mp4"),
        (["-o", "a", "-o", "a.mp4", "--bits", "16"], "--bits must be 8 for an MP4"),
        (["-o", "a", "-o", "a.mp4", "--format", "exr"], "--format must be png for an MP4"),
        (["-o", "a", "--bits", "12"], "--bits is 12; allowed: 8 or 16"),
        (["-o", "a", "--exposure", "dark"], "--exposure is 'dark'; allowed: auto, locked, or"),
        (["-o", "a", "--workers", "0"], "--workers is 0; allowed: 1 to 256"),
        (["-o", "a", "--key", "view.altitude"], "--key is 'view.altitude'; allowed: PATH=A,B"),
        (["-o", "a", "--key", "view.altitude=2m,3m fast"], "a law of linear, smooth"),
        (["-o", "a", "--key", "view.altitud=2m,3m"], "view.altitude"),
        (["-o", "a", "--set", "film.frams=3"], "did you mean 'frames'"),
        (["-o", "a", "--wavelengths", "550"], "three or more wavelengths"),
        (["-o", "a", "--tone-map", "none"], "--tone-map is 'none'"),
        (["-o", "x/y/z"], "x/y/z: no such file or directory"),
    ],
)
def test_wrong_options_are_one_line(
    words: list[str], line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    quick = ["--wavelengths", "rgb"] if "--wavelengths" not in words else []
    status = main(["animate", "earth-atmosphere-plus", "--size", "8x8", *quick, *words])
    said = capsys.readouterr().err
    assert status == 2
    assert line in said
    assert said.count("\n") == 1
    assert not list(tmp_path.rglob("*.png"))


def test_a_name_that_is_nothing_is_answered_by_the_nearest(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["animate", "lunar-eclips", "-o", "a"]) == 2
    assert "did you mean 'lunar-eclipse'" in capsys.readouterr().err
