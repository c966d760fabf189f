"""Surface brightness of a dark sky in magnitudes, as observers of stars give it."""

from __future__ import annotations

import math
from typing import Final

#: Illuminance of a star of magnitude V = 0 outside the air (Allen's Astrophysical Quantities, 4th
#: ed., 2000). [lx]
ZERO_MAGNITUDE: Final = 2.54e-6
#: Square arcseconds in a steradian. [arcsec² sr⁻¹]
ARCSECONDS: Final = (180.0 * 3600.0 / math.pi) ** 2
#: Luminance below which a sky is called dark: that of civil dusk. [cd m⁻²]
DARK: Final = 1.0


def sky_magnitude(luminance: float) -> float:
    """Surface brightness V = -2.5 lg(L / (E₀ n)), n the square arcseconds in 1 sr. [mag arcsec⁻²]

    Parameters
    ----------
    luminance : float
        Luminance L, above 0. [cd m⁻²]

    Examples
    --------
    >>> f"{sky_magnitude(1.7e-4):.1f}"  # a natural dark sky
    '22.0'
    """
    return -2.5 * math.log(luminance / (ZERO_MAGNITUDE * ARCSECONDS)) / math.log(10.0)
