"""Damaged planet files: the answer is one clear line or a medium without a NaN."""

from __future__ import annotations

import re
from importlib import resources
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, seed, settings
from hypothesis import strategies as st

from airlight.errors import AirlightError
from airlight.planets import Medium, load_planet, planet_names
from airlight.planets.reading.reader import read_planet

TEXTS = tuple(
    (resources.files("airlight.planets") / "presets" / f"{name}.toml").read_text(encoding="utf-8")
    for name in planet_names()
)
TEXTS += (Path(__file__).with_name("composed.toml").read_text(encoding="utf-8"),)
NASTY = (
    *("nan", "inf", "-inf", "0", "-1", "1e308", "1e-308", "-0.0", "1e999", "9" * 400, "true"),
    *("{}", "[]", "[[]]", '""', '"nan"', '"1e400 km"', '"680, 550 nm"', '"0 nm"', '"km"', '"8 kg"'),
    *('"1 m"', '"1e6 km"', '"1e9 m"', '"1e12 m"', "0.999", "-0.999", "0.5", "1", "1e-300"),
    *('"1e-12 /m"', '"1 /m"', '"0.01 /m"', '"1e-300 /m"', '"1e-6 deg"', '"30 deg"'),
    *('"20, 30, 1e6 nm"', '"1e9 W/m^2/nm"', '"exponential"', "[1, [2]]", "[nan, nan, nan]"),
    *("1979-05-27", "0x7f", '"1 km" # ', '"\\u0000"', "[1e308, 1e308, 1e308]", "[0, 0, 0]"),
    *('{ rayleigh = "air" }', '{ ozone = "1e30 DU" }', '"own.csv"', '"/dev/zero.csv"'),
    *("{ composition = { N2 = 1 } }", "{ N2 = 1e308, O2 = -1e308 }", "{ CO2 = 1 }"),
    '{ cross_section = "ozone-293k", number_density = "1e29 /m^3" }',
)


@st.composite
def damaged(draw):
    """Bytes of a preset with up to four damages."""
    content = bytearray(draw(st.sampled_from(TEXTS)).encode())
    for _ in range(draw(st.integers(1, 4))):
        at = draw(st.integers(0, max(0, len(content) - 1)))
        kind = draw(st.sampled_from(("delete", "swap", "insert", "value", "value", "line")))
        if kind == "delete":
            del content[at : at + draw(st.integers(1, 40))]
        elif kind == "swap" and len(content) > 1:
            other = draw(st.integers(0, len(content) - 1))
            content[at], content[other] = content[other], content[at]
        elif kind == "insert":
            content[at:at] = draw(st.binary(min_size=1, max_size=8))
        elif kind == "value":
            equals = [i for i, byte in enumerate(content) if byte == ord("=")]
            if equals:
                start = draw(st.sampled_from(equals)) + 1
                ends = [content.find(stop, start) for stop in (b"\n", b",", b"}", b"#")]
                stop = min((end for end in ends if end >= 0), default=len(content))
                content[start:stop] = b" " + draw(st.sampled_from(NASTY)).encode() + b" "
        else:
            lines = bytes(content).split(b"\n")
            del lines[draw(st.integers(0, len(lines) - 1))]
            content = bytearray(b"\n".join(lines))
    return bytes(content)


def check_medium(medium: Medium) -> None:
    arrays = (
        medium.scattering,
        medium.absorption,
        medium.density.edges,
        medium.density.coefficients,
        medium.density.at(np.linspace(0.0, medium.thickness, 101)),
        medium.phase_table,
        medium.phase_moments(8),
        medium.ground_albedo,
        medium.solar_irradiance,
        medium.vertical_optical_depth,
        medium.single_scattering_albedo,
        np.array([medium.bottom_radius, medium.top_radius, medium.star_angular_radius]),
    )
    for array in arrays:
        assert np.all(np.isfinite(array))
    for array in (arrays[0], arrays[1], arrays[4], arrays[5], *arrays[7:]):
        assert np.all(array >= 0.0)
    assert medium.top_radius > medium.bottom_radius > 0.0
    assert np.all(np.diff(medium.density.edges) >= 0.0)


@seed(20240217)
@settings(max_examples=200, deadline=None, suppress_health_check=list(HealthCheck))
@given(content=damaged())
def test_two_hundred_damaged_files_never_give_a_traceback_or_a_nan(tmp_path_factory, content):
    file = tmp_path_factory.mktemp("planets") / "planet.toml"
    file.write_bytes(content)
    try:
        planet = load_planet(file)
        medium = Medium.from_planet(planet, planet.wavelengths)
    except AirlightError as error:
        assert "\n" not in str(error)
        assert len(str(error)) < 1000
        return
    check_medium(medium)


@pytest.mark.parametrize("which", ["good", "composed"])
def test_every_nasty_value_at_every_place_of_a_file(request, which):
    # all single damages of a value, none chosen at random
    whole = request.getfixturevalue(which)
    places = [(m.start(), m.end()) for m in re.finditer(r"(?<== )[^={}\[\]\n]+(?=[,}\n])", whole)]
    places += [(m.start(), m.end()) for m in re.finditer(r"(?<== )[\[{].*(?=\n)", whole)]
    for start, end in places:
        for value in NASTY:
            text = f"{whole[:start]}{value}{whole[end:]}"
            try:
                planet = read_planet(text, "test.toml")
                medium = Medium.from_planet(planet, planet.wavelengths)
            except AirlightError as error:
                assert "\n" not in str(error)
                continue
            check_medium(medium)
