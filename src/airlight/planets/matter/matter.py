"""What a constituent can be made of: the two promises that the planet relies on.

``Matter`` says everything about light in one object, scattering, absorption and phase function: a
gas by its composition, particles by their sizes and refractive index. ``Absorber`` says only what
is absorbed, beside any scattering.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
import numpy.typing as npt

from airlight.kernel.threads import Cancel, Progress
from airlight.planets.matter.phases import PhaseFunction
from airlight.planets.spectral import Limits

FloatArray = npt.NDArray[np.float64]


class Absorber(ABC):
    """Absorption of a constituent, as a parameter object."""

    @property
    @abstractmethod
    def limits(self) -> Limits:
        """The wavelengths at which it is known, lowest and highest. [nm]"""

    @abstractmethod
    def coefficients(self, wavelengths: npt.ArrayLike, vertical_column: float) -> FloatArray:
        """Absorption coefficient at relative density 1, shape (nl,). [m⁻¹]

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            [nm]
        vertical_column : float
            ∫ relative density dh over the shell. [m]
        """


class Matter(ABC):
    """Scattering, absorption and phase function of a constituent, as one parameter object."""

    @property
    @abstractmethod
    def limits(self) -> Limits:
        """The wavelengths at which it is known, lowest and highest. [nm]"""

    @abstractmethod
    def scattering_coefficients(
        self, wavelengths: npt.ArrayLike, vertical_column: float
    ) -> FloatArray:
        """Scattering coefficient at relative density 1, shape (nl,). [m⁻¹]

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            [nm]
        vertical_column : float
            ∫ relative density dh over the shell, by which an optical depth is divided. [m]
        """

    @abstractmethod
    def absorption_coefficients(
        self, wavelengths: npt.ArrayLike, vertical_column: float
    ) -> FloatArray:
        """Absorption coefficient at relative density 1, shape (nl,). [m⁻¹]

        Parameters
        ----------
        wavelengths, vertical_column
            As for ``scattering_coefficients``. [nm], [m]
        """

    def prepare(  # noqa: B027 - most matter has nothing to prepare
        self,
        wavelengths: npt.ArrayLike,
        *,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> None:
        """Do what takes long before values are asked for.

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            [nm]
        progress, cancel : callable, optional
            See ``airlight.kernel.threads``.
        """

    @abstractmethod
    def phase_function(self, wavelengths: npt.ArrayLike) -> PhaseFunction:
        """Its phase function, known at these wavelengths [nm], shape (nl,)."""
