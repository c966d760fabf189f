"""Star catalogue: directions and spectral irradiances."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.physics.constants import BOLTZMANN, PLANCK, SPEED_OF_LIGHT
from airlight.physics.units import values_in

FloatArray = npt.NDArray[np.float64]

#: Irradiance by a star of V = 0 at 550 nm: Bessell (1979), Publications of the Astronomical Society
#: of the Pacific 91, 589. [W m⁻² nm⁻¹]
ZERO_MAGNITUDE: Final = 3.63e-11
_GREEN: Final = 550.0


@dataclass(frozen=True, eq=False)
class Stars:
    """Catalogue of stars to magnitude 6.5.

    Attributes
    ----------
    directions : array, shape (n, 3)
        Unit vectors in the frame of the J2000 equator, brightest first. [1]
    magnitudes : array, shape (n,)
        Magnitude V.
    colors : array, shape (n,)
        Colour B - V. [mag]
    """

    directions: FloatArray
    magnitudes: FloatArray
    colors: FloatArray

    def irradiances(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Spectral irradiance of each star outside the atmosphere, shape (n, nl). [W m⁻² nm⁻¹]

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            Wavelengths. [nm]
        """
        return black_body_irradiances(self.magnitudes, self.colors, wavelengths)


def black_body_irradiances(
    magnitudes: FloatArray, colors: FloatArray, wavelengths: npt.ArrayLike
) -> FloatArray:
    """Spectral irradiance by stars of given magnitudes and colours, shape (n, nl). [W m⁻² nm⁻¹]

    Parameters
    ----------
    magnitudes, colors : array, shape (n,)
        Magnitude V, and colour B - V. [mag]
    wavelengths : array, shape (nl,)
        Wavelengths. [nm]

    Notes
    -----
    A black body of the star's colour, scaled to its magnitude at 550 nm. The sun's own magnitude,
    -26.74, gives 1.80 W m⁻² nm⁻¹; measured are 1.86.
    """
    nm = values_in(wavelengths, "nm", "wavelengths")
    x = PLANCK * SPEED_OF_LIGHT / (BOLTZMANN * 1e-9 * color_temperatures(colors)[:, None])
    shape = (_GREEN / nm) ** 5 * np.expm1(x / _GREEN) / np.expm1(x / nm)
    return np.asarray(ZERO_MAGNITUDE * 10.0 ** (-0.4 * magnitudes[:, None]) * shape)


def color_temperatures(colors: FloatArray) -> FloatArray:
    """Black-body temperatures of stars from colour indices B - V, shape (n,). [K]

    References
    ----------
    Ballesteros (2012), Europhysics Letters 97, 34008, eq. 14.
    """
    bv = np.clip(colors, -0.4, 2.5)
    return np.asarray(4600.0 * (1.0 / (0.92 * bv + 1.7) + 1.0 / (0.92 * bv + 0.62)))


@cache
def stars() -> Stars:
    """Load the catalogue; see ``scene/system/data/SOURCES.md``.

    Examples
    --------
    >>> f"{stars().magnitudes[0]:.2f}"  # Sirius
    '-1.44'
    """
    file = resources.files("airlight.scene.system") / "data" / "stars.npz"
    with resources.as_file(file) as path, np.load(path) as found:
        ascension = np.radians(found["right_ascension"].astype(np.float64))
        declination = np.radians(found["declination"].astype(np.float64))
        magnitudes, colors = found["magnitude"] / 100.0, found["color"] / 100.0
    flat = np.cos(declination)
    directions = np.stack(
        [flat * np.cos(ascension), flat * np.sin(ascension), np.sin(declination)], axis=-1
    )
    return Stars(directions, magnitudes, colors)
