"""Folders for programs: whole, refused in one line, and read back as they were written."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from airlight.cli import main
from airlight.engines import targets
from airlight.engines.targets.target import (
    ErrorRow,
    ExportReport,
    FittedFormula,
    Target,
    read_export,
)
from airlight.errors import AirlightWarning, ParameterError
from airlight.planets import load_planet
from airlight.planets import replace as change
from airlight.planets.rings import Ring

Solve = Callable[..., Any]
FOUND = ExportReport(
    fitted=(
        FittedFormula(name="dust: phase function", form="Cornette-Shanks", parameters={"g": 0.7},
               errors={"relative, mean": 0.2}, where="0 to 180 deg"),
    ),
    errors=(ErrorRow.of("sky", [0.01, -0.5], where="everywhere"),),
    notes=("no sea",),
    about={"unit": "m"},
)  # fmt: skip


def fill(solution: Any, folder: Path, *, progress: Any, text: str = "some") -> ExportReport:
    (folder / "light.txt").write_text(text, encoding="utf-8")
    if text == "broken":
        raise ParameterError("text", text, "anything else")
    return FOUND


ECHO = Target(
    name="echo",
    program="Echo",
    version="1.0",
    fill=fill,
    files=("light.txt",),
    options=("text",),
    wavelengths=(550.0,),
)


@pytest.fixture
def green(solved: Solve) -> Any:
    return solved(load_planet("earth-atmosphere-plus"), (550.0,), quality="preview")


def test_the_account_is_read_back_as_it_was_written(green: Any, tmp_path: Path) -> None:
    export = ECHO.write(green, tmp_path / "echo", text="more")
    assert export.files == {"light.txt": 4}
    assert (export.fitted, export.errors, export.notes) == (
        FOUND.fitted, FOUND.errors, FOUND.notes
    )  # fmt: skip
    assert read_export(tmp_path / "echo", ECHO) == export
    said = json.loads((tmp_path / "echo" / "manifest.json").read_text(encoding="utf-8"))
    assert (said["unit"], said["program"], said["wavelengths_nm"]) == ("m", "Echo", [550.0])


def test_a_folder_that_fails_leaves_the_old_one(green: Any, tmp_path: Path) -> None:
    ECHO.write(green, tmp_path / "echo")
    with pytest.raises(ParameterError, match="anything else"):
        ECHO.write(green, tmp_path / "echo", text="broken")
    assert (tmp_path / "echo" / "light.txt").read_text(encoding="utf-8") == "some"
    assert [file.name for file in tmp_path.iterdir()] == ["echo"]


def test_what_the_program_lacks_is_refused(green: Any, tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="does not apply to layout echo"):
        ECHO.write(green, tmp_path / "echo", file_form="x")
    red = replace(ECHO, wavelengths=(680.0,))
    with pytest.raises(ParameterError, match="680 nm for Echo"):
        red.write(green, tmp_path / "echo")
    with pytest.raises(ParameterError, match="layout is 'nowhere'"):
        targets.target_of("nowhere")


def test_the_largest_error_is_kept_whatever_its_sign() -> None:
    row = ErrorRow.of("sky", [0.1, -0.4, 0.2], where="everywhere")
    assert (row.points, row.median, row.largest) == (3, 0.2, 0.4)


@pytest.mark.parametrize("name", list(targets.MODULES))
def test_every_program_has_its_own_name(name: str) -> None:
    assert targets.target_of(name).name == name


def test_the_command_prints_files_errors_fits_and_notes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(targets.MODULES, "bruneton", "echo")
    monkeypatch.setattr(targets, "import_module", lambda name: SimpleNamespace(TARGET=ECHO))
    words = ["bake", "earth-atmosphere-plus", "--quality", "preview", "--layout", "bruneton"]
    assert main([*words, "-o", str(tmp_path / "echo")]) == 0
    out = capsys.readouterr().out
    for text in ("light.txt", "4 B", "sky", "5.0e-01", "g = 0.7", "relative, mean", "note: no sea"):
        assert text in out
    for option in (["--wavelengths", "5"], ["--mie", "combined"], ["--precision", "half"]):
        assert main([*words, *option, "-o", str(tmp_path / "other")]) == 2
        assert option[0] in capsys.readouterr().err
    assert not (tmp_path / "other").exists()


def test_files_of_an_oblate_planet_with_rings_say_what_is_left_out(
    solved: Solve, tmp_path: Path
) -> None:
    # a program draws a sphere without rings: without a line its user would look for them
    plain = load_planet("earth-atmosphere-plus")
    ring = Ring(inner_radius=8e6, outer_radius=9e6, optical_depth=0.5)
    shaped = change(plain, rings=(ring,), flattening=0.1)
    with pytest.warns(AirlightWarning) as said:
        ECHO.write(solved(shaped, (550.0,), quality="preview"), tmp_path / "shaped")
    lines = [str(one.message) for one in said]
    assert any("Echo without rings: their shadow and light are left out" in one for one in lines)
    assert any("Echo of a sphere" in one and "0.1, is left out" in one for one in lines)
    ECHO.write(solved(plain, (550.0,), quality="preview"), tmp_path / "plain")  # warns of nothing
