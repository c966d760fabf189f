"""Choices of the kinds of three-dimensional clouds, which also add and remove them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

from airlight.planets.clouds import WORDS
from airlight.planets.reading.nested_tables import Tables, get, put, steps_of
from airlight.render.clouds import MOST_KINDS
from airlight.viewer.parameters.parameter import Parameter

#: Group of three-dimensional clouds.
CLOUD_GROUP: Final = "3-D clouds"
#: Option without clouds.
NONE: Final = "none"
_KIND: Final = re.compile(r"clouds\[\d+\]\.kind")


def is_cloud_kind(path: str) -> bool:
    """Whether a path is that of the kind of clouds.

    Examples
    --------
    >>> is_cloud_kind("clouds[0].kind"), is_cloud_kind("clouds[0].cover")
    (True, False)
    """
    return _KIND.fullmatch(path) is not None


def cloud_options(tables: Tables, path: str) -> tuple[str, ...]:
    """Options of the kind of clouds at a path: none, and kinds that no others have.

    Examples
    --------
    >>> tables = {"clouds": [{"kind": "cumulus"}, {"kind": "cirrus"}]}
    >>> "cumulus" in cloud_options(tables, "clouds[0].kind")
    True
    >>> "cirrus" in cloud_options(tables, "clouds[0].kind")
    False
    """
    listed = tables.get("clouds") or []
    own = get(tables, path)
    taken = {one.get("kind") for one in listed if isinstance(one, dict)} - {own}
    more = (own,) if isinstance(own, str) and own not in WORDS else ()
    return (NONE, *(word for word in WORDS if word not in taken), *more)


def further_clouds(tables: Tables) -> Iterator[Parameter]:
    """Parameter that adds clouds to a planet, unless a picture has no more.

    Parameters
    ----------
    tables : dict
        Tables of a planet file.
    """
    count = len(tables.get("clouds") or [])
    if count < MOST_KINDS:
        path = f"clouds[{count}].kind"
        yield Parameter(
            path=path,
            label="more clouds" if count else "clouds",
            group=CLOUD_GROUP,
            help="Kind of clouds to add.",
            kind="choice",
            options=cloud_options(tables, path),
            synonyms=("weather", "cloudiness", "overcast", "cumulus", "cirrus", "stratus", "fog"),
        )


def with_cloud_kind(tables: Tables, path: str, word: str) -> Tables:
    """Copy of the tables with clouds of another kind and its defaults, or without them.

    Parameters
    ----------
    tables : dict
        Tables of a planet file.
    path : str
        Path of the kind.
    word : str
        Its option.

    Examples
    --------
    >>> one = with_cloud_kind({}, "clouds[0].kind", "cirrus")
    >>> one, with_cloud_kind(one, "clouds[0].kind", "none")
    ({'clouds': [{'kind': 'cirrus'}]}, {})
    """
    index = steps_of(path)[1]
    assert isinstance(index, int)
    listed = list(tables.get("clouds") or [])
    listed[index : index + 1] = [] if word == NONE else [{"kind": word}]
    return put(tables, "clouds", listed or None)


def original_clouds(base: Tables, tables: Tables) -> Tables:
    """Original tables whose clouds are of the kinds of current ones, with defaults where added.

    Examples
    --------
    >>> added = {"clouds": [{"kind": "cirrus", "cover": 0.9}]}
    >>> original_clouds({}, added), original_clouds(added, added) == added
    ({'clouds': [{'kind': 'cirrus'}]}, True)
    """
    before = [*(base.get("clouds") or [])]
    clouds = []
    for index, one in enumerate(tables.get("clouds") or []):
        old = before[index] if index < len(before) else {}
        clouds.append(old if old.get("kind") == one.get("kind") else {"kind": one.get("kind")})
    return {**base, "clouds": clouds}
