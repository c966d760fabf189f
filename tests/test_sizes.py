"""Sizes of what is shipped: the wheel with its maps, and a page."""

from __future__ import annotations

from pathlib import Path

import airlight
from airlight.viewer.browser.page import LARGEST, export_page

PACKAGE = Path(airlight.__file__).parent


def test_the_package_is_below_12_megabytes() -> None:
    # Sources and data as a wheel has them, without compression.
    # Compiled code is not part of a checkout, see builders/compiled_code.py.
    others = {"__pycache__", "compiled"}
    files = [one for one in PACKAGE.rglob("*") if one.is_file() and others.isdisjoint(one.parts)]
    assert sum(one.stat().st_size for one in files) < 12e6
    maps = [one for one in files if one.parent.parts[-2:] == ("scene", "data")]
    assert {one.name for one in maps} >= {"earth-albedo.jpg", "earth-water.png"}
    assert sum(one.stat().st_size for one in maps) < 3e6


def test_a_page_with_the_earth_s_maps_is_below_4_megabytes(tmp_path: Path) -> None:
    page = export_page("earth", tmp_path / "earth.html", quality="preview")
    assert page.size == (tmp_path / "earth.html").stat().st_size
    assert page.size <= 4e6 < LARGEST <= 5e6
