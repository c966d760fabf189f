"""The density profiles a constituent can have, as parameter objects."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from airlight.errors import ParameterError
from airlight.optics import density_profile
from airlight.optics.density_profile import LayerTerms, Row
from airlight.optics.tabulated_profile import tabulated
from airlight.planets.parameters import (
    Length,
    ScaleHeight,
    all_between,
    ascending,
    between,
    parameters,
)

#: The most rows a profile's table and the most layers a layered profile may have.
MOST_ROWS = 1000


@parameters
class Exponential:
    """exp(-h/H).

    Parameters
    ----------
    scale_height : float
        H, 1 to 1e9. [m]

    Examples
    --------
    >>> f"{Exponential(scale_height=8000.0).column(100e3):.4f}"
    '7999.9702'
    """

    scale_height: ScaleHeight

    def row(self, thickness: float) -> Row:
        """Segments over a shell of this thickness [m]; see ``optics.density_profile``."""
        return density_profile.exponential(self.scale_height, thickness)

    def column(self, thickness: float) -> float:
        """Vertical column over a shell of this thickness [m]. [m]"""
        return density_profile.row_column(self.row(thickness))


@parameters
class Tent:
    """``max(0, 1 - |h - center|/half_width)``.

    Parameters
    ----------
    center : float
        Altitude of the peak. [m]
    half_width : float
        From the peak to where the density is 0. [m]
    """

    center: Length
    half_width: ScaleHeight

    def row(self, thickness: float) -> Row:
        """Segments over a shell of this thickness [m]; see ``optics.density_profile``."""
        return density_profile.tent(self.center, self.half_width, thickness)

    def column(self, thickness: float) -> float:
        """Vertical column over a shell of this thickness [m]. [m]"""
        return density_profile.row_column(self.row(thickness))


@parameters
class Layer:
    """One of Bruneton's layers: exp_term·e^(exp_scale·h) + linear_term·h + constant_term.

    The sum is clamped to [0, 1].

    Parameters
    ----------
    width : float
        Thickness; that of the topmost layer is not used. [m]
    exp_term, constant_term : float
        [1]
    exp_scale, linear_term : float
        [m⁻¹]
    """

    width: Length = 0.0
    exp_term: Annotated[float, between(-1e6, 1e6)] = 0.0
    exp_scale: Annotated[float, between(-1.0, 1.0, "/m")] = 0.0
    linear_term: Annotated[float, between(-1.0, 1.0, "/m")] = 0.0
    constant_term: Annotated[float, between(-1e6, 1e6)] = 0.0


@parameters
class Layered:
    """Layers stacked from the ground; the last one reaches the top of the shell.

    Parameters
    ----------
    layers : tuple of Layer
        At least one; all but the last have a width.
    """

    layers: tuple[Layer, ...]

    def __post_init__(self) -> None:
        if not 1 <= len(self.layers) <= MOST_ROWS:
            raise ParameterError("layers", len(self.layers), f"1 to {MOST_ROWS} layers")
        for index, layer in enumerate(self.layers[:-1]):
            if layer.width <= 0.0:
                raise ParameterError(f"layers[{index}].width", layer.width, "more than 0 m")

    def row(self, thickness: float) -> Row:
        """Segments over a shell of this thickness [m]; see ``optics.density_profile``."""
        terms = [
            LayerTerms(
                width=layer.width,
                exp_term=layer.exp_term,
                exp_scale=layer.exp_scale,
                linear_term=layer.linear_term,
                constant_term=layer.constant_term,
            )
            for layer in self.layers
        ]
        return density_profile.layered(terms, thickness)

    def column(self, thickness: float) -> float:
        """Vertical column over a shell of this thickness [m]. [m]"""
        return density_profile.row_column(self.row(thickness))


@parameters
class Tabulated:
    """A table of altitudes and densities; see ``optics.tabulated_profile``.

    Parameters
    ----------
    altitudes : tuple of float
        Strictly ascending, 2 to 1000 of them. [m]
    densities : tuple of float
        As many, relative, not negative. [1]
    """

    altitudes: Annotated[tuple[float, ...], all_between(0.0, 1e9, "m")]
    densities: Annotated[tuple[float, ...], all_between(0.0, 1e6)]

    def __post_init__(self) -> None:
        if not 2 <= len(self.altitudes) <= MOST_ROWS:
            raise ParameterError("altitudes", self.altitudes, f"2 to {MOST_ROWS} altitudes")
        if len(self.densities) != len(self.altitudes):
            raise ParameterError(
                "densities", self.densities, f"one for each of {len(self.altitudes)} altitudes"
            )
        ascending(self.altitudes, "altitudes", "m")
        if float(np.min(np.diff(self.altitudes))) < 1e-3:
            raise ParameterError("altitudes", self.altitudes, "steps of at least 1 mm")

    def row(self, thickness: float) -> Row:
        """Segments over a shell of this thickness [m]; see ``optics.density_profile``."""
        return tabulated(self.altitudes, self.densities, thickness)

    def column(self, thickness: float) -> float:
        """Vertical column over a shell of this thickness [m]. [m]"""
        return density_profile.row_column(self.row(thickness))


@parameters
class Uniform:
    """The same density everywhere in the shell."""

    def row(self, thickness: float) -> Row:
        """Segments over a shell of this thickness [m]; see ``optics.density_profile``."""
        return density_profile.uniform(thickness)

    def column(self, thickness: float) -> float:
        """Vertical column over a shell of this thickness [m]. [m]"""
        return density_profile.row_column(self.row(thickness))


Profile = Exponential | Tent | Layered | Tabulated | Uniform
