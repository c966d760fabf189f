"""The folder for CosmoScout: its files as its loader reads them, and the light that comes out."""

import ctypes
import ctypes.util
import json
import math
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.engines.targets import target_of
from airlight.engines.targets.cosmoscout_inputs import planet_from_inputs, wavelengths_for
from airlight.engines.targets.cosmoscout_tables import (
    CosmoScoutTables,
    read_texture,
    texel_angles,
    write_texture,
)
from airlight.errors import FileError
from airlight.image.spectral import rgb_weights
from airlight.image.xyz import luminance
from airlight.planets import load_planet, replace
from airlight.planets.medium import Medium
from airlight.solver.refracted_geometry import RefractedGeometry

tifffile = pytest.importorskip("tifffile")

NM = (680.0, 550.0, 440.0)
SIZE = (16, 32, 16, 8)


@pytest.fixture(scope="module")
def written(solved, tmp_path_factory):
    """A small folder of an Earth that bends light, its solution, and its account."""
    solution = solved(load_planet("earth"), NM, quality="preview")
    folder = tmp_path_factory.mktemp("cosmoscout") / "out"
    return solution, folder, target_of("cosmoscout").write(solution, folder, size=SIZE)


def test_files_are_those_of_the_loader(written):
    _, folder, export = written
    assert {
        "metadata.json", "phase.tif", "transmittance.tif", "indirect_illuminance.tif",
        "multiple_scattering.tif", "single_aerosols_scattering.tif", "theta_deviation.tif",
    } <= set(export.files)  # fmt: skip
    metadata = json.loads((folder / "metadata.json").read_text())
    assert set(metadata) == {
        "sunAngularRadius", "sunIlluminance", "scatteringTextureNuSize", "maxSunZenithAngle",
        "refraction",
    }  # fmt: skip
    assert metadata["refraction"] is True
    assert metadata["scatteringTextureNuSize"] == 8
    # 683 lm/W times the sun's golden tristimulus value.
    assert_allclose(luminance(np.array(metadata["sunIlluminance"])), 683.0 * 194.87615, rtol=1e-6)


@pytest.mark.parametrize(
    ("name", "width", "height", "depth"),
    [
        ("phase.tif", 4096, 2, 1), ("transmittance.tif", 256, 64, 1),
        ("theta_deviation.tif", 256, 64, 1), ("indirect_illuminance.tif", 64, 16, 1),
        ("multiple_scattering.tif", 128, 32, 16), ("single_aerosols_scattering.tif", 128, 32, 16),
    ],
)  # fmt: skip
def test_textures_are_scanlines_of_three_floats(written, name, width, height, depth):
    # TIFFReadScanline into float[3 · width] needs contiguous 32-bit floats, not compressed.
    with tifffile.TiffFile(written[1] / name) as file:
        assert len(file.pages) == depth
        for page in file.pages:
            assert (page.imagewidth, page.imagelength) == (width, height)
            assert (page.samplesperpixel, page.bitspersample) == (3, 32)
            assert page.sampleformat == tifffile.SAMPLEFORMAT.IEEEFP
            assert page.planarconfig == tifffile.PLANARCONFIG.CONTIG
            assert page.compression == tifffile.COMPRESSION.NONE
            assert page.photometric == tifffile.PHOTOMETRIC.RGB


@pytest.fixture(scope="module")
def libtiff():
    """The library by which CosmoScout reads textures: the system's, or that in Pillow's wheel."""
    import PIL

    bundled = sorted(Path(PIL.__file__).parents[1].glob("[pP]illow.libs/libtiff*"))
    named = ctypes.util.find_library("tiff") or (str(bundled[0]) if bundled else None)
    if named is None:
        pytest.skip("no libtiff")
    try:
        library = ctypes.CDLL(named)
    except OSError as reason:
        pytest.skip(str(reason))
    library.TIFFOpen.restype = ctypes.c_void_p
    return library


