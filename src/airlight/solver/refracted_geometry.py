"""Geometry of refracted rays, which are straight lines in the optical radius."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.geometry.path import ray_length
from airlight.geometry.refraction import apparent_sun
from airlight.geometry.shell import meets_ground
from airlight.kernel import compiled_loop, vectorized
from airlight.kernel.cache import Cache
from airlight.physics.cubic_curves import cubic_curve, monotone_slopes
from airlight.physics.optics.refracting_shell import RefractingShell
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.tables.columns import columns
from airlight.solver.tables.refraction_table import NONE, refraction_angles, refraction_table

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

#: Number of refraction tables in the cache.
_CACHE_SIZE: Final = 4
_TABLES: Final[Cache[Any, FloatArray]] = Cache(_CACHE_SIZE)
#: Newton steps from a true length to a length by optical radius; each squares the error.
_STEPS: Final = 6
_QUICK_STEPS: Final = 3


@dataclass(frozen=True, eq=False)
class RefractedGeometry:
    """Medium in the optical radius, in which rays are straight, and conversions to and from it.

    Attributes
    ----------
    medium : Medium
        Medium in the optical radius, whose last constituent is the refraction column; the planet's
        own without refraction.
    shell : RefractingShell or None
        Refracting shell, or None without refraction.
    refraction_table : array, shape (rows, columns, 2)
        Table from ``refraction_table``; empty without refraction. [1]
    """

    medium: Medium
    shell: RefractingShell | None
    refraction_table: FloatArray

    @classmethod
    def of(cls, medium: Medium) -> RefractedGeometry:
        """Geometry of the rays in a planet's medium."""
        drawn, shell = medium.in_optical_radius(), medium.refracting_shell
        if shell is None:
            return cls(drawn, None, NONE)
        return cls(drawn, shell, _refraction_table_of(shell))

    @property
    def refraction_strength(self) -> float:
        """Refraction angle over impact parameter times refraction column; 0 if none. [m⁻²]"""
        return 0.0 if self.shell is None else self.shell.refraction_strength

    def optical_radius(self, r: FloatArray) -> FloatArray:
        """Optical radius x = n r of true radii, which may lie outside the shell. [m]"""
        if self.shell is None:
            return np.asarray(r, float)
        shell = self.shell
        altitude = r - (shell.top - shell.altitude[-1])
        inside = np.clip(altitude, 0.0, shell.altitude[-1])
        slopes = monotone_slopes(shell.altitude, shell.optical)
        excess = cubic_curve(shell.altitude, shell.optical, slopes, inside)
        return np.asarray(np.where(altitude > inside, r, excess))

    def optical_lines(self, lines: LinesOfSight) -> LinesOfSight:
        """Lines of sight in the optical radius, in which they are straight."""
        if self.shell is None:
            return lines
        x = self.optical_radius(lines.r)
        missed = (lines.length <= 0.0) & ~lines.to_ground
        bottom, top = self.shell.bottom, self.shell.top
        to_ground = vectorized(meets_ground)(x, lines.mu, bottom) & ~missed
        length = np.where(missed, 0.0, vectorized(ray_length)(x, lines.mu, bottom, top))
        return replace(lines, r=x, length=length, to_ground=to_ground)

    def apparent_nu(self, lines: LinesOfSight) -> FloatArray:
        """Cosines between lines of sight and the apparent star, shape (n,). [1]"""
        if self.shell is None:
            return lines.nu
        out = np.empty(lines.nu.size)
        arrays = (lines.r, lines.mu, lines.mu_s, lines.nu)
        _apparent_nu(*arrays, self.shell.bottom, self.shell.top, self.refraction_table, out)
        return out

    @property
    def max_refraction(self) -> float:
        """Refraction angle of a ray from space that grazes the ground. [rad]"""
        if self.shell is None:
            return 0.0
        x, mu = np.array([self.shell.bottom]), np.zeros(1)
        return 2.0 * float(self.refraction_angle(x, mu)[0])

    def refraction_angle(self, x: FloatArray, mu: FloatArray) -> FloatArray:
        """Refraction angle of rays from points to space that miss the ground, (n,). [rad]"""
        if self.shell is None:
            return np.zeros(np.shape(x))
        shell = self.shell
        return refraction_angles(
            x, mu, shell.bottom, shell.top, shell.density, shell.refraction_strength
        )

    def optical_length(
        self,
        x: FloatArray,
        mu: FloatArray,
        true_length: FloatArray,
        longest: FloatArray,
        *,
        quick: bool = False,
    ) -> FloatArray:
        """Length, in the optical radius, of segments of rays with known true length, (n,). [m]

        Parameters
        ----------
        x, mu : array, shape (n,)
            Optical radius of the start [m] and zenith cosine there [1].
        true_length, longest : array, shape (n,)
            Length along the ray, and upper limit of the result. [m]
        quick : bool
            Fewer points and steps: relative error up to 1e-4, for pixels.
        """
        if self.shell is None:
            return true_length
        shell = self.shell
        length = np.minimum(true_length, longest)
        nodes, panels = (12, 2) if quick else (24, 6)
        for _ in range(_QUICK_STEPS if quick else _STEPS):
            reached = columns(
                x, mu, length, shell.bottom, shell.length, nodes=nodes, panels=panels
            )[..., 0]
            end = np.sqrt(np.maximum(x * x + length * (length + 2.0 * x * mu), 0.0))
            slope = shell.length.at(end - shell.bottom)[0]
            following = np.maximum(length + (true_length - reached) / slope, 0.0)
            length = np.minimum(following, longest)
        return np.asarray(np.where(reached < true_length * (1.0 - 1e-9), following, length))


def _refraction_table_of(shell: RefractingShell) -> FloatArray:
    """Refraction table of a shell, from a cache: edits of haze do not change it."""
    refraction_row = (shell.density.edges[-1].tobytes(), shell.density.coefficients[-1].tobytes())
    key = (shell.bottom, shell.top, shell.refraction_strength, *refraction_row)
    parts = shell.bottom, shell.top, shell.density, shell.refraction_strength
    return _TABLES.of(key, lambda: refraction_table(*parts))


@compiled_loop
def _apparent_nu(x, mu, mu_s, nu, bottom, top, refraction_table, out):
    for k in range(x.size):
        sine = max((1.0 - mu[k]) * (1.0 + mu[k]), 0.0) ** 0.5
        sine_s = max((1.0 - mu_s[k]) * (1.0 + mu_s[k]), 0.0) ** 0.5
        seen, _, _ = apparent_sun(x[k], mu_s[k], bottom, top, refraction_table)
        across = sine * sine_s
        azimuth = (nu[k] - mu[k] * mu_s[k]) / across if across > 1e-12 else 1.0
        sine_seen = max((1.0 - seen) * (1.0 + seen), 0.0) ** 0.5
        value = mu[k] * seen + sine * sine_seen * min(max(azimuth, -1.0), 1.0)
        out[k] = min(max(value, -1.0), 1.0)


def without_refraction(medium: Medium) -> tuple[Medium, str]:
    """Medium without refraction and a note for the report, or the medium itself and "".

    Without refraction, on Earth, the sun sets half a degree earlier, and the zenith in twilight is
    up to 10 % darker.
    """
    if not medium.refractivity.any():
        return medium, ""
    straight = replace(medium, refractivity=np.zeros_like(medium.refractivity))
    return straight, "refraction is ignored"


def require_no_refraction(medium: Medium, what: str) -> None:
    """Raise an error if the medium refracts; ``what`` names the method without refraction."""
    if medium.refractivity.any():
        raise ParameterError("refraction", "bouguer", f"'none' for {what}")
