"""Folder for three-atmosphere: the files its loader wants, and the light that its look-up gives."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.engines.baking.air_light import AirLight
from airlight.engines.targets.bruneton_tables import coefficients, mie_colours
from airlight.engines.targets.takram import TARGET, read_tables
from airlight.engines.targets.target import read_export
from airlight.errors import FileError, ParameterError
from airlight.image.exr import read_exr_channels
from airlight.planets import load_planet
from airlight.solver.tables.layout import Positions

#: Sizes of the loader's constants.ts: bytes of RGBA half floats.
BYTES = {
    "transmittance": 8 * 256 * 64,
    "irradiance": 8 * 64 * 16,
    "scattering": 8 * 256 * 128 * 32,
    "single_mie_scattering": 8 * 256 * 128 * 32,
    "higher_order_scattering": 8 * 256 * 128 * 32,
}

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def earth(takram_folder: Callable[[str], Path]) -> Path:
    return takram_folder("earth")


def test_the_files_have_the_names_and_sizes_that_the_loader_wants(earth: Path) -> None:
    files = read_export(earth, TARGET).files
    assert {name: files[f"{name}.bin"] for name in BYTES} == BYTES
    assert set(files) == {f"{name}.{kind}" for name in BYTES for kind in ("bin", "exr")} | {
        "atmosphere.json", "planet.js",
    }  # fmt: skip


@pytest.mark.parametrize("name", ["transmittance", "scattering"])
def test_the_exr_is_the_binary_file_upside_down(earth: Path, name: str) -> None:
    # As the shipped assets of the package are.
    width = 256
    binary = np.frombuffer((earth / f"{name}.bin").read_bytes(), "<f2").reshape(-1, width, 4)
    channels = read_exr_channels(earth / f"{name}.exr")
    for k, letter in enumerate("RGBA"):
        assert channels[letter].dtype == np.float16
        assert_array_equal(channels[letter][::-1], binary[..., k])


def test_the_look_up_gives_the_solution_s_light(earth: Path) -> None:
    # Eight angles to the sun, half floats and one lobe cost this much; read back from the files.
    rows = {row.name: row for row in read_export(earth, TARGET).errors}
    assert rows["sky"].median < 0.015
    assert rows["sky"].percentile_95 < 0.07
    assert rows["air before the ground"].median < 0.003
    assert rows["irradiance of the ground by the sky"].percentile_95 < 0.01
    assert rows["transmittance to the top"].percentile_95 < 5e-4


def test_alpha_is_the_red_of_the_particles_light(earth: Path) -> None:
    tables = read_tables(earth)
    assert tables.single_mie is not None
    assert_array_equal(tables.scattering[..., 3], tables.single_mie[..., 0])
    assert_array_equal(tables.mie_colours[0], 1.0)
    # Higher orders are a part of the smooth light, at every sun, but for rounding to half floats.
    higher = np.frombuffer((earth / "higher_order_scattering.bin").read_bytes(), "<f2")
    parts = higher.reshape(32, 128, 8, 32, 4).transpose(0, 1, 3, 2, 4)[..., :3].astype(float)
    smooth = tables.scattering[..., :3]
    assert (parts <= smooth + 1e-3 * np.abs(smooth) + 1e-7).all()
    assert parts[:, 64:, :].max() > 0.1


def test_the_parameters_are_the_planet_s(earth: Path) -> None:
    said = json.loads((earth / "atmosphere.json").read_text(encoding="utf-8"))
    planet = load_planet("earth")
    assert (said["bottomRadius"], said["topRadius"]) == (planet.bottom_radius, planet.top_radius)
    assert -0.6 < said["muSMin"] < -0.3
    # Rayleigh scattering of air: the package's own (0.0058, 0.0136, 0.0331) are of denser air.
    assert_allclose(said["rayleighScattering"], (0.005802, 0.013558, 0.0331), rtol=0.2)
    assert 0.6 < said["miePhaseFunctionG"] < 0.8
    assert_allclose(said["sunAngularRadius"], 0.004675, rtol=0.01)


def test_air_without_particles_or_molecules_has_colours_all_the_same(
    solved: Callable[..., Any],
) -> None:
    # The shader divides one by the other.
    medium = solved(load_planet("earth"), (680.0, 550.0, 440.0), quality="preview").medium
    molecules, particles, extinction = coefficients(medium)
    assert (extinction > particles).all()
    assert (particles / molecules > 0.5).all()
    names = np.array(medium.names)
    for lacking in ("air", "aerosol"):
        scattering = np.where((np.char.find(names, lacking) >= 0)[:, None], 0.0, medium.scattering)
        assert_array_equal(mie_colours(replace(medium, scattering=scattering)), 1.0)


@pytest.mark.validation  # tables of Mars of full size, for it alone; those of the Earth are above
def test_a_low_sun_of_mars_has_no_false_light(
    solved: Callable[..., Any], takram_folder: Callable[[str], Path]
) -> None:
    # the solution's own light of the air; by the light at eight angles alone an oval of a tenth of
    # these views was more than 40 % too bright, and the glow opposite to the sun a quarter too dim
    planet = replace(load_planet("mars"), refraction="none")
    solution = solved(planet, TARGET.wavelengths, quality="preview")
    tables, star = read_tables(takram_folder("mars")), solution.medium.lights[0].irradiance
    zenith, azimuth = (one.ravel() for one in np.meshgrid(np.linspace(35, 89, 30), np.arange(60)))
    for altitude, sun, seen, around in (
        (2e3, 85.0, zenith, azimuth), (400e3, 50.0, 195.0 - zenith, 180.0 + azimuth)
    ):  # fmt: skip
        lines, _ = solution.lines_of_sight(
            altitude=altitude, sun_zenith=sun, view_zenith=seen, azimuth=around
        )
        in_air = lines.length > 0.0
        place = Positions(lines.r, lines.mu, lines.mu_s, lines.nu, lines.to_ground)
        own = (AirLight(solution)(lines) * star)[in_air]
        error = np.abs(tables.radiance(place)[in_air] / own - 1.0)
        assert (error.max(axis=-1) > 0.4).mean() < 0.002
        assert np.percentile(error, 95.0) < 0.15


def test_what_cannot_be_written_is_refused_in_one_line(
    solved: Callable[..., Any], tmp_path: Path
) -> None:
    planet = replace(load_planet("earth"), refraction="none")
    solution = solved(planet, (680.0, 550.0, 440.0), quality="preview")
    with pytest.raises(ParameterError, match="mie is 'both'; allowed: separate, combined"):
        TARGET.write(solution, tmp_path / "a", mie="both")
    with pytest.raises(ParameterError, match="lowest_sun is 80"):
        TARGET.write(solution, tmp_path / "a", lowest_sun=80.0)
    with pytest.raises(FileError, match="not a folder of layout takram"):
        read_tables(tmp_path)
    assert list(tmp_path.iterdir()) == []