@pytest.mark.parametrize("name", ["multiple_scattering.tif", "phase.tif", "theta_deviation.tif"])
def test_libtiff_reads_the_same_scanlines(written, libtiff, name):
    # What CosmoScout does: count directories, read the sizes, then scanline by scanline.
    ours = read_texture(written[1] / name)
    file = ctypes.c_void_p(libtiff.TIFFOpen(str(written[1] / name).encode(), b"r"))
    assert file.value
    try:
        width, height = ctypes.c_uint32(), ctypes.c_uint32()
        libtiff.TIFFGetField(file, 256, ctypes.byref(width))
        libtiff.TIFFGetField(file, 257, ctypes.byref(height))
        depth = 1
        while libtiff.TIFFReadDirectory(file):
            depth += 1
        assert (depth, height.value, width.value) == ours.shape[:3]
        assert libtiff.TIFFScanlineSize(file) == 12 * width.value
        row = (ctypes.c_float * (3 * width.value))()
        for page in {0, depth - 1}:
            assert libtiff.TIFFSetDirectory(file, page)
            for y in range(height.value):
                assert libtiff.TIFFReadScanline(file, row, y, 0) == 1
                assert_allclose(np.ctypeslib.as_array(row).reshape(-1, 3), ours[page, y], rtol=0)
    finally:
        libtiff.TIFFClose(file)


def test_light_looked_up_as_the_shaders_do_is_the_solutions(written, solved):
    # Tables of an eighth of the texels: 5 % are the steps of the radius. The claim is orientation,
    # units and phase functions, each of which would err by a factor.
    _, _, export = written
    rows = {row.name: row for row in export.errors}
    sky = rows["luminance of the sky, sun above -2 deg"]
    assert sky.points > 1000
    assert sky.median < 0.06
    assert rows["colour of the sky, sun above -2 deg"].median < 2.0


def test_texels_hold_the_luminance_of_the_solution(written, solved):
    # Ground, zenith and a sun in the zenith, seen, are texels: nothing is interpolated.
    _, folder, _ = written
    solution = solved(replace(load_planet("earth"), refraction="none"), NM, quality="preview")
    tables = CosmoScoutTables.read(folder)
    mu = np.array([1.0])
    nu = mu_s = np.array([1.0])
    made = tables.sky_luminance(np.array([tables.bottom_radius]), mu, mu_s, nu)[0]
    star = solution.lights[0]
    true = solution.radiance(altitude=0.0, sun_zenith=0.0, view_zenith=0.0).values
    true = 683.0 * true @ rgb_weights(NM, star.spectrum)
    # The phase function is read half a texel, 0.02 deg, off straight forward.
    assert_allclose(made, true, rtol=5e-3)


def test_illuminance_and_sunlight_are_the_solutions(written):
    solution, folder, _ = written
    tables = CosmoScoutTables.read(folder)
    ground = np.full(3, tables.bottom_radius)
    mu_s = np.array([1.0, 0.6, 0.3])
    star = solution.lights[0]
    weights = 683.0 * rgb_weights(NM, star.spectrum) * star.irradiance[:, None]
    sky = solution.relative_sky_irradiance(ground, mu_s) @ weights
    assert_allclose(tables.sky_illuminance(ground, mu_s), sky, rtol=0.02)
    angles = np.array([0.0, 60.0, 85.0])
    transmittance = solution.transmittance(altitude=0.0, view_zenith=angles).values
    assert_allclose(tables.through(ground, np.cos(np.radians(angles))), transmittance, atol=2e-3)


