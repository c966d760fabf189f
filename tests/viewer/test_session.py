"""Editing, undo, comparing, saving."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import FileError, ParameterError
from airlight.planets import load_planet, planet_names
from airlight.planets.matter.phases import PHASES
from airlight.planets.matter.profiles import PROFILES
from airlight.planets.medium import Medium
from airlight.viewer.session.saved_state import from_fragment, to_fragment
from airlight.viewer.session.session import Session

PLANET = "earth-atmosphere-plus"


class Clock:
    """Clock that is advanced by hand."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def session(clock: Clock) -> Session:
    return Session(PLANET, clock=clock)


def snapshot(session: Session) -> tuple[Any, ...]:
    return session.planet.tables, session.planet.off, dict(session.view)


def test_a_refused_edit_leaves_everything_as_it_was(session: Session) -> None:
    # Out of range, of another kind, or an unknown parameter: one line, and no change.
    before, versions = snapshot(session), session.versions
    for path, value in (
        ("ground.albedo", 1.5),
        ("ground.albedo", math.nan),
        ("shell.top_radius", True),
        ("air.profile.kind", "cube"),
        ("light.constituents[0]", 1),
        ("ground.albdo", 0.5),
        ("constituents[7].scattering", 0.5),
        ("view.altitude", -1.0),
        ("", 1.0),
    ):
        with pytest.raises(ParameterError) as refused:
            session.set(path, value)
        assert "\n" not in str(refused.value)
    assert snapshot(session) == before
    assert session.versions == versions
    assert not session.can_undo


def test_a_misspelt_path_gets_the_nearest(session: Session) -> None:
    # Like the reader's suggestions for keys.
    with pytest.raises(ParameterError, match=r"did you mean 'ground\.albedo'"):
        session.set("ground.albeda", 0.5)


def test_edits_are_undone_and_done_again_one_by_one(session: Session, clock: Clock) -> None:
    # Undo goes back through every state, redo forward through the same ones.
    states = [snapshot(session)]
    for path, value in (
        ("ground.albedo", 0.5),
        ("air.scattering[0]", 0.01),
        ("view.sun_zenith", 80.0),
        ("light.constituents[1]", False),
        ("aerosol.phase_function.kind", "henyey-greenstein"),
        ("display.tone_map", "agx"),
    ):
        session.set(path, value)
        clock.now += 10.0
        states.append(snapshot(session))
    for state in reversed(states[:-1]):
        assert session.undo() is not None
        assert snapshot(session) == state
    assert session.undo() is None
    for state in states[1:]:
        assert session.redo() is not None
        assert snapshot(session) == state
    assert session.redo() is None


def test_a_drag_is_one_step_however_long_it_takes(session: Session, clock: Clock) -> None:
    # begin_drag … end_drag; another drag of the same parameter is another step.
    start = snapshot(session)
    for first in (0.2, 0.6):
        session.begin_drag("ground.albedo")
        for k in range(10):
            clock.now += 5.0
            session.set("ground.albedo", first + 0.01 * k)
        session.end_drag()
    session.undo()
    assert_allclose(session.value("ground.albedo"), 0.29)
    session.undo()
    assert snapshot(session) == start


def test_a_drag_that_changes_nothing_is_no_step(session: Session) -> None:
    # There is nothing to undo, and the undone steps are kept.
    session.set("ground.albedo", 0.5)
    session.undo()
    session.begin_drag("ground.albedo")
    session.end_drag()
    assert session.can_redo
    assert not session.can_undo


def test_quick_edits_of_one_parameter_are_one_step_and_slow_ones_are_not(
    session: Session, clock: Clock
) -> None:
    # Edits half a second apart or less are merged.
    for albedo, wait in ((0.2, 0.3), (0.3, 0.3), (0.4, 2.0), (0.5, 2.0)):
        session.set("ground.albedo", albedo)
        clock.now += wait
    session.undo()
    assert session.value("ground.albedo") == 0.4
    session.undo()
    assert session.value("ground.albedo") == 0.1


