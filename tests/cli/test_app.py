"""Exit of the command: help, version, one line for every error."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from importlib import import_module
from importlib.metadata import version
from pathlib import Path

import pytest

from airlight.cli import app, main
from airlight.cli import version as version_file
from airlight.errors import Cancelled

COMMANDS = ["planets", "show", "render", "radiance", "plot", "bake", "validate"]


def error_line(capsys: pytest.CaptureFixture[str]) -> str:
    """Standard error stream, which must be one line, with nothing on standard output."""
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("airlight: ")
    assert captured.err.count("\n") == 1
    assert "Traceback" not in captured.err
    return captured.err


@pytest.mark.parametrize("words", [[], ["--help"], ["-h"]])
def test_help_names_every_command(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words) == 0
    out = capsys.readouterr().out
    assert all(command in out for command in COMMANDS)


@pytest.mark.parametrize("command", COMMANDS)
def test_help_of_every_command_has_examples(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([command, "--help"]) == 0
    out = capsys.readouterr().out
    assert "Examples:" in out
    assert f"$ airlight {command}" in out


def test_version_is_the_installed_one_with_its_commit(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert main(["--version"]) == 0
    assert re.fullmatch(
        rf"airlight {re.escape(version('airlight'))}( \([0-9a-f]{{12,}}\))?\n",
        capsys.readouterr().out,
    )
    # what a distribution carries; a copy of the folder that is neither has no commit
    monkeypatch.setattr(version_file, "COMMIT_FILE", tmp_path / "src" / "airlight" / "commit.txt")
    assert version_file.version_line() == f"airlight {version('airlight')}"
    version_file.COMMIT_FILE.parent.mkdir(parents=True)
    version_file.COMMIT_FILE.write_text("0123456789ab\n", encoding="utf-8")
    assert version_file.version_line() == f"airlight {version('airlight')} (0123456789ab)"


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (["paint"], "No such command 'paint'"),
        (["render"], "PLANET"),
        (["render", "earth"], "--output"),
        (["render", "earth", "--colour", "-o", "a.png"], "--colour"),
        (["render", "earth", "--quality", "best", "-o", "a.png"], "'best'"),
        (["render", "earth", "--projection", "mercator", "-o", "a.png"], "'mercator'"),
        (["show", "earth", "--set", "grond.albedo=1"], "did you mean 'ground.albedo'?"),
        (["show", "earth", "--set", "ground.albedo=2"], "ground.albedo is 2.0; allowed: 0 to 1"),
        (["plot", "earth", "density", "-o", "a.png", "--set", "albedo"], "--set is 'albedo'"),
        (["render", "earth", "-o", "a.png", "--set", "air.h=1"], "a key of constituents[0] is 'h'"),
        (["bake", "earth", "--layout", "bruneton", "-o", "a", "--set", "x.y=1"], "--set is 'x.y'"),
        (["render", "earth", "-o", "a.jpg"], "the name of a picture ends in .png, .exr, .hdr"),
        (["render", "earth", "-o", "no/such/a.png"], "there is no folder"),
        (["render", "earth", "-o", "a.png", "--exposure", "bright"], "--exposure is 'bright'"),
        (["render", "earth", "-o", "a.png", "--exposure", "101"], "auto, or -100 to 100 EV"),
        (["render", "earth", "-o", "a.png", "--tone-map", "sepia"], "--tone-map is 'sepia'"),
        (["radiance", "earth", "--altitude", "0m", "--view-zenith", "0"], "--sun-zenith"),
        (["radiance", "earth", "--sun-zenith", "1 kg", "--view-zenith", "0"], "--sun-zenith"),
        (["radiance", "earth", "--sun-zenith", "181", "--view-zenith", "0"], "0 to 180 deg"),
        (["radiance", "earth", "--altitude=-1km", "--sun-zenith=0", "--view-zenith=0"], "-440 m"),
        (["radiance", "earth", "--output", "a.csv"], "only together with --input"),
        (
            ["radiance", "earth", "--input", "-", "--azimuth", "0"],
            "--azimuth cannot be combined with --input",
        ),
        (["radiance", "earth", "--input", "no.csv"], "no.csv: cannot be read: No such file"),
    ],
)
def test_bad_input_is_one_line_and_status_2(
    words: list[str],
    part: str,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(words) == 2
    assert part in error_line(capsys)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (["--altitude", "5 apples"], "--altitude is '5 apples'"),
        (["--altitude=-445m"], "-440 m, the deepest basin of earth, or more"),
        (["--sun-zenith", "200"], "scene.sun_zenith is 200.0; allowed: 0 to 180 deg"),
        (["--fov", "180deg"], "camera.field_of_view is 180.0"),
        (["--crop", "1200,0,100,10"], "of a window inside 1280x720"),
        (["--crop", "0,0,9"], "X,Y,WIDTH,HEIGHT"),
        (["--projection", "orthographic", "--altitude", "4km"], "takes no --altitude"),
        (["--projection", "orthographic", "--look-at", "sun"], "takes no --look-at"),
        (["--projection", "orthographic", "--fov", "60deg"], "--fov is '60deg'"),
        (["--size", "big"], "--size is 'big'"),
        (["--size", "0x10"], "camera.width is 0"),
        (["--size", "100x100", "--projection", "cubemap"], "six times as wide as high"),
        (["--look", "90"], "zenith,azimuth in degrees"),
        (["--look", "90,0", "--look-at", "sun"], "--look cannot be combined with --look-at"),
        (["--wavelengths", "2"], "a picture has colours"),
        (["--wavelengths", "0"], "--wavelengths is '0'"),
        (["--wavelengths", "550,550,440"], "each wavelength once"),
        (["--wavelengths", "550,440,-1"], "wavelengths above 0 nm"),
    ],
)
def test_an_impossible_picture_is_refused_before_anything_is_solved(
    words: list[str],
    part: str,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    solvers = pytest.importorskip("airlight.solver")
    monkeypatch.setattr(solvers, "solve", None, raising=False)
    monkeypatch.chdir(tmp_path)
    assert main(["render", "earth", "-o", "a.png", *words]) == 2
    assert part in error_line(capsys)
    assert not list(tmp_path.iterdir())


def test_an_unknown_planet_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    for command in (["show", "vulcan"], ["render", "vulcan", "-o", "a.png"]):
        assert main(command) == 2
        assert "vulcan" in error_line(capsys)


@pytest.mark.parametrize(
    ("interruption", "ended", "line"),
    [(KeyboardInterrupt(), 130, "airlight: cancelled\n"), (SystemExit(143), 143, "")],
)
def test_an_interruption_that_a_library_wraps_is_no_error_of_ours(
    interruption: BaseException,
    ended: int,
    line: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    # While a class is made, Python raises RuntimeError from whatever __set_name__ raises: Ctrl-C
    # while matplotlib was imported was an internal error.
    def interrupted(*_: object, **__: object) -> int:
        raise RuntimeError("Error calling __set_name__ on 'locs'") from interruption

    monkeypatch.setattr(import_module("airlight.cli.app"), "app", interrupted)
    assert main(["planets"]) == ended
    assert capsys.readouterr().err == line


@pytest.mark.parametrize("interruption", [KeyboardInterrupt, Cancelled])
def test_an_interrupted_command_says_cancelled_and_leaves_nothing(
    interruption: type[BaseException],
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def interrupted(*arguments: object, **options: object) -> None:
        raise interruption

    solvers = pytest.importorskip("airlight.solver")
    rendering = pytest.importorskip("airlight.render")
    monkeypatch.setattr(solvers, "solve", interrupted, raising=False)
    monkeypatch.setattr(rendering, "render", interrupted, raising=False)
    assert main(["render", "earth", "-o", str(tmp_path / "a.png")]) == 130
    assert error_line(capsys) == "airlight: cancelled\n"
    assert not list(tmp_path.iterdir())


def fails(*arguments: object, **options: object) -> None:
    raise ZeroDivisionError("several\nlines")


def test_even_a_mistake_of_ours_is_one_line(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(app, "app", fails)
    assert main(["planets"]) == 2
    assert "ZeroDivisionError: several lines (--debug" in error_line(capsys)


@pytest.mark.parametrize("words", [["--debug", "planets"], ["planets", "--debug"]])
def test_debug_shows_the_traceback_wherever_it_stands(
    words: list[str], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(app, "app", fails)
    assert main(words) == 2
    assert "Traceback" in capsys.readouterr().err


def test_the_installed_command_is_this_one() -> None:
    command = str(Path(sys.executable).with_name("airlight"))
    for words in ([command], [sys.executable, "-m", "airlight"]):
        done = subprocess.run([*words, "--version"], capture_output=True, text=True, check=True)
        assert done.stdout == version_file.version_line() + "\n"


def test_what_is_missing_is_said_in_words(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["radiance", "earth", "--sun-zenith", "10"]) == 2
    line = error_line(capsys)
    assert "--view-zenith is missing" in line
    assert "None" not in line


def test_a_picture_is_no_table(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_bytes(b"\x89PNG\r\n\x1a\n")
    assert main(["radiance", "earth", "--input", str(tmp_path / "a.csv")]) == 2
    assert "is not UTF-8 text" in error_line(capsys)


def test_a_write_protected_picture_is_kept(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target = tmp_path / "a.png"
    target.write_text("precious")
    # root may write everywhere: the question to the system is answered here
    monkeypatch.setattr(os, "access", lambda path, mode: path != target or mode == os.R_OK)
    assert main(["render", "earth", "-o", str(target)]) == 2
    assert "is write-protected" in error_line(capsys)
    assert target.read_text() == "precious"


@pytest.mark.parametrize("name", app.COMMANDS)
def test_the_list_of_commands_says_what_each_command_says_of_itself(name: str) -> None:
    command = app.Commands().get_command(None, name)
    assert command.help.split("\n\n")[0].replace("\n", " ") == app.COMMANDS[name]
    assert command.name == name
