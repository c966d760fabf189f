"""Search of the controls by what people say, in window and page alike."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest
from numpy.testing import assert_allclose

from airlight.viewer.parameters.number_text import quantity_text
from airlight.viewer.session.session import Session

#: What people type, and the parameter that they look for; the first of those found, or among them.
WORDS = {
    "rayleigh": "air.amounts[0]",
    "molecules": "air.amounts[0]",
    "pressure": "air.amounts[0]",
    "haze": "air.amounts[1]",
    "smog": "air.amounts[1]",
    "fog": "air.amounts[1]",
    "pollution": "air.amounts[1]",
    "dust": "air.amounts[1]",
    "aerosol": "air.amounts[1]",
    "visibility": "air.turbidity",
    "turbidity": "air.turbidity",
    "linke": "air.turbidity",
    "ozone": "air.amounts[2]",
    "dobson": "air.amounts[2]",
    "albedo": "air.ground",
    "ground brightness": "air.ground",
    "snow": "air.ground",
    "sun height": "view.sun_zenith",
    "sunset": "view.sun_zenith",
    "time": "view.sun_zenith",
    "time of day": "view.sun_azimuth",
    "zoom": "view.field_of_view",
    "fov": "view.field_of_view",
    "Field of View": "view.field_of_view",
    "height": "view.altitude",
    "orbit": "view.altitude",
    "position": "view.latitude",
    "pitch": "view.look_zenith",
    "direction": "view.heading",
    "fisheye": "view.projection",
    "exposure": "display.exposure",
    "brightness": "display.exposure",
    "darker": "display.exposure",
    "auto": "display.automatic",
    "colour": "display.tone_map",
    "color": "display.tone_map",
    "contrast": "display.tone_map",
    "spectrum": "light.wavelengths",
    "single scattering": "light.orders",
    "accuracy": "light.quality",
    "red dwarf": "star.spectrum",
    "moon": "view.second_light",
    "moonlight": "view.second_light",
    "second sun": "view.second_light",
    "binary": "view.second_light",
    "full moon": "view.moon_phase",
}


@pytest.fixture(scope="module")
def session() -> Session:
    return Session("earth")


@pytest.mark.parametrize("words", WORDS)
def test_what_people_say_finds_the_parameter(words: str, session: Session) -> None:
    # The expectation is a person's; the search must not drown it in others either.
    found = [one.path for one in session.parameters if one.answers(words)]
    assert WORDS[words] in found
    assert found.index(WORDS[words]) < 12, found


def test_nothing_is_found_by_nonsense(session: Session) -> None:
    assert not [one.path for one in session.parameters if one.answers("sauerkraut")]


def test_every_control_of_view_and_air_has_other_words(session: Session) -> None:
    # Declared with the parameter, so that no host needs a list of its own.
    for one in session.parameters:
        if one.path.startswith(("view.", "display.", "air.")):
            assert one.synonyms, one.path
            assert all(word == word.lower() for word in one.synonyms)
            json.dumps(one.as_json(), allow_nan=False)


def test_a_page_finds_what_the_window_finds(session: Session, modules: Callable[..., Any]) -> None:
    # The declared function is the second method.
    page = modules({"ui/search": ("answers",)})
    parameters = [one.as_json() for one in session.parameters]
    found = page.evaluate(
        """([parameters, searches]) => searches.map((words) =>
          parameters.filter((one) => answers(one, words)).map((one) => one.path))""",
        [parameters, list(WORDS)],
    )
    for words, paths in zip(WORDS, found, strict=True):
        assert paths == [one.path for one in session.parameters if one.answers(words)], words


def test_a_page_writes_numbers_as_the_window_and_reads_them(modules: Callable[..., Any]) -> None:
    # The function of Python is the second method; a text has three digits.
    page = modules({"state/number_text": ("quantityText", "numberOf")})
    values = [0.0, 1.0, -0.5, 187.752, 1995.0, 9.996, 0.00743, 1.156e-5, 384400.0, 5.2e8, 1.496e11]
    units = ("1", "m", "km", "deg", "DU", "×", "h", "K", "cd/m^2", "W/m^2/nm", "/m", "um")
    cases = [[value, unit] for value in (*values, 17.99, 23.5) for unit in units]
    texts, numbers = page.evaluate(
        """(cases) => [
          cases.map(([value, unit]) => quantityText(value, unit)),
          cases.map(([value, unit]) => numberOf(quantityText(value, unit), unit)),
        ]""",
        cases,
    )
    assert texts == [quantity_text(value, unit) for value, unit in cases]
    for (value, unit), text, number in zip(cases, texts, numbers, strict=True):
        if unit != "cd/m^2":  # which is never typed
            assert_allclose(number, value, rtol=6e-3, atol=1.0 / 60.0 if ":" in text else 0.0)
