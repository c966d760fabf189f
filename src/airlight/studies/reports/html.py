"""Report pages as self-contained HTML."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from html import escape

from airlight.studies.reports.parts import Part, ReportPicture, ReportTable, cell_text

_STYLE = """
:root { --ink: #1c2530; --paper: #fff; --line: #d8dee6; --met: #0a6b3d; --missed: #b3261e;
  --soft: #f4f6f9; --ours: #fff6d6; --quiet: #5a6675; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e8ee; --paper: #14181d; --line: #38424e;
  --met: #5fcf97; --missed: #ff8a80; --soft: #1d242c; --ours: #3a3318; --quiet: #9aa7b6; } }
body { font: 15px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper);
  max-width: 72rem; margin: 0 auto; padding: 1.5rem 1.2rem 4rem; }
h1 { font-size: 1.7rem; margin: 0 0 .3rem; }
h2 { font-size: 1.35rem; margin: 3rem 0 .6rem; border-top: 2px solid var(--line);
  padding-top: 1.2rem; }
h3 { font-size: 1.05rem; margin: 1.8rem 0 .4rem; }
p { max-width: 52rem; }
.verdict { font-size: 1.15rem; font-weight: 600; }
.met { color: var(--met); } .missed { color: var(--missed); font-weight: 600; }
.quiet { color: var(--quiet); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .87rem; font-variant-numeric: tabular-nums; }
th, td { border-bottom: 1px solid var(--line); padding: .22rem .7rem .22rem .3rem;
  text-align: left; vertical-align: top; }
th { background: var(--soft); font-weight: 600; }
tr.fail td { color: var(--missed); } tr.ours td { background: var(--ours); font-weight: 600; }
figure { margin: 1.2rem 0; } figcaption { color: var(--quiet); max-width: 52rem; }
figure img { max-width: 100%; height: auto; background: #fff; }
summary { cursor: pointer; font-weight: 600; margin: .7rem 0 .3rem; }
dl { display: grid; grid-template-columns: max-content auto; gap: .1rem 1rem; font-size: .9rem; }
dt { color: var(--quiet); } dd { margin: 0; }
"""


def page_html(title: str, body: Sequence[str]) -> str:
    """HTML page that is also well-formed XML.

    Parameters
    ----------
    title : str
        Title and first heading, plain text.
    body : sequence of str
        Content in HTML, block by block.
    """
    return "\n".join(
        [
            "<!DOCTYPE html>",
            '<html lang="en"><head><meta charset="utf-8"/>',
            '<meta name="viewport" content="width=device-width, initial-scale=1"/>',
            f"<title>{escape(title)}</title><style>{_STYLE}</style></head><body>",
            f"<h1>{escape(title)}</h1>",
            *body,
            "</body></html>\n",
        ]
    )


def part_html(part: Part) -> str:
    """Table, picture or text in HTML."""
    if isinstance(part, ReportTable):
        return _table(part)
    if isinstance(part, ReportPicture):
        return _picture(part)
    return "\n".join(f"<p>{escape(paragraph)}</p>" for paragraph in part.text.split("\n\n"))


def table_html(columns: Sequence[str], rows: Sequence[str]) -> str:
    """Table of plain headings and of rows in HTML."""
    head = "".join(f"<th>{escape(column)}</th>" for column in columns)
    body = "\n".join(rows)
    return (
        f'<div class="scroll"><table><thead><tr>{head}</tr></thead>'
        f"<tbody>\n{body}\n</tbody></table></div>"
    )


def _table(table: ReportTable) -> str:
    marks = table.marks or [""] * len(table.rows)
    rows = [
        f'<tr class="{mark}">' + "".join(f"<td>{escape(cell_text(c))}</td>" for c in row) + "</tr>"
        for row, mark in zip(table.rows, marks, strict=True)
    ]
    body = table_html(table.columns, rows)
    note = f'<p class="quiet">{escape(table.note)}</p>' if table.note else ""
    if table.folded:
        # A table with a missed threshold is initially open.
        is_open = ' open="open"' if "fail" in marks else ""
        missed = sum(mark == "fail" for mark in marks)
        count = f"{len(rows)} row{'s' * (len(rows) != 1)}" + (
            f", {missed} missed" if missed else ""
        )
        title = f"{escape(table.title)} ({count})"
        return f"<details{is_open}><summary>{title}</summary>{body}{note}</details>"
    return f"<h3>{escape(table.title)}</h3>{body}{note}"


def _picture(picture: ReportPicture) -> str:
    data = base64.b64encode(picture.png).decode("ascii")
    return (
        f'<figure><img alt="{escape(picture.title)}" src="data:image/png;base64,{data}"/>'
        f"<figcaption>{escape(picture.caption)}</figcaption></figure>"
    )
