"""Displayed value of a picture's key, by the adaptation of the eye and by long exposures."""

from __future__ import annotations

from typing import Final

from airlight.kernel import kernel
from airlight.physics.constants import LUMINOUS_EFFICACY

#: Displayed level of the key of a sunlit picture. [1]
KEY: Final = 0.42
#: Luminance below which the exposure follows the eye's dark adaptation: that of a sky half an hour
#: after sunset, which should look like dusk. [cd m⁻²]
_PHOTOPIC: Final = 34.0
#: Exponent of brightness as a function of luminance. [Stevens & Stevens 1963]
_BRIGHTNESS: Final = 1.0 / 3.0
#: Luminance of a moonless, starless night; darker pictures are not brightened further. [cd m⁻²]
NIGHT: Final = 1e-4
#: Displayed level of the key of a long exposure by night, and luminance below which it falls, as
#: exposures are not longer. [1, cd m⁻²]
_LONG_EXPOSURE: Final = 0.055
_LONGEST: Final = 1e-3


@kernel
def adapted_key(bright):
    """Displayed value of a picture's key, for the state of adaptation of the eye. [1]

    Parameters
    ----------
    bright : float
        Luminance of the key. [cd m⁻²]
    """
    return KEY / (1.0 + _PHOTOPIC / max(bright, NIGHT)) ** _BRIGHTNESS


@kernel
def shown_key(bright):
    """Displayed value of a picture's key: to the adapted eye, or by a long exposure at night. [1]

    Parameters
    ----------
    bright : float
        Luminance of the key. [cd m⁻²]
    """
    long = _LONG_EXPOSURE * min(max(bright, NIGHT) / _LONGEST, 1.0)
    return max(adapted_key(bright), long)


@kernel
def seen_share(exposure):
    """Brightness to the adapted eye over that in a picture, at the key of an exposure. [1]

    Parameters
    ----------
    exposure : float
        Factor of the exposure, above 0. [1]
    """
    bright = max(_LONG_EXPOSURE * LUMINOUS_EFFICACY / exposure, _LONGEST)
    return min(adapted_key(bright) / shown_key(bright), 1.0)
