"""Raise of a star by bent light."""

from __future__ import annotations

from pathlib import Path

import pytest

from airlight import load_planet
from airlight.errors import ParameterError
from airlight.planets.medium import Medium
from airlight.solver.refracted_geometry import RefractedGeometry


def test_a_mirage_of_the_star_is_refused(tmp_path: Path) -> None:
    # 438 K/km of warming between 20 and 32 km: a star low in the sky would be seen several times
    from importlib import resources

    text = (resources.files("airlight.planets") / "presets" / "earth-hazy.toml").read_text()
    file = tmp_path / "planet.toml"
    file.write_text(text.replace('"6.5, 0, -1, -2.8,', '"6.5, 0, -438, -2.8,'))
    planet = load_planet(file)
    assert file.read_text() != text
    with pytest.raises(ParameterError, match=r"refraction is 'bouguer'; allowed: 'none' .* star"):
        RefractedGeometry.of(Medium.from_planet(planet, [680.0, 550.0, 440.0]))
