"""Luminance and V of radiances: of light like the sun's, and where wavelengths do not reach."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import load_planet
from airlight.cli import main
from airlight.physics.spectra.color_matching import cie_1931
from airlight.physics.spectra.sun import solar_irradiance
from airlight.solver.moments.solution import MomentsSolution
from airlight.studies.observables.brightness import BRIGHTNESS_WAVELENGTHS, brightness


def test_light_like_the_suns_has_its_brightness(solved: Callable[..., MomentsSolution]) -> None:
    # Radiance of the sun's irradiance over 1 sr: -26.76 + 2.5 log (arcsec²/sr), and 683 times the
    # integral of ȳ E; the wavelengths leave out 0.1 % of that.
    solution = solved(load_planet("earth"), BRIGHTNESS_WAVELENGTHS, "preview")
    luminance, magnitude = brightness(solution, solution.lights[0].irradiance[None, :])
    assert_allclose(magnitude, -26.76 + 5.0 * np.log10(np.degrees(3600.0)), atol=1e-3)
    seen = cie_1931()
    light = seen.values[:, 1] * solar_irradiance(seen.wavelengths)
    assert_allclose(luminance, 683.0 * np.trapezoid(light, seen.wavelengths), rtol=2e-3)


def test_few_wavelengths_have_neither(solved: Callable[..., MomentsSolution]) -> None:
    solution = solved(load_planet("earth"), (680.0, 550.0, 440.0), "preview")
    luminance, magnitude = brightness(solution, np.ones((1, 3)))
    assert np.isnan(luminance).all()  # ȳ at 440 nm is 2 % of its largest
    assert np.isnan(magnitude).all()  # V at 680 nm is 1.7 %


def test_a_table_of_radiances_has_the_columns(capsys: pytest.CaptureFixture[str]) -> None:
    # Patat et al. (2006): 15.9 mag at 2635 m with the sun 8 degrees low; within 0.6 at sea level
    words = ["radiance", "earth", "--quality", "preview", "--photometric", "--view-zenith", "0"]
    assert main([*words, "--sun-zenith", "50,98"]) == 0
    head, day, dusk = (line.split(",") for line in capsys.readouterr().out.splitlines())
    luminance, magnitude = (head.index(one) for one in ("luminance_cd_m-2", "V_mag_arcsec-2"))
    assert 1e3 < float(day[luminance]) < 1e4  # a clear zenith by day
    assert_allclose(float(dusk[magnitude]), 15.9, atol=0.6)
    assert main([*words, "--sun-zenith", "50", "--stokes"]) == 2
    assert "--photometric cannot be combined with --stokes" in capsys.readouterr().err
