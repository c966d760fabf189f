"""Typical spectra of atmospheric light by formula, to which few wavelengths are fitted."""

from __future__ import annotations

from functools import cache
from itertools import product
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.image.spectral import EYE
from airlight.physics.constants import DOBSON_UNIT
from airlight.physics.spectra.ozone import ozone_cross_section

#: Powers n of λ⁻ⁿ of the initial light: gas; fine, coarse and grey haze or ground; red ground.
_SOURCES: Final = (4.0, 2.0, 1.0, 0.0, -1.0)
#: Optical depths at 550 nm removed by scattering by gas; 0.097 is Earth's zenith.
_GAS: Final = (0.0, 0.1, 0.3, 0.8, 2.0, 4.0)
#: Optical depths at 550 nm removed by haze, proportional to λ^-1.3.
_HAZE: Final = (0.0, 0.5)
#: Ozone columns passed, in units of 300 Dobson units: 1 at noon, some tens at dusk.
_OZONE: Final = (0.0, 3.0, 10.0, 30.0)
#: Logistic absorption edges of blue absorbers (iron oxides, tholins, sulphur): middle, width,
#: depth.
_EDGES: Final = (450.0, 480.0, 510.0, 540.0, 570.0)
_WIDTHS: Final = (15.0, 30.0, 45.0)
_DEPTHS: Final = (0.3, 1.0, 2.0, 4.0)
#: Powers of the initial light of such spectra.
_COLORED_SOURCES: Final = (0.0, 2.0, -1.0)


@cache
def typical_light() -> NDArray[np.float64]:
    r"""Radiance over the star's irradiance, up to a factor, for light of atmospheres.

    With x = λ / 550 nm, scattered or reflected light attenuated by gas, haze and ozone,

    .. math:: x^{-n} \exp(-\tau_g x^{-4} - \tau_h x^{-1.3} - N \sigma_{O_3}(\lambda)),

    from a zenith to a setting sun and the blue of dusk, and light that has lost its blue,

    .. math:: x^{-n} \exp\left(-\frac{d}{1 + e^{(\lambda - \lambda_e) / w}}\right),

    by dust, tholins and sulphur. Narrow bands (methane on Titan, water and oxygen on Earth) are not
    included, as four wavelengths cannot resolve them.

    Returns
    -------
    array, shape (420, 471)
        Spectra at 360 to 830 nm. [1]

    References
    ----------
    Ångström (1929) for λ^-1.3 of haze; ozone as in ``airlight.physics.spectra.ozone``.
    """
    x = EYE / 550.0
    ozone = 300.0 * DOBSON_UNIT * ozone_cross_section(EYE)
    weakened = [
        x**-source * np.exp(-gas * x**-4.0 - haze * x**-1.3 - layers * ozone)
        for source, gas, layers, haze in product(_SOURCES, _GAS, _OZONE, _HAZE)
    ]
    colored = [
        x**-source * np.exp(-depth / (1.0 + np.exp((EYE - edge) / width)))
        for edge, width, depth, source in product(_EDGES, _WIDTHS, _DEPTHS, _COLORED_SOURCES)
    ]
    light = np.array([*weakened, *colored])
    light.flags.writeable = False
    return light
