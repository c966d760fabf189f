"""Declared list of parameters: complete, in range, and consistent with the reader."""

from __future__ import annotations

import math
from importlib import resources

import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.planets import load_planet, planet_names
from airlight.planets.reading.declared_keys import spelled_out
from airlight.planets.reading.nested_tables import Tables
from airlight.planets.reading.reader import nested_tables, planet_text
from airlight.render.gpu.picture.uniforms import FRAME
from airlight.render.pixels.view_uniforms import display_uniforms
from airlight.viewer.parameters.parameter import KINDS
from airlight.viewer.parameters.parameter_list import parameters_of, value_at
from airlight.viewer.parameters.view_parameters import (
    DEFAULTS,
    VIEW_VALUES,
    scene_of,
    settings_of,
    view_parameters,
)
from airlight.viewer.session.session import Session


def tables_of(name: str) -> Tables:
    text, file, folder = planet_text(name)
    return spelled_out(nested_tables(text, file), folder)


@pytest.mark.parametrize("planet", planet_names())
def test_every_number_and_word_of_a_planet_file_is_a_parameter(planet: str) -> None:
    # Completeness: the file's values are counted by an independent traversal without declarations.
    tables = tables_of(planet)
    paths = {one.path for one in parameters_of(tables)}

    def leaves(value: object, path: str) -> list[str]:
        if isinstance(value, dict):
            return [p for k, v in value.items() for p in leaves(v, f"{path}.{k}" if path else k)]
        if isinstance(value, list):
            return [p for i, v in enumerate(value) for p in leaves(v, f"{path}[{i}]")]
        return [path]

    assert set(leaves(tables, "")) <= paths


@pytest.mark.parametrize("planet", planet_names())
def test_parameters_hold_what_they_say(planet: str) -> None:
    # Each value and each slider is within the parameter's limits, and texts are not empty.
    tables = tables_of(planet)
    seen = set()
    for one in parameters_of(tables):
        value = value_at(tables, one)
        assert one.path not in seen, one.path
        seen.add(one.path)
        assert one.kind in KINDS
        assert one.label
        assert one.help.endswith(".")
        assert one.group
        assert one.mode in ("standard", "advanced")
        if one.kind == "number":
            assert isinstance(value, float)
            assert_allclose(one.checked(value), value, rtol=1e-12)
            assert one.least <= one.low < one.high <= one.most or one.low == one.high, one
            assert one.low <= value <= one.high or value == 0.0, one
            assert one.scale == "linear" or one.low > 0.0, one
            assert math.isfinite(one.low)
            assert math.isfinite(one.high)
        elif one.kind == "choice":
            assert value in one.options, one


def test_an_unknown_key_is_an_error_and_not_dropped() -> None:
    # The list is complete only if undeclared keys are reported.
    tables = tables_of("mars")
    tables["constituents"][0]["gas"]["colour"] = "1 nm"
    with pytest.raises(ParameterError, match=r"a key of constituents\[0\]\.gas is 'colour'"):
        parameters_of(tables)


def test_every_key_that_the_handbook_names_is_declared() -> None:
    # docs/planet-files.md lists the reader's keys in the first columns of its tables.
    import re
    import runpy
    from pathlib import Path

    root = Path(__file__).parents[2]
    handbook = root / "docs" / "planet-files.md"
    kinds = runpy.run_path(str(root / "builders" / "file_keys.py"))["PAGES"]["planet-files.md"]
    declared = {key.name for kind in kinds.values() for key in kind.declared()}
    # words of the first column that are not keys: kinds, tables of indices, gases
    other = {"dependent"}
    named: set[str] = set()
    for line in handbook.read_text(encoding="utf-8").splitlines():
        if line.startswith("| `") and not line.startswith('| `"'):
            first = line.split("|")[1]
            named |= {
                word.partition(" ")[0] for word in re.findall(r"`([a-z_]+(?: = [^`]*)?)`", first)
            }
    assert len(named) > 30
    assert named - declared - other == set()


def test_numbers_are_in_the_declared_unit_as_the_reader_has_them() -> None:
    # The planet that the reader makes is the second method.
    tables = tables_of("mars")
    planet = load_planet("mars")
    by_path = {one.path: one for one in parameters_of(tables)}

    def value(path: str) -> float:
        found = value_at(tables, by_path[path])
        assert isinstance(found, float)
        return found

    assert_allclose(1e3 * value("shell.bottom_radius"), planet.bottom_radius, rtol=1e-15)
    gas = planet.constituents[0].matter
    assert_allclose(100.0 * value("constituents[0].gas.pressure"), gas.pressure, rtol=1e-15)
    sizes = planet.constituents[1].matter.sizes  # type: ignore[union-attr]
    radius = value("constituents[1].particles.sizes.effective_radius")
    assert_allclose(1e-6 * radius, sizes.effective_radius, rtol=1e-15)


