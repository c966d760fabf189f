r"""Profiles over optical altitude, with which refracted rays are integrated as straight lines.

With x = n r (see ``geometry.refraction``) a column along a refracted ray is the column of the
density times dr/dx along a straight line, and the refraction angle is b times the column of

.. math:: \frac{1}{x^2}\left(\frac{x}{r}\frac{dr}{dx} - 1\right)

which is positive where n falls with height and vanishes with it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.physics.optics.density_profile import DensitySegments, Row

FloatArray = npt.NDArray[np.float64]

#: Number of pieces of a profile over optical altitude, even in its square root, in addition to
#: the profile's own.
_PIECES: Final = 192
#: Smallest allowed d(n r)/dr: at 0 a horizontal ray circles the planet (critical refraction).
_LEAST_GROWTH: Final = 0.05


@dataclass(frozen=True, eq=False)
class RefractingShell:
    """Refracting shell over the optical radius.

    Attributes
    ----------
    bottom, top : float
        Optical radii of the ground and of the top of the shell. [m]
    altitude, optical : array, shape (n,)
        Altitude above the ground [m], and optical radius there [m].
    density : DensitySegments
        Profiles over optical altitude: the constituents times dr/dx, then the refraction column's,
        the formula at the head of this module over its maximum. [1]
    length : DensitySegments
        Profile of dr/dx itself, whose column is the true length of a ray. [1]
    refraction_strength : float
        That maximum; the refraction angle is ``refraction_strength`` · b · refraction column. [m⁻²]
    """

    bottom: float
    top: float
    altitude: FloatArray
    optical: FloatArray
    density: DensitySegments
    length: DensitySegments
    refraction_strength: float

    @classmethod
    def build(
        cls,
        density: DensitySegments,
        refractivity: FloatArray,
        bottom_radius: float,
        top_radius: float,
    ) -> RefractingShell:
        """Shell of the given profiles.

        Parameters
        ----------
        density : DensitySegments
            Profiles over altitude.
        refractivity : array, shape (nc,)
            n - 1 of each constituent at relative density 1. [1]
        bottom_radius, top_radius : float
            Radii of the ground and of the top. [m]

        Raises
        ------
        ParameterError
            If refraction is nearly critical, or the refractivity increases with height.
        """
        thickness = top_radius - bottom_radius
        own = density.edges[(density.edges > 0.0) & (density.edges < thickness)]
        even = thickness * np.linspace(0.0, 1.0, _PIECES + 1) ** 2
        nodes = np.unique(np.concatenate([even, own]))
        nodes = nodes[np.concatenate([[True], np.diff(nodes) > 1e-9 * thickness])]
        nodes[-1] = thickness
        # The top counts as vacuum, so that nothing jumps where the shell ends.
        excess = refractivity @ (density.at(nodes) - density.at(np.array([thickness])))
        growth = _growth(density, refractivity, bottom_radius, nodes, excess)
        _check(nodes, growth, excess)
        r = bottom_radius + nodes
        optical = r * (1.0 + excess)
        stretch = 1.0 / growth
        # The optical altitude from differences that do not cancel.
        optical_altitude = nodes * (1.0 + excess) + bottom_radius * (excess - excess[0])
        refraction = ((1.0 + excess) * stretch - 1.0) / optical**2
        strength = float(refraction.max())
        normalised = refraction / strength if strength > 0.0 else refraction
        # From both sides of a node, since a profile may jump there.
        hair = 1e-6 * np.diff(nodes)
        above = density.at(nodes[:-1] + hair) * stretch[:-1]
        below = density.at(nodes[1:] - hair) * stretch[1:]
        # Density and dr/dx at the middle of each piece, the latter to second order.
        halfway = density.at(nodes[:-1] + 0.5 * np.diff(nodes))
        halfway = halfway * np.sqrt(stretch[:-1] * stretch[1:])
        rows = [
            _row(optical_altitude, *values) for values in zip(above, below, halfway, strict=True)
        ]
        return cls(
            bottom=float(optical[0]),
            top=float(optical[-1]),
            altitude=nodes,
            optical=optical,
            density=replace(
                DensitySegments.from_rows(
                    [*rows, _row(optical_altitude, normalised[:-1], normalised[1:], None)]
                ),
                known_breakpoints=np.interp(density.breakpoints, nodes, optical_altitude),
            ),
            length=DensitySegments.from_rows(
                [_row(optical_altitude, stretch[:-1], stretch[1:], None)]
            ),
            refraction_strength=strength,
        )


def _growth(
    density: DensitySegments,
    refractivity: FloatArray,
    bottom_radius: float,
    nodes: FloatArray,
    excess: FloatArray,
) -> FloatArray:
    """d(n r)/dr at each node: 1 + excess + r d excess/dr. [1]"""
    step = 1e-7 * nodes[-1]
    low, high = np.maximum(nodes - step, 0.0), np.minimum(nodes + step, nodes[-1])
    change = refractivity @ (density.at(high) - density.at(low)) / (high - low)
    return np.asarray(1.0 + excess + (bottom_radius + nodes) * change)


def _check(nodes: FloatArray, growth: FloatArray, excess: FloatArray) -> None:
    worst = int(growth.argmin())
    if growth[worst] < _LEAST_GROWTH:
        raise ParameterError(
            "refraction",
            "bouguer",
            f"'none' for this atmosphere: at {nodes[worst]:.4g} m d(n r)/dr is "
            f"{growth[worst]:.3g}, less than {_LEAST_GROWTH:g}, and rays would be ducted",
        )
    rising = int(np.argmax(np.diff(excess)))
    if np.diff(excess)[rising] > 1e-12:
        raise ParameterError(
            "refraction",
            "bouguer",
            f"'none' for this atmosphere: its refractivity increases with height at "
            f"{nodes[rising]:.4g} m",
        )


def _row(altitude: FloatArray, low: FloatArray, high: FloatArray, middle: FloatArray | None) -> Row:
    """Segments from values at the ends of each and, if known, in the middle.

    Exponentials; straight lines next to a 0 and where they are nearer to the middle value.
    """
    width = np.diff(altitude)
    curved = (low > 0.0) & (high > 0.0)
    if middle is not None:
        straight = np.abs(0.5 * (low + high) - middle)
        curved &= np.abs(np.sqrt(low * high) - middle) <= straight
    safe_low, safe_high = np.where(curved, low, 1.0), np.where(curved, high, 1.0)
    rows = np.zeros((width.size, 4))
    rows[:, 0] = np.where(curved, low, 0.0)
    rows[:, 1] = np.where(curved, np.log(safe_high / safe_low) / width, 0.0)
    rows[:, 2] = np.where(curved, 0.0, (high - low) / width)
    rows[:, 3] = np.where(curved, 0.0, low)
    return altitude.copy(), rows
