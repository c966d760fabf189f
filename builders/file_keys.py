"""Write the tables of keys of planet files, scenes and films into their pages.

python builders/file_keys.py
"""

from __future__ import annotations

import inspect
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from airlight.planets.clouds import CLOUD_TYPES, CLOUDS
from airlight.planets.constituent import MATTER, Constituent
from airlight.planets.ground import Ground
from airlight.planets.matter.absorbers import ABSORBERS, SmallParticleAbsorption
from airlight.planets.matter.gases import SCATTERERS
from airlight.planets.matter.particle_index import INDICES
from airlight.planets.matter.particle_sizes import SIZES
from airlight.planets.matter.phases import PHASES
from airlight.planets.matter.profiles import PROFILES, BulkGas, Layer
from airlight.planets.planet import Planet
from airlight.planets.rings import Ring
from airlight.planets.schema.field import Field, KindOfTable
from airlight.planets.schema.measures import converted
from airlight.planets.schema.tagged_union import Alternatives, TaggedUnion
from airlight.planets.shell import Shell
from airlight.planets.star import Star
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light
from airlight.scene.system.viewpoint import SceneObserver, View
from airlight.studies.film.key_frames import KeyFrames
from airlight.studies.film.plan import FilmPlan
from airlight.studies.film.view import PlanetView

DOCS: Final = Path(__file__).parents[1] / "docs"
#: Kinds of table of each page, by the name of their block.
PAGES: Final[dict[str, dict[str, KindOfTable]]] = {
    "planet-files.md": {
        "planet": Planet,
        "shell": Shell,
        "ground": Ground,
        "star": Star,
        "constituent": Constituent,
        "profile": PROFILES,
        "bulk": BulkGas,
        "layer": Layer,
        "phase_function": PHASES,
        **{kind.keyword: kind for kind in MATTER},
        "scattering": SCATTERERS,
        "absorption": ABSORBERS,
        "small_particles": SmallParticleAbsorption,
        "index": INDICES,
        "sizes": SIZES,
        "clouds": CLOUDS,
        "rings": Ring,
    },
    "clouds.md": {"kinds": CLOUDS},
    "scenes.md": {"bodies": Body, "lights": Light, "observer": SceneObserver, "camera": View},
    "films.md": {"film": FilmPlan, "keys": KeyFrames, "view": PlanetView},
}
#: Keys of a table of which one has to be given.
ONE_OF: Final = {
    "bodies": ("planet", "radius"),
    "lights": ("star", "body"),
    "observer": ("body", "position"),
    "camera": ("look_at", "direction", "look_zenith"),
}
_BLOCK: Final = re.compile(r"<!-- keys: (\w+) -->\n.*?<!-- end of keys -->", flags=re.DOTALL)
#: Largest number of words listed in a cell; more are described as tables.
_MOST_WORDS: Final = 8


def filled(name: str) -> str:
    """Text of a page with every block between ``<!-- keys: kind -->`` and its end filled."""

    def block(match: re.Match[str]) -> str:
        text = key_table(match[1], PAGES[name][match[1]])
        return f"<!-- keys: {match[1]} -->\n{text}<!-- end of keys -->"

    return _BLOCK.sub(block, (DOCS / name).read_text(encoding="utf-8"))


def key_table(name: str, kind: KindOfTable) -> str:
    """Keys of one kind of table, as a table in Markdown."""
    if name == "kinds":
        return "\n".join(_cloud_kinds()) + "\n"
    lines: list[str] = []
    keys = kind.declared()
    which = ONE_OF.get(name, ())
    if isinstance(kind, TaggedUnion):
        lines += _of_kinds(kind)
        keys = tuple(_of_all_kinds(key, kind) for key in keys if key.name != "kind")
        lines += [""] if keys else []
    elif isinstance(kind, Alternatives):
        which = kind.keywords
    if keys:
        lines.append(rows_of(keys, which))
    return "\n".join(lines) + "\n"


