"""Light sources of a scene: the star, a second star, a moon.

A solution is per irradiance of a source, for all its elevations: the radiance of several sources is
the sum of irradiance times the solution at the direction of each. Directions belong to the lights
of a scene (``Scene.lights``).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from airlight.image.four_wavelengths import picture_weights
from airlight.physics.spectra.limb_darkening import UNIFORM

FloatArray = npt.NDArray[np.float64]


class Occulter(NamedTuple):
    """Moon in front of a source.

    Attributes
    ----------
    x, y, z : float
        Direction of its centre, in the observer's frame with x towards the source. [1]
    radius : float
        Angular radius. [rad]
    left : float
        Unocculted fraction of the source's irradiance, above 0. [1]
    """

    x: float
    y: float
    z: float
    radius: float
    left: float


@dataclass(frozen=True, kw_only=True, eq=False)
class LightSource:
    """Disc at infinity that illuminates the planet.

    Attributes
    ----------
    name : str
        Name of the source: ``"star"``.
    angular_radius : float
        Angular radius of the disc. [rad]
    wavelengths : array, shape (nl,)
        Wavelengths of the samples. [nm]
    irradiance : array, shape (nl,)
        Irradiance at the planet, on a plane that faces the source. [W m⁻² nm⁻¹]
    spectrum : callable or None
        ``spectrum(wavelengths)``, proportional to the irradiance; None if only the samples are
        known: colours then use the sun's spectral shape between them.
    darkening : callable or None
        ``darkening(wavelengths)``, coefficients of limb darkening, shape (nl, 6), see
        ``physics.spectra.limb_darkening``; None for a uniform disc.
    phase : float or None
        Phase angle of a reflecting body, 0 to below 180; None for a star. [deg]
    limb : float
        Position angle of the bright limb of a reflecting body, clockwise from the zenith. [deg]
    face : array, shape (rows, columns, 3), or None
        Linear sRGB reflectance of a reflecting body's disc over its mean, a pyramid as for
        ``render.pixels.disc_shading.face_level``: upwards towards the bright limb. [1]
    occulter : Occulter or None
        Moon in front of it; ``irradiance`` is then the unocculted part.
    hidden : array, shape (nl,)
        Mean unocculted fraction over that at each wavelength; 1 without a moon. [1]
    """

    name: str
    angular_radius: float
    wavelengths: FloatArray
    irradiance: FloatArray
    spectrum: Callable[[Any], FloatArray] | None = None
    darkening: Callable[[Any], FloatArray] | None = None
    phase: float | None = None
    limb: float = 0.0
    face: FloatArray | None = None
    occulter: Occulter | None = None
    hidden: FloatArray | float = 1.0

    @property
    def darkenings(self) -> FloatArray:
        """Limb-darkening coefficients at the wavelengths, (nl, 6); uniform without a law. [1]"""
        count = self.wavelengths.size
        law = (
            np.tile(UNIFORM, (count, 1))
            if self.darkening is None
            else self.darkening(self.wavelengths)
        )
        return np.asarray(law * np.broadcast_to(self.hidden, count)[:, None])

    def colors(self, weights: npt.ArrayLike | None = None) -> FloatArray:
        """Linear sRGB of radiance per irradiance of this source, shape (nl, 3).

        Parameters
        ----------
        weights : array, shape (nl, 3), optional
            Linear sRGB per radiance; ``picture_weights`` by default.
        """
        if weights is None:
            weights = _weights(tuple(self.wavelengths.tolist()), self.spectrum)
        return np.asarray(weights, float) * self.irradiance[:, None]


@lru_cache(maxsize=64)
def _weights(
    wavelengths: tuple[float, ...], spectrum: Callable[[Any], FloatArray] | None
) -> FloatArray:
    """``picture_weights``, cached for live pictures."""
    weights = picture_weights(wavelengths, spectrum)
    weights.flags.writeable = False
    return weights
