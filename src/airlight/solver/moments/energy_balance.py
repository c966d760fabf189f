r"""Energy balance of a solution, over the whole planet.

The power :math:`P_s` scattered out of the direct beam leaves through the top, enters the ground or
is absorbed. With the net upward diffuse flux F, the mean diffuse radiance J and the absorption
coefficient :math:`k_a`,

.. math:: 4\pi R_t^2 \langle F(R_t)\rangle - 4\pi R_g^2 \langle F(R_g)\rangle
          = P_s - \int k_a 4\pi J \, dV

where :math:`\langle\,\rangle` is the mean over the planet. Both sides follow from the moments of
degree 0 and 1 and the column table. A solution whose grids do not resolve the medium violates the
balance. Delta-M scaling applies to both sides; with refraction the balance is that of straight rays
in the optical radius.
"""

from __future__ import annotations

from math import pi, sqrt
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.mappings.transmittance import direction_coordinate
from airlight.kernel import vectorized
from airlight.solver.moments.setup import Setup
from airlight.solver.tables.columns import density_table

FloatArray = NDArray[np.float64]

#: Step in rows of the column table outside layers: the quadrature error of the balance is below
#: 1e-3.
_EVERY: Final = 2


def energy_error(setup: Setup, field: NDArray[np.float32]) -> FloatArray:
    """Energy balance error over the scattered and absorbed power; positive: energy is created.

    Parameters
    ----------
    setup : Setup
        Set-up of the solve.
    field : array, shape (r, s, k, nl)
        Moments of the diffuse radiance, per irradiance of the star. [1]

    Returns
    -------
    array, shape (nl,)
        [1]
    """
    grid, optics = setup.grid, setup.optics
    bottom, top = grid.bottom_radius, grid.top_radius
    mu = grid.sun_cosines
    sun_weights = 0.5 * (np.diff(mu, prepend=-1.0) + np.diff(mu, append=1.0))
    radii, beam = _direct_beam(setup)
    below = _amounts_below(setup)
    amount = _between(setup, below, radii)
    lit = np.tensordot(_logarithmic_mean(beam[:-1], beam[1:]), sun_weights, (1, 0))
    scattered = np.einsum("rc,cw,rw->w", amount, optics.scattering, lit)
    taken = np.einsum("rc,cw,rw->w", amount, optics.extinction, lit)
    ground = 2.0 * pi * bottom**2 * ((sun_weights * np.maximum(mu, 0.0)) @ beam[0])
    diffuse = np.tensordot(np.asarray(field[:, :, 0], float), sun_weights, (1, 0)) * sqrt(4.0 * pi)
    amount = _between(setup, below, setup.gathering.radii)
    diffuse = _logarithmic_mean(diffuse[:-1], diffuse[1:])
    absorbed = np.einsum("rc,cw,rw->w", amount, optics.extinction - optics.scattering, diffuse)
    # Moments refer to viewing directions: upward radiation has negative cosines.
    flux = np.tensordot(np.asarray(field[[0, -1], :, 1], float), sun_weights, (1, 0))
    flux *= -sqrt(4.0 * pi / 3.0)
    leaving = 2.0 * pi * (top**2 * flux[1] - bottom**2 * flux[0])
    return np.asarray((leaving + absorbed - scattered) / (taken + ground))


def violates_energy_balance(energy: FloatArray, tolerance: float) -> bool:
    """Whether the energy balance error exceeds half of the tolerance.

    Interpolation across an unresolved cloud boundary creates energy; radiance errors reach twice
    the energy balance error.

    Parameters
    ----------
    energy : array, shape (nl,)
        Result of ``energy_error``. [1]
    tolerance : float
        ``MomentsSettings.energy_tolerance``. [1]
    """
    return bool(energy.max() > 0.5 * tolerance)


def imbalance(energy: FloatArray, wavelengths: FloatArray, tolerance: float) -> str:
    """Message about an energy balance error; empty within the tolerance.

    Parameters
    ----------
    energy, wavelengths : array, shape (nl,)
        Result of ``energy_error`` [1], and wavelengths [nm].
    tolerance : float
        Largest size of the former. [1]
    """
    worst = int(np.abs(energy).argmax())
    error = float(energy[worst])
    if abs(error) <= tolerance:
        return ""
    return (
        f"energy is not conserved: reflected and absorbed light is {100.0 * error:+.2g} % off the "
        f"incident light at {wavelengths[worst]:g} nm (limit {100.0 * tolerance:g} %); "
        "the grid of this quality does not resolve the atmosphere"
    )


def _logarithmic_mean(low: FloatArray, high: FloatArray) -> FloatArray:
    """Logarithmic mean (a - b)/ln(a/b), of an exponential between a and b."""
    low, high = np.maximum(low, 1e-300), np.maximum(high, 1e-300)
    ratio = np.log(low / high)
    even = np.abs(ratio) < 1e-4
    return np.where(even, 0.5 * (low + high), (low - high) / np.where(even, 1.0, ratio))


def _amounts_below(setup: Setup) -> FloatArray:
    """∫ 2π r² density dr up to each altitude node, shape (n, nc). [m³]"""
    density, bottom = setup.medium.density, setup.grid.bottom_radius
    altitude, at_nodes = density.node_altitudes, density_table(density)
    middle = 0.5 * (altitude[1:] + altitude[:-1])
    shell = 0.5 * (at_nodes[1:] + at_nodes[:-1])
    shell *= (2.0 * pi * (bottom + middle) ** 2 * np.diff(altitude))[:, None]
    return np.concatenate([np.zeros((1, shell.shape[1])), np.cumsum(shell, axis=0)])


def _between(setup: Setup, below: FloatArray, radii: FloatArray) -> FloatArray:
    """Increment of ``_amounts_below`` between neighbouring radii, shape (count - 1, nc). [m³]"""
    altitude, nodes = radii - setup.grid.bottom_radius, setup.medium.density.node_altitudes
    return np.stack([np.diff(np.interp(altitude, nodes, one)) for one in below.T], axis=1)


def _direct_beam(setup: Setup) -> tuple[FloatArray, FloatArray]:
    """Radii [m], and transmittance of the direct beam there, shape (r, s, nl) [1].

    The radii are those of the column table, every other one outside layers.
    """
    grid, table, optics = setup.grid, setup.table, setup.optics
    step = _EVERY if table.radii.size == setup.settings.column_radii else 1
    radii = np.append(table.radii[:-1:step], table.radii[-1])
    values = np.concatenate([table.values[:-1:step], table.values[-1:]])
    r, mu = radii[:, None], grid.sun_cosines
    bottom, top = grid.bottom_radius, grid.top_radius
    horizon = -np.sqrt(np.maximum((r - bottom) * (r + bottom), 0.0)) / r
    x = vectorized(direction_coordinate)(r, np.maximum(mu, horizon), bottom, top)
    x = x * (values.shape[1] - 1)
    at = np.minimum(x.astype(int), values.shape[1] - 2)
    fraction = (x - at)[..., None]
    index = np.arange(r.size)[:, None]
    columns = values[index, at] * (1.0 - fraction) + values[index, at + 1] * fraction
    transmittance = np.exp(-columns @ optics.extinction)
    transmittance[mu < horizon] = 0.0
    return radii, transmittance
