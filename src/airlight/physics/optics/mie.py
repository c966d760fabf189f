"""Mie scattering by spheres, averaged over a size distribution.

The coefficients a_n, b_n of all spheres follow from one recurrence; sums over them, over angles and
over radii are matrix products, a few hundred times faster than loops over spheres and angles.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.errors import Cancelled, ParameterError
from airlight.kernel.threads import Cancel
from airlight.physics.optics.size_distribution import SizeNodes

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

#: Largest size parameter 2πr/λ by Mie theory; larger spheres are in the geometric-optics regime.
LARGEST_SIZE_PARAMETER: Final = 3000.0
#: Step in ln r between larger absorbing spheres.
_LARGE_STEP: Final = 0.1
#: Largest number of even steps between scattering angles.
MOST_STEPS: Final = 8000.0
#: Number of diffraction rings, and of glory rings, that are always resolved, and angles per ring.
_RINGS: Final = 12
_PER_RING: Final = 40.0
#: Growth of the steps between angles from the ends inwards.
_GROWTH: Final = 1.15
#: Number of radii summed together, since their series have similar lengths.
_BLOCK: Final = 64


@dataclass(frozen=True, eq=False)
class Scattering:
    """Mean optical properties per particle at one wavelength.

    Parameters
    ----------
    extinction, scattering : float
        Cross-sections. [m²]
    asymmetry : float
        Mean cosine of the scattering angle. [1]
    phase : array, shape (na,)
        Phase function at the given angles; its integral over the sphere is 1. [sr⁻¹]
    ratios : array, shape (3, na)
        F₁₂, F₃₃ and F₃₄ of the phase matrix over the phase function, see ``phase_matrix``. [1]
    """

    extinction: float
    scattering: float
    asymmetry: float
    phase: FloatArray
    ratios: FloatArray


def efficiencies(size_parameter: float, index: complex) -> tuple[float, float, float]:
    """Extinction and scattering efficiencies and asymmetry of a sphere.

    Parameters
    ----------
    size_parameter : float
        Size parameter x = 2πr/λ. [1]
    index : complex
        Refractive index n + ik, k 0 or more. [1]

    Returns
    -------
    extinction, scattering, asymmetry : float
        Efficiencies, and mean cosine of the scattering angle. [1]

    References
    ----------
    Bohren & Huffman (1983), Absorption and Scattering of Light by Small Particles, eqs. 4.61,
    4.62 and p. 120.

    Examples
    --------
    >>> from math import pi
    >>> q_ext, q_sca, g = efficiencies(2 * pi * 1600 / 550, 1.52 + 0.006j)
    >>> f"{q_ext:.3f} {q_sca / q_ext:.3f} {g:.3f}"
    '2.267 0.822 0.792'
    """
    a, b = _coefficients(np.array([size_parameter]), np.array([index]))
    sums = _sums(a, b, index)
    scale = 2.0 / size_parameter**2
    return float(scale * sums[0, 0]), float(scale * sums[1, 0]), float(sums[2, 0] / sums[1, 0])


def scattering(
    sizes: SizeNodes,
    wavelength: float,
    index: complex,
    angles: npt.ArrayLike,
    *,
    cancel: Cancel | None = None,
) -> Scattering:
    """Mean cross-sections and phase matrix per particle.

    Parameters
    ----------
    sizes : SizeNodes
        Sizes from ``physics.optics.size_distribution``.
    wavelength : float
        Vacuum wavelength; the surrounding medium is taken as vacuum. [nm]
    index : complex
        Refractive index of the particles n + ik, k 0 or more. [1]
    angles : array, shape (na,)
        Scattering angles. [deg]
    cancel : callable, optional
        Called every 64 radii; True stops with ``Cancelled``.

    Raises
    ------
    ParameterError
        If the index is unphysical.

    Notes
    -----
    See ``computed_spheres`` for spheres of a size parameter above 3000.

    References
    ----------
    Bohren & Huffman (1983), Absorption and Scattering of Light by Small Particles, §4.4.
    """
    check_index(index)
    wavenumber = 2.0 * np.pi / (1e-9 * wavelength)
    sizes, indices = computed_spheres(sizes, wavelength, index)
    mu = np.cos(np.radians(np.asarray(angles, dtype=np.float64)))
    totals, matrix = np.zeros(3), np.zeros((4, mu.size))
    longest = _terms(wavenumber * float(sizes.radii.max()))
    plus, minus = _angular_functions(mu, longest)
    for part in _blocks(len(sizes.radii)):
        if cancel is not None and cancel():
            raise Cancelled("cancelled")
        a, b = _coefficients(wavenumber * sizes.radii[part], indices[part])
        weights = sizes.weights[part]
        totals += _sums(a, b, index) @ weights
        matrix += _matrices(a, b, plus, minus, weights)
    # C = 2π/k² Σ …, dC/dΩ = (|S₁|² + |S₂|²)/(2k²)
    extinction, scattered, forward = totals
    area = 2.0 * np.pi / wavenumber**2
    return Scattering(
        extinction=float(area * extinction),
        scattering=float(area * scattered),
        asymmetry=float(forward / scattered),
        phase=matrix[0] / (4.0 * np.pi * scattered),
        ratios=matrix[1:] / matrix[0],
    )


def check_index(index: complex) -> None:
    """Raise an error for an unphysical refractive index or one with gain."""
    if not 0.1 <= index.real <= 10.0:
        raise ParameterError("index.real", index.real, "0.1 to 10")
    if not 0.0 <= index.imag <= 10.0:
        raise ParameterError("index.imaginary", index.imag, "0 to 10, without gain")


def computed_spheres(
    sizes: SizeNodes, wavelength: float, index: complex
) -> tuple[SizeNodes, ComplexArray]:
    """Equivalent spheres for size parameters above 3000, and their refractive indices.

    In geometric optics scattering depends on area and on absorption along a diameter. A larger
    sphere is replaced by spheres of size parameter 3000 with the same total area and the same
    absorption along a diameter. The cross-section is too large by at most 0.5 % (edge term 1.99
    x^(-2/3), Nussenzveig & Wiscombe 1980); the forward peak, 0.07° wide, remains narrower than the
    sun's disc.

    Parameters
    ----------
    sizes : SizeNodes
        Sizes from ``physics.optics.size_distribution``. [m]
    wavelength : float
        Wavelength. [nm]
    index : complex
        Refractive index of the particles. [1]

    Returns
    -------
    sizes : SizeNodes
        Radii up to the largest, with those of nearly equal index merged. [m]
    indices : array, shape (n,)
        Refractive index of each. [1]
    """
    largest = LARGEST_SIZE_PARAMETER * 1e-9 * wavelength / (2.0 * np.pi)
    above = sizes.radii > largest
    if not above.any():
        return sizes, np.full(sizes.radii.size, index)
    ratio = sizes.radii[above] / largest
    steps = np.rint(np.log(ratio) / _LARGE_STEP) if index.imag > 0.0 else np.zeros(ratio.size)
    group = np.unique(steps, return_inverse=True)[1]
    areas = sizes.weights[above] * ratio**2
    weights = np.bincount(group, areas)
    mean = np.bincount(group, areas * ratio) / weights
    radii = np.append(sizes.radii[~above], np.full(weights.size, largest))
    absorbing = np.append(np.ones(np.count_nonzero(~above)), mean)
    indices = index.real + 1j * np.minimum(index.imag * absorbing, 10.0)
    return SizeNodes(radii, np.append(sizes.weights[~above], weights)), indices


def work(radii: int, size_parameter: float, angles: int) -> float:
    """Estimated work of ``scattering``: terms of all radii at all angles. [1]

    Parameters
    ----------
    size_parameter : float
        Largest size parameter. [1]
    angles : int
        Number of scattering angles; the coefficients of a radius take as long as 400 of them.
    """
    return float(radii) * _terms(size_parameter) * (angles + 400.0)


def memory(size_parameter: float, angles: int) -> float:
    """Memory of ``scattering``. [byte]

    Parameters
    ----------
    size_parameter : float
        Largest size parameter. [1]
    """
    # both angular functions, and amplitudes of a block of radii
    return 16.0 * angles * _terms(size_parameter) + 64.0 * _BLOCK * angles


def scattering_angles(size_parameter: float, per_ripple: float = 12.0) -> FloatArray:
    """Scattering angles for the table of a phase function, ascending from 0 to 180. [deg]

    Even steps resolve the ripples of a sphere; they grow from a sixteenth of a step at both ends,
    for the diffraction peak and the glory. There are at most 8000; for larger spheres they resolve
    the first 12 rings at both ends, and ``ripples.ripple_means`` averages elsewhere.

    Parameters
    ----------
    size_parameter : float
        Size parameter x = 2πr/λ of the radius with the finest structure. [1]
    per_ripple : float
        Steps per ripple of 180°/x. [1]

    Examples
    --------
    >>> angles = scattering_angles(50.0)
    >>> len(angles), float(angles[0]), float(angles[-1])
    (629, 0.0, 180.0)
    """
    steps = max(per_ripple * size_parameter, 180.0)
    step = 180.0 / min(steps, MOST_STEPS)
    fine = step if steps <= MOST_STEPS else 180.0 / (_PER_RING * size_parameter)
    rings = _RINGS * 180.0 / size_parameter
    near, width = [0.0], step / 16.0
    while width < step:
        near.append(near[-1] + width)
        if width < fine or near[-1] >= rings:
            width *= _GROWTH
    ends = np.array(near[:-1])
    count = math.ceil((180.0 - 2.0 * near[-1]) / step)
    middle = np.linspace(near[-1], 180.0 - near[-1], count + 1)
    return np.concatenate([ends, middle, (180.0 - ends)[::-1]])


def _blocks(count: int) -> Iterator[slice]:
    for start in range(0, count, _BLOCK):
        yield slice(start, min(start + _BLOCK, count))


def _terms(size_parameter: float) -> int:
    """Number of terms of a sphere's series, by Wiscombe's (1980) criterion. [1]"""
    return int(size_parameter + 4.05 * size_parameter**0.33333 + 2.0)


def _coefficients(
    size_parameters: FloatArray, indices: ComplexArray
) -> tuple[ComplexArray, ComplexArray]:
    """Coefficients a_n and b_n of spheres, zero beyond their series, shape (nr, nn).

    Bohren & Huffman (1983), eqs. 4.88 and 4.89, for all spheres at once: logarithmic derivatives
    D_n and ratios ψ_n/ψ_{n-1} by downward, ψ_n below n = x and χ_n by upward recurrence.
    """
    x, m = np.asarray(size_parameters), np.asarray(indices)
    terms = np.array([_terms(one) for one in x])
    longest = int(terms.max())
    derivatives, ratios = _derivatives(m * x, longest), _ratios(x, longest)
    both = np.zeros((2, x.size, longest), dtype=np.complex128)
    psi_before, psi, chi_before, chi = np.cos(x), np.sin(x), -np.sin(x), np.cos(x)
    for n in range(1, longest + 1):
        here = n <= terms  # beyond, χ_n would overflow
        factor = (2.0 * n - 1.0) / x
        psi_before, psi = psi, np.where(n < x, factor * psi - psi_before, psi * ratios[n])
        chi_before, chi = chi, np.where(here, factor * chi - chi_before, chi)
        xi_before, xi = psi_before - 1j * chi_before, psi - 1j * chi
        for k, inner in enumerate((derivatives[n] / m, derivatives[n] * m)):
            outer = inner + n / x
            found = (outer * psi - psi_before) / (outer * xi - xi_before)
            both[k, here, n - 1] = found[here]
    return both[0], both[1]


def _derivatives(arguments: ComplexArray, terms: int) -> ComplexArray:
    """Logarithmic derivatives D_n of ψ_n for n from 0, shape (terms + 1, nr)."""
    found = np.zeros((terms + 1, arguments.size), dtype=np.complex128)
    start = _start(max(terms, float(np.abs(arguments).max())))
    value = np.zeros(arguments.size, dtype=np.complex128)
    for n in range(start, 0, -1):
        value = n / arguments - 1.0 / (value + n / arguments)
        if n <= terms + 1:
            found[n - 1] = value
    return found


def _start(largest: float) -> int:
    """Order from which a downward recurrence is exact to rounding for an argument or order."""
    return int(largest + 10.0 * largest ** (1.0 / 3.0)) + 16


def _ratios(arguments: FloatArray, terms: int) -> FloatArray:
    """Ratios ψ_n/ψ_{n-1} for n from 1, shape (terms + 1, nr); the first row is zero."""
    found = np.zeros((terms + 1, arguments.size))
    ratio = np.zeros(arguments.size)
    for n in range(_start(terms), 0, -1):
        ratio = 1.0 / ((2.0 * n + 1.0) / arguments - ratio)
        if n <= terms:
            found[n] = ratio
    return found


def _sums(a: ComplexArray, b: ComplexArray, index: complex) -> FloatArray:
    """Sums for extinction, scattering and scattering × asymmetry, shape (3, nr).

    Q = 2/x² times each.
    """
    n = np.arange(1.0, a.shape[1] + 1.0)
    odd = 2.0 * n + 1.0
    scattered = (np.abs(a) ** 2 + np.abs(b) ** 2) @ odd
    extinction = (a + b).real @ odd
    if index.imag == 0.0:  # Re(a) = |a|² is lost in rounding for the smallest spheres
        extinction = scattered
    neighbours = (a[:, :-1] * a[:, 1:].conj() + b[:, :-1] * b[:, 1:].conj()).real
    forward = 2.0 * neighbours @ (n * (n + 2.0) / (n + 1.0))[:-1]
    forward += 2.0 * (a * b.conj()).real @ (odd / (n * (n + 1.0)))
    return np.stack([np.maximum(extinction, scattered), scattered, forward])


def _angular_functions(mu: FloatArray, terms: int) -> tuple[FloatArray, FloatArray]:
    """Functions π_n + τ_n and π_n - τ_n, times (2n+1)/(n(n+1)), shape (terms, na)."""
    plus, minus = np.empty((terms, len(mu))), np.empty((terms, len(mu)))
    before, pi = np.zeros_like(mu), np.ones_like(mu)
    for n in range(1, terms + 1):
        tau = n * mu * pi - (n + 1) * before
        factor = (2 * n + 1) / (n * (n + 1))
        plus[n - 1], minus[n - 1] = factor * (pi + tau), factor * (pi - tau)
        before, pi = pi, ((2 * n + 1) * mu * pi - (n + 1) * before) / n
    return plus, minus


def _matrices(
    a: ComplexArray, b: ComplexArray, plus: FloatArray, minus: FloatArray, weights: FloatArray
) -> FloatArray:
    """Elements 2S₁₁, 2S₁₂, 2S₃₃ and 2S₃₄ of spheres, summed with weights, shape (4, na).

    From P = S₁ + S₂ and M = S₁ - S₂ (Bohren & Huffman 1983, eq. 4.77): 2S₁₁ = (|P|² + |M|²)/2,
    2S₁₂ = -Re P M*, 2S₃₃ = (|P|² - |M|²)/2, 2S₃₄ = Im P M*.
    """
    terms = a.shape[1]
    p, m = (
        (amplitude.real @ function[:terms], amplitude.imag @ function[:terms])
        for amplitude, function in ((a + b, plus), (a - b, minus))
    )
    sums, differences = p[0] ** 2 + p[1] ** 2, m[0] ** 2 + m[1] ** 2
    return np.stack(
        [
            0.5 * (weights @ (sums + differences)),
            -(weights @ (p[0] * m[0] + p[1] * m[1])),
            0.5 * (weights @ (sums - differences)),
            weights @ (p[1] * m[0] - p[0] * m[1]),
        ]
    )
