"""Planets whose mean, weighted by area, is a planet with clouds."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from math import prod
from typing import Any, Final, NamedTuple

import numpy as np

from airlight.clouds.cloud_optics import REFERENCE, CloudOptics, droplets
from airlight.clouds.planet_clouds import Box, field_of
from airlight.errors import ConflictError, ParameterError
from airlight.planets.clouds import ICE, Clouds, CloudType
from airlight.planets.constituent import Constituent
from airlight.planets.matter.profiles import Layer, Layered
from airlight.planets.planet import Planet

#: Largest number of columns.
MOST_COLUMNS: Final = 8
#: Vertical optical depth up to which a column of a field is clear. [1]
CLEAR_COLUMN: Final = 0.1


class PlanetColumn(NamedTuple):
    """Planet of horizontally uniform layers that covers a part of another.

    Attributes
    ----------
    fraction : float
        Fraction of the area. [1]
    planet : Planet
        Planet without three-dimensional clouds.
    """

    fraction: float
    planet: Planet


def planet_columns(planet: Planet) -> tuple[PlanetColumn, ...]:
    r"""Columns of a planet with clouds: each kind of clouds is there, or not.

    The kinds overlap at random: a column with the kinds K has the fraction

    .. math:: \prod_{k \in K} c_k \prod_{k \notin K} (1 - c_k)

    for covers c. A cloud is a uniform layer from base to top with its mean optical depth.

    Parameters
    ----------
    planet : Planet
        Planet.

    Returns
    -------
    tuple of PlanetColumn
        Columns with a fraction above 0; the first has the fewest clouds.

    Raises
    ------
    ConflictError
        If there would be more than eight columns.
    ParameterError
        If a cloud is higher than the atmosphere.
    """
    layers = [_layer(one, planet) for one in planet.clouds]
    bare = planet.without_clouds
    columns = []
    for present in product((False, True), repeat=len(layers)):
        fraction = prod(
            one.fraction if there else 1.0 - one.fraction
            for one, there in zip(layers, present, strict=True)
        )
        if fraction > 0.0:
            extra = tuple(one.layer for one, there in zip(layers, present, strict=True) if there)
            constituents = (*bare.constituents, *extra)
            columns.append(PlanetColumn(fraction, replace(bare, constituents=constituents)))
    if len(columns) > MOST_COLUMNS:
        raise ConflictError(
            "clouds", f"at most 3 kinds of broken cover, {len(columns)} columns here"
        )
    return tuple(columns)


class _Layer(NamedTuple):
    """Uniform layer in the cloudy columns, and their fraction of the area. [1]"""

    fraction: float
    layer: Constituent


def _layer(clouds: Clouds, planet: Planet) -> _Layer:
    """Layer of a kind of clouds, which has to be within the atmosphere of the planet."""
    if isinstance(clouds, CloudType):
        base, depth = clouds.base, clouds.depth
        cover, optical_depth, radius = clouds.cover, clouds.optical_depth, clouds.effective_radius
    else:
        field, radius = field_of(clouds, Box(), planet.bottom_radius)
        columns = field.column_optical_depth
        cloudy = columns > CLEAR_COLUMN
        levels = np.nonzero(field.extinction.max(axis=(0, 1)) > 0.0)[0]
        first, last = (int(levels[0]), int(levels[-1]) + 1) if levels.size else (0, 1)
        base, depth = field.base + first * field.spacing[2], (last - first) * field.spacing[2]
        cover = float(cloudy.mean())
        optical_depth = float(columns[cloudy].mean()) if cover > 0.0 else 0.0
    if base + depth >= planet.thickness:
        allowed = f"0 to {planet.thickness - depth:g} m, below the top of the atmosphere"
        raise ParameterError(f"clouds.{clouds.title}.base", base, allowed)
    widths = [Layer(width=depth, constant_term=1.0), Layer()]
    if base > 0.0:
        widths.insert(0, Layer(width=base))
    parts: dict[str, Any] = {
        "name": f"{clouds.title} (clouds)",
        "profile": Layered(layers=tuple(widths)),
    }
    if clouds.particles == ICE:
        phase = CloudOptics.of_ice(radius, [REFERENCE]).phase
        parts |= {"scattering": optical_depth / depth, "phase_function": phase}
    else:
        drops = droplets(radius, clouds.effective_variance)
        parts["matter"] = replace(
            drops, number_density=None, optical_depth=optical_depth, at=REFERENCE
        )
    return _Layer(cover, Constituent(**parts))