def test_what_a_file_leaves_out_is_shown_with_the_readers_value() -> None:
    # docs/planet-files.md: 1 au, 550 nm, no refraction, exact Mie, no absorption.
    tables = tables_of("titan") | {"star": {"spectrum": "astm-g173"}}
    values = {one.path: value_at(tables, one) for one in parameters_of(tables)}
    assert values["star.distance"] == 1.0
    assert values["refraction"] == "none"
    dust = tables_of("mars")
    del dust["constituents"][1]["particles"]["at"]
    values = {one.path: value_at(dust, one) for one in parameters_of(dust)}
    assert values["constituents[1].particles.at"] == 550.0
    assert values["constituents[1].particles.method"] == "mie"
    assert values["constituents[1].absorption"] == 0.0


def test_items_of_a_list_say_what_they_belong_to() -> None:
    # Labels have the wavelengths given beside the list, in any order.
    labels = {one.path: one.label for one in parameters_of(tables_of("earth-bruneton"))}
    assert labels["constituents[0].scattering[2]"] == "scattering at 440 nm"
    assert labels["star.irradiance[0]"] == "irradiance at 680 nm"


def test_constituents_that_share_a_name_with_a_group_have_one_of_their_own() -> None:
    # A constituent may be named "shell": its controls must not mix with those of the shell.
    tables = tables_of("earth-atmosphere-plus")
    tables["constituents"][0]["name"] = "shell"
    groups = [one.group for one in parameters_of(tables) if one.path.startswith("constituents[0]")]
    assert set(groups) == {"shell (1)"}


def test_view_parameters_have_a_default_each_and_make_a_scene() -> None:
    # The defaults have declared keys, are valid, and a scene accepts the ends of all ranges.
    known = {one.path: one for one in view_parameters()}
    assert set(known) == set(DEFAULTS)
    for path, value in DEFAULTS.items():
        assert known[path].checked(value) == value
    numbers = [one for one in known.values() if one.kind == "number" and one.group != "display"]
    for projection in known["view.projection"].options:
        for share in (0, 1):
            view = {**DEFAULTS, "view.projection": projection}
            view |= {one.path: one.checked((one.least, one.most)[share]) for one in numbers}
            scene = scene_of(view, 97, 31)
            assert scene.camera.width <= 97
            assert scene.camera.height <= 31


def test_json_of_a_parameter_is_json() -> None:
    # Infinity is not valid JSON, which the page must read.
    import json

    for one in (*view_parameters(("air",)), *parameters_of(tables_of("venus"))):
        text = json.dumps(one.as_json(), allow_nan=False)
        assert type(one)(**{**json.loads(text), "options": one.options}).label == one.label


def test_refused_values_name_the_field_and_the_range() -> None:
    # One line with path, value and range; a bool and a text are not numbers.
    (radius, *_) = [one for one in view_parameters() if one.path == "view.sun_zenith"]
    for wrong in (math.nan, math.inf, -1.0, 180.1, True, "60", None, [1.0]):
        with pytest.raises(ParameterError, match=r"view\.sun_zenith is .*; allowed: 0 to 180 deg"):
            radius.checked(wrong)


def test_presets_are_all_there() -> None:
    # The list is tested on the shipped presets.
    folder = resources.files("airlight.planets") / "presets"
    assert len(planet_names()) == sum(one.name.endswith(".toml") for one in folder.iterdir())


def test_a_value_of_the_view_that_names_a_uniform_is_a_number_of_the_shaders() -> None:
    # Declared once: the page sends the index of an option or the number itself under this name,
    # which must be what the display settings of the same view give.
    for one in VIEW_VALUES:
        if one.uniform:
            assert one.uniform in FRAME.layout()["numbers"]
            ends = (False, True) if one.kind == "switch" else (one.least, one.most)
            for value in one.options or ends:
                sent = float(one.options.index(str(value)) if one.options else value)
                settings = settings_of({**DEFAULTS, one.path: value})
                assert display_uniforms(0.0, settings)[one.uniform] == sent
    names = [one.uniform for one in VIEW_VALUES if one.uniform]
    assert len(set(names)) == len(names) > 0


def test_a_planet_without_a_date_has_all_display_settings() -> None:
    # a planet of one's own has no date of its sky: its page and its window need none
    from airlight.viewer.session.session import Session

    session = Session("exoplanet")
    assert "view.clock" not in session.values
    assert settings_of(session.values) == settings_of({**DEFAULTS, **session.values})


def test_clouds_are_added_changed_restored_and_removed_by_their_kind() -> None:
    # Keys that are left out are the defaults of the kind; undo and a link lead back.
    session = Session("earth-atmosphere-plus")
    clear = session.to_state()
    session.set("clouds[0].kind", "cumulus")
    assert session.value("clouds[0].effective_radius") == 6.0
    session.set("clouds[0].cover", 0.6)
    session.set("clouds[1].kind", "cirrus")
    assert "cumulus" not in session.parameter("clouds[2].kind").options
    again = Session("earth-atmosphere-plus")
    again.from_state(session.to_state())
    assert again.value("clouds[0].cover") == 0.6
    session.reset("clouds[0].cover")
    assert session.value("clouds[0].cover") == 0.25
    session.set("clouds[0].kind", "none")
    assert session.to_state()["set"] == {"clouds": [{"kind": "cirrus"}]}
    session.undo()
    assert session.value("clouds[0].kind") == "cumulus"
    session.reset("3-D clouds")
    assert session.to_state() == clear
