"""Folder for Bruneton's WebGL demo: files of its sizes, constants in the shaders, read back."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.engines.targets.bruneton_demo import TARGET, read_constants, read_tables, shaders
from airlight.engines.targets.bruneton_tables import SkyTables, check_halves
from airlight.engines.targets.sky_errors import level_errors, sky_errors
from airlight.engines.targets.target import read_export
from airlight.errors import FileError, ParameterError
from airlight.planets import load_planet

#: Bytes of the files that demo.js loads: RGBA floats.
BYTES = {
    "transmittance.dat": 16 * 256 * 64,
    "irradiance.dat": 16 * 64 * 16,
    "scattering.dat": 16 * 256 * 128 * 32,
}
SHADERS = {"atmosphere_shader.txt", "vertex_shader.txt", "fragment_shader.txt"}
#: Constants of a planet of round numbers.
ROUND: dict[str, Any] = {
    "BOTTOM_RADIUS": 1000.0,
    "TOP_RADIUS": 1100.5,
    "SOLAR_IRRADIANCE": [1.0, 2.0, 2.5e-7],
    "SUN_ANGULAR_RADIUS": 0.005,
    "MU_S_MIN": -0.25,
    "MIE_PHASE_FUNCTION_G": 0.75,
    "MIE_COLOURS": [1.0, 1.5, 2.0],
    "GROUND_ALBEDO": [0.0, 0.5, 1.0],
    "SKY_SPECTRAL_RADIANCE_TO_LUMINANCE": [1.0, 1.0, 1.0],
    "SUN_SPECTRAL_RADIANCE_TO_LUMINANCE": [1.0, 1.0, 1.0],
}
_CONSTANT = re.compile(r"^const (?:float|vec3) ([A-Z_]+) = (?:vec3)?\(?([^;)]*)\)?;$", re.MULTILINE)


def constants_of(shader: str) -> dict[str, Any]:
    """Constants of a shader's text by name, numbers and lists of three."""
    found = {}
    for name, text in _CONSTANT.findall(shader):
        numbers = [float(word) for word in text.split(",")]
        found[name] = numbers if len(numbers) > 1 else numbers[0]
    return found


@pytest.fixture(scope="module")
def earth(demo_folder: Callable[[str], Path]) -> Path:
    return demo_folder("earth")


@pytest.fixture(scope="module")
def tables(earth: Path) -> SkyTables:
    return read_tables(earth)


def test_constants_stand_in_the_shader_as_written() -> None:
    # GLSL ES 3.00 takes no integer for a float: every number has a point or an exponent.
    made = shaders(ROUND)
    assert set(made) == SHADERS
    said = constants_of(made["atmosphere_shader.txt"])
    assert said.pop("PI") == pytest.approx(np.pi)
    assert said == ROUND
    for text in made.values():
        assert text.startswith("#version 330\n")
        assert not re.search(r"\b(PLANET|CENTER|RADIUS|SUN|ALBEDO)\b", text)
    assert "kCenter = vec3(0.0, 0.0, -1000.0);" in made["fragment_shader.txt"]
    assert "kRadius = 1000.0;" in made["fragment_shader.txt"]


@pytest.mark.slow
def test_the_files_have_the_names_and_sizes_that_the_demo_wants(earth: Path) -> None:
    files = read_export(earth, TARGET).files
    assert {name: files[name] for name in BYTES} == BYTES
    assert set(files) == set(BYTES) | SHADERS | {"planet.json"}


@pytest.mark.slow
def test_the_shader_s_constants_are_the_planet_s(earth: Path) -> None:
    # Nine digits: the lengths of a planet to a centimetre.
    said = constants_of((earth / "atmosphere_shader.txt").read_text(encoding="utf-8"))
    del said["PI"]
    kept = read_constants(earth)
    assert set(said) == set(kept)
    for name, value in kept.items():
        assert_allclose(said[name], value, rtol=1e-8)
    planet = load_planet("earth")
    assert 1e3 * said["BOTTOM_RADIUS"] == pytest.approx(planet.bottom_radius)
    assert 1e3 * said["TOP_RADIUS"] == pytest.approx(planet.top_radius)


@pytest.mark.slow
def test_texels_are_read_where_the_demo_has_them(earth: Path, tables: SkyTables) -> None:
    # texImage3D: the sun runs fastest, then the angle, both along the width; then view; then r.
    stored = np.fromfile(earth / "scattering.dat", "<f4").reshape(32, 128, 8, 32, 4)
    for r, view, angle, sun in ((0, 64, 7, 31), (31, 0, 0, 0), (5, 100, 3, 20)):
        kept = stored[r, view, angle, sun].astype(np.float16)  # RGBA16F, as the demo loads it
        assert_array_equal(tables.scattering[r, view, sun, angle], kept)
    assert_array_equal(np.fromfile(earth / "transmittance.dat", "<f4")[3::4], 1.0)
    # Row 0 is the ground, column 0 straight up: less air above every next row, none above the last.
    assert (np.diff(tables.transmittance[:, 0, 2]) > 0.0).all()
    assert_allclose(tables.transmittance[-1, 0], 1.0, rtol=1e-6)
    assert (np.diff(tables.transmittance[0], axis=0) < 0.0).all()


@pytest.mark.slow
def test_the_errors_are_those_of_the_files_read_back(
    earth: Path, tables: SkyTables, solved: Callable[..., Any]
) -> None:
    solution = solved(
        replace(load_planet("earth"), refraction="none"), TARGET.wavelengths, quality="preview"
    )
    rows = sky_errors(solution, tables.radiance)
    rows += level_errors(solution, tables.irradiance_at, tables.transmittance_at)
    said = read_export(earth, TARGET).errors
    assert [row.name for row in said] == [row.name for row in rows]
    for reported, found in zip(said, rows, strict=True):
        assert_allclose(reported.median, found.median, rtol=1e-6)
        assert_allclose(reported.largest, found.largest, rtol=1e-6)
    by_name = {row.name: row for row in said}
    assert by_name["sky"].median < 0.015
    assert by_name["sky"].percentile_95 < 0.07
    assert by_name["irradiance of the ground by the sky"].percentile_95 < 0.01


@pytest.mark.slow
def test_what_is_no_folder_of_the_demo_is_refused(earth: Path, tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"planet\.json: cannot be read"):
        read_tables(tmp_path)
    (tmp_path / "planet.json").write_text("{}", encoding="utf-8")
    with pytest.raises(FileError, match="not a folder of layout bruneton-demo"):
        read_tables(tmp_path)
    for name in ("planet.json", *BYTES):
        shutil.copy(earth / name, tmp_path / name)
    read_tables(tmp_path)
    with (tmp_path / "scattering.dat").open("ab") as file:
        file.write(bytes(16))
    with pytest.raises(FileError, match="not a folder of layout bruneton-demo"):
        read_tables(tmp_path)


def test_what_cannot_be_written_is_refused_in_one_line(
    solved: Callable[..., Any], tmp_path: Path
) -> None:
    planet = replace(load_planet("earth"), refraction="none")
    solution = solved(planet, TARGET.wavelengths, quality="preview")
    with pytest.raises(ParameterError, match="lowest_sun is 80"):
        TARGET.write(solution, tmp_path / "a", lowest_sun=80.0)
    with pytest.raises(ParameterError, match="mie does not apply to layout"):
        TARGET.write(solution, tmp_path / "a", mie="separate")
    with pytest.raises(ParameterError, match="at most 65504, the largest half float"):
        check_halves({"scattering": np.array([0.0, 7e4])})
    assert list(tmp_path.iterdir()) == []