def test_bending_is_that_of_the_horizon_and_of_a_setting_star(written):
    solution, folder, _ = written
    tables = CosmoScoutTables.read(folder)
    geometry = RefractedGeometry.of(solution.medium)
    ground = np.array([tables.bottom_radius])
    # 34 arc minutes on the horizon: the refraction of almanacs, for 10 deg C and 1010 hPa.
    bent, lowest = tables.refraction_angle(ground, np.array([1e-4]))
    assert_allclose(np.degrees(bent) * 60.0, 34.0, atol=2.0)
    assert lowest[0] >= 0.0
    # From 60 km a ray that grazes the ground bends twice as far, less what is above.
    high = np.array([tables.bottom_radius + 60e3])
    horizon = -math.sqrt(1.0 - (tables.bottom_radius / high[0]) ** 2)
    above, _ = tables.refraction_angle(high, np.array([horizon + 0.005]))
    optical = geometry.optical_radius(high)
    assert_allclose(
        above, geometry.refraction_angle(optical, np.array([horizon + 0.005])), rtol=0.05
    )
    _, below = tables.refraction_angle(high, np.array([horizon - 0.02]))
    assert below[0] < 0.0  # meets the ground


def test_a_straight_planet_has_no_table_of_bending(solved, tmp_path):
    planet = load_planet("earth-bruneton")
    solution = solved(planet, NM, quality="preview")
    export = target_of("cosmoscout").write(solution, tmp_path / "out", size=(4, 16, 8, 4))
    assert "theta_deviation.tif" not in export.files
    tables = CosmoScoutTables.read(tmp_path / "out")
    assert tables.deviation is None
    assert tables.bottom_radius == 6360e3
    (tmp_path / "out" / "phase.tif").write_bytes(b"II*\0")
    with pytest.raises(FileError):
        CosmoScoutTables.read(tmp_path / "out")


def test_inputs_of_the_preprocessor_give_the_planet_again(written):
    solution, folder, _ = written
    planet = solution.planet
    nm = wavelengths_for(planet)
    assert nm.size % 3 == 0  # three at a time
    made = planet_from_inputs(folder, planet.star, "again")
    true, again = (Medium.from_planet(one, nm) for one in (planet, made))
    assert again.names == ("molecules", "aerosols", "ozone")
    scattering, extinction = (
        [(array(one) * one.columns[:, None]).sum(axis=0) for one in (true, again)]
        for array in (lambda one: one.scattering, lambda one: one.extinction)
    )
    assert_allclose(scattering[1], scattering[0], rtol=2e-3)
    assert_allclose(extinction[1], extinction[0], rtol=2e-3)
    assert_allclose(again.density.at([8e3])[0], true.density.at([8e3])[0], rtol=1e-3)
    settings = json.loads((folder / "preprocessor.json").read_text())
    assert_allclose(settings["ior"], 2.77e-4, rtol=0.01)  # CosmoScout's own Earth
    assert_allclose(settings["sunDistance"], 149.6e9, rtol=2e-3)
    assert (settings["minAltitude"], settings["maxAltitude"]) == (6371e3, 6471e3)


def test_all_inputs_have_the_same_wavelengths_and_counts(written):
    _, folder, _ = written
    spectra = {}
    for path in sorted(folder.glob("*.csv")):
        header, *rows = path.read_text().splitlines()
        if path.stem.endswith("density"):
            assert header == "density"
            assert len(rows) == 501
            assert max(float(row) for row in rows) == 1.0
            continue
        spectra[path.stem] = [row.split(",")[0] for row in rows]
        assert header.startswith("lambda,")
        if path.stem.endswith("phase"):
            assert header.split(",")[1:3] == ["0", "0.25"]
            assert header.endswith(",180")
    assert len(spectra) == 7
    assert len({tuple(one) for one in spectra.values()}) == 1


def test_phase_texels_are_where_the_shader_reads_them():
    # u = angle/180°, and texel i has its value at (i + 1/2)/n.
    assert_allclose(texel_angles(4), [22.5, 67.5, 112.5, 157.5])


def test_texture_read_back_is_what_was_written(tmp_path):
    values = np.random.default_rng(1).random((3, 4, 5, 3)).astype(np.float32)
    write_texture(tmp_path / "a.tif", values)
    assert_allclose(read_texture(tmp_path / "a.tif"), values, rtol=0)
