"""Text from outside is text: on the terminal, in figures, in pages, in error lines."""

from __future__ import annotations

import io
import json
import re
from pathlib import Path
from typing import Any

import pytest
from outside_text import NAMES, OBEYED

from airlight.cli import main
from airlight.errors import AirlightError, FileError, ParameterError
from airlight.planets import Planet, load_planet, replace

#: Names that a planet may have, though each has broken a program.
ALLOWED = tuple(
    name for name in NAMES if 1 <= len(name) <= 60 and not OBEYED.search(name) and "\n" not in name
)


def named(name: str) -> Planet:
    """Planet with this name, and a constituent with it."""
    planet = load_planet("earth-openspace")
    first, *others = planet.constituents
    return replace(planet, name=name, constituents=(replace(first, name=name), *others))


@pytest.mark.parametrize("name", [name for name in NAMES if name not in ALLOWED])
def test_a_name_is_letters_that_are_shown(name: str) -> None:
    with pytest.raises(ParameterError, match="letters") as caught:
        named(name)
    assert not OBEYED.search(str(caught.value))


@pytest.mark.parametrize("error", [
    FileError("a\x1b[2J\n\udc80.toml", "is\rno \x9bfile"),
    ParameterError("a\x1b.b\udc80", "\x1b[2J", "one\x07two", "x\u202e.toml"),
    AirlightError("bell \x07 and \ud800"),
])  # fmt: skip
def test_an_error_line_steers_no_terminal(error: AirlightError) -> None:
    line = str(error)
    assert not OBEYED.search(line)
    assert "\n" not in line
    line.encode()


def test_markup_and_emoji_names_are_printed_as_they_are(
    capsys: pytest.CaptureFixture[str],
) -> None:
    words = ["show", "earth-openspace", "--no-cache", "--set", "name=[/x] :smile:",
             "--compare", "mars-rayleigh", "--set", "aerosol.name=[bold]a"]  # fmt: skip
    assert main(words) == 0
    out = capsys.readouterr().out
    assert "[/x] :smile:" in out
    assert "[bold]a" in out


def test_a_planet_compared_with_itself_does_not_differ(
    capsys: pytest.CaptureFixture[str],
) -> None:
    words = ["show", "earth-openspace", "--compare", "earth-openspace", "--set", "name=[/x]"]
    assert main(words) == 0
    assert "do not differ" in capsys.readouterr().out


@pytest.mark.parametrize("kind", ["density", "optical-depth", "phase", "solar-spectrum"])
def test_figures_draw_every_name(kind: str) -> None:
    # matplotlib reads "$…$" as a formula and leaves "_…" out of legends
    from airlight.studies.plots.catalogue import Choices, Work, draw
    from airlight.studies.plots.figure import write_figure

    for name in ("$x_{$", "_hidden", "大気", "\\"):
        figure = draw(named(name), kind, Choices(), Work(cache=False))
        write_figure(figure, io.BytesIO(), "png", dpi=20)
        write_figure(figure, io.BytesIO(), "svg")
        assert name.strip("_$") in figure.get_suptitle().replace("\\$", "$")
        for axes in figure.axes:
            legend = axes.get_legend()
            if legend is not None and kind != "solar-spectrum":
                shown = [text.get_text().replace("\\$", "$") for text in legend.get_texts()]
                assert any(name in text for text in shown), (kind, shown)


@pytest.mark.parametrize("name", ALLOWED)
def test_the_page_escapes_every_name(name: str) -> None:
    from airlight.viewer.browser.page import page_text

    data: dict[str, Any] = {"title": name, "planet": name, "parameters": [{"group": name}]}
    text = page_text(f"{name} – airlight", data, None)
    # the only elements are those of the page itself
    plain = page_text("plain – airlight", {}, None)
    assert len(re.findall(r"<(?=[/!a-zA-Z])", text)) == len(re.findall(r"<(?=[/!a-zA-Z])", plain))
    assert json.dumps(name)[1:-1].replace("<", "\\u003c") in text


