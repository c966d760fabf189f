"""Transmittance of stretches, and of light from the star, out of a table to the top of the shell.

The quadratures of ``Solution.transmittance`` need no table and are exact; this is what a program
does that has the table alone.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from airlight.errors import ParameterError
from airlight.geometry.shell import horizon_cosine, meets_ground, radius_along
from airlight.geometry.sun_disc import sun_elevation, visible_fraction
from airlight.kernel import vectorized
from airlight.tables.layout import FloatArray
from airlight.tables.table import Table
from airlight.tables.transmittance import TransmittanceLayout


def _layout(table: Table) -> TransmittanceLayout:
    if not isinstance(table.layout, TransmittanceLayout):
        raise ParameterError("table", table.name, "one of transmittance to the top of the shell")
    return table.layout


def stretch_transmittance(
    table: Table, r: ArrayLike, mu: ArrayLike, distance: ArrayLike
) -> FloatArray:
    r"""Transmittance between two points in the shell, as a ratio of two entries.

    .. math:: T(p, q) = T(p, top) / T(q, top), \quad
              T(p, q) = T(q, top) / T(p, top) \text{ seen backwards if the ground is ahead}

    Near the horizon both entries are small and the table's error is that of their ratio; a ratio
    of two zeros counts as zero.

    Parameters
    ----------
    table : Table
        Of transmittance.
    r, mu, distance : arrays that broadcast to (...)
        Start [m], cosine of the view's zenith angle [1], and length [m]; the stretch must lie in
        the shell.

    Returns
    -------
    array, shape (..., channels)
        0 to 1. [1]

    Raises
    ------
    ParameterError
        If the table is another one.

    References
    ----------
    E. Bruneton (2017), Precomputed Atmospheric Scattering: a New Implementation,
    ``GetTransmittance``; the walk through Bruneton's transmittance, where the zenith angle at the
    far end belongs to q, not to p.
    """
    layout = _layout(table)
    start, cosine, length = np.broadcast_arrays(*(np.asarray(x, float) for x in (r, mu, distance)))
    end = vectorized(radius_along)(start, cosine, length)
    end = np.clip(end, layout.bottom_radius, layout.top_radius)
    cosine_end = np.clip((start * cosine + length) / end, -1.0, 1.0)
    back = vectorized(meets_ground)(start, cosine, layout.bottom_radius)
    sign = np.where(back, -1.0, 1.0)
    here = table.look_up(start, sign * cosine, to_ground=np.zeros(start.shape, bool))
    there = table.look_up(end, sign * cosine_end, to_ground=np.zeros(start.shape, bool))
    far, near = np.where(back[..., None], here, there), np.where(back[..., None], there, here)
    ratio = np.divide(near, far, out=np.zeros_like(near), where=far > 0.0)
    return np.minimum(ratio, 1.0)


def star_transmittance(
    table: Table, r: ArrayLike, mu_s: ArrayLike, angular_radius: ArrayLike
) -> FloatArray:
    """Share of a star's light that arrives: transmittance times the visible part of its disc.

    Parameters
    ----------
    table : Table
        Of transmittance.
    r, mu_s, angular_radius : arrays that broadcast to (...)
        Place [m], cosine of the star's zenith angle [1], radius of its disc [rad].

    Returns
    -------
    array, shape (..., channels)
        0 to 1. [1]

    Raises
    ------
    ParameterError
        If the table is another one.

    References
    ----------
    Bruneton (2017), ``GetTransmittanceToSun``, where a smoothstep stands for the exact circular
    segment, off by up to 0.039.
    """
    bottom = _layout(table).bottom_radius
    place, cosine, radius = np.broadcast_arrays(
        *(np.asarray(x, float) for x in (r, mu_s, angular_radius))
    )
    seen = vectorized(visible_fraction)(vectorized(sun_elevation)(place, cosine, bottom), radius)
    above = np.maximum(cosine, vectorized(horizon_cosine)(place, bottom))
    light = table.look_up(place, above, to_ground=np.zeros(place.shape, bool))
    return np.asarray(light * seen[..., None])
