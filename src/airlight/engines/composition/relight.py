"""Relighting of surfaces by direct sunlight and by spherical harmonics of sky and ground.

Sunlight is attenuated from space to each point. Radiance of sky and ground, without the scene, is
projected on spherical harmonics at the point's altitude and star-zenith angle, and convolved with
the clamped cosine of the normal. Shadows within the scene are the caller's task.

Colours of surfaces that are not relit are attenuated spectrally, see ``SurfaceLight``.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.quadrature import gauss_legendre
from airlight.image.upsampling import reflectance_basis

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]

#: Numbers of zenith angles of each hemisphere, and of azimuths of half a turn, of the quadrature.
_ZENITHS: Final = 12
_AZIMUTHS: Final = 12
#: Steps of the nodes: of ln(1 + h/5 km), 500 m at the ground; of arsinh(20 μ), a quarter of
#: a degree at a level sun and 5 at a high one.
_RISE: Final = 0.1
_HIGH: Final = 5e3
_TURN: Final = 0.08
_LEVEL: Final = 20.0
#: Degrees of the harmonics: a hemisphere weighted by the cosine has no odd degrees other than 1.
_DEGREES: Final = (0, 1, 2, 4, 6, 8)


def _half_sphere(degree: int) -> float:
    """Zonal harmonic coefficient of the clamped cosine for a degree.

    Ramamoorthi & Hanrahan (2001), JOSA A 18, 2448, eq. 19.
    """
    if degree < 2:
        return math.pi if degree == 0 else 2.0 * math.pi / 3.0
    half = degree // 2
    sign = 1.0 if half % 2 else -1.0
    share = math.comb(degree, half) / 2.0**degree
    return 2.0 * math.pi * sign * share / ((degree + 2) * (degree - 1))


#: The same for each of the harmonics, in the order of ``_harmonics``.
_RECEIVED: Final = np.array([_half_sphere(l) for l in _DEGREES for m in range(l + 1)])


class SurroundingLight:
    """Irradiance of surfaces at points of the atmosphere.

    Parameters
    ----------
    solution : MomentsSolution
        Solution, lit by one light.
    """

    def __init__(self, solution: MomentsSolution) -> None:
        self._solution = solution
        self._nodes: dict[tuple[int, int], FloatArray] = {}

    def _fill(self, nodes: list[tuple[int, int]]) -> None:
        """Fill radiance harmonics per irradiance at nodes, each shape (27, nl). [sr⁻¹]"""
        rule = gauss_legendre(_ZENITHS)
        # x² concentrates the directions at the horizon, where the gradient of the sky is largest
        up, weight = rule.nodes**2, 2.0 * rule.nodes * rule.weights
        z, weight = np.concatenate([up, -up]), np.concatenate([weight, weight])
        azimuth = np.pi * (np.arange(_AZIMUTHS) + 0.5) / _AZIMUTHS
        z, weight, around = (
            np.ravel(one)
            for one in np.broadcast_arrays(z[:, None], weight[:, None], azimuth[None, :])
        )
        flat = np.sqrt(1.0 - z * z)
        ways = np.stack([flat * np.cos(around), flat * np.sin(around), z], axis=-1)
        basis = _harmonics(ways)
        basis *= (weight * 2.0 * np.pi / _AZIMUTHS)[:, None]
        rise, turn = np.array(nodes, float).T
        altitude = np.minimum(_HIGH * np.expm1(_RISE * rise), self._solution.medium.thickness)
        mu_s = np.clip(np.sinh(_TURN * turn) / _LEVEL, -1.0, 1.0)
        lines, _ = self._solution.lines_of_sight(
            altitude=altitude[:, None],
            sun_zenith=np.degrees(np.arccos(mu_s))[:, None],
            view_zenith=np.degrees(np.arccos(z))[None, :],
            azimuth=np.degrees(around)[None, :],
        )
        light = self._solution.relative_radiance(lines).reshape(len(nodes), z.size, -1)
        for node, one in zip(nodes, light, strict=True):
            self._nodes[node] = basis.T @ one

    def irradiance(
        self,
        r: FloatArray,
        mu_s: FloatArray,
        normals: FloatArray,
        lit: FloatArray,
        beam: FloatArray | float = 1.0,
        diffuse: FloatArray | None = None,
    ) -> FloatArray:
        """Irradiance of surfaces over irradiance of the star, (n, nl). [1]

        Parameters
        ----------
        r, mu_s : array, shape (n,)
            Radii of the points [m], and cosines of the star's zenith angle there [1].
        normals : array, shape (n, 3)
            Unit normals in the local frame of each point: x to the star's side, z up. [1]
        lit : array, shape (n,)
            Fraction of the star that the scene does not occlude. [1]
        beam, diffuse : array, shapes (n, nl) and (2, n, nl)
            Transmittance of clouds for the star's light, and factors of diffuse light from above
            and from below, which are mixed by the slope of a surface. [1]
        """
        medium = self._solution.medium
        held = np.clip(r, medium.bottom_radius, medium.top_radius)
        sine = np.sqrt(np.maximum(1.0 - mu_s**2, 0.0))
        facing = np.maximum(normals[:, 0] * sine + normals[:, 2] * mu_s, 0.0) * lit
        star = self._solution.relative_normal_irradiance(held, mu_s) * facing[:, None] * beam
        share = _harmonics(normals) * _RECEIVED
        # between four nodes, whose harmonics are the same for all pictures of this solution
        rise = np.log1p((held - medium.bottom_radius) / _HIGH) / _RISE
        turn = np.arcsinh(_LEVEL * mu_s) / _TURN
        low, near = np.floor(rise).astype(int), np.floor(turn).astype(int)
        sky = np.zeros_like(star)
        for up in (0, 1):
            for on in (0, 1):
                weight = np.abs(1 - up - (rise - low)) * np.abs(1 - on - (turn - near))
                self._add(low + up, near + on, share * weight[:, None], sky)
        sky = np.maximum(sky, 0.0)
        if diffuse is not None:
            risen = 0.5 * (1.0 + normals[:, 2:])
            sky *= risen * diffuse[0] + (1.0 - risen) * diffuse[1]
        return np.asarray(star + sky)

    def _add(
        self, rise: NDArray[np.int_], turn: NDArray[np.int_], share: FloatArray, out: FloatArray
    ) -> None:
        """Add the irradiance from the harmonics at one node per surface."""
        pairs = np.stack([rise, turn], axis=-1)
        found, where = np.unique(pairs, axis=0, return_inverse=True)
        nodes = [(int(i), int(j)) for i, j in found]
        lacking = [one for one in nodes if one not in self._nodes]
        if lacking:
            self._fill(lacking)
        order = np.argsort(where.ravel(), kind="stable")
        ends = np.append(0, np.cumsum(np.bincount(where.ravel(), minlength=len(nodes))))
        for k, node in enumerate(nodes):
            rows = order[ends[k] : ends[k + 1]]
            out[rows] += share[rows] @ self._nodes[node]


def _harmonics(v: FloatArray) -> FloatArray:
    """Real spherical harmonics even in y, of the degrees used, shape (n, 27).

    The sky is symmetric about the plane of the star, so that odd harmonics vanish.
    """
    x, y, z = v.T
    around = np.ones_like(x, np.complex128)
    found: dict[tuple[int, int], FloatArray] = {}
    for m in range(_DEGREES[-1] + 1):
        # associated Legendre functions over sin^m, by their recurrence in the degree
        before, here = np.zeros_like(z), np.full_like(z, float(math.prod(range(1, 2 * m, 2))))
        for l in range(m, _DEGREES[-1] + 1):
            norm = (2 * l + 1) * math.factorial(l - m) / math.factorial(l + m)
            found[l, m] = math.sqrt((2.0 if m else 1.0) * norm / (4.0 * math.pi)) * (
                here * around.real
            )
            before, here = here, ((2 * l + 1) * z * here - (l + m) * before) / (l + 1 - m)
        around = around * (x + 1j * y)
    return np.stack([found[l, m] for l in _DEGREES for m in range(l + 1)], axis=-1)


class Relight:
    """Relighting of surfaces with albedo and normals.

    Parameters
    ----------
    solution : MomentsSolution
        Solution, lit by one light.
    r, sun : float, array of shape (3,)
        Radius of the observer [m], and direction towards the light in the local frame [1].
    """

    def __init__(self, solution: MomentsSolution, r: float, sun: FloatArray) -> None:
        self._solution, self._r, self._sun = solution, r, sun
        self._basis = reflectance_basis(solution.wavelengths)
        self._surrounding = SurroundingLight(solution)

    def radiance(
        self,
        points: FloatArray,
        normals: FloatArray,
        albedo: FloatArray,
        lit: FloatArray,
        beam: FloatArray | float = 1.0,
        diffuse: FloatArray | None = None,
    ) -> FloatArray:
        """Reflected radiance per irradiance, without attenuation to the camera, (n, nl). [sr⁻¹]

        Parameters
        ----------
        points : array, shape (n, 3)
            Positions relative to the observer, in the observer's local frame. [m]
        normals : array, shape (n, 3)
            Normals in the same frame, of any length; a zero vector stands for a horizontal surface.
        albedo : array, shape (n, 3)
            Lambert albedo, linear sRGB under the star. [1]
        lit, beam, diffuse : array
            Arguments of ``SurroundingLight.irradiance``.
        """
        from_centre = points + np.array([0.0, 0.0, self._r])
        r = np.linalg.norm(from_centre, axis=-1)
        up = from_centre / r[:, None]
        mu_s = np.clip(up @ self._sun, -1.0, 1.0)
        level = self._sun - mu_s[:, None] * up
        length = np.linalg.norm(level, axis=-1)
        level = np.where(length[:, None] > 1e-9, level, [1.0, 0.0, 0.0])
        x = level / np.linalg.norm(level, axis=-1, keepdims=True)
        y = np.cross(up, x)
        size = np.linalg.norm(normals, axis=-1, keepdims=True)
        n = np.where(size > 1e-6, normals / np.maximum(size, 1e-6), up)
        local = np.stack([np.sum(n * one, axis=-1) for one in (x, y, up)], axis=-1)
        received = self._surrounding.irradiance(r, mu_s, local, lit, beam, diffuse)
        return np.asarray(albedo @ self._basis.T * received / np.pi)


class SurfaceLight:
    """Attenuation of surface colours by spectral transmittance.

    A colour is upsampled to the smoothest reflectance spectrum with that colour under the star
    (``image.upsampling``), multiplied by the spectral transmittance and converted back: a 3 x 3
    matrix per pixel, the identity without atmosphere. White under the star is exact.

    Parameters
    ----------
    solution : MomentsSolution
        Solution, whose first light is the star.
    white : float or None
        Value of a white Lambert surface facing the star without atmosphere; None for colours in
        radiance. [1]

    Attributes
    ----------
    scale : array, shape (3,)
        Radiance of the unit of each channel. [W m⁻² sr⁻¹]
    colors : array, shape (nl, 3)
        Linear sRGB per radiance over the star's irradiance. [W m⁻² sr⁻¹ sr]
    """

    def __init__(self, solution: MomentsSolution, white: float | None) -> None:
        self.colors = solution.lights[0].colors()
        sun = self.colors.sum(axis=0)
        self.scale = np.ones(3) if white is None else sun / (np.pi * white)
        basis = reflectance_basis(solution.wavelengths)
        whole = self.colors.T @ basis
        # what a spectrum of unit colour contributes at each wavelength, shape (nl, 3, 3)
        spectra = basis @ np.linalg.inv(whole)
        self._shares = self.colors[:, :, None] * spectra[:, None, :]

    def through(self, colors: FloatArray, transmittance: FloatArray) -> FloatArray:
        """Attenuated colours, shape (n, 3).

        Parameters
        ----------
        colors : array, shape (n, 3)
            Colours of surfaces, linear sRGB. [any unit]
        transmittance : array, shape (n, nl)
            Transmittance between camera and surfaces. [1]
        """
        matrices = (transmittance @ self._shares.reshape(-1, 9)).reshape(-1, 3, 3)
        return np.asarray(np.einsum("nij,nj->ni", matrices, colors))