def test_an_edit_after_undo_forgets_what_was_undone(session: Session) -> None:
    # A new edit discards the undone steps.
    session.set("ground.albedo", 0.5)
    session.undo()
    session.set("ground.albedo", 0.7)
    assert not session.can_redo
    assert session.redo() is None


def test_undo_of_the_planet_leaves_the_camera(session: Session) -> None:
    # Undo of an edit must not move a camera that has flown on.
    session.set("ground.albedo", 0.5)
    session.move({"view.altitude": 1e6})
    session.undo()
    assert session.value("view.altitude") == 1e6
    assert session.value("ground.albedo") == 0.1


def test_mole_fractions_make_room_for_each_other_and_come_back_on_a_drag() -> None:
    # The sum is kept, and the ratio of the others, even if the drag has passed 1.
    session = Session("earth")
    path = "air.gas.composition.N2"
    session.begin_drag(path)
    for share in (0.9, 1.0, 0.3):
        session.set(path, share)
    gases = session.planet.tables["constituents"][0]["gas"]["composition"]
    assert_allclose(sum(gases.values()), 0.78084 + 0.209476 + 0.00934 + 0.000314, rtol=1e-8)
    assert_allclose(gases["O2"] / gases["Ar"], 0.209476 / 0.00934, rtol=1e-7)
    assert gases["N2"] == 0.3


def test_a_tabulated_phase_function_keeps_its_integral(session: Session, tmp_path: Path) -> None:
    # The reader rejects a norm that is off by more than 0.001; the result of a drag does not depend
    # on its path.
    session.set("aerosol.phase_function.kind", "tabulated")
    path = "aerosol.phase_function.values[0]"
    session.begin_drag(path)
    for value in (1.0, 30.0, 0.5):
        session.set(path, value)
        session.save_planet(tmp_path / "table.toml")
        load_planet(tmp_path / "table.toml")
    session.end_drag()
    ratio = session.value(path) / session.value("aerosol.phase_function.values[1]")
    assert_allclose(ratio, 0.5 * 4.0 * math.pi, rtol=1e-7)


def test_the_air_moves_with_the_ground(session: Session) -> None:
    # The thickness of the shell stays 100 km.
    session.set("shell.bottom_radius", 3000.0)
    assert session.value("shell.top_radius") == 3100.0


@pytest.mark.parametrize(
    ("path", "kinds"),
    [
        ("aerosol.profile.kind", PROFILES.keywords),
        ("aerosol.phase_function.kind", PHASES.keywords),
    ],
)
def test_every_form_that_can_be_chosen_makes_a_planet(
    path: str, kinds: tuple[str, ...], session: Session, tmp_path: Path
) -> None:
    # The reader accepts the saved file; its profile or phase function is of that kind.
    for kind in kinds:
        session.set(path, kind)
        session.save_planet(tmp_path / "form.toml")
        planet = load_planet(tmp_path / "form.toml")
        assert planet.constituents[1] != load_planet(PLANET).constituents[1] or kind in (
            "exponential",
            "cornette-shanks",
        )
        assert session.value(path) == kind


def test_a_star_becomes_a_black_body_and_the_sun_again(session: Session, tmp_path: Path) -> None:
    # The nominal sun as a black body gives the solar constant within 1 %: 1361 W/m2.
    start = session.planet.tables["star"]
    session.set("star.spectrum", "black body")
    session.save_planet(tmp_path / "star.toml")
    nm = np.arange(200.0, 20000.0, 10.0)
    total = 10.0 * load_planet(tmp_path / "star.toml").star.irradiances(nm).sum()
    assert_allclose(total, 1361.0, rtol=0.01)
    session.set("star.temperature", 3000.0)
    assert session.value("star.spectrum") == "black body"
    session.set("star.spectrum", "astm-g173")
    assert "star.temperature" not in session.values
    session.reset("star.spectrum")
    assert session.planet.tables["star"] == start


