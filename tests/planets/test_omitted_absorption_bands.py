"""Bands that a spectrum will not show are named, and nothing else is."""

from __future__ import annotations

import numpy as np
import pytest

from airlight import load_planet
from airlight.planets.omitted_absorption_bands import BANDS, omitted_absorption_bands


def test_known_bands_are_named_with_their_size() -> None:
    # 41 % at 764 nm, as gas_bands has it
    (line,) = omitted_absorption_bands(load_planet("earth"), [550.0, 764.0])
    assert line == (
        "absorption bands of O2 are omitted: up to 41 % of direct light at airmass 1.5, at 764 nm; "
        "a bandwidth counts them"
    )


def test_bands_without_a_table_are_named_where_the_spectrum_meets_them() -> None:
    planet = load_planet("exoplanet")  # nitrogen with carbon dioxide
    (line,) = omitted_absorption_bands(planet, np.arange(900.0, 1690.0, 10.0))
    assert "CO2 1040 to 1060, 1200 to 1220, 1420 to 1460, 1520 to 1660 nm" in line
    assert omitted_absorption_bands(planet, [1000.0, 1300.0]) == []


@pytest.mark.parametrize("name", ["earth", "mars", "venus", "earth-bruneton"])
def test_pictures_in_the_visible_raise_no_alarm(name: str) -> None:
    assert omitted_absorption_bands(load_planet(name), [680.0, 550.0, 440.0]) == []


def test_bands_ascend_and_do_not_overlap() -> None:
    for bands in BANDS.values():
        edges = np.ravel(bands)
        assert (np.diff(edges) > 0.0).all()
