"""The page of planets: its optical depths are those of the presets and of their sources."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

import pytest
from numpy.testing import assert_allclose

from airlight.planets import Constituent, load_planet, planet_names

PAGE = (Path(__file__).parents[2] / "docs" / "planets.md").read_text(encoding="utf-8")


class Row(NamedTuple):
    """One row of the page's table of optical depths."""

    preset: str
    parts: str
    wavelength: float
    ours: str
    cited: float
    within: float
    source: str


def rows() -> list[Row]:
    pattern = (
        r"\| `([a-z-]+)` \| ([^|]+) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) % \| ([^|]+) \|"
    )
    return [
        Row(preset, parts, float(nm), ours, float(cited), 0.01 * float(percent), source)
        for preset, parts, nm, ours, cited, percent, source in re.findall(pattern, PAGE)
    ]


def optical_depth(one: Constituent, wavelength: float, thickness: float) -> float:
    scattering = one.scattering_coefficients([wavelength], thickness)
    absorption = one.absorption_coefficients([wavelength], thickness)
    return float((scattering + absorption)[0] * one.profile.column(thickness))


@pytest.mark.parametrize(
    "row",
    # Mie of Venus's droplets takes seconds
    [pytest.param(r, marks=pytest.mark.slow) if r.preset == "venus" else r for r in rows()],
    ids=lambda row: f"{row.preset} {row.parts}",
)
def test_vertical_optical_depths_are_those_of_the_sources(row: Row) -> None:
    # the source is in the row; the tolerance and its reason below the table
    planet = load_planet(row.preset)
    parts = {one.name: one for one in planet.constituents}
    chosen = [parts[name.strip()] for name in row.parts.split("+")]
    ours = sum(optical_depth(one, row.wavelength, planet.thickness) for one in chosen)
    assert_allclose(ours, row.cited, rtol=row.within)
    digits = len(row.ours.partition(".")[2])
    # half the last printed digit
    assert_allclose(ours, float(row.ours), rtol=0, atol=0.501 * 10.0**-digits)


def test_every_planet_of_the_page_has_its_row_and_every_row_a_year() -> None:
    # a preset without a cited optical depth is a preset without a source
    sections = set(re.findall(r"^## `([a-z-]+)`", PAGE, flags=re.MULTILINE))
    assert sections == {row.preset for row in rows()}
    assert sections <= set(planet_names())
    for row in rows():
        assert re.search(r"\((18|19|20)\d\d\)", row.source), row.source