def test_versions_tell_what_to_redo(session: Session) -> None:
    # Planet: solve. View: render. Display: expose. No other counter increases.
    for path, value, part in (
        ("ground.albedo", 0.5, "planet"),
        ("light.quality", "preview", "planet"),
        ("light.wavelengths", "three", "planet"),
        ("light.constituents[0]", False, "planet"),
        ("light.orders", "single", "view"),
        ("view.heading", 10.0, "view"),
        ("display.exposure", 3.0, "display"),
    ):
        before = session.versions
        reported: list[Any] = []
        stop = session.subscribe(reported.append)
        session.set(path, value)
        stop()
        session.set(path, value)  # no change
        assert session.versions == before._replace(**{part: getattr(before, part) + 1})
        assert reported == [session.versions]


def test_reset_of_a_parameter_of_a_group_and_of_all(session: Session) -> None:
    # Original values are restored; each reset is an undo step.
    start = snapshot(session)
    session.set("air.scattering[1]", 0.5)
    session.set("aerosol.phase_function.kind", "rayleigh")
    session.set("aerosol.scattering", 0.5)
    session.set("shell.bottom_radius", 3000.0)
    session.set("view.altitude", 1e6)
    session.set("light.constituents[2]", False)
    session.reset("air.scattering[1]")
    assert session.value("air.scattering[1]") == 0.013558
    session.reset("aerosol.phase_function.kind")
    assert session.value("aerosol.phase_function.asymmetry") == 0.8
    session.undo()
    assert session.value("aerosol.phase_function.kind") == "rayleigh"
    session.reset("aerosol")
    assert session.planet.tables["constituents"][1] == start[0]["constituents"][1]
    assert session.value("shell.bottom_radius") == 3000.0
    session.reset("shell.bottom_radius")
    assert session.planet.tables["shell"] == start[0]["shell"]
    assert session.value("view.altitude") == 1e6
    session.reset()
    assert snapshot(session) == start
    session.undo()
    session.undo()
    assert session.value("light.constituents[2]") is False
    with pytest.raises(ParameterError):
        session.reset("nothing")


def test_two_sides_are_edited_apart_and_share_the_camera(session: Session) -> None:
    # The stored side is a copy; a swap keeps the camera.
    session.store_b()
    session.set("ground.albedo", 0.5)
    session.move({"view.altitude": 5e5})
    assert [(d.path, d.first, d.second) for d in session.differences()] == [
        ("ground.albedo", 0.5, 0.1)
    ]
    session.swap()
    assert session.showing == "B"
    assert session.value("ground.albedo") == 0.1
    assert session.value("view.altitude") == 5e5
    assert not session.can_undo
    session.open("mars")
    session.swap()
    assert session.showing == "A"
    assert session.planet_name == "Earth (Atmosphere Plus)"
    assert session.can_undo
    paths = {one.path for one in session.differences()}
    assert "shell.bottom_radius" in paths
    session.forget_other()
    assert session.differences() == ()


def test_switches_and_names_count_as_differences(session: Session) -> None:
    # A constituent that is off, and a constituent that the other side lacks.
    session.swap()
    session.set("light.constituents[1]", False)
    labels = {one.label: (one.first, one.second) for one in session.differences()}
    assert labels == {"aerosol: on": (True, False)}


@pytest.mark.parametrize("planet", planet_names())
def test_a_saved_planet_is_the_planet(planet: str, tmp_path: Path) -> None:
    # Saving is the reader's inverse; two loads of the same preset are equal too.
    session = Session(planet)
    session.save_planet(tmp_path / "saved.toml")
    assert load_planet(tmp_path / "saved.toml") == load_planet(planet)


def test_an_edited_planet_is_saved_with_its_edits(session: Session, tmp_path: Path) -> None:
    # The same edits as overrides of the reader are the second way.
    session.set("air.scattering[2]", 0.02)
    session.set("star.distance", 2.0)
    session.set("name", 'Quoted "name" \\ with ü')
    session.save_planet(tmp_path / "saved.toml")
    overrides = {
        "air.scattering[2]": "2e-5 /m",
        "star.distance": "2 au",
        "name": 'Quoted "name" \\ with ü',
    }
    assert load_planet(tmp_path / "saved.toml") == load_planet(PLANET, overrides)


