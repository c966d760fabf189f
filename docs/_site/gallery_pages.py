"""The gallery: a page for each script in `examples/`, with the picture that it ends with.

Pictures are committed, small; the tests run each script and compare (tests/docs). So the site is
built without computing anything.
"""

from __future__ import annotations

import ast
from pathlib import Path

from page_files import write_pages

#: What the examples are about, in the order of the gallery.
SECTIONS = {
    "Skies from the ground": (
        "sunset_colours", "belt_of_venus", "ozone", "twilight", "mars_sunset", "moonlit_sky",
        "polarised_sky",
    ),
    "From space": (
        "limb_from_orbit", "two_planets", "city_lights", "glory", "jupiter", "ring_shadow",
        "ice_giants", "titan_backlight",
    ),
    "Planets of your own": ("own_planet", "dust"),
    "Spectra, and how right they are": (
        "zenith_spectrum", "transit_spectrum", "monte_carlo", "second_code",
    ),
    "For engines, domes and pictures": (
        "transmittance_table", "dome_master", "cube_map", "exposure",
    ),
}  # fmt: skip

HEAD = """# Gallery

Each page opens with a question and ends with a picture. Its script runs as it stands, in seconds;
the checks run all of them and compare their pictures with those shown here.
"""


def write(folder: Path, examples: Path, pictures: Path) -> None:
    """Write all pages and the index."""
    found = {path.stem: path for path in examples.glob("*.py")}
    listed = [name for names in SECTIONS.values() for name in names]
    if sorted(found) != sorted(listed):
        odd = ", ".join(sorted(set(found) ^ set(listed)))
        raise ValueError(f"docs/_site/gallery_pages.py: in examples/ or in SECTIONS only: {odd}")
    pages = {f"{name}.md": _page(found[name], pictures) for name in listed}
    pages["index.md"] = _index(found)
    write_pages(folder, pages)


def read_example(path: Path) -> tuple[str, str, int]:
    """Question, text and the number of the first line of code of an example."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    text = ast.get_docstring(tree) or ""
    question, _, rest = text.partition("\n\n")
    if not question.endswith("?"):
        raise ValueError(f"{path}: the first line of an example is a question")
    return question, rest.strip(), (tree.body[0].end_lineno or 0) + 2


def _page(path: Path, pictures: Path) -> str:
    question, text, first = read_example(path)
    picture = pictures / f"{path.stem}.png"
    if not picture.exists():
        raise ValueError(f"{picture} is missing: scripts/docs --pictures makes it")
    return f"""# {question}

{text}

```{{literalinclude}} ../../../examples/{path.name}
:language: python
:lines: {first}-
```

```{{image}} ../../images/gallery/{path.stem}.png
:alt: {question}
:class: gallery-picture
```

{{download}}`{path.name} <../../../examples/{path.name}>`
"""


def _index(found: dict[str, Path]) -> str:
    parts = [HEAD]
    for section, names in SECTIONS.items():
        parts.append(f"## {section}\n\n::::{{grid}} 1 2 3 3\n:gutter: 3\n")
        for name in names:
            question = read_example(found[name])[0]
            parts.append(
                f":::{{grid-item-card}} {question}\n:link: {name}\n:link-type: doc\n"
                f":img-top: ../../images/gallery/{name}.png\n:::\n"
            )
        parts.append("::::\n")
    listed = "\n".join(name for names in SECTIONS.values() for name in names)
    parts.append(f"```{{toctree}}\n:hidden:\n\n{listed}\n```\n")
    return "\n".join(parts)
