r"""Reflection of a flat layer of water droplets by adding and doubling: table and first order.

The droplets are those of low clouds (gamma distribution, effective radius 10 µm, variance 1/9) and
absorb nothing, which is so to 1e-5 of a scattering in visible light; the optical depth, of 550 nm,
is that of all wavelengths (2 % from 400 to 700 nm). The phase function is split by delta-M: the
forward fraction f is not scattered, which leaves the optical depth τ' = (1 - f) τ. Single
scattering has the exact phase function p of each wavelength (TMS correction, Nakajima & Tanaka),

.. math:: R_1 = \frac{\pi p(\Theta)}{(1 - f)(\mu_s + \mu_r)}
          \left(1 - e^{-\tau' (1/\mu_s + 1/\mu_r)}\right)

hence glory and cloudbow; multiple scattering is smooth and tabulated over both cosines and the
azimuth. R is the reflectance factor, π L/(μ_s F).

References
----------
Hansen & Travis (1974), Light scattering in planetary atmospheres, Space Sci. Rev. 16, 527: adding
and doubling, §3; Wiscombe (1977), J. Atmos. Sci. 34, 1408: delta-M; Nakajima & Tanaka (1988), JQSRT
40, 51.
"""

from __future__ import annotations

from functools import cache, lru_cache
from importlib import resources
from typing import Annotated, Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.kernel.lanes import LANES
from airlight.kernel.shader_fields import scalars, spectra

FloatArray = NDArray[np.float64]

#: Wavelength of the optical depth and of multiple scattering. [nm]
REFERENCE: Final = 550.0
#: Streams in each hemisphere. With twelve the reflectance is within 0.4 % (root mean square) of
#: that with 64, a tenth too bright in the middle of the glory.
STREAMS: Final = 12
#: Degree of the tabulated Legendre moments.
DEGREE: Final = 128
#: Steps of the tabulated phase function, of a quarter of a degree.
STEPS: Final = 720
#: Nodes of the table in the root of each cosine, and in sin(φ/2). Linear between them it is within
#: 0.4 % (root mean square) of the layer of optical depth 10, 1.3 % of that of 1.
COSINES: Final = 24
AZIMUTHS: Final = 21
#: Smallest cosine: a lower sun or observer sees the layer of this one. [1]
LEAST_COSINE: Final = 0.01
#: Largest scaled optical depth of the initial layer of doubling, by single scattering. [1]
_THINNEST: Final = 1e-9
#: Largest optical depth. [1]
THICKEST: Final = 1000.0
#: Layers that are kept.
_KEPT: Final = 16


class DropletLayer(NamedTuple):
    """Layer of droplets as an argument of kernels; w is the number of wavelengths or lanes.

    Attributes
    ----------
    layer_depth : float
        Scaled optical depth τ'. [1]
    layer_gain : float
        1/(1 - f), factor of single scattering. [1]
    layer_albedo : float
        Spherical albedo. [1]
    layer_plane : array, shape (COSINES,)
        Plane albedo of a beam, over the root of its cosine. [1]
    layer_multiple : array, shape (COSINES, COSINES, AZIMUTHS)
        Reflectance factor of multiple scattering, over the roots of both cosines
        and sin(φ/2) of the azimuth φ, 0 for forward scattering. [1]
    layer_phase : array, shape (STEPS + 1, w)
        Phase functions on even steps of the scattering angle. [sr⁻¹]
    """

    layer_depth: float
    layer_gain: float
    layer_albedo: float
    layer_plane: Annotated[Any, scalars(1)]
    layer_multiple: Annotated[Any, scalars(3)]
    layer_phase: Annotated[Any, spectra(1)]

    def at(self, block: slice) -> DropletLayer:
        """The layer at some of its wavelengths."""
        return self._replace(layer_phase=np.ascontiguousarray(self.layer_phase[:, block]))


