"""Self-contained HTML file with style, script and data."""

from __future__ import annotations

import html
import json
from collections.abc import Mapping
from string import Template
from typing import Any, Final

from airlight.viewer.browser.modules import join_modules, web_file

#: Content security policy: nothing may be loaded, only inline script and style are allowed.
_POLICY: Final = (
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src blob: data:"
)

#: Picture and text in front of the script and the data, which a browser reads later.
_FIRST: Final = Template(
    '<img class="airlight-first" src="$address" alt="" style="object-fit: $fit">'
    '<div class="airlight-over airlight-progress">preview — loading</div>'
)


def page_text(title: str, data: Mapping[str, Any], first: Mapping[str, str] | None = None) -> str:
    """Text of a page.

    Parameters
    ----------
    data : mapping
        Data for ``web/main.js``, as JSON values.
    first : mapping, optional
        Image that is shown immediately, see ``first_view``.

    Returns
    -------
    str
        Text in HTML.
    """
    # Within a script element "</" could end it, and "<!--" could start a comment.
    carried = json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    script = join_modules("main.js")
    if "</script" in script.lower() or "<!--" in script:
        raise AssertionError("the viewer's script contains the end of a script element")
    return Template(web_file("page.html")).substitute(
        title=html.escape(title),
        policy=_POLICY,
        style=web_file("style.css"),
        first="" if first is None else _FIRST.substitute(first),
        data=carried,
        script=script,
    )
