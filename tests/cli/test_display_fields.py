"""Display settings have one name, default and range in commands, films and the viewer."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path
from typing import Any

import pytest
import typer

from airlight.cli.app import app, with_words
from airlight.cli.display_options import DisplayOptions, ToneOptions
from airlight.cli.option_groups import option_name
from airlight.errors import ParameterError
from airlight.image.display_settings import DisplaySettings
from airlight.scene.display_fields import DISPLAY_FIELDS
from airlight.studies.film import load_film
from airlight.viewer.parameters.view_parameters import DEFAULTS, VIEW_VALUE, settings_of

PLAIN = vars(DisplaySettings())


@pytest.mark.parametrize("name", DISPLAY_FIELDS)
def test_a_setting_has_the_default_and_the_range_that_are_declared(name: str) -> None:
    # names, limits and choices are those of ``DisplaySettings``, which checks each value
    declared, shown = DISPLAY_FIELDS[name], VIEW_VALUE[f"display.{name}"]
    assert shown.default == declared.initial
    assert PLAIN[name] in (declared.initial, None)
    if declared.kind == "choice":
        assert shown.options == declared.choices()
        allowed: Any = declared.choices()
    else:
        allowed = declared.range if declared.kind == "number" else (False, True)
    for value in allowed:
        assert vars(DisplaySettings(**{name: value}))[name] == value
        assert load_film("mars", {f"display.{name}": value}).display[name] == value
    if declared.kind == "number":
        assert (shown.least, shown.most) == declared.range
        for beyond in (allowed[0] - 1.0, allowed[1] + 1.0):
            with pytest.raises(ParameterError, match=name):
                DisplaySettings(**{name: beyond})


def test_options_that_are_left_out_and_a_new_view_are_the_defaults() -> None:
    assert vars(ToneOptions().settings()) == vars(DisplayOptions().settings()) == PLAIN
    assert settings_of(DEFAULTS) == DisplaySettings(eye=True)
    assert ToneOptions().given_settings() == {}


@pytest.mark.parametrize("command", ["render", "view", "sky", "compose", "animate"])
def test_a_command_says_of_a_setting_what_is_declared(command: str) -> None:
    root: Any = typer.main.get_command(app)
    options = {one.opts[0]: one.help for one in root.get_command(None, command).params}
    named = {one.name for one in fields(ToneOptions)} & set(DISPLAY_FIELDS)
    assert len(named) == 4
    for name in named:
        declared = DISPLAY_FIELDS[name]
        words = with_words(options[option_name(name)])
        assert words.startswith(declared.help.rstrip("."))
        assert all(choice in words for choice in declared.choices())
        shown = declared.initial
        assert f"({shown:g})" in words if isinstance(shown, float) else f"({shown})" in words


def test_a_film_refuses_what_is_no_setting(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="display is 'bits'; allowed: eye, tone_map, style"):
        load_film("mars", {"display.bits": 16})
