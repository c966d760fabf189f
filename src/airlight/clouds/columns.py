"""Planets whose mean, weighted by area, is a planet with clouds."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from math import prod
from typing import Final, NamedTuple

from airlight.clouds.cloud_optics import droplets
from airlight.errors import ConflictError, ParameterError
from airlight.planets.clouds import Clouds, CloudType
from airlight.planets.constituent import Constituent
from airlight.planets.matter.profiles import Layer, Layered
from airlight.planets.planet import Planet

#: Largest number of columns.
MOST_COLUMNS: Final = 8


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
    layers = [cloud_layer(one, planet) for one in planet.clouds]
    bare = replace(planet, clouds=())
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


class CloudLayer(NamedTuple):
    """Uniform layer of the mean optical depth of a kind of clouds.

    Attributes
    ----------
    fraction : float
        Cover. [1]
    layer : Constituent
        Layer in the cloudy columns.
    """

    fraction: float
    layer: Constituent


def cloud_layer(clouds: Clouds, planet: Planet) -> CloudLayer:
    """Layer of a kind of clouds, which has to be within the atmosphere of the planet."""
    assert isinstance(clouds, CloudType)
    if clouds.base + clouds.depth >= planet.thickness:
        allowed = f"0 to {planet.thickness - clouds.depth:g} m, below the top of the atmosphere"
        raise ParameterError(f"clouds.{clouds.title}.base", clouds.base, allowed)
    layers = [Layer(width=clouds.depth, constant_term=1.0), Layer()]
    if clouds.base > 0.0:
        layers.insert(0, Layer(width=clouds.base))
    layer = Constituent(
        name=f"{clouds.title} (clouds)",
        profile=Layered(layers=tuple(layers)),
        matter=droplets(clouds, clouds.optical_depth),
    )
    return CloudLayer(clouds.cover, layer)
