"""Files that are not airlight's: each command that writes more than its output stops first."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Any, NoReturn

import pytest

from airlight.cli import main

#: Command lines; what is there already, written by somebody else; and which file is named.
COMMANDS: dict[str, tuple[list[str], list[str], str]] = {
    "sky, JSON": (["sky", "earth", "--for", "blender", "-o", "a.exr"], ["a.json"], "a.json"),
    "sky, XML": (
        ["sky", "earth", "--for", "mitsuba", "--sun", "light", "-o", "a.exr"], ["a.xml"], "a.xml"
    ),
    "sky, USD": (["sky", "earth", "--for", "usd", "-o", "a.exr"], ["a.usda"], "a.usda"),
    "sky, PNG": (["sky", "earth", "--for", "dome", "-o", "a.png"], ["a.json"], "a.json"),
    "bake": (
        ["bake", "earth", "--layout", "bruneton", "-o", "out"], ["out/scattering.npz"], "out"
    ),
    "bake, manifest": (
        ["bake", "earth", "--layout", "atmosphere-plus", "-o", "out"], ["out/manifest.json"],
        "manifest.json",
    ),
    **{
        f"bake, {name}": (["bake", "earth", "--layout", name, "-o", "out"], ["out/a.txt"], "out")
        for name in ("takram", "bruneton-demo", "openspace", "unreal", "celestia")
    },
    "aerial": (["aerial", "earth", "-o", "out"], ["out/air.wgsl", "out/manifest.json"], "manifest"),
    "fit": (
        ["fit", "earth", "--data", "data.csv", "--free", "ground.albedo", "-o", "a.toml",
         "--report", "r.md"], ["r-pictures/a.png"], "r-pictures",
    ),
    "validate": (["validate", "-o", "r.md"], ["pictures/a.png"], "pictures"),
    "validate, page": (["validate", "-o", "r.html", "--pictures", "p"], ["r.md"], "r.md"),
}  # fmt: skip


class Work(Exception):
    """What would be computed."""


@pytest.fixture(autouse=True)
def _nothing_is_computed(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    import airlight.solver
    import airlight.studies.fit
    import airlight.validation.run

    def work(*_: Any, **__: Any) -> NoReturn:
        raise Work

    monkeypatch.setattr(airlight.solver, "solve", work)
    # `airlight.render` may be the function of this name
    monkeypatch.setattr(import_module("airlight.render.solve_planet"), "solve_planet", work)
    monkeypatch.setattr("airlight.engines.environment.environment_map.environment_map", work)
    monkeypatch.setattr("airlight.validation.run.run", work)
    monkeypatch.setattr("airlight.cli.fit._measurements", work)
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("name", COMMANDS)
def test_a_file_of_somebody_else_stops_a_command_before_its_work(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words, others, named = COMMANDS[name]
    for other in others:
        path = tmp_path / other
        path.parent.mkdir(exist_ok=True)
        path.write_text('{"mine": 1}', encoding="utf-8")
    assert main(words) == 2
    err = capsys.readouterr().err
    assert named in err
    assert err.count("\n") == 1
    assert "Work" not in err
    assert [(tmp_path / other).read_text(encoding="utf-8") for other in others] == [
        '{"mine": 1}' for _ in others
    ]
    assert main([*words, "--overwrite"]) == 2  # which reaches the work
    assert "internal error, Work" in capsys.readouterr().err
    assert all((tmp_path / other).exists() for other in others)


def test_the_named_file_itself_is_replaced(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # what -o names is what the user wants to be written, as by every command
    (tmp_path / "a.exr").write_text("mine", encoding="utf-8")
    assert main(["sky", "earth", "--for", "blender", "-o", "a.exr"]) == 2
    assert "internal error, Work" in capsys.readouterr().err
