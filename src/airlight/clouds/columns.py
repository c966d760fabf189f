"""Planets whose mean, weighted by area, is a planet with clouds."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from math import prod
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import REFERENCE, CloudOptics, droplets
from airlight.clouds.planet_clouds import Box, field_of
from airlight.errors import ConflictError, ParameterError
from airlight.planets.clouds import ICE, Clouds, CloudType
from airlight.planets.constituent import Constituent
from airlight.planets.matter.profiles import Layer, Layered
from airlight.planets.spectral import PerWavelength

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

#: Largest number of columns.
MOST_COLUMNS: Final = 8
#: Vertical optical depth up to which a column of a field is clear. [1]
CLEAR_COLUMN: Final = 0.1
#: Displacement of base and top [m], and logarithm of the ratio of optical depths [1], up to which
#: layers count as alike: a few per cent of the light of the air.
_LIKE_ALTITUDE: Final = 800.0
_LIKE_DEPTH: Final = 0.3
#: Start of the names of constituents of ``with_even_layer``.
LAYER: Final = "mean layer of clouds"


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


class EvenLayer(NamedTuple):
    """Uniform layer in the cloudy columns of a field.

    Attributes
    ----------
    cover : float
        Fraction of the area of cloudy columns. [1]
    base, depth : float
        Altitude of the lowest cloud, and height of the highest above it. [m]
    optical_depths : array, shape (n,)
        Vertical optical depths of the cloudy columns at 550 nm. [1]
    """

    cover: float
    base: float
    depth: float
    optical_depths: NDArray[np.float32]

    @classmethod
    def of(cls, field: CloudField) -> EvenLayer:
        """Layer of a field."""
        columns = field.column_optical_depth
        cloudy = columns > CLEAR_COLUMN
        levels = np.nonzero(field.extinction.max(axis=(0, 1)) > 0.0)[0]
        first, last = (int(levels[0]), int(levels[-1]) + 1) if levels.size else (0, 1)
        step = field.spacing[2]
        return cls(
            float(cloudy.mean()), field.base + first * step, (last - first) * step, columns[cloudy]
        )

    def is_like(self, other: EvenLayer) -> bool:
        """Whether the air above and below scatters nearly the same light, whatever the cover."""
        first, second = (max(float(np.mean(one.optical_depths)), 1e-3) for one in (self, other))
        moved = abs(self.base - other.base) + abs(self.depth - other.depth)
        return moved < _LIKE_ALTITUDE and abs(np.log(first / second)) < _LIKE_DEPTH


def reflecting_depth(optical_depths: NDArray[np.floating], asymmetry: float) -> float:
    r"""Optical depth of a uniform layer that reflects as much as columns on average. [1]

    A layer of their mean depth would reflect more: 0.63 rather than 0.47 for cumuli. The
    reflectance is that of diffuse light without absorption,

    .. math:: R = \frac{b \tau}{1 + b \tau}, \quad b = \frac{\sqrt{3}}{2} (1 - g)

    Parameters
    ----------
    optical_depths : array
        Vertical optical depths of the columns. [1]
    asymmetry : float
        Mean cosine g of the scattering angle. [1]

    References
    ----------
    Lacis & Hansen (1974), J. Atmos. Sci. 31, 118 (R; b = 0.13 for g = 0.85); Cahalan et al.
    (1994), J. Atmos. Sci. 51, 2434 (bias of plane-parallel albedo).

    Examples
    --------
    >>> round(reflecting_depth(np.full(3, 8.0), 0.85), 6)
    8.0
    """
    b = max(0.5 * np.sqrt(3.0) * (1.0 - asymmetry), 1e-6)
    passed = (1.0 / (1.0 + b * optical_depths.astype(float))).mean()
    return float((1.0 / passed - 1.0) / b)


def with_even_layer(planet: Planet, layer: EvenLayer, optics: CloudOptics) -> Planet:
    """Planet with an additional uniform layer that reflects as much as three-dimensional clouds.

    Parameters
    ----------
    planet : Planet
        Planet without three-dimensional clouds, possibly with other such layers.
    layer : EvenLayer
        Altitudes of the layer, and optical depths of the clouds' columns.
    optics : CloudOptics
        Optical properties of the particles.
    """
    nm, albedo = np.asarray(optics.wavelengths), np.asarray(optics.albedo)
    moments = np.asarray(optics.phase.moments(nm, 1))
    asymmetry = float((moments[:, 1] / moments[:, 0]).mean())
    optical_depth = reflecting_depth(layer.optical_depths, asymmetry)
    extinction = optical_depth / layer.depth * np.asarray(optics.extinction)

    def spectrum(values: NDArray[np.float64]) -> PerWavelength:
        return PerWavelength(wavelengths=tuple(nm.tolist()), values=tuple(values.tolist()))

    bare = planet.without_clouds
    cloud = Constituent(
        name=f"{LAYER} {len(bare.constituents)}",
        profile=_profile(layer.base, layer.depth),
        scattering=spectrum(extinction * albedo),
        absorption=spectrum(extinction * (1.0 - albedo)),
        phase_function=optics.phase,
    )
    return replace(bare, constituents=(*bare.constituents, cloud))


def _profile(base: float, depth: float) -> Layered:
    """Profile that is 1 from base to top of a layer, and 0 elsewhere."""
    widths = [Layer(width=depth, constant_term=1.0), Layer()]
    if base > 0.0:
        widths.insert(0, Layer(width=base))
    return Layered(layers=tuple(widths))


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
        even = EvenLayer.of(field)
        cover, base, depth = even.cover, even.base, even.depth
        optical_depth = float(even.optical_depths.mean()) if cover > 0.0 else 0.0
    if base + depth >= planet.thickness:
        allowed = f"0 to {planet.thickness - depth:g} m, below the top of the atmosphere"
        raise ParameterError(f"clouds.{clouds.title}.base", base, allowed)
    parts: dict[str, Any] = {"name": f"{clouds.title} (clouds)", "profile": _profile(base, depth)}
    if clouds.particles == ICE:
        phase = CloudOptics.of_ice(radius, [REFERENCE]).phase
        parts |= {"scattering": optical_depth / depth, "phase_function": phase}
    else:
        drops = droplets(radius, clouds.effective_variance)
        parts["matter"] = replace(
            drops, number_density=None, optical_depth=optical_depth, at=REFERENCE
        )
    return _Layer(cover, Constituent(**parts))
