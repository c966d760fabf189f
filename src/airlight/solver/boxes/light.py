"""``BoxLight``: sun, sky, ground and air of a box of cloud."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError

FloatArray = NDArray[np.float64]

#: Radiance over the beam's irradiance, shape (n, w) [sr⁻¹], of light that propagates in the
#: directions of unit vectors of shape (n, 3).
Sky: TypeAlias = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, eq=False, kw_only=True)
class BoxAir:
    """Gas and haze in a box, in layers of constant coefficients.

    Parameters
    ----------
    edges : array, shape (n + 1,)
        Altitudes of the layers' edges, ascending; there is no air outside. [m]
    extinction : array, shape (n, w)
        Extinction coefficient. [m⁻¹]
    albedo : array, shape (n, w)
        Single-scattering albedo. [1]
    moments : array, shape (n, w, degree + 1)
        Legendre moments of the phase function, the first is 1; those of higher degree are 0. [1]
    """

    edges: FloatArray
    extinction: FloatArray
    albedo: FloatArray
    moments: FloatArray

    def __post_init__(self) -> None:
        for name in ("edges", "extinction", "albedo", "moments"):
            object.__setattr__(self, name, np.asarray(getattr(self, name), np.float64))
        if self.edges.ndim != 1 or not np.all(np.diff(self.edges) > 0.0):
            raise ParameterError("air.edges", self.edges, "ascending altitudes in m")
        shape = self.edges.size - 1, self.extinction.shape[-1]
        if self.extinction.shape != shape or not np.all(self.extinction >= 0.0):
            raise ParameterError("air.extinction", self.extinction, f"0 or more, shape {shape}")
        if self.albedo.shape != shape or not np.all((self.albedo >= 0.0) & (self.albedo <= 1.0)):
            raise ParameterError("air.albedo", self.albedo, f"0 to 1, shape {shape}")
        if self.moments.shape[:2] != shape or self.moments.ndim != 3:
            raise ParameterError(
                "air.moments", self.moments.shape, f"shape {(*shape, 'degree + 1')}"
            )


@dataclass(frozen=True, eq=False, kw_only=True)
class BoxBeam:
    """Beam in a spherical planet's air, which may arrive from below.

    Parameters
    ----------
    irradiance : callable
        Irradiance normal to the beam behind ``air``, of altitudes [m], shapes (n,) to (n, w). [1]
    radius : float
        Radius of the planet. [m]
    air : BoxAir, optional
        Air of which the irradiance is; the rest of the box's air attenuates it further. Default:
        all of it.
    """

    irradiance: Callable[[FloatArray], FloatArray]
    radius: float
    air: BoxAir | None = None


@dataclass(frozen=True, eq=False, kw_only=True)
class BoxLight:
    """Sun, sky and ground of a box of cloud.

    Parameters
    ----------
    towards : tuple of three float
        Unit vector to the sun: east, north, up. [1]
    albedo : array, shape (w,)
        Albedo of the Lambertian ground. [1]
    ground : float, optional
        Altitude of the ground; default: the base of the field. [m]
    sky : array of shape (n, w) or callable, optional
        Diffuse radiance that enters at the top over the irradiance of the beam there: in the
        directions of ``sky_directions``, or a function of such directions. Default: black. [sr⁻¹]
    air : BoxAir, optional
        Gas and haze inside the box.
    beam : BoxBeam, optional
        The beam, in the unit of the other light. Default: 1 at the top, attenuated by ``air`` in a
        plane; a sun at or below the horizon gives none.
    """

    towards: tuple[float, float, float]
    albedo: FloatArray
    ground: float | None = None
    sky: FloatArray | Sky | None = None
    air: BoxAir | None = None
    beam: BoxBeam | None = None

    def __post_init__(self) -> None:
        vector = np.asarray(self.towards, np.float64)
        if vector.shape != (3,) or not abs(np.linalg.norm(vector) - 1.0) < 1e-3:
            raise ParameterError("towards", self.towards, "a unit vector")
        vector = vector / np.linalg.norm(vector)
        object.__setattr__(self, "towards", tuple(float(one) for one in vector))
        albedo = np.atleast_1d(np.asarray(self.albedo, np.float64))
        if not np.all((albedo >= 0.0) & (albedo <= 1.0)):
            raise ParameterError("albedo", self.albedo, "0 to 1")
        object.__setattr__(self, "albedo", albedo)

    @property
    def cosine(self) -> float:
        """Cosine of the sun's zenith angle; 0 for a sun below the horizon. [1]"""
        return max(self.towards[2], 0.0)

    @property
    def curvature(self) -> float:
        """Reciprocal of the planet's radius; 0 for a plane. [m⁻¹]"""
        return 0.0 if self.beam is None else 1.0 / self.beam.radius

    def sky_at(self, directions: ArrayLike, wavelengths: int) -> FloatArray:
        """Radiance of the sky in directions of shape (n, 3), shape (n, w). [sr⁻¹]

        Parameters
        ----------
        wavelengths : int
            Number of wavelengths.

        Raises
        ------
        ParameterError
            If the sky has another shape or a value below 0.
        """
        given = np.asarray(directions, np.float64)
        shape = given.shape[0], wavelengths
        if self.sky is None:
            return np.zeros(shape)
        found = self.sky(given) if callable(self.sky) else self.sky
        values = np.asarray(found, np.float64)
        if values.shape != shape or not np.all((values >= 0.0) & (values < np.inf)):
            raise ParameterError("sky", f"shape {values.shape}", f"0 or more, shape {shape}")
        return values
