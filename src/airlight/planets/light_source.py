"""The light sources of a scene: the star today; a second star or a moon by the same door.

A solution holds the light of one source of irradiance 1 under all its elevations, so each further
source costs one more look-up: the radiance of a place is the sum over ``lights`` of irradiance
times the solution at that light's direction. What stands here is what a source is, seen from the
planet; where it stands in the sky is the scene's (``Scene.lights``, in the same order).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from airlight.color.four_wavelengths import picture_weights

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class LightSource:
    """A disc at infinity that lights the planet.

    Attributes
    ----------
    name : str
        ``"star"``.
    angular_radius : float
        [rad]
    wavelengths : array, shape (nl,)
        [nm]
    irradiance : array, shape (nl,)
        At the planet, on a plane that faces the source. [W m⁻² nm⁻¹]
    spectrum : callable or None
        ``spectrum(wavelengths)``, the same at any wavelengths; None where only the samples are
        known: then colours take the sun's shape between them.
    """

    name: str
    angular_radius: float
    wavelengths: FloatArray
    irradiance: FloatArray
    spectrum: Callable[[Any], FloatArray] | None = None

    def colors(self, weights: npt.ArrayLike | None = None) -> FloatArray:
        """Linear sRGB of light that is known per irradiance of this source, shape (nl, 3).

        Parameters
        ----------
        weights : array, shape (nl, 3), optional
            Linear sRGB per radiance; ``picture_weights`` without it.
        """
        if weights is None:
            weights = picture_weights(self.wavelengths, self.spectrum)
        return np.asarray(weights, float) * self.irradiance[:, None]
