"""One HTML file with everything in it: style, script and data; it asks for nothing else."""

from __future__ import annotations

import html
import json
from collections.abc import Mapping
from string import Template
from typing import Any, Final

from airlight.viewer.browser.modules import join_modules, web_file

#: Nothing may be loaded, and the only script and style are those of the page itself.
_POLICY: Final = (
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src blob: data:"
)


def page_text(title: str, data: Mapping[str, Any]) -> str:
    """The text of a page.

    Parameters
    ----------
    title : str
        Of the page.
    data : mapping
        What ``web/main.js`` reads, as JSON takes it.

    Returns
    -------
    str
        HTML.
    """
    # Within a script element "</" might end it, and "<!--" begin a comment.
    carried = json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    script = join_modules("main.js")
    if "</script" in script.lower() or "<!--" in script:
        raise AssertionError("the viewer's script holds the end of a script element")
    return Template(web_file("page.html")).substitute(
        title=html.escape(title),
        policy=_POLICY,
        style=web_file("style.css"),
        data=carried,
        script=script,
    )
