"""Sizes: the wheel with its maps, a page, and the figures of ``scripts/sizes``."""

from __future__ import annotations

import runpy
from pathlib import Path

import airlight
from airlight.viewer.browser.page import LARGEST, export_page

PACKAGE = Path(airlight.__file__).parent


def test_the_package_is_below_13_megabytes() -> None:
    # Sources and data as a wheel has them, without compression.
    # Compiled code is not part of a checkout, see builders/compiled_code.py.
    others = {"__pycache__", "compiled"}
    files = [one for one in PACKAGE.rglob("*") if one.is_file() and others.isdisjoint(one.parts)]
    assert sum(one.stat().st_size for one in files) < 13e6
    maps = [one for one in files if one.parent.parts[-2:] == ("scene", "data")]
    kinds = ("albedo.jpg", "water.png", "clouds.jpg", "relief.png", "lights.jpg")
    assert {one.name for one in maps} >= {f"earth-{kind}" for kind in kinds}
    assert sum(one.stat().st_size for one in maps) < 6.5e6


def test_a_page_with_the_earth_s_maps_is_below_4_megabytes(tmp_path: Path) -> None:
    page = export_page("earth", tmp_path / "earth.html", quality="preview")
    assert page.size == (tmp_path / "earth.html").stat().st_size
    assert page.size <= 4e6 < LARGEST <= 5e6


def test_the_figures_of_the_code_count_what_they_name() -> None:
    script = Path(__file__).parents[1] / "scripts" / "sizes"
    source = """'''Two lines
    of docstring.'''

# a comment
class A:
    def f(self, a, b, c, d, e, f, g, h, i):  # fmt: skip
        '''One more.'''
        return a
class A:
    pass
"""
    figures = runpy.run_path(str(script))["sizes"](
        {"src/airlight/a.py": source, "docs/a.md": "three short words", "docs/generated/b.md": "x"}
    )
    assert list(figures.values()) == [1, 5, 3, 0, 1, 1, 1, "10 a.py", 3]
