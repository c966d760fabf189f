"""``CloudLayer``: a cloud field with the optical properties of its particles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics
from airlight.errors import ParameterError
from airlight.planets.matter.particles import Particles


@dataclass(frozen=True, eq=False)
class CloudLayer:
    """Cloud of one kind of particles.

    Parameters
    ----------
    field : CloudField
        Extinction at 550 nm.
    matter : CloudOptics or Particles
        Optical properties, or particles from which they are computed.
    """

    field: CloudField
    matter: CloudOptics | Particles

    def optics_at(self, wavelengths: npt.NDArray[np.float64]) -> CloudOptics:
        """Optical properties at wavelengths.

        Parameters
        ----------
        wavelengths : array, shape (w,)
            Wavelengths. [nm]

        Raises
        ------
        ParameterError
            If given optical properties are at other wavelengths.
        """
        if isinstance(self.matter, Particles):
            return CloudOptics.of_particles(self.matter, wavelengths)
        own = np.asarray(self.matter.wavelengths, float)
        if own.shape != wavelengths.shape or not np.allclose(own, wavelengths, rtol=1e-9):
            raise ParameterError("wavelengths", own, f"those of the medium, {wavelengths} nm")
        return self.matter
