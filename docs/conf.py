"""How Sphinx builds the site; `scripts/docs` calls it."""

from __future__ import annotations

import sys
from importlib.metadata import version as installed_version
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
sys.path[:0] = [str(HERE / "_site"), str(ROOT / "src")]

import plain_kernels  # noqa: E402

plain_kernels.install()

import api_pages  # noqa: E402
import command_page  # noqa: E402
import gallery_pages  # noqa: E402
import mathjax_file  # noqa: E402

GENERATED = HERE / "generated"

project = "airlight"
author = "airlight contributors"
copyright = author
release = installed_version("airlight")
version = release

extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "sphinx.ext.viewcode",
    "numpydoc",
    "myst_parser",
    "sphinx_design",
    "sphinx_copybutton",
]
exclude_patterns = ["_site", "_static", "images"]
templates_path: list[str] = []
nitpicky = True
myst_enable_extensions = ["amsmath", "attrs_inline", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}

autodoc_typehints = "none"  # the numpy docstrings say types, shapes and units
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
autodoc_class_signature = "mixed"
autodoc_inherit_docstrings = False
numpydoc_show_class_members = False
numpydoc_class_members_toctree = False
add_module_names = False
toc_object_entries = False
python_display_short_literal_types = True

mathjax_path = mathjax_file.NAME
html_theme = "pydata_sphinx_theme"
html_title = "airlight"
html_static_path = ["_static"]
html_css_files = ["airlight.css"]
html_search_scorer = str(HERE / "_static" / "search_scores.js")
html_copy_source = False
html_show_sphinx = False
html_sidebars = {"index": [], "generated/gallery/index": []}
html_theme_options = {
    "logo": {"text": "airlight"},
    "navbar_align": "left",
    "navbar_end": ["theme-switcher"],
    "navigation_with_keys": False,
    "show_nav_level": 1,
    "navigation_depth": 3,
    "collapse_navigation": True,
    "header_links_before_dropdown": 7,
    "footer_start": ["copyright"],
    "footer_end": [],
    "pygments_light_style": "tango",
    "pygments_dark_style": "monokai",
}
copybutton_exclude = ".linenos, .gp, .go"
copybutton_prompt_text = "$ "


def _write_pages(app) -> None:
    api_pages.write(GENERATED / "api", ROOT / "src" / "airlight")
    command_page.write(GENERATED / "commands.md")
    gallery_pages.write(GENERATED / "gallery", ROOT / "examples", HERE / "images" / "gallery")


def _keep_public_bases(app, name, value, options, bases) -> None:
    bases[:] = api_pages.public_bases(value)


def setup(app):
    """Pages that are made of the code are written before Sphinx looks for pages."""
    app.connect("config-inited", lambda app, config: _write_pages(app))
    app.connect("autodoc-process-bases", _keep_public_bases)
    app.connect("build-finished", mathjax_file.copy)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
