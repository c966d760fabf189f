"""Planets by formulas: what is kept, and how far the sky's colours are off."""

import dataclasses

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.engines.targets.fits.fit_errors import fit_errors
from airlight.engines.targets.fits.formula_planet import Formulas, formula_planet, name_of
from airlight.engines.targets.fits.lobe import CORNETTE_SHANKS, HENYEY_GREENSTEIN
from airlight.planets import load_planet, replace
from airlight.planets.medium import Medium

NM = (680.0, 550.0, 440.0)
FREE = Formulas(lobe=CORNETTE_SHANKS, absorber="tent")


def straight(name):
    return replace(load_planet(name), refraction="none")


def depths(medium):
    scattering, extinction = (
        (array * medium.columns[:, None]).sum(axis=0)
        for array in (medium.scattering, medium.extinction)
    )
    return scattering, extinction


@pytest.mark.parametrize("name", ["earth", "mars-openspace", "titan"])
def test_optical_depths_are_kept(name):
    medium = Medium.from_planet(straight(name), NM)
    fit = formula_planet(medium, name, FREE)
    assert [one.name for one in fit.planet.constituents][:2] == ["molecules", "particles"]
    made = Medium.from_planet(fit.planet, NM)
    assert_allclose(depths(made), depths(medium), rtol=1e-10)


def test_planet_of_these_formulas_is_itself():
    planet = load_planet("earth-bruneton")  # exponentials, Cornette-Shanks, a tent of ozone
    medium = Medium.from_planet(planet, NM)
    fit = formula_planet(medium, "again", FREE).planet
    air, aerosol, ozone = fit.constituents
    assert_allclose(air.profile.scale_height, 8e3, rtol=1e-4)
    assert_allclose(aerosol.profile.scale_height, 1.2e3, rtol=1e-4)
    assert_allclose(aerosol.phase_function.asymmetry, 0.8, rtol=1e-6)
    assert_allclose([ozone.profile.center, ozone.profile.half_width], [25e3, 15e3], rtol=1e-3)
    assert_allclose(air.scattering.values, medium.scattering[0], rtol=1e-4)


def test_colours_of_a_fit_without_error_are_the_planets(solved):
    solution = solved(load_planet("earth-bruneton"), NM, quality="preview")
    fit = formula_planet(solution.medium, "again", FREE)
    rows = {row.name: row for row in fit_errors(solution, fit.planet)}
    assert max(row.largest for row in rows.values()) < 0.05  # ΔE, a twentieth of the noticeable
    assert rows["transmittance at 88 deg"].largest < 1e-5


def test_ozone_left_out_is_seen_at_sunset(solved):
    # The Chappuis band absorbs green: without it the twilight is off by many ΔE, the noon by one.
    solution = solved(load_planet("earth-bruneton"), NM, quality="preview")
    bare = formula_planet(solution.medium, "x", dataclasses.replace(FREE, absorber="none"))
    assert any("absorption by gases" in note for note in bare.notes)
    rows = {row.name: row.median for row in fit_errors(solution, bare.planet)}
    assert rows["colour of the sky, sun at 88 deg"] > 10.0
    assert 0.5 < rows["colour of the sky, sun at 30 deg"] < 3.0


def test_one_albedo_keeps_what_is_scattered():
    medium = Medium.from_planet(straight("mars-openspace"), NM)
    fit = formula_planet(medium, "x", dataclasses.replace(FREE, one_albedo=True))
    made = Medium.from_planet(fit.planet, NM)
    assert_allclose(depths(made)[0], depths(medium)[0], rtol=1e-10)
    albedo = made.single_scattering_albedo[1]
    assert_allclose(albedo, albedo[0], rtol=1e-12)
    said = next(one for one in fit.fitted if "colour" in one.name)
    ratio = depths(made)[1] / depths(medium)[1] - 1.0
    # Molecules are a hundredth of the whole.
    assert_allclose(max(said.errors.values()), np.abs(ratio).max(), rtol=0.05)


def test_grey_particles_leave_their_colour_to_the_molecules():
    medium = Medium.from_planet(straight("earth"), NM)
    formulas = Formulas(lobe=HENYEY_GREENSTEIN, absorber="with particles", grey=True)
    fit = formula_planet(medium, "x", formulas)
    made = Medium.from_planet(fit.planet, NM)
    assert_allclose(made.scattering[1], made.scattering[1, 0], rtol=1e-12)
    assert_allclose(depths(made), depths(medium), rtol=1e-10)


def test_molecules_alone_are_one_constituent():
    medium = Medium.from_planet(straight("mars-rayleigh"), NM)
    fit = formula_planet(medium, "x", FREE)
    assert [one.name for one in fit.planet.constituents] == ["molecules"]


def test_what_no_formula_holds_is_said():
    medium = Medium.from_planet(straight("earth"), NM)
    notes = " ".join(formula_planet(medium, "x", FREE).notes)
    assert "map of the ground" in notes
    assert "lights of towns" in notes
    assert "glint" in notes


@pytest.mark.parametrize(
    ("name", "expected"),
    [("Earth (Bruneton 2017)", "EarthBruneton2017"), ("67 P", "Planet67P"), ("火星", "Planet")],
)
def test_names_are_identifiers(name, expected):
    assert name_of(replace(load_planet("earth-bruneton"), name=name)) == expected
