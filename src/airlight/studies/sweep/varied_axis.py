"""Values of a varied key of planet files as a coordinate: numbers with unit, or texts."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.planets.reading.declared_keys import key_at, spelled_out
from airlight.planets.reading.overrides import indexed_path
from airlight.planets.reading.reader import PlanetLike, nested_tables, planet_text
from airlight.planets.schema.field import Field
from airlight.planets.schema.measures import DOBSON, number_in

#: Number and the symbol of its unit; other units are converted.
_TEXT: Final = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([A-Za-zµ]+|%)\s*")
_POWERS: Final = str.maketrans("⁻¹²³", "-123")


def varied_axis(planet: PlanetLike, path: str, values: Sequence[Any]) -> tuple[NDArray[Any], str]:
    """Values of a key as an axis.

    Parameters
    ----------
    planet : str, Path, Planet or Solution
        Preset or planet file with the key.
    path : str
        Path of the key, as for overrides.
    values : sequence
        Numbers, texts with a unit, or words, as in a planet file.

    Returns
    -------
    values : array, shape (n,)
        Numbers in the unit; texts if one of the values is not a number.
    unit : str
        Common unit of the values, otherwise the SI unit of the key, by the CF conventions; empty
        for texts.

    Examples
    --------
    >>> numbers, unit = varied_axis("earth", "ozone.absorption.ozone", ["200 DU", "300 DU"])
    >>> numbers.tolist(), unit
    ([200.0, 300.0], 'DU')
    >>> numbers, unit = varied_axis("earth", "shell.top_radius", ["6460 km", 6.5e6])
    >>> numbers.tolist(), unit
    ([6460000.0, 6500000.0], 'm')
    """
    matches = [_TEXT.fullmatch(one) if isinstance(one, str) else None for one in values]
    symbols = {match[2] if match else "" for match in matches}
    if len(symbols) == 1 and "" not in symbols:
        return np.array([float(match[1]) for match in matches if match]), symbols.pop()
    key = _key(planet, path)
    if key is None or key.kind != "number":
        words = [isinstance(one, (str, bool)) for one in values]
        return np.array([str(one) for one in values] if any(words) else values), ""
    unit = DOBSON if key.shown_unit == DOBSON else key.unit
    try:
        numbers = [number_in(one, unit, key.unit, path) for one in values]
    except ParameterError:
        return np.array([str(one) for one in values]), ""
    return np.array(numbers), replace(key, unit=unit).unit_words.translate(_POWERS) or "1"


def _key(planet: PlanetLike, path: str) -> Field | None:
    """Declaration of the key; None if the planet has no file or not this key."""
    if not isinstance(planet, (str, Path)):
        return None
    text, file, folder = planet_text(planet)
    tables = spelled_out(nested_tables(text, file), folder)
    try:
        return key_at(tables, indexed_path(tables, path))
    except ParameterError:
        return None
