"""What docs/planet-files.md shows works as shown."""

from __future__ import annotations

import re
from pathlib import Path

from airlight.planets import Medium
from airlight.planets.reader import read_planet

PAGE = (Path(__file__).parents[2] / "docs" / "planet-files.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", PAGE, flags=re.DOTALL)


def test_the_whole_file_of_the_page_is_read():
    (text,) = blocks("toml")
    planet = read_planet(text, "page.toml")
    assert Medium.from_planet(planet, planet.wavelengths).names == ("air", "aerosol", "ozone")


def test_the_python_of_the_page_runs():
    (code,) = blocks("python")
    names: dict[str, object] = {}
    exec(code, names)
    assert names["dusty"].ground.albedo == 0.3


def test_the_page_names_every_kind():
    from airlight.planets.constituent_reader import _PHASES, _PROFILES

    for kind in (*_PHASES, *_PROFILES):
        assert f'`"{kind}"`' in PAGE
