"""Write the tables of docs/planet-files.md from the declarations of its keys.

python builders/planet_file_tables.py
"""

from __future__ import annotations

from pathlib import Path

from airlight.planets.reading.handbook import filled

PAGE = Path(__file__).parents[1] / "docs" / "planet-files.md"

if __name__ == "__main__":
    PAGE.write_text(filled(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
