"""What a constituent can be made of: the three promises that the planet relies on.

``Matter`` says everything about light in one object, scattering, absorption and phase function: a
gas by its composition, particles by their sizes and refractive index. ``Scatterer`` says only what
molecules scatter, ``Absorber`` only what is absorbed, beside any scattering.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from airlight.kernel.threads import Cancel, Progress
from airlight.planets.matter.phases import PhaseFunction
from airlight.planets.schema.record import Record
from airlight.planets.spectral import Limits

FloatArray = npt.NDArray[np.float64]


class Absorber(Record, ABC):
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


class Scatterer(Record, ABC):
    """Scattering of molecules, as a parameter object; they bend light too."""

    bends: ClassVar[bool] = True

    @property
    @abstractmethod
    def limits(self) -> Limits:
        """The wavelengths at which it is known, lowest and highest. [nm]"""

    @abstractmethod
    def coefficients(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Scattering coefficient at relative density 1, shape (nl,). [m⁻¹]"""

    @abstractmethod
    def refractivities(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """n - 1 at relative density 1, shape (nl,). [1]"""

    @abstractmethod
    def phase_function(self, wavelengths: npt.ArrayLike) -> PhaseFunction:
        """Its phase function, known at these wavelengths [nm], shape (nl,)."""


class Matter(Record, ABC):
    """Scattering, absorption and phase function of a constituent, as one parameter object.

    Attributes
    ----------
    label, help : str
        Of the key that it stands at in a planet file; the key itself is its ``keyword``.
    example : str
        A table as a file may write it.
    bends : bool
        Whether it bends light.
    """

    label: ClassVar[str]
    help: ClassVar[str]
    example: ClassVar[str]
    bends: ClassVar[bool] = False

    @property
    def needs_phase(self) -> str:
        """What has no phase function of its own, so that the file gives one; empty if it has."""
        return ""

    def own_scale_height(self) -> float | None:
        """Scale height of the profile that stands for one left out; None if it needs one. [m]"""
        return None

    def refractivities(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """n - 1 where the relative density is 1, shape (nl,); 0 if it does not bend light. [1]"""
        return np.zeros(np.shape(wavelengths))

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

    def prepare(
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
