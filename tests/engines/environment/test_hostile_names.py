"""Maps of odd names: every text beside them names the map, as the programs themselves read it."""

from __future__ import annotations

import json
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import NoReturn

import pytest

from airlight.engines.environment.environment_map import EnvironmentMap
from airlight.engines.environment.files import write_map
from airlight.errors import FileError

Made = Callable[..., EnvironmentMap]

#: Names without their suffix.
NAMES = (
    "sky@2x", "a@@@b", "@@@@", "a@@", '"', "'", "]]", "]]>", "<", "&amp;", "<!--", "a--b", "#",
    "%", "%20", "%s", "{x}", "{name}", "$", "$name", "${x}", "\\", "a\\$b", "\\@@@", "-o", " a b ",
    "大気 ❄", "`", "[ 1 ]", ";", "a,b", "?",
)  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
def test_usd_names_the_map(
    made: Made, tmp_path: Path, name: str, lacking: Callable[[str], NoReturn]
) -> None:
    try:
        from pxr import Usd, UsdLux
    except ImportError:
        lacking("no OpenUSD (pip install usd-core)")
    shown = made("usd", "light", width=16)
    shown.frame.metadata["planet"] = f'{name} "quoted" \\'
    path = tmp_path / f"{name}.exr"
    write_map(path, shown)
    stage = Usd.Stage.Open(str(path.with_suffix(".usda")))
    texture = UsdLux.DomeLight.Get(stage, "/Sky/Dome").GetTextureFileAttr().Get()
    assert texture.path == f"./{name}.exr"
    assert stage.GetRootLayer().documentation.startswith(f'Sky of {name} "quoted" \\: x east')
    assert json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))["map"] == path.name


@pytest.mark.parametrize("name", NAMES)
def test_mitsuba_names_the_map(
    made: Made,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    name: str,
    lacking: Callable[[str], NoReturn],
) -> None:
    try:
        import mitsuba
    except ImportError:
        lacking("no Mitsuba (pip install mitsuba)")
    mitsuba.set_variant("scalar_rgb")
    path = tmp_path / f"{name}.exr"
    write_map(path, made("mitsuba", "light", width=16))
    tree = ElementTree.parse(path.with_suffix(".xml"))
    assert tree.find("emitter/string").get("value").replace(r"\$", "$") == path.name  # type: ignore[union-attr]
    monkeypatch.chdir(tmp_path)
    path.with_suffix(".xml").rename(tmp_path / "scene.xml")
    assert len(mitsuba.load_file("scene.xml").emitters()) == 2  # which reads the map


@pytest.mark.parametrize("name", ["a\nb", "a\x1b[2J", "a\u202eb", "a\udc80"])
def test_a_name_that_no_text_can_hold_is_rejected(made: Made, tmp_path: Path, name: str) -> None:
    for consumer in ("usd", "mitsuba", "blender"):
        with pytest.raises(FileError, match="contains control characters"):
            write_map(tmp_path / f"{name}.exr", replace(made(consumer, width=16)))
    assert list(tmp_path.iterdir()) == []
