"""Amounts of the constituents, turbidity, albedo: the first controls of window and page."""

from __future__ import annotations

import math

import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.planets import load_planet, planet_names
from airlight.planets.medium import Medium
from airlight.planets.reading.reader import read_tables
from airlight.viewer.parameters.amounts import AMOUNTS, Amount
from airlight.viewer.session.saved_state import from_fragment, to_fragment
from airlight.viewer.session.session import Session


def depths(session: Session) -> dict[str, float]:
    """Vertical optical depth of each constituent at 550 nm, by the medium that is solved."""
    planet = read_tables(session.planet.tables, "test")
    medium = Medium.from_planet(planet, (550.0,))
    return dict(zip(medium.names, medium.vertical_optical_depth[:, 0].tolist(), strict=False))


@pytest.mark.parametrize("planet", planet_names())
def test_every_preset_has_an_amount_of_each_constituent_on_top(planet: str) -> None:
    # One for each constituent of the file, by its name; all others follow.
    session = Session(planet)
    shown = [one for one in session.parameters if one.group == AMOUNTS]
    assert list(session.parameters[: len(shown)]) == shown
    names = [str(one["name"]) for one in session.planet.tables["constituents"]]
    labels = [one.label for one in shown]
    assert [one.removesuffix(" optical depth") for one in labels][: len(names)] == names
    assert {one.label for one in shown[len(names) :]} <= {"turbidity", "ground albedo"}
    for one in shown:
        value = session.value(one.path)
        assert isinstance(value, float)
        assert one.mode == "standard"
        assert one.least <= one.low < one.high <= one.most
        assert one.low <= value <= one.high, one
        assert one.checked(value) == pytest.approx(value)


@pytest.mark.parametrize("planet", ["earth", "earth-bruneton", "earth-volcanic", "mars-standard"])
def test_an_optical_depth_is_that_of_the_medium_that_is_solved(planet: str) -> None:
    # The medium is a second way from the tables to the depth.
    session = Session(planet)
    amounts = [one for one in session.parameters if isinstance(one, Amount)]
    haze = [one for one in amounts if one.matter == "haze" and one.unit == "1"]
    assert haze
    for one in haze:
        assert_allclose(
            depths(session)[one.label.removesuffix(" optical depth")],
            session.value(one.path),
            rtol=1e-9,
        )
        session.set(one.path, 0.31)
        assert session.value(one.path) == pytest.approx(0.31, rel=1e-8)
        assert_allclose(depths(session)[one.label.removesuffix(" optical depth")], 0.31, rtol=1e-8)


def test_ozone_is_in_dobson_units() -> None:
    # The file says 345 DU; coefficients of the same planet's model have about 300 DU.
    session = Session("earth")
    assert session.value("air.amounts[2]") == 345.0
    before = depths(session)["ozone"]
    session.set("air.amounts[2]", 690.0)
    assert_allclose(depths(session)["ozone"], 2.0 * before, rtol=1e-12)
    given = Session("earth-bruneton").value("air.amounts[2]")
    assert isinstance(given, float)
    assert 250.0 < given < 350.0


def test_turbidity_is_the_depth_of_all_over_that_of_the_gas() -> None:
    # Preetham et al. 1999: T = (t_m + t_h) / t_m; the medium gives both depths.
    session = Session("earth-volcanic")
    haze = ("aerosol", "sulphuric acid")

    def by_medium() -> float:
        found = depths(session)
        return 1.0 + sum(found[name] for name in haze) / found["air"]

    assert_allclose(session.value("air.turbidity"), by_medium(), rtol=1e-9)
    ratio = depths(session)["aerosol"] / depths(session)["sulphuric acid"]
    session.set("air.turbidity", 5.0)
    assert_allclose(by_medium(), 5.0, rtol=1e-7)
    found = depths(session)
    assert_allclose(found["aerosol"] / found["sulphuric acid"], ratio, rtol=1e-7)
    session.set("air.turbidity", 1.0)
    assert_allclose(by_medium(), 1.0, rtol=1e-12)
    session.set("air.turbidity", 3.0)  # all haze was gone: it comes back as in the file
    found = depths(session)
    assert_allclose(by_medium(), 3.0, rtol=1e-7)
    assert_allclose(found["aerosol"] / found["sulphuric acid"], ratio, rtol=1e-7)
    session.set("air.amounts[0]", 2.0)  # twice the gas: half of T - 1
    assert_allclose(session.value("air.turbidity"), 2.0, rtol=1e-7)


def test_brightness_of_the_ground_is_its_albedo() -> None:
    session = Session("mars")
    session.set("air.ground", 0.34)
    ground = load_planet("mars", {"ground.brightness": session.value("ground.brightness")}).ground
    assert_allclose(ground.albedos([550.0]), 0.34, rtol=1e-8)


def test_amounts_are_edits_like_any_other() -> None:
    # Undo, reset, comparison, saved state and planet file know them; a drag is one step.
    session = Session("earth")
    plain = session.planet.tables
    session.begin_drag("air.amounts[1]")
    for value in (0.1, 0.2, 0.4):
        session.set("air.amounts[1]", value)
    session.end_drag()
    assert session.value("air.amounts[1]") == pytest.approx(0.4)
    session.undo()
    assert session.planet.tables == plain
    session.redo()
    session.set("air.turbidity", 4.0)
    session.set("air.ground", 0.5)
    session.set("air.amounts[0]", 0.5)
    other = Session("earth")
    other.from_state(from_fragment(to_fragment(session.to_state())))
    for one in session.parameters:
        assert other.value(one.path) == session.value(one.path), one.path
    other.store_b()
    other.set("air.amounts[1]", 1.0)
    assert [one.label for one in other.differences()] == ["aerosol: amount"]
    session.reset("air.turbidity")
    assert session.value("air.amounts[1]") == pytest.approx(0.064)
    session.reset(AMOUNTS)
    assert session.planet.tables == plain


def test_amounts_follow_the_numbers_that_they_stand_for() -> None:
    # The file's own number changes too: the amount is of what is there, not of what was.
    session = Session("mars")
    session.set("dust.particles.optical_depth", 2.0)
    assert session.value("air.amounts[1]") == pytest.approx(2.0)
    session.set("air.amounts[1]", 1.0)
    assert session.value("dust.amount") == pytest.approx(0.5)
    with pytest.raises(ParameterError, match=r"air\.amounts\[1\] is nan"):
        session.set("air.amounts[1]", math.nan)


def test_an_invalid_edit_in_between_leaves_a_list() -> None:
    # The solver's thread reports what is wrong; the controls stay.
    session = Session("earth")
    before = [one.path for one in session.parameters]
    session.set("aerosol.wavelengths[1]", 400.0)  # no longer ascending
    assert [one.path for one in session.parameters] == before
    assert session.values["air.amounts[1]"] > 0.0
