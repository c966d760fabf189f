"""Colours of monochromatic light."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.image.xyz import xyz_to_rgb
from airlight.physics.spectra.color_matching import cie_1931

Normalization = Literal["none", "sum", "peak"]


def wavelength_color(
    wavelengths: ArrayLike, normalization: Normalization = "none"
) -> NDArray[np.float64]:
    """Linear sRGB of monochromatic light.

    Monochromatic light is outside the gamut: at least one channel is negative.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths, 350 to 840; end values beyond 360 and 830. [nm]
    normalization : "none", "sum" or "peak"
        ``none``: the matching functions themselves; ``sum``: XYZ divided by X + Y + Z, which shows
        the hue of wavelengths at which the eye is insensitive; ``peak``: RGB divided by its largest
        channel.

    Returns
    -------
    array, shape (..., 3)
        Linear sRGB. [1]

    Raises
    ------
    ParameterError
        If a wavelength lies outside, or ``normalization`` is unknown.

    References
    ----------
    Atmosphere Plus notes 2, section 1.1.3.

    Examples
    --------
    >>> wavelength_color([650.0, 550.0, 450.0], "peak").round(2)
    array([[ 1.  , -0.1 , -0.01],
           [-0.09,  1.  , -0.12],
           [ 0.08, -0.1 ,  1.  ]])
    """
    if normalization not in ("none", "sum", "peak"):
        raise ParameterError("normalization", normalization, "none, sum, peak")
    xyz = cie_1931().at(wavelengths)
    if normalization == "sum":
        xyz = xyz / xyz.sum(axis=-1, keepdims=True)
    rgb = xyz_to_rgb(xyz)
    if normalization == "peak":
        rgb = rgb / rgb.max(axis=-1, keepdims=True)
    return rgb
