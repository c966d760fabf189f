"""Remake the tables of keys in docs/window.md and docs/page-and-notebook.md.

Run with ``python builders/key_tables.py`` after a change of viewer/navigation/keys.py.
"""

from __future__ import annotations

import re
from pathlib import Path

from airlight.viewer.navigation.keys import Host, markdown

ROOT = Path(__file__).parents[1]
#: Files by host; the table stands between two comments.
FILES: dict[Host, Path] = {
    "window": ROOT / "docs" / "window.md",
    "page": ROOT / "docs" / "page-and-notebook.md",
}
_BLOCK = re.compile(r"(<!-- made by builders/key_tables.py -->\n).*?(<!-- end -->)", re.DOTALL)


def with_table(text: str, host: Host) -> str:
    """A document with its table as it should be."""
    return _BLOCK.sub(lambda found: f"{found[1]}{markdown(host)}\n{found[2]}", text)


if __name__ == "__main__":
    for host, file in FILES.items():
        file.write_text(with_table(file.read_text(encoding="utf-8"), host), encoding="utf-8")