def no_layer(count: int = LANES) -> DropletLayer:
    """Layer without droplets, of some wavelengths.

    Parameters
    ----------
    count : int
        Number of wavelengths.
    """
    phase = np.zeros((2, count), np.float32)
    return DropletLayer(0.0, 1.0, 0.0, np.zeros(2), np.zeros((2, 2, 2)), phase)


def droplet_layer(optical_depth: float, wavelengths: FloatArray) -> DropletLayer:
    """Layer of an optical depth at wavelengths, cached by the optical depth.

    Parameters
    ----------
    optical_depth : float
        Optical depth, 0 to 1000. [1]
    wavelengths : array, shape (w,)
        Wavelengths; beyond 380 to 750 nm, the phase function of these. [nm]

    Examples
    --------
    >>> layer = droplet_layer(10.0, np.array([550.0]))
    >>> f"{layer.layer_albedo:.3f}"
    '0.523'
    """
    if not 0.0 <= optical_depth <= THICKEST:
        raise ParameterError("optical_depth", optical_depth, f"0 to {THICKEST:g}")
    nm, phase = _phase_table()
    columns = np.array([np.interp(wavelengths, nm, row) for row in phase], np.float32)
    depth, gain, albedo, plane, multiple = _tables(optical_depth)
    return DropletLayer(depth, gain, albedo, plane.copy(), multiple.copy(), columns)


class Reflected(NamedTuple):
    """Light reflected and let through by a layer, at quadrature points and nodes.

    Attributes
    ----------
    cosines, weights : array, shape (n,)
        Cosines μ of zenith angles, and weights 2 μ w; 0 of nodes. [1]
    reflected, transmitted : array, shape (m, n, n)
        Fourier modes of the reflectance factor, and of diffuse transmission alike. [1]
    once : array, shape (m, n, n)
        Modes of single scattering by the truncated phase function. [1]
    depth, peak : float
        Scaled optical depth, and fraction f. [1]
    """

    cosines: FloatArray
    weights: FloatArray
    reflected: FloatArray
    transmitted: FloatArray
    once: FloatArray
    depth: float
    peak: float


def doubled(
    optical_depth: float,
    moments: FloatArray,
    nodes: FloatArray,
    streams: int = STREAMS,
    modes: int = 2 * STREAMS,
) -> Reflected:
    """Reflection and diffuse transmission of a conservative homogeneous layer by doubling.

    Parameters
    ----------
    optical_depth : float
        Optical depth before scaling. [1]
    moments : array, shape (l,)
        Legendre moments of the phase function, more than twice the streams. [1]
    nodes : array, shape (k,)
        Cosines at which light is wanted beside the quadrature points, above 0. [1]
    streams, modes : int
        Quadrature points of a hemisphere; Fourier modes of the azimuth, at most twice as many.
    """
    peak = float(moments[2 * streams])
    scaled = (moments[: 2 * streams] - peak) / (1.0 - peak)
    depth = (1.0 - peak) * optical_depth
    x, w = np.polynomial.legendre.leggauss(streams)
    gauss = 0.5 * (x + 1.0)
    mu = np.concatenate([gauss, nodes])
    weights = np.concatenate([gauss * w, np.zeros(len(nodes))])
    count = max(0, int(np.ceil(np.log2(max(depth, _THINNEST) / _THINNEST))))
    found = [_doubled_mode(m, scaled, mu, weights, depth, count) for m in range(modes)]
    reflected, transmitted, once = (np.array(one) for one in zip(*found, strict=True))
    return Reflected(mu, weights, reflected, transmitted, once, depth, peak)


