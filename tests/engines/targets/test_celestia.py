"""The catalogue file for Celestia, and what its keys mean."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.engines.targets import target_of
from airlight.engines.targets.celestia import (
    g_of_schlick,
    planet_from_celestia,
    read_atmosphere,
    schlick,
)
from airlight.errors import ParameterError
from airlight.kernel import vectorized
from airlight.physics.optics.legendre import legendre_moments
from airlight.planets import load_planet, replace
from airlight.planets.medium import Medium

NM = (680.0, 550.0, 440.0)
#: Keys of the parser for an atmosphere.
KEYS = {
    "Height", "Mie", "MieScaleHeight", "MieAsymmetry", "MieHGAnisotropy", "Rayleigh",
    "RayleighScaleHeight", "Absorption", "CloudHeight", "CloudMap", "CloudShadowDepth",
}  # fmt: skip


def written(solved, tmp_path, name):
    planet = replace(load_planet(name), refraction="none")
    solution = solved(planet, NM, quality="preview")
    export = target_of("celestia").write(solution, tmp_path / "out")
    text = (tmp_path / "out" / "atmosphere.ssc").read_text(encoding="utf-8")
    return solution, export, text


def test_file_read_back_has_the_optical_depths(solved, tmp_path):
    solution, export, text = written(solved, tmp_path, "earth-openspace")
    assert 'Modify "Earth" "Sol"' in text
    assert text.count("{") == text.count("}") == 2
    keys = read_atmosphere(text)
    assert set(keys) <= KEYS
    assert keys["Height"] == 70.0
    made = planet_from_celestia(keys, solution.planet.star, 6377e3, 0.1, "again")
    again = Medium.from_planet(made, NM)
    whole, got = (one.vertical_optical_depth.sum(axis=0) for one in (solution.medium, again))
    assert_allclose(got, whole, rtol=1e-6)
    assert_allclose([one.profile.scale_height for one in made.constituents],
                    [7.99575e3, 1.2e3], rtol=1e-4)  # fmt: skip
    assert any("single scattering" in note for note in export.notes)


def test_asymmetry_is_negative_forward_for_old_versions(solved, tmp_path):
    # Celestia's own Earth has MieAsymmetry -0.7 for aerosol that scatters forward.
    solution, _, text = written(solved, tmp_path, "earth-openspace")
    keys = read_atmosphere(text)
    made = planet_from_celestia(keys, solution.planet.star, 6377e3, 0.1, "again")
    assert_allclose(made.constituents[1].phase_moments([550.0], 1)[0, 1], 0.85, rtol=1e-4)
    assert keys["MieHGAnisotropy"] > 0.0
    assert keys["MieAsymmetry"] == -keys["MieHGAnisotropy"]


@pytest.mark.parametrize("g", [-0.4, 0.0, 0.3, 0.7, 0.9])
def test_schlick_integrates_to_one_with_the_mean_cosine_of_the_closed_form(g):
    moments = legendre_moments(lambda nu: vectorized(schlick)(nu, g), 1)
    assert_allclose(moments[0], 1.0, rtol=1e-9)
    assert_allclose(g_of_schlick(moments[1]), g, atol=1e-6)


def test_lobe_that_schlick_has_not_is_refused():
    with pytest.raises(ParameterError, match="mean cosine"):
        g_of_schlick(0.995)


def test_colour_of_particles_is_in_the_rayleigh_coefficients(solved, tmp_path):
    solution, export, text = written(solved, tmp_path, "earth")
    keys = read_atmosphere(text)
    column = keys["RayleighScaleHeight"] * -np.expm1(-keys["Height"] / keys["RayleighScaleHeight"])
    gas = solution.medium.vertical_optical_depth[0]
    assert (np.array(keys["Rayleigh"]) * column >= 0.999 * gas).all()
    assert any("grey" in one.form for one in export.fitted)


def test_broken_files_are_refused_in_one_line():
    star = load_planet("earth-bruneton").star
    with pytest.raises(ParameterError, match="Atmosphere is 'missing'"):
        read_atmosphere('"Earth" "Sol" { Radius 6378 } # Atmosphere { Height 1 }')
    with pytest.raises(ParameterError, match="Height is 'missing'"):
        planet_from_celestia({"Mie": 0.1}, star, 6e6, 0.1, "x")
    keys = read_atmosphere("Atmosphere { Height 60 Rayleigh 3 Absorption [ 0 0 0 ] }")
    with pytest.raises(ParameterError, match="three numbers"):
        planet_from_celestia(keys, star, 6e6, 0.1, "x")


def test_what_older_versions_lose_is_said(solved, tmp_path):
    # a column of exponential air is its density times its scale height: theirs is MieScaleHeight's
    planet = replace(load_planet("earth-openspace"), refraction="none")
    solution = solved(planet, (680.0, 550.0, 440.0), quality="preview")
    export = target_of("celestia").write(solution, tmp_path / "out")
    (note,) = [one for one in export.notes if "before August 2026" in one]
    assert f"{1.2 / 7.99575:.0%} of the planet's" in note
