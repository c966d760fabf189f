"""Key tables of ``docs/films.md``, from the declarations."""

from __future__ import annotations

from typing import Any, Final

from airlight.planets.reading.handbook import rows_of
from airlight.planets.schema.toml_model import TomlModel
from airlight.studies.film.key_frames import KeyFrames
from airlight.studies.film.plan import FilmPlan
from airlight.studies.film.view import PlanetView

#: Tables of a film file.
TABLES: Final[dict[str, type[TomlModel]]] = {
    "film": FilmPlan,
    "keys": KeyFrames,
    "view": PlanetView,
}


def key_table(kind: str) -> str:
    """Markdown table of the keys of one table of a film file.

    Parameters
    ----------
    kind : str
        Name from ``TABLES``.

    Examples
    --------
    >>> print(key_table("film").splitlines()[2])
    | `frames` | 1 to 1e5 | 120 | Number of frames. |
    """
    keys: tuple[Any, ...] = TABLES[kind].declared()
    return rows_of(keys) + "\n"
