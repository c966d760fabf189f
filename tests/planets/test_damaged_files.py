"""Damaged planet files: the answer is one clear line or a medium without a NaN."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from outside_text import FILE_VALUES
from planet_files import check_line, check_medium, preset_texts, try_files

from airlight.errors import AirlightError
from airlight.planets import Medium
from airlight.planets.reading.reader import read_planet

TEXTS = (*preset_texts(), Path(__file__).with_name("composed.toml").read_text(encoding="utf-8"))


def test_two_hundred_damaged_files_never_give_a_traceback_or_a_nan(tmp_path):
    tally = try_files(200, 20240217, tmp_path, TEXTS)
    assert tally.broke == []
    assert tally.tried == 200
    assert min(tally.counts["held"], tally.counts["refused"]) > 10


@pytest.mark.parametrize("which", ["good", "composed"])
def test_every_nasty_value_at_every_place_of_a_file(request, which):
    # all single damages of a value, none chosen at random
    whole = request.getfixturevalue(which)
    places = [(m.start(), m.end()) for m in re.finditer(r"(?<== )[^={}\[\]\n]+(?=[,}\n])", whole)]
    places += [(m.start(), m.end()) for m in re.finditer(r"(?<== )[\[{].*(?=\n)", whole)]
    for start, end in places:
        for value in FILE_VALUES:
            text = f"{whole[:start]}{value}{whole[end:]}"
            try:
                planet = read_planet(text, "test.toml")
                medium = Medium.from_planet(planet, planet.wavelengths)
            except AirlightError as error:
                check_line(error)
                continue
            check_medium(medium)
