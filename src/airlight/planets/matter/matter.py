"""Interfaces of the matter of a constituent: three classes that the planet relies on.

``Matter`` gives scattering, absorption and phase function in one object: a gas by its composition,
particles by their sizes and refractive index. ``Scatterer`` gives only the scattering of molecules,
``Absorber`` only an absorption, beside any scattering.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from airlight.kernel.threads import Cancel, Progress
from airlight.planets.matter.phases import PhaseFunction
from airlight.planets.schema.toml_model import TomlModel
from airlight.planets.spectral import Limits

FloatArray = npt.NDArray[np.float64]


class Absorber(TomlModel, ABC):
    """Absorption of a constituent, as a parameter object."""

    mode = "advanced"

    @property
    @abstractmethod
    def limits(self) -> Limits:
        """Wavelengths at which it is known, lowest and highest. [nm]"""

    @abstractmethod
    def coefficients(self, wavelengths: npt.ArrayLike, vertical_column: float) -> FloatArray:
        """Absorption coefficient at relative density 1, shape (nl,). [m⁻¹]

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            Wavelengths. [nm]
        vertical_column : float
            Integral ∫ relative density dh over the shell. [m]
        """


class Scatterer(TomlModel, ABC):
    """Scattering of molecules, as a parameter object; they bend light too."""

    mode = "advanced"
    bends: ClassVar[bool] = True

    @property
    @abstractmethod
    def limits(self) -> Limits:
        """Wavelengths at which it is known, lowest and highest. [nm]"""

    @abstractmethod
    def coefficients(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Scattering coefficient at relative density 1, shape (nl,). [m⁻¹]"""

    @abstractmethod
    def refractivities(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Refractivity n - 1 at relative density 1, shape (nl,). [1]"""

    @abstractmethod
    def phase_function(self, wavelengths: npt.ArrayLike) -> PhaseFunction:
        """Phase function, known at these wavelengths [nm], shape (nl,)."""


class Matter(TomlModel, ABC):
    """Scattering, absorption and phase function of a constituent, as one parameter object.

    Attributes
    ----------
    label, help : str
        Label and help of its key in a planet file; the key itself is its ``keyword``.
    example : str
        Table as a file may write it.
    bends : bool
        Whether it bends light.
    """

    mode = "advanced"
    label: ClassVar[str]
    help: ClassVar[str]
    example: ClassVar[str]
    bends: ClassVar[bool] = False

    @property
    def needs_phase(self) -> str:
        """Name of matter that requires a phase function in the file; otherwise empty."""
        return ""

    def own_scale_height(self) -> float | None:
        """Scale height of the default profile; None if a profile is required. [m]"""
        return None

    def refractivities(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Refractivity n - 1 at relative density 1, shape (nl,); 0 if light is not bent. [1]"""
        return np.zeros(np.shape(wavelengths))

    @property
    @abstractmethod
    def limits(self) -> Limits:
        """Wavelengths at which it is known, lowest and highest. [nm]"""

    @abstractmethod
    def scattering_coefficients(
        self, wavelengths: npt.ArrayLike, vertical_column: float
    ) -> FloatArray:
        """Scattering coefficient at relative density 1, shape (nl,). [m⁻¹]

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            Wavelengths. [nm]
        vertical_column : float
            Integral ∫ relative density dh over the shell, by which an optical depth is divided. [m]
        """

    @abstractmethod
    def absorption_coefficients(
        self, wavelengths: npt.ArrayLike, vertical_column: float
    ) -> FloatArray:
        """Absorption coefficient at relative density 1, shape (nl,). [m⁻¹]

        Parameters
        ----------
        wavelengths, vertical_column
            See ``scattering_coefficients``. [nm], [m]
        """

    def prepare(
        self,
        wavelengths: npt.ArrayLike,
        *,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> None:
        """Do the slow computations before values are requested.

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            Wavelengths. [nm]
        progress, cancel : callable, optional
            See ``airlight.kernel.threads``.
        """

    @abstractmethod
    def phase_function(self, wavelengths: npt.ArrayLike) -> PhaseFunction:
        """Phase function, known at these wavelengths [nm], shape (nl,)."""