def _doubled_mode(
    m: int, moments: FloatArray, mu: FloatArray, weights: FloatArray, depth: float, count: int
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Mode m of reflection, transmission and single scattering, after a number of doublings."""
    degrees = np.arange(moments.size)
    functions = _associated(m, moments.size, mu)
    strength = (2.0 * degrees + 1.0) * moments
    forward = (functions.T * strength) @ functions
    backward = (functions.T * (strength * (-1.0) ** (degrees + m))) @ functions
    below, above = mu[:, None], mu[None, :]
    once = 0.25 * backward / (below + above)
    thin = depth / 2.0**count
    reflected = once * -np.expm1(-thin * (1.0 / below + 1.0 / above))
    # of thin layers, whose optical path is at most 1e-7
    transmitted = 0.25 * forward * thin / (below * above) * np.exp(-thin / below)
    one = np.eye(mu.size)
    for _ in range(count):
        direct = np.exp(-thin / mu)
        twice = (reflected * weights) @ reflected
        series = np.linalg.solve(one - twice * weights, twice)
        down = transmitted + series * direct + (series * weights) @ transmitted
        up = reflected * direct + (reflected * weights) @ down
        reflected = reflected + direct[:, None] * up + (transmitted * weights) @ up
        transmitted = direct[:, None] * down + transmitted * direct + (transmitted * weights) @ down
        thin *= 2.0
    return reflected, transmitted, once * -np.expm1(-depth * (1.0 / below + 1.0 / above))


def _associated(m: int, count: int, mu: FloatArray) -> FloatArray:
    """Associated Legendre functions over √((l+m)!/(l-m)!), shape (count, n). [1]"""
    out = np.zeros((count, mu.size))
    sine, first = np.sqrt((1.0 - mu) * (1.0 + mu)), np.ones_like(mu)
    for k in range(1, m + 1):
        first = first * sine * np.sqrt((2.0 * k - 1.0) / (2.0 * k))
    for l in range(m, count):
        if l == m:
            out[l] = first
        else:
            low = out[l - 2] * np.sqrt((l - 1.0) ** 2 - m * m) if l > m + 1 else 0.0
            out[l] = ((2.0 * l - 1.0) * mu * out[l - 1] - low) / np.sqrt(l * l - m * m)
    return out


@lru_cache(maxsize=_KEPT)
def _tables(optical_depth: float) -> tuple[float, float, float, FloatArray, FloatArray]:
    """Depth, gain, spherical albedo and tables of ``DropletLayer``."""
    nodes = np.maximum(np.linspace(0.0, 1.0, COSINES) ** 2, LEAST_COSINE)
    found = doubled(optical_depth, droplet_moments(), nodes)
    plane = found.weights @ found.reflected[0]
    wanted = slice(STREAMS, None)
    modes = (found.reflected - found.once)[:, wanted, wanted]
    order = np.arange(len(modes))
    azimuths = 2.0 * np.arcsin(np.linspace(0.0, 1.0, AZIMUTHS))
    waves = np.where(order == 0, 1.0, 2.0)[:, None] * np.cos(order[:, None] * azimuths)
    multiple = np.tensordot(modes, waves, (0, 0))
    symmetric = 0.5 * (multiple + multiple.swapaxes(0, 1))  # of rounding alone
    albedo = float(found.weights @ plane)
    return found.depth, 1.0 / (1.0 - found.peak), albedo, plane[wanted], symmetric


@cache
def droplet_moments() -> FloatArray:
    """Legendre moments of the droplets' phase function at 550 nm, shape (DEGREE + 1,). [1]

    Examples
    --------
    >>> droplet_moments()[:2].round(4).tolist()  # the mean cosine of water clouds
    [1.0, 0.8636]
    """
    return _numbers("moments")[1][:, 1]


@cache
def _phase_table() -> tuple[FloatArray, FloatArray]:
    """Wavelengths [nm], and phase functions, shape (STEPS + 1, wavelengths) [sr⁻¹]."""
    names, rows = _numbers("phase")
    return np.array([float(one) for one in names[1:]]), rows[:, 1:]


def _numbers(name: str) -> tuple[list[str], FloatArray]:
    """Column names and numbers of a table of droplets."""
    file = resources.files("airlight.physics.optics") / "data" / f"cloud-droplets-{name}.csv"
    lines = [one for one in file.read_text(encoding="utf-8").splitlines() if one[:1] != "#"]
    rows = [[float(x) for x in line.split(",")] for line in lines[1:]]
    return lines[0].split(","), np.array(rows)
