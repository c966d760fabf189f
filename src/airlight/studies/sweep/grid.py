"""``Grid``: axes and blocks of a sweep."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.physics.units import values_in
from airlight.planets.parameters import numbers
from airlight.planets.planet import Planet
from airlight.planets.reading.reader import PlanetLike, load_planet

FloatArray: TypeAlias = NDArray[np.float64]

#: Range of numbers with the same unit: ``0.1:0.5:0.1``, ``1:5:2 km``.
_RANGE: Final = re.compile(r"([^:]+:[^:]+:\s*[-+.\deE]+)\s*(.*)")

#: Angles and altitude, with range and unit.
AXES: Final[dict[str, tuple[float, float, str]]] = {
    "altitude": (0.0, 1e12, "m"),
    "sun_zenith": (0.0, 180.0, "deg"),
    "view_zenith": (0.0, 180.0, "deg"),
    "azimuth": (-360.0, 360.0, "deg"),
}
#: Largest number of values of one axis, of planets and of radiances in total.
MOST_VALUES: Final = 100_000
MOST_PLANETS: Final = 10_000
MOST_RADIANCES: Final = 10**12
#: Radiances of one block, of four bytes each.
_BLOCK: Final = 1 << 19


@dataclass(frozen=True, kw_only=True)
class Grid:
    """Grid of a sweep: planets × varied keys × geometry × wavelengths.

    Parameters
    ----------
    planets : sequence of str, Path, Planet or Solution
        Presets, planet files or planets with different names; or a single one.
    vary : mapping
        Values of keys of the planet files by path, each of which is an axis; see ``varied``.
        Planets without a file do not vary.
    common : mapping
        Overrides of the files of all planets by path, before those of ``vary``.
    altitude : array
        Altitudes of the observer: numbers, text with a unit (also a range, ``"0:10:2 km"``) or
        quantities. [m]
    sun_zenith, view_zenith, azimuth : array
        Zenith angles of sun and view, and the azimuth between them. [deg]
    wavelengths : array, optional
        Wavelengths; default: those of the first planet. [nm]

    Examples
    --------
    >>> grid = Grid(planets=["earth-atmosphere-plus"], sun_zenith=[0, 60], view_zenith=[0, 30, 60])
    >>> grid.dims
    ('planet', 'altitude', 'sun_zenith', 'view_zenith', 'azimuth', 'wavelength')
    >>> grid.shape
    (1, 1, 2, 3, 1, 3)
    """

    planets: Sequence[PlanetLike]
    vary: Mapping[str, Sequence[Any]] = field(default_factory=dict)
    altitude: Sequence[float] = (0.0,)
    sun_zenith: Sequence[float]
    view_zenith: Sequence[float]
    azimuth: Sequence[float] = (0.0,)
    common: Mapping[str, Any] = field(default_factory=dict)
    wavelengths: Sequence[float] | None = None

    def __post_init__(self) -> None:
        if isinstance(self.planets, (str, Path)) or not isinstance(self.planets, Sequence):
            object.__setattr__(self, "planets", (self.planets,))
        vary = {path: varied(values, path) for path, values in self.vary.items()}
        object.__setattr__(self, "vary", vary)
        if self.wavelengths is not None:
            nm = np.atleast_1d(values_in(self.wavelengths, "nm", "wavelengths"))
            object.__setattr__(self, "wavelengths", tuple(nm.tolist()))
        for name, (low, high, unit) in AXES.items():
            given = np.atleast_1d(values_in(getattr(self, name), unit, name)).tolist()
            if not 1 <= len(given) <= MOST_VALUES:
                raise ParameterError(name, f"{len(given)} values", f"1 to {MOST_VALUES}")
            values = numbers(given, name, low, high, unit)
            if any(b <= a for a, b in itertools.pairwise(values)):
                raise ParameterError(name, given, "ascending values")
            object.__setattr__(self, name, values)
        count = len(self.planets) * math.prod(len(values) for values in self.vary.values())
        if not 1 <= count <= MOST_PLANETS:
            raise ParameterError("planets", count, f"1 to {MOST_PLANETS} including varied keys")
        for names in (self.names, *self.vary.values()):
            texts = [str(one) for one in names]
            for text in texts:
                if texts.count(text) > 1:
                    raise ParameterError("planets", text, "each planet and each value once")
        total = math.prod(self.shape)
        if total > MOST_RADIANCES:
            raise ParameterError("size", total, f"at most {MOST_RADIANCES} radiances in total")

    @property
    def names(self) -> tuple[str, ...]:
        """Planets by preset, path or name."""
        return tuple(
            str(one) if isinstance(one, (str, Path)) else load_planet(one).name
            for one in self.planets
        )

    @cached_property
    def nm(self) -> tuple[float, ...]:
        """Wavelengths. [nm]"""
        if self.wavelengths is None:
            return tuple(self.planet((0,) * (1 + len(self.vary))).wavelengths)
        return tuple(float(one) for one in self.wavelengths)

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the axes."""
        return ("planet", *self.vary, *AXES, "wavelength")

    @property
    def shape(self) -> tuple[int, ...]:
        """Lengths of the axes."""
        sizes = (len(getattr(self, name)) for name in AXES)
        return (*self.variants, *sizes, len(self.nm))

    @property
    def variants(self) -> tuple[int, ...]:
        """Numbers of planets and of values of each path."""
        return (len(self.planets), *(len(values) for values in self.vary.values()))

    def changes(self, variant: tuple[int, ...]) -> dict[str, Any]:
        """Overrides of one planet of the grid."""
        varied = zip(variant[1:], self.vary.items(), strict=True)
        return {**self.common, **{path: values[k] for k, (path, values) in varied}}

    def planet(self, variant: tuple[int, ...]) -> Planet:
        """Planet of the grid, by its indices along ``variants``."""
        return load_planet(self.planets[variant[0]], self.changes(variant))

    # --- blocks -------------------------------------------------------------------------------

    @property
    def steps(self) -> tuple[int, int]:
        """Numbers of suns and of views in a block of about half a million radiances."""
        line = len(self.azimuth) * len(self.nm)
        views = max(1, min(len(self.view_zenith), _BLOCK // line))
        return max(1, min(len(self.sun_zenith), _BLOCK // (line * views))), views

    @property
    def blocks(self) -> tuple[int, ...]:
        """Numbers of blocks along planets, paths, altitudes, suns and views."""
        angles = zip((self.sun_zenith, self.view_zenith), self.steps, strict=True)
        return (*self.variants, len(self.altitude), *(-(-len(one) // step) for one, step in angles))

    def region(self, block: tuple[int, ...]) -> tuple[Any, ...]:
        """Indices and slices of a block in the array of radiances."""
        parts = zip(block[-2:], self.steps, (self.sun_zenith, self.view_zenith), strict=True)
        angles = [slice(k * step, min((k + 1) * step, len(one))) for k, step, one in parts]
        return (*block[:-2], *angles, slice(None), slice(None))


def varied(values: Any, path: str) -> list[Any]:
    """Values of a varied key, from a sequence or from the text of a list or range.

    Parameters
    ----------
    values : str, or sequence
        Text, or values as a planet file takes them, quantities included.
    path : str
        Path of the key, for errors.

    Examples
    --------
    >>> varied("0.1:0.3:0.1", "ground.albedo"), varied("1:5:2 km", "dust.profile.scale_height")
    ([0.1, 0.2, 0.3], ['1 km', '3 km', '5 km'])
    """
    if not isinstance(values, str):
        return list(values)
    match = _RANGE.fullmatch(values.strip())
    if match is None:
        items = [item.strip() for item in values.split(",")]
        if not all(items):
            raise ParameterError(path, values, "A,B,C or FROM:TO:STEP, such as 0.1,0.3")
        return [_plain(item) for item in items]
    numbers = values_in(match[1], "1", path).tolist()
    return [f"{one:.12g} {match[2]}" for one in numbers] if match[2] else numbers


def _plain(item: str) -> float | str:
    try:
        return float(item)
    except ValueError:
        return item
