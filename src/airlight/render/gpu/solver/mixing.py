"""Kernels of Anderson acceleration: the next guess from the last iterates.

``rays`` defines the index.
"""

from __future__ import annotations

from airlight.kernel import inlined
from airlight.render.pixels.render_tables import WAVELENGTHS
from airlight.solver.moments.convergence import is_near
from airlight.solver.moments.stopping import PASS_ITERATES


@inlined
def mean(index, sizes, iterate, guess):
    """Mean radiances and irradiances of an iterate and its guess, read by the host. [1]

    Texels (iterate or guess, mean radiance or irradiance, radius, sun).
    """
    nodes = sizes.radii * sizes.sun_angles
    node = index % nodes
    at = node * sizes.terms
    if index // nodes % 2 == 1:
        at = nodes * sizes.terms + node
    if index < 2 * nodes:
        return iterate[at]
    return guess[at]


@inlined
def mixed(index, first, step, weights, iterates):
    """Linear combination of iterates: texel, or component if these are read as scalars.

    Parameters
    ----------
    first, step : int
        Index of the weight of ``iterate_0``, and step to the next weight.
    """
    total = weights[first] * iterates.iterate_0[index]
    total = total + weights[first + step] * iterates.iterate_1[index]
    total = total + weights[first + 2 * step] * iterates.iterate_2[index]
    total = total + weights[first + 3 * step] * iterates.iterate_3[index]
    return total + weights[first + 4 * step] * iterates.iterate_4[index]


@inlined
def sound(index, sizes, weights, iterates):
    """Acceptance of the combination of iterates by ``is_near``: 1 or 0.

    Scalars (mean radiance or irradiance, radius, sun, lane); ``iterate_0`` is the latest.
    """
    numbers = sizes.radii * sizes.sun_angles * WAVELENGTHS
    lane = index % WAVELENGTHS
    brightest = weights[WAVELENGTHS * PASS_ITERATES + lane]
    at = index // WAVELENGTHS * sizes.terms * WAVELENGTHS + lane
    if index >= numbers:
        brightest = weights[WAVELENGTHS * (PASS_ITERATES + 1) + lane]
        at = numbers * sizes.terms + index - numbers
    combined = mixed(at, lane, WAVELENGTHS, weights, iterates)
    near = is_near(combined, iterates.iterate_0[at], brightest)
    return 1.0 if near else 0.0


@inlined
def next_guess(index, sizes, weights, iterates, sounds):
    """Combination of iterates if ``sound`` accepts it, otherwise the last iterate.

    Texels as in ``gathered_moment``.
    """
    nodes = sizes.radii * sizes.sun_angles
    node = index // sizes.terms
    if index >= nodes * sizes.terms:
        node = nodes + index - nodes * sizes.terms
    last = iterates.iterate_0[index]
    return last + sounds[node] * (mixed(index, 0, 1, weights, iterates) - last)
