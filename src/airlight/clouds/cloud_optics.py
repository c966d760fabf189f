"""``CloudOptics``: extinction ratio, albedo and phase function of a cloud's particles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.physics.units import values_in
from airlight.planets.clouds import Clouds
from airlight.planets.matter.particle_index import TableIndex
from airlight.planets.matter.particle_sizes import GammaSizes
from airlight.planets.matter.particles import Particles
from airlight.planets.matter.phases.phase_function import PhaseFunction

FloatArray = npt.NDArray[np.float64]

#: Wavelength of the extinction of cloud fields. [nm]
REFERENCE: float = 550.0


@dataclass(frozen=True, eq=False, kw_only=True)
class CloudOptics:
    """Optical properties of a cloud's particles at wavelengths.

    Parameters
    ----------
    wavelengths : array, shape (w,)
        Wavelengths. [nm]
    extinction : array, shape (w,)
        Extinction over that at 550 nm. [1]
    albedo : array, shape (w,)
        Single-scattering albedo. [1]
    phase : PhaseFunction
        Phase function: ``values``, ``moments``, ``phase_f12``, ``sampled``.
    """

    wavelengths: FloatArray
    extinction: FloatArray
    albedo: FloatArray
    phase: PhaseFunction

    def __post_init__(self) -> None:
        count = np.size(self.wavelengths)
        for name, high in (("extinction", np.inf), ("albedo", 1.0)):
            values = getattr(self, name)
            if np.shape(values) != (count,) or not np.all((values >= 0.0) & (values <= high)):
                raise ParameterError(name, values, f"{count} numbers from 0 to {high:g}")

    @classmethod
    def of_particles(cls, particles: Particles, wavelengths: npt.ArrayLike) -> CloudOptics:
        """Optical properties of particles by exact Mie theory.

        Parameters
        ----------
        particles : Particles
            Substance and sizes.
        wavelengths : array, shape (w,)
            Wavelengths. [nm]
        """
        nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
        extinction, scattering = particles.cross_sections(np.append(nm, REFERENCE))
        return cls(
            wavelengths=nm,
            extinction=extinction[:-1] / extinction[-1],
            albedo=np.minimum(scattering[:-1] / extinction[:-1], 1.0),
            phase=particles.phase_function(nm),
        )


def droplets(clouds: Clouds, optical_depth: float = 1.0) -> Particles:
    """Droplets of water clouds, of a vertical optical depth at 550 nm.

    Parameters
    ----------
    clouds : Clouds
        Clouds of water.
    optical_depth : float
        Vertical optical depth. [1]
    """
    sizes = GammaSizes(
        effective_radius=clouds.effective_radius, effective_variance=clouds.effective_variance
    )
    return Particles(
        index=TableIndex(table="water"), sizes=sizes, optical_depth=optical_depth, at=REFERENCE
    )
