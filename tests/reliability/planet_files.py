"""Damaged planet files: each is refused in one line, or gives a medium without a NaN."""

from __future__ import annotations

import random
from importlib import resources
from pathlib import Path

import numpy as np
from outside_text import FILE_VALUES, OBEYED
from tally import Tally

from airlight.errors import AirlightError
from airlight.planets import Medium, load_planet, planet_names


def preset_texts() -> tuple[str, ...]:
    """Texts of all planets of the package."""
    folder = resources.files("airlight.planets") / "presets"
    return tuple((folder / f"{name}.toml").read_text(encoding="utf-8") for name in planet_names())


def damaged(text: str, chance: random.Random) -> bytes:
    """Bytes of a planet file with up to four damages."""
    content = bytearray(text.encode())
    for _ in range(chance.randint(1, 4)):
        at = chance.randint(0, max(0, len(content) - 1))
        kind = chance.choice(("delete", "swap", "insert", "value", "value", "line"))
        if kind == "delete":
            del content[at : at + chance.randint(1, 40)]
        elif kind == "swap" and len(content) > 1:
            other = chance.randint(0, len(content) - 1)
            content[at], content[other] = content[other], content[at]
        elif kind == "insert":
            content[at:at] = chance.randbytes(chance.randint(1, 8))
        elif kind == "value":
            equals = [i for i, byte in enumerate(content) if byte == ord("=")]
            if equals:
                start = chance.choice(equals) + 1
                ends = [content.find(stop, start) for stop in (b"\n", b",", b"}", b"#")]
                stop = min((end for end in ends if end >= 0), default=len(content))
                content[start:stop] = b" " + chance.choice(FILE_VALUES).encode() + b" "
        else:
            lines = bytes(content).split(b"\n")
            del lines[chance.randint(0, len(lines) - 1)]
            content = bytearray(b"\n".join(lines))
    return bytes(content)


def check_line(error: AirlightError) -> None:
    """Check that the message of an error is one line that steers no terminal."""
    line = str(error)
    assert "\n" not in line
    assert not OBEYED.search(line), ascii(line)
    assert len(line) < 1000


def check_medium(medium: Medium) -> None:
    """Check that all numbers of a medium are finite, and not negative where they cannot be."""
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


def check_file(file: Path) -> str:
    """Read a planet file; its verdict, ``held`` or ``refused``.

    Raises
    ------
    AssertionError, Exception
        If it is neither read without a NaN nor refused in one line.
    """
    try:
        planet = load_planet(file)
        medium = Medium.from_planet(planet, planet.wavelengths)
    except AirlightError as error:
        check_line(error)
        return "refused"
    check_medium(medium)
    return "held"


def try_files(count: int, seed: int, folder: Path, texts: tuple[str, ...]) -> Tally:
    """Damage files and read them."""
    chance, tally = random.Random(seed), Tally("damaged planet files")
    file = folder / "planet.toml"
    for number in range(count):
        content = damaged(chance.choice(texts), chance)
        file.write_bytes(content)
        try:
            tally.add(check_file(file))
        except Exception as error:  # whatever it is, it is what is looked for
            kept = folder / f"broke-{seed}-{number}.toml"
            kept.write_bytes(content)
            tally.add("", f"{kept}: {type(error).__name__}: {ascii(str(error))[:200]}")
    return tally
