"""One table of keys: each bound once, told everywhere, and known to who has to act."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from airlight.viewer.navigation.keys import Host, as_json, chord, markdown, rows_of

DOCS = Path(__file__).parents[2] / "docs"
FILES: dict[Host, Path] = {
    "window": DOCS / "window.md",
    "page": DOCS / "page-and-notebook.md",
}


@pytest.mark.parametrize("host", FILES)
def test_the_documentation_has_the_table(host: Host) -> None:
    # remade by: python builders/key_tables.py
    text = FILES[host].read_text(encoding="utf-8")
    blocks = re.findall(
        r"<!-- made by builders/key_tables.py -->\n(.*?)\n<!-- end -->", text, re.DOTALL
    )
    assert blocks == [markdown(host)]


@pytest.mark.parametrize("host", FILES)
def test_no_key_is_bound_twice(host: Host) -> None:
    # a key that flies does nothing else, and a chord stands in one row
    rows = rows_of(host)
    held = [key for row in rows for key in (*row.held, *row.factors)]
    once = [key for row in rows for key in row.once]
    assert len(held) == len(set(held))
    assert len(once) == len(set(once))
    assert not set(held) & set(once)
    # as hosts spell them, so that they can be found at all
    for key in once:
        *words, name = key.split("+") if not key.endswith("+") else [*key[:-1].split("+")[:-1], "+"]
        assert key == chord(name, control="Control" in words, shift="Shift" in words)
    assert all(key == key.lower() for key in held)


def test_both_hosts_have_the_same_rates_and_share_their_keys() -> None:
    # what one host alone offers is what the other cannot
    window, page = as_json("window"), as_json("page")
    assert window["rates"] == page["rates"]
    assert window["held"] == page["held"]
    only = set(window["once"].values()) - set(page["once"].values())
    assert only == {"compare", "save planet", "close"}
    assert set(page["once"].items()) <= set(window["once"].items())
    assert set(window["factors"]) - set(page["factors"]) == {"control"}