@pytest.mark.parametrize("words", [
    ["render", "earth-openspace", "-o", "loop.png"],
    ["bake", "earth-openspace", "--layout", "bruneton", "-o", "loop"],
    ["plot", "earth-openspace", "density", "-o", "loop/a.png"],
    ["export-page", "earth-openspace", "-o", "loop.html"],
    ["show", "loop.toml"],
    ["sweep", "earth-openspace", "--altitude", "0m", "--sun-zenith", "60", "--view-zenith", "0",
     "--azimuth", "0", "-o", "loop.zarr"],
])  # fmt: skip
def test_a_loop_of_links_is_one_line(
    words: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in {word.partition("/")[0] for word in words if word.startswith("loop")}:
        Path(name).symlink_to(f"other-{name}")
        Path(f"other-{name}").symlink_to(name)
    assert main(words) == 2
    captured = capsys.readouterr()
    assert captured.err.startswith("airlight: loop")
    assert captured.err.count("\n") == 1
    assert "internal error" not in captured.err


@pytest.mark.parametrize("part", ["[[constituents]]", "[shell]", "[ground]", "[star]"])
def test_the_viewer_refuses_a_planet_without_its_tables_in_a_line(
    part: str, tmp_path: Path
) -> None:
    from command_lines import PLANET

    from airlight.viewer.session.session import Session

    whole = PLANET.format(name='"A"', constituent='"air"')
    start = whole.index(part)
    end = whole.find("\n[", start + 1)
    file = tmp_path / "planet.toml"
    file.write_text(whole[:start] + ("" if end < 0 else whole[end + 1 :]))
    with pytest.raises(ParameterError, match=rf"{part.strip('[]')} is missing; allowed: .*table"):
        Session(file)


@pytest.mark.parametrize("path", ["name", "constituents[0].name", "description"])
def test_the_viewer_refuses_characters_that_are_not_shown(path: str) -> None:
    from airlight.viewer.session.session import Session

    session = Session("mars-rayleigh")
    for text in ("a\x1b[31m", "a\x00", "\udc80"):
        with pytest.raises(ParameterError, match="letters without control characters"):
            session.set(path, text)
    session.set("name", "[/x] $x_{$ ❄")
    assert session.value("name") == "[/x] $x_{$ ❄"


@pytest.mark.parametrize("words", [
    ["animate", "9" * 400, "-o", "frames"],
    ["render", "9" * 400, "-o", "a.png"],
    ["show", "9" * 400],
    ["fit", "9" * 400, "--free", "ground.albedo", "-o", "a.toml"],
    ["bake", "earth-openspace", "--layout", "bruneton", "-o", "9" * 400, "--quality", "preview"],
])  # fmt: skip
def test_a_name_too_long_for_a_file_is_one_line(
    words: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(words) == 2
    error = capsys.readouterr().err
    assert error.startswith("airlight: ")
    assert "internal error" not in error


@pytest.mark.parametrize("name", ALLOWED)
def test_every_text_format_holds_every_name(name: str) -> None:
    # each is read by a parser of its format, and the names of planets are all that is free there
    import tomllib

    from airlight.engines.targets.celestia import read_atmosphere, ssc_of
    from airlight.engines.targets.fits.formula_planet import name_of
    from airlight.engines.targets.openspace import asset_of
    from airlight.engines.targets.unreal import script_of
    from airlight.planets.reading.planet_file import planet_file
    from airlight.studies.reports.markdown import escaped, row_lines

    lupa = pytest.importorskip("lupa")
    lua = lupa.LuaRuntime(unpack_returned_tuples=True)
    lua.execute("openspace = {}; asset = {require = function() end, export = function() end,"
                "onInitialize = function() end, onDeinitialize = function() end}")  # fmt: skip
    lua.execute(asset_of({"Height": 1.0}, named(name)))
    assert lua.eval("asset.meta.Name") == f"{name} Atmosphere"
    assert read_atmosphere(ssc_of({"Height": 1.0}, named(name)))["Height"] == 1.0
    compile(script_of({"height": 1.0}, name_of(named(name))), "sky_atmosphere.py", "exec")
    tables = {"name": name, name: {name: [name]}}
    assert tomllib.loads(planet_file(tables, (f"from {name}\x1b\n{name}",))) == tables
    (row,) = row_lines(["a"], [[f"{name}|{name}"]])[2:]
    assert len(re.findall(r"(?<!\\)(?:\\\\)*\|", row)) == 2
    assert not re.search(r"(?<!\\)(?:\\\\)*`|\]\(|<", escaped(f"[a](b){name}"))


LONG = "x" * 5000


@pytest.mark.parametrize("words", [
    ["render", "earth", "-o", LONG + ".png"],
    ["render", "earth", "-o", "/tmp/" + LONG + "/a.png"],
    ["render", LONG], ["show", LONG + ".toml"], ["animate", LONG, "-o", "x"], [LONG],
    ["fit", "earth", "--data", LONG, "--free", "ground.albedo", "-o", "a.toml"],
    ["radiance", "earth", "--input", LONG], ["compose", LONG, "-o", "a.png"],
    ["bake", "earth", "--layout", "bruneton", "-o", LONG], ["aerial", "earth", "-o", LONG],
    ["bake", "earth", "--layout", LONG, "-o", "x"], ["render", "earth", "--quality", LONG],
    ["render", "earth", f"--{LONG}"], ["render", "earth", "--set", f"{LONG}=1"],
    ["render", "earth", "--set", f"ground.map={LONG}"], ["validate", "-o", "a b " * 1250 + ".html"],
    ["export-page", "earth", "-o", "a b " * 1250 + ".html"],
])  # fmt: skip
def test_no_message_echoes_five_thousand_characters(
    words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert len(err) < 1100
    assert "internal error" not in err
