"""Interface of all density profiles."""

from __future__ import annotations

from abc import ABC, abstractmethod

from airlight.physics.optics import density_profile
from airlight.physics.optics.density_profile import Row
from airlight.planets.schema.toml_model import TomlModel


class Profile(TomlModel, ABC):
    """Relative density over altitude, as a parameter object.

    Subclasses are frozen (``@parameters``), with a ``keyword``, fields declared by ``Field`` and a
    ``row``, and are registered in ``PROFILES``.
    """

    @abstractmethod
    def row(self, thickness: float) -> Row:
        """Segments over a shell of this thickness [m]; see ``physics.optics.density_profile``."""

    def column(self, thickness: float) -> float:
        """Vertical column ∫ density dh over a shell of this thickness [m]. [m]"""
        return density_profile.row_column(self.row(thickness))
