"""Write the tables of keys of planet files, scenes and films into their pages.

python builders/file_keys.py
"""

from __future__ import annotations

from pathlib import Path

from airlight.planets.reading.handbook import filled
from airlight.scene.system.handbook import key_table
from airlight.studies.film import handbook as films

DOCS = Path(__file__).parents[1] / "docs"
PAGES = {"planet-files.md": None, "scenes.md": key_table, "films.md": films.key_table}

if __name__ == "__main__":
    for name, table in PAGES.items():
        page = DOCS / name
        page.write_text(filled(page.read_text(encoding="utf-8"), table), encoding="utf-8")
