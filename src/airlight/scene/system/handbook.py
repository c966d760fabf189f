"""Tables of ``docs/scenes.md``: every key of a scene file as it is declared."""

from __future__ import annotations

from typing import Any, Final

from airlight.planets.reading.handbook import rows_of
from airlight.planets.schema.toml_model import TomlModel
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light
from airlight.scene.system.viewpoint import SceneObserver, View

#: Tables of a scene file, with the keys of which one is required.
TABLES: Final[dict[str, tuple[type[TomlModel], tuple[str, ...]]]] = {
    "bodies": (Body, ("planet", "radius")),
    "lights": (Light, ("star", "body")),
    "observer": (SceneObserver, ("body", "position")),
    "camera": (View, ("look_at", "direction", "look_zenith")),
}


def key_table(kind: str) -> str:
    """Markdown table of the keys of one table of a scene file.

    Parameters
    ----------
    kind : str
        Name from ``TABLES``.

    Examples
    --------
    >>> print(key_table("observer").splitlines()[2])
    | `body` | text | one of these | Body above which the observer is. |
    """
    record, which = TABLES[kind]
    keys: tuple[Any, ...] = record.declared()
    return rows_of(keys, which) + "\n"
