"""Angular shape of the smooth part of radiance: the divisor of the table ``scattering``.

In dust multiple scattering has a wide forward peak, which eight linear texels of nu do not resolve.
Its shape varies little, so the smooth part is divided by the shape along one reference line of
sight, a phase function. Impossible angles of texels are filled by the same shape. Measurements:
docs/decisions/14-engine-exports.md.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.baking.air_light import AirLight
from airlight.engines.baking.packing import ScatteringGroups, separate_orders
from airlight.kernel import vectorized
from airlight.physics.optics.phase_functions import rayleigh as rayleigh_phase
from airlight.solver.tables.columns import columns
from airlight.solver.tables.layout import Positions
from airlight.solver.tables.scattered_light import PhaseFunctions

FloatArray = NDArray[np.float64]

#: Zenith angle of view and star on the reference line of sight. [deg]
_ZENITH: Final = 80.0
#: Largest vertical optical depth above the reference point; in thinner atmospheres it is on the
#: ground.
_DEPTH: Final = 0.5
#: Number of angles on the reference line of sight.
_ANGLES: Final = 129
#: Number of altitudes at which the depth is found.
_ALTITUDES: Final = 2001
#: Smallest value of an angular shape, relative to its largest.
_LEAST: Final = 1e-4


def smooth_phases(
    air: AirLight, groups: ScatteringGroups, *, each: bool, rayleigh: bool
) -> tuple[PhaseFunctions, FloatArray]:
    """Phase functions of a look-up, and the angular shape of multiple scattering.

    On the reference line of sight view and star are 80° from the zenith, at angles of 0 to 160°,
    beyond which shapes are constant.

    Parameters
    ----------
    air, groups, each
        Arguments of ``separate_orders``.
    rayleigh : bool
        Whether the smooth part is divided by the Rayleigh phase function.

    Returns
    -------
    phases : PhaseFunctions
        ``smooth``, or ``rayleigh``, then those of the particles of ``groups``. [sr⁻¹]
    rest : array, shape (nl, nodes)
        Shape of the smooth part without single scattering by the gas, on the same nodes. [1]
    """
    medium = air.solution.medium
    mu = float(np.cos(np.radians(_ZENITH)))
    around = np.pi * np.linspace(0.0, 1.0, _ANGLES) ** 1.5  # dense towards the star
    nu = np.clip(mu * mu + (1.0 - mu * mu) * np.cos(around), -1.0, 1.0)
    radius = np.full(nu.size, _radius(air))
    separated = separate_orders(
        air, Positions.of(radius, mu, mu, nu, bottom_radius=medium.bottom_radius), groups, each=each
    )
    gas = groups.phases.at("gas", nu)
    nodes = np.linspace(0.0, 1.0, groups.phases.values.shape[-1])
    u = np.sqrt(0.5 * (1.0 - nu))
    whole = _on_nodes(u, separated.rayleigh * gas + separated.remainder, nodes)
    # dΩ = 2π sinθ dθ = 8π u du.
    rings = 8.0 * np.pi * nodes * whole
    norm = 0.5 * (rings[:, 1:] + rings[:, :-1]).sum(axis=-1) * nodes[1]
    rest = _on_nodes(u, separated.remainder, nodes)
    own = np.asarray(groups.phases.values[1:])
    if rayleigh:
        even = vectorized(rayleigh_phase)(1.0 - 2.0 * nodes**2, 0.0)
        first, whole = "rayleigh", np.broadcast_to(even, whole.shape)
        # Radiance at the nearest possible angle: with the shape along the reference line, skies of
        # Earth under a high sun err by 1.6 % instead of 0.3 % (median).
        rest = np.ones_like(rest)
    else:
        first, whole = "smooth", whole / norm[:, None]
    names = (first, *groups.phases.names[1:])
    return PhaseFunctions(names, np.concatenate([whole[None], own])), rest


def _radius(air: AirLight) -> float:
    """Radius of the reference point. [m]"""
    medium = air.solution.medium
    r = medium.bottom_radius + medium.thickness * np.linspace(0.0, 1.0, _ALTITUDES) ** 2
    up = np.ones_like(r)
    above = columns(r, up, medium.top_radius - r, medium.bottom_radius, medium.density)
    depth = (above @ medium.extinction).mean(axis=-1)
    return float(r[int(np.argmax(depth <= _DEPTH))])


def _on_nodes(u: FloatArray, values: FloatArray, nodes: FloatArray) -> FloatArray:
    """Positive values (n, nl) at ascending u, interpolated to nodes, shape (nl, nodes)."""
    from scipy.interpolate import PchipInterpolator

    rows, first = np.unique(u, return_index=True)
    made = values[first].T
    largest = made.max(axis=-1, keepdims=True)
    made = np.where(largest > 0.0, np.maximum(made, _LEAST * largest), 1.0)
    logarithms = PchipInterpolator(rows, np.log(made), axis=-1)
    return np.asarray(np.exp(logarithms(np.clip(nodes, rows[0], rows[-1]))))
