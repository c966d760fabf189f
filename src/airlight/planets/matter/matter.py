"""Interfaces of the matter of a constituent.

``Matter`` has scattering, absorption and phase function: a gas by composition, particles by size
and refractive index. ``Scatterer`` has only scattering by molecules, ``Absorber`` only absorption.
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

    @property
    @abstractmethod
    def limits(self) -> Limits:
        """Wavelength range. [nm]"""

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
    """Scattering and refraction by molecules, as a parameter object."""

    bends: ClassVar[bool] = True

    @property
    @abstractmethod
    def limits(self) -> Limits:
        """Wavelength range. [nm]"""

    @abstractmethod
    def coefficients(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Scattering coefficient at relative density 1, shape (nl,). [m⁻¹]"""

    @abstractmethod
    def refractivities(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Refractivity n - 1 at relative density 1, shape (nl,). [1]"""

    @abstractmethod
    def phase_function(self, wavelengths: npt.ArrayLike) -> PhaseFunction:
        """Phase function at wavelengths [nm], shape (nl,)."""


class Matter(TomlModel, ABC):
    """Scattering, absorption and phase function of a constituent, as one parameter object.

    Attributes
    ----------
    label, help : str
        Label and help of its key ``keyword`` in a planet file.
    example : str
        Example of its table in a file.
    bends : bool
        Whether it refracts.
    """

    label: ClassVar[str]
    help: ClassVar[str]
    example: ClassVar[str]
    bends: ClassVar[bool] = False

    @property
    def needs_phase(self) -> str:
        """Name of matter that requires an explicit phase function; otherwise empty."""
        return ""

    def own_scale_height(self) -> float | None:
        """Scale height of the default profile; None if a profile is required. [m]"""
        return None

    def refractivities(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Refractivity n - 1 at relative density 1, shape (nl,); 0 without refraction. [1]"""
        return np.zeros(np.shape(wavelengths))

    @property
    @abstractmethod
    def limits(self) -> Limits:
        """Wavelength range. [nm]"""

    @abstractmethod
    def scattering_coefficients(
        self, wavelengths: npt.ArrayLike, vertical_column: float
    ) -> FloatArray:
        """Scattering coefficient at relative density 1, shape (nl,). [m⁻¹]

        Parameters
        ----------
        vertical_column : float
            Integral ∫ relative density dh over the shell. [m]
        """

    @abstractmethod
    def absorption_coefficients(
        self, wavelengths: npt.ArrayLike, vertical_column: float
    ) -> FloatArray:
        """Absorption coefficient at relative density 1, shape (nl,). [m⁻¹]"""

    def prepare(
        self,
        wavelengths: npt.ArrayLike,
        *,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> None:
        """Compute slow quantities before values are requested."""

    @abstractmethod
    def phase_function(self, wavelengths: npt.ArrayLike) -> PhaseFunction:
        """Phase function at wavelengths [nm], shape (nl,)."""