def test_a_file_that_cannot_be_written_is_not_half_there(session: Session, tmp_path: Path) -> None:
    # The folder does not exist: one line, nothing written.
    with pytest.raises(FileError):
        session.save_planet(tmp_path / "no folder" / "saved.toml")
    assert list(tmp_path.iterdir()) == []


def test_files_named_beside_a_planet_file_are_found_wherever_it_is_saved(tmp_path: Path) -> None:
    # The reader resolves names relative to the file; a file saved elsewhere has absolute paths.
    (tmp_path / "one").mkdir()
    (tmp_path / "two").mkdir()
    table = "# quantity: cross-section\n# unit: cm^2\n# source: made up\nwavelength_nm,value\n"
    (tmp_path / "one" / "gas.csv").write_text(table + "300,1e-21\n900,2e-21\n", encoding="utf-8")
    text = Session(PLANET).planet.text
    gas = 'absorption = { cross_section = "gas.csv", column = "10 DU" }'
    lines = [gas if line.startswith("absorption = [") else line for line in text.splitlines()]
    (tmp_path / "one" / "planet.toml").write_text("\n".join(lines), encoding="utf-8")
    session = Session(tmp_path / "one" / "planet.toml")
    session.save_planet(tmp_path / "two" / "planet.toml")
    saved = load_planet(tmp_path / "two" / "planet.toml")
    assert saved == load_planet(tmp_path / "one" / "planet.toml")


def test_a_state_comes_back_from_the_address_of_a_page(session: Session) -> None:
    # JSON, as a fragment, read by another session; only differences are in it.
    assert session.to_state() == {"planet": PLANET}
    session.set("aerosol.scattering", 0.02)
    session.set("aerosol.phase_function.kind", "rayleigh")
    session.set("light.constituents[0]", False)
    session.set("view.altitude", 123456.0)
    fragment = to_fragment(session.to_state())
    assert len(fragment) < 400
    other = Session("mars")
    other.from_state(from_fragment("#" + fragment))
    assert snapshot(other) == snapshot(session)
    json.dumps(session.to_state(), allow_nan=False)


@pytest.mark.parametrize(
    "state",
    [
        {},
        {"planet": "no such planet"},
        {"planet": PLANET, "more": 1},
        {"planet": PLANET, "set": {"ground.albedo": 7.0}},
        {"planet": PLANET, "set": {"ground.colour": 1.0}},
        {"planet": PLANET, "set": {"ground": 1.0}},
        {"planet": PLANET, "set": {"constituents": []}},
        {"planet": PLANET, "set": {"constituents": {"a": 1}}},
        {"planet": PLANET, "set": {"shell.top_radius": [1, 2]}},
        {"planet": PLANET, "set": 3},
        {"planet": PLANET, "off": [9]},
        {"planet": PLANET, "off": {"0": 1}},
        {"planet": PLANET, "view": {"view.altitude": "x"}},
        {"planet": PLANET, "view": {"view.alt": 1.0}},
        {"planet": PLANET, "view": 1},
        {"planet": PLANET, "air": {"air.amounts[9]": 2}},
        {"planet": PLANET, "air": {"air.amounts[0]": -2}},
        {"planet": PLANET, "air": {"ground": 2}},
        {"planet": PLANET, "air": [2]},
    ],
)
def test_a_state_that_cannot_be_is_one_line_and_changes_nothing(
    state: dict[str, Any], session: Session
) -> None:
    # URLs are untrusted input.
    before = snapshot(session)
    with pytest.raises(ParameterError) as refused:
        session.from_state(state)
    assert "\n" not in str(refused.value)
    assert snapshot(session) == before


