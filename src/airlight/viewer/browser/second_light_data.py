"""Colours of a page's second light: the Moon, and stars by temperature."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.render.pixels.render_tables import WAVELENGTHS
from airlight.scene.moon_light import MoonLight
from airlight.scene.star_light import StarLight
from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]

#: Temperatures, uniform in their reciprocal, in which the logarithm of a black body's radiance is
#: almost linear; they span the range of the view's control. [K]
TEMPERATURES: Final = tuple((1.0 / np.linspace(1.0 / 1500.0, 1.0 / 40000.0, 25)).tolist())
#: Number of significant digits.
_DIGITS: Final = 6


def second_light_data(solution: MomentsSolution) -> dict[str, Any]:
    """Data of a second light for ``web/drawing/lights.js``, per squared sine of its radius.

    Parameters
    ----------
    solution : MomentsSolution
        Solution at three or four wavelengths.

    Returns
    -------
    dict
        ``irradiance`` of the planet's own star [W m⁻² nm⁻¹], shape (nl,); ``moon``: albedo,
        shape (nl,), and weights to linear sRGB, shape (3·nl,); ``stars``, by temperature:
        ``temperature`` [K], logarithm of the irradiance, weights, and darkening, shape (6·4,).
    """
    own = solution.lights
    full = MoonLight(zenith=0.0, angular_radius=30.0).source(own)
    stars = []
    for temperature in TEMPERATURES:
        light = StarLight(zenith=0.0, star=StarLight.black_body(temperature, 30.0)).source(own)
        law = np.zeros((light.darkenings.shape[1], WAVELENGTHS))
        law[:, : light.wavelengths.size] = light.darkenings.T
        stars.append(
            {
                "temperature": temperature,
                "irradiance": _short(np.log(4.0 * light.irradiance)),
                "weights": _short(light.colors() / light.irradiance[:, None]),
                "darkening": _short(law),
            }
        )
    return {
        "irradiance": _short(own[0].irradiance),
        "moon": {
            "albedo": _short(4.0 * full.irradiance / own[0].irradiance),
            "weights": _short(full.colors() / full.irradiance[:, None]),
        },
        "stars": stars,
    }


def _short(values: FloatArray) -> list[float]:
    return [float(f"{x:.{_DIGITS}g}") for x in values.ravel()]
