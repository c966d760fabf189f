"""MathJax from the installed package, one file that draws equations as SVG.

The site asks for nothing from a network and opens from disk: no web fonts, no parts that are
loaded later.
"""

from __future__ import annotations

import shutil
from importlib.metadata import files
from pathlib import Path

#: As `mathjax_path` names it, below `_static`.
NAME = "mathjax/tex-svg.js"


def copy(app, error) -> None:
    """Put the file where pages look for it, once the site is built."""
    if error is not None or app.builder.format != "html":
        return
    found = [path for path in files("sphinx-mathjax-offline") or [] if path.name == "tex-svg.js"]
    target = Path(app.outdir) / "_static" / NAME
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(found[0].locate(), target)
