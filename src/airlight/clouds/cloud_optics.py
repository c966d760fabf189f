"""``CloudOptics``: extinction ratio, albedo and phase function of a cloud's particles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.physics.units import values_in
from airlight.planets.clouds import ICE, Clouds
from airlight.planets.matter.particle_index import TableIndex
from airlight.planets.matter.particle_sizes import GammaSizes
from airlight.planets.matter.particles import Particles
from airlight.planets.matter.phases import DoubleHenyeyGreenstein
from airlight.planets.matter.phases.phase_function import PhaseFunction

FloatArray = npt.NDArray[np.float64]

#: Wavelength of the extinction of cloud fields. [nm]
REFERENCE: float = 550.0
#: Mean cosine of the scattering angle of ice crystals. [1]
ICE_ASYMMETRY: float = 0.75
#: Largest mean cosine of the lobe of diffraction. [1]
SHARPEST: float = 0.999
#: Smallest effective radius of crystals, ten wavelengths around. [m]
LEAST_CRYSTAL: float = 3e-6


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

    @classmethod
    def of_ice(cls, effective_radius: float, wavelengths: npt.ArrayLike) -> CloudOptics:
        r"""Optical properties of severely roughened ice crystals, large against the wavelength.

        Half of the light is diffracted and half takes rays through the crystals, so that

        .. math:: p = \tfrac{1}{2} (p_{d} + p_{r}), \quad g = \tfrac{1}{2} (g_{d} + g_{r}) = 0.75

        Both lobes are Henyey-Greenstein functions: that of diffraction has the half-width of a
        disc of the effective radius at 550 nm, :math:`g_d = 1 - 2.11 \lambda / (2 \pi r)`. Crystals
        are of no orientation and have no halo; absorption is neglected, less than 0.1 % of the
        extinction below 1 µm for 30 µm.

        Parameters
        ----------
        effective_radius : float
            Effective radius, 3e-6 to 1e-3. [m]
        wavelengths : array, shape (w,)
            Wavelengths. [nm]

        References
        ----------
        van Diedenhoven et al. (2012), Atmos. Meas. Tech. 5, 2361, eq. 1 (halves); Platnick et al.
        (2017), IEEE Trans. Geosci. Remote Sens. 55, 502, section II.D (0.75, roughened
        aggregates of columns).
        """
        nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
        if not LEAST_CRYSTAL <= effective_radius <= 1e-3:
            allowed = f"{LEAST_CRYSTAL:g} to 0.001 m for ice"
            raise ParameterError("effective_radius", effective_radius, allowed)
        diffracted = 1.0 - 2.11 * REFERENCE * 1e-9 / (2.0 * np.pi * effective_radius)
        diffracted = min(diffracted, SHARPEST)
        return cls(
            wavelengths=nm,
            extinction=np.ones(nm.size),
            albedo=np.ones(nm.size),
            phase=DoubleHenyeyGreenstein(
                asymmetry_1=diffracted, asymmetry_2=2.0 * ICE_ASYMMETRY - diffracted, weight=0.5
            ),
        )

    @classmethod
    def of_clouds(
        cls, clouds: Clouds, wavelengths: npt.ArrayLike, effective_radius: float | None = None
    ) -> CloudOptics:
        """Optical properties of the particles of clouds.

        Parameters
        ----------
        clouds : Clouds
            Substance and sizes.
        wavelengths : array, shape (w,)
            Wavelengths. [nm]
        effective_radius : float, optional
            Effective radius, if not that of the clouds. [m]
        """
        radius = clouds.effective_radius if effective_radius is None else effective_radius
        if clouds.particles == ICE:
            return cls.of_ice(radius, wavelengths)
        return cls.of_particles(droplets(radius, clouds.effective_variance), wavelengths)


def droplets(effective_radius: float, effective_variance: float) -> Particles:
    """Droplets of water with a gamma distribution of radii.

    Parameters
    ----------
    effective_radius : float
        Effective radius. [m]
    effective_variance : float
        Effective variance. [1]
    """
    sizes = GammaSizes(effective_radius=effective_radius, effective_variance=effective_variance)
    return Particles(index=TableIndex(table="water"), sizes=sizes, number_density=1.0)