def rows_of(keys: Sequence[Field], which: Sequence[str] = ()) -> str:
    """Table of keys in Markdown: value, default and meaning of each.

    Parameters
    ----------
    keys : sequence of Field
        Declarations.
    which : sequence of str
        Names of keys of which one has to be given.
    """
    lines = ["| key | value | left out | meaning |", "|---|---|---|---|"]
    for key in keys:
        left_out = _left_out(key, one_of=key.name in which)
        lines.append(_row(_cell(f"`{key.name}`"), _value(key), left_out, _meaning(key)))
    return "\n".join(lines)


def _of_kinds(kinds: TaggedUnion[Any]) -> Iterator[str]:
    """Rows of a table of kinds: the word, its keys, and the first line of its class."""
    yield "| `kind` | keys | |"
    yield "|---|---|---|"
    for one in kinds.classes:
        names = ", ".join(f"`{key.name}`" for key in one.declared())
        summary = (inspect.getdoc(one) or "").splitlines()[0]
        yield _row(f'`"{one.keyword}"`', names, _cell(summary.replace("``", "`")))


def _of_all_kinds(key: Field, kinds: TaggedUnion[Any]) -> Field:
    """Key of a kind, whose default is that of all kinds or the words ``by kind``."""
    found = [own for one in kinds.classes for own in one.declared() if own.name == key.name]
    differs = len({own.left_out for own in found if not callable(own.left_out)}) > 1
    return replace(key, left_out="by kind") if differs and kinds is CLOUDS else key


def _cloud_kinds() -> Iterator[str]:
    """Table of the defaults of generated clouds."""
    names = ("base", "depth", "cover", "optical_depth", "cell", "shear", "effective_radius")
    yield _row("`kind`", *(f"`{name}`" for name in names), "")
    yield f"|{'---|' * (len(names) + 2)}"
    for one in CLOUD_TYPES:
        keys = {key.name: key for key in one.declared()}
        cells = []
        for name in names:
            unit = keys[name].shown_unit
            number = converted(keys[name].left_out, keys[name].unit, unit)
            cells.append(f"{_number(number)} {'' if unit == '1' else unit}".strip())
        summary = (inspect.getdoc(one) or "").splitlines()[0]
        yield _row(f'`"{one.keyword}"`', *cells, summary)


def _row(*cells: str) -> str:
    return f"| {' | '.join(cells)} |".replace("|  |", "| |")


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def _value(key: Field) -> str:
    """Allowed values: words, a table, a range in the unit in which it is edited."""
    parts = []
    words = key.choices()
    if key.kind == "text":
        parts.append("text")
    elif key.kind == "table":
        parts.append("a table")
    elif key.kind == "switch":
        parts.append("`true`, `false`")
    elif key.kind == "number":
        parts.append(_range(key))
        if key.spectral:
            parts.append("a list")
        elif key.listed:
            parts[-1] += ", a list"
    if words:
        few = len(words) <= _MOST_WORDS
        parts.append(", ".join(f'`"{word}"`' for word in words) if few else "a word, below")
    if key.table and key.kind != "table":
        parts.append("a table")
    return " or ".join(parts)


def _range(key: Field) -> str:
    unit = "" if key.shown_unit == "1" else f" {key.shown_unit}"
    low, high = key.limits
    if math.isfinite(low) and math.isfinite(high):
        return f"{_number(low)} to {_number(high)}{unit}"
    return f"a number{unit and f' of{unit}'}"


def _number(value: float) -> str:
    """Number with four digits, without the plus and the zeros of an exponent.

    Examples
    --------
    >>> _number(1e6), _number(1e-11), _number(0.5)
    ('1e6', '1e-11', '0.5')
    """
    return re.sub(r"e([+-])0*", lambda sign: "e" + sign[1].strip("+"), f"{value:.4g}")


def _left_out(key: Field, *, one_of: bool) -> str:
    if one_of:
        return "one of these"
    if key.required:
        return "required"
    default = key.left_out
    if isinstance(default, float):
        unit = "" if key.unit == "1" or default == 0.0 else f" {key.unit}"
        return f"{_number(default)}{unit}"
    return f"{default}" if isinstance(default, str) else ""


def _meaning(key: Field) -> str:
    return _cell(" ".join(part for part in (key.help, key.note) if part))


if __name__ == "__main__":
    for name in PAGES:
        (DOCS / name).write_text(filled(name), encoding="utf-8")
