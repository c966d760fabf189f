"""Colour of the sky in three directions."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from airlight.planets import load_planet
from airlight.render.sky_color import LOOKS, sky_colors


def test_under_twice_the_light_the_sky_is_twice_as_bright_and_of_the_same_colour() -> None:
    # radiance is linear in the star's irradiance
    paths = {"star.spectrum": None, "star.angular_radius": "0.27 deg"}
    nm = ["430 nm", "690 nm"]
    skies = [
        sky_colors(
            load_planet(
                "earth-atmosphere-plus",
                {**paths, "star.wavelengths": nm, "star.irradiance": [f"{level} W/m^2/nm"] * 2},
            ),
            cache=False,
        )
        for level in (1.0, 2.0)
    ]
    assert [color.look for color in skies[0]] == [look for look, _ in LOOKS]
    for dim, bright in zip(*skies, strict=True):
        # rounding of the solver's sums
        assert_allclose(bright.luminance, 2.0 * dim.luminance, rtol=1e-6)
        assert_allclose(bright.chromaticity, dim.chromaticity, rtol=0, atol=1e-6)
    # Rayleigh's blue: bluer than the equal-energy light, x = y = 1/3, and most so overhead
    x = np.array([color.chromaticity[0] for color in skies[0]])
    assert x[0] < 0.3
    assert x[0] < x[2]
    # the code is that of the displayed colour: blue above red overhead
    assert int(skies[0][0].code[5:], 16) > int(skies[0][0].code[1:3], 16)
