"""Airglow in pictures: brightness, colour, and its absence by day."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import Camera, Scene, load_planet
from airlight.image.spectral_color import wavelength_color
from airlight.image.xyz import luminance
from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.physics.optics.airglow import layer_columns
from airlight.planets.medium import Medium
from airlight.render import render
from airlight.render.pixels.airglow import airglow_tables, basis_colors, emission_color
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.solve import solve

NM = (440.0, 500.0, 560.0, 620.0)


@pytest.fixture(scope="module")
def solution() -> MomentsSolution:
    """Solution of the Earth without city lights."""
    planet = load_planet("earth", {"ground.lights": None, "ground.map": None})
    return solve(planet, NM, "preview")


def picture(solution: MomentsSolution, **more: Any) -> np.ndarray:
    """Centre of a picture of the night sky."""
    look = more.pop("look", 0.0)
    camera = Camera(width=1, height=1, field_of_view=0.01, look_zenith=look)
    scene = Scene(camera=camera, **{"altitude": 2.0, "sun_zenith": 180.0, **more})
    return render(solution, scene).rgb[0, 0].astype(float)


@pytest.mark.parametrize("count", [3, 4, 16])
def test_a_line_s_colour_does_not_depend_on_the_wavelengths(count: int) -> None:
    # Colour of the weighted basis: that of the matching functions at 557.7 nm, exactly.
    planet = load_planet("earth")
    nm = np.linspace(440.0, 680.0, count)
    solved: Any = SimpleNamespace(lights=planet.lights(nm), medium=Medium.from_planet(planet, nm))
    line = wavelength_color(557.7)
    spectrum = solved.medium.map_basis @ basis_colors(solved, line)
    assert_allclose(solved.lights[0].colors().T @ spectrum, line, rtol=1e-9)


def test_the_zenith_is_as_bright_as_a_dark_sky_s_airglow(solution: MomentsSolution) -> None:
    # Leinert et al. (1998), A&AS 127, 1: dark skies have 21.6 to 22.0 mag per square arcsecond, of
    # which airglow is a half to three quarters; zodiacal light and stars are not in it.
    seen = LUMINOUS_EFFICACY * float(luminance(picture(solution)))
    assert 21.9 < 2.5 * np.log10(1.08e5 / seen) < 22.8


def test_the_limb_is_the_column_of_its_layers(solution: MomentsSolution) -> None:
    # Above the air nothing attenuates: colours times columns, at a tangent height of 200 km, where
    # only the red layer is left.
    altitude, radius = 4e5, 6.371e6
    look = 180.0 - np.degrees(np.arcsin((radius + 2e5) / (radius + altitude)))
    layers, _ = airglow_tables(solution)
    start = (radius + altitude) * np.cos(np.radians(look))
    shown = solution.lights[0].colors().T @ solution.medium.map_basis
    wanted = sum(
        sum(layer_columns(row[0], row[1], radius + 2e5, start)) * (shown @ row[2:5])
        for row in layers
    )
    assert_allclose(picture(solution, altitude=altitude, look=look), wanted, rtol=2e-3)


def test_by_day_there_is_none(solution: MomentsSolution) -> None:
    # Not drawn, so that the picture is the same to the last bit.
    planet = load_planet("earth", {"ground.lights": None, "ground.map": None, "airglow": "none"})
    dark = solve(planet, NM, "preview")
    by_day = [picture(one, sun_zenith=60.0, look=40.0) for one in (solution, dark)]
    assert_array_equal(*by_day)
    assert picture(dark).max() < 1e-3 * picture(solution).max()


def test_emissions_add_up_to_published_luminance() -> None:
    # 250 R at 557.7 nm: 7.09e-8 W m⁻² sr⁻¹, times 683 lm/W and V(557.7 nm) = 0.9990.
    from airlight.physics.optics.airglow import airglow_emissions

    green = airglow_emissions("earth")[0]
    seen = LUMINOUS_EFFICACY * float(luminance(emission_color(green)))
    assert_allclose(seen, 683.0 * 0.999 * 7.09e-8, rtol=2e-3)