def test_a_page_with_edits_is_shown_with_the_same_edits(session: Session) -> None:
    # The page's factors are keys of the file: the medium equals the one with its arrays multiplied.
    edit = {"air.amounts[0]": 0.5, "air.amounts[2]": 3, "air.ground": 2.5}
    session.from_state({"planet": PLANET, "air": edit, "view": {"view.altitude": 5.0}})
    assert session.value("view.altitude") == 5.0
    assert session.value("ground.brightness") == 2.5
    nm = [440.0, 550.0, 680.0]
    plain, edited = (
        Medium.from_planet(load_planet(PLANET, changes), nm)
        for changes in ({}, session.to_state()["set"])
    )
    factors = np.array([0.5, 1.0, 3.0])[:, None]
    assert_allclose(edited.scattering, factors * plain.scattering, rtol=1e-15)
    assert_allclose(edited.absorption, factors * plain.absorption, rtol=1e-15)
    assert_allclose(edited.ground_albedo, 2.5 * plain.ground_albedo, rtol=1e-15)
    assert_allclose(edited.map_basis, 2.5 * plain.map_basis, rtol=1e-15)
    session.undo()
    assert session.to_state() == {"planet": PLANET}


def test_gases_bend_light_whatever_their_amount() -> None:
    # Earth's air by its composition: a larger amount scatters more, along the same paths.
    plain, edited = (
        Medium.from_planet(load_planet("earth", changes), [550.0])
        for changes in ({}, {"air.amount": 3.0})
    )
    assert_allclose(edited.scattering[0], 3.0 * plain.scattering[0], rtol=1e-15)
    assert_allclose(edited.refractivity, plain.refractivity, rtol=0.0)


@pytest.mark.parametrize("fragment", ["", "#", "%7B", "[1]", '{"planet":1e999}'])
def test_a_fragment_that_is_none_is_refused(fragment: str, session: Session) -> None:
    # The same, when the fragment is decoded.
    with pytest.raises(ParameterError):
        session.from_state(from_fragment(fragment))


@pytest.mark.parametrize("name", ["earth", "exoplanet"])
def test_a_gas_frozen_to_coefficients_scatters_the_same(name: str, tmp_path: Path) -> None:
    # Fixed and computed coefficients agree at the nodes, and within 0.1 % between: the factor of
    # λ⁻⁴ has little curvature.
    # Air of preset earth is in layers, and bends light.
    session = Session(name)
    session.freeze_coefficients("air")
    assert "air" not in session.advanced
    if name == "exoplanet":  # RT/(Mg) with 28.020 g/mol
        assert session.value("air.profile.scale_height") == pytest.approx(9.250, abs=1e-3)
    assert session.planet.tables.get("refraction", "none") == "none"
    session.save_planet(tmp_path / "frozen.toml")
    frozen, whole = (
        Medium.from_planet(load_planet(planet), [440.0, 500.0, 550.0, 620.0, 680.0])
        for planet in (tmp_path / "frozen.toml", name)
    )
    assert_allclose(frozen.scattering[0, [0, 2, 4]], whole.scattering[0, [0, 2, 4]], rtol=1e-6)
    assert_allclose(frozen.scattering[0], whole.scattering[0], rtol=2e-3)
    assert_allclose(frozen.columns[0], whole.columns[0], rtol=1e-6)
    session.undo()
    assert "air" in session.advanced


def test_particles_frozen_to_coefficients_keep_extinction_albedo_and_mean_cosine(
    tmp_path: Path,
) -> None:
    # At the wavelengths of the lists they equal the medium's.
    session = Session("mars")
    session.freeze_coefficients("dust")
    session.save_planet(tmp_path / "frozen.toml")
    nm = [440.0, 550.0, 680.0]
    frozen, whole = (
        Medium.from_planet(load_planet(planet), nm) for planet in (tmp_path / "frozen.toml", "mars")
    )
    assert_allclose(frozen.extinction[1], whole.extinction[1], rtol=1e-6)
    albedos = (frozen.single_scattering_albedo[1], whole.single_scattering_albedo[1])
    assert_allclose(*albedos, rtol=1e-6)
    cosines = (one.phase_moments(1)[1, :, 1] for one in (frozen, whole))
    assert_allclose(*cosines, atol=2e-4)
    with pytest.raises(ParameterError, match="a constituent with a composition"):
        session.freeze_coefficients("dust")
