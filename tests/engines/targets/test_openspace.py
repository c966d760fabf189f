"""The asset for OpenSpace, read by Lua."""

import json

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.engines.targets import target_of
from airlight.engines.targets.openspace import OZONE_UNIT, planet_from_openspace
from airlight.errors import ParameterError
from airlight.planets import load_planet, replace
from airlight.planets.medium import Medium

NM = (680.0, 550.0, 440.0)
#: Keys that RenderableAtmosphere requires, and all that it knows.
REQUIRED = {
    "Type", "AtmosphereHeight", "PlanetRadius", "PlanetAverageGroundReflectance",
    "GroundRadianceEmission", "Rayleigh", "Mie",
}  # fmt: skip
KNOWN = REQUIRED | {
    "SunIntensity", "MieScatteringExtinctionPropCoefficient", "Ozone", "Debug", "ShadowGroup",
    "AtmosphereDimmingHeight", "SunsetAngle", "SunAngularSize", "LightSourceNode",
}  # fmt: skip


def plain(table):
    """Lua table as dictionaries and lists."""
    if not hasattr(table, "items"):
        return table
    pairs = dict(table.items())
    if pairs and set(pairs) == set(range(1, len(pairs) + 1)):
        return [plain(pairs[n + 1]) for n in range(len(pairs))]
    return {key: plain(value) for key, value in pairs.items()}


def run(text):
    """Run an asset with stubs of OpenSpace's tables: exported table, added and required nodes."""
    lupa = pytest.importorskip("lupa")
    lua = lupa.LuaRuntime(unpack_returned_tuples=True)
    lua.execute("""
        required, added, removed = {}, {}, {}
        openspace = {
            addSceneGraphNode = function(node) added[#added + 1] = node end,
            removeSceneGraphNode = function(node) removed[#removed + 1] = node end,
        }
        asset = {
            require = function(name) required[#required + 1] = name; return {} end,
            onInitialize = function(f) start = f end,
            onDeinitialize = function(f) stop = f end,
            export = function(table) exported = table end,
        }
    """)
    lua.execute(text)
    lua.execute("start() stop()")
    found = lua.globals()
    assert found.added[1] is not None
    assert plain(found.added[1]) == plain(found.removed[1]) == plain(found.exported)
    return plain(found.exported), plain(found.required), plain(found.asset.meta)


def written(solved, tmp_path, name):
    planet = replace(load_planet(name), refraction="none")
    solution = solved(planet, NM, quality="preview")
    export = target_of("openspace").write(solution, tmp_path / "out")
    return solution, export, (tmp_path / "out" / "atmosphere.asset").read_text(encoding="utf-8")


def test_asset_read_by_lua_gives_the_planet_again(solved, tmp_path):
    # Exponentials, an albedo of 0.9 for all wavelengths, no ozone: OpenSpace holds all but the
    # lobe, which is Henyey-Greenstein here and Cornette-Shanks there.
    solution, export, text = written(solved, tmp_path, "earth-openspace")
    table, required, meta = run(text)
    earth = "scene/solarsystem/planets/earth"
    assert required == [f"{earth}/earth", "scene/solarsystem/sun/sun", f"{earth}/moon/moon"]
    # the group of OpenSpace's own Earth, with the radii of the IAU (2015)
    assert table["Renderable"]["ShadowGroup"] == {
        "Sources": [{"Name": "Sun", "Radius": 6.957e8}],
        "Casters": [{"Name": "Moon", "Radius": 1.7374e6}],
    }
    assert (table["Parent"], meta["Author"]) == ("Earth", "airlight")
    renderable = table["Renderable"]
    assert set(renderable) >= REQUIRED
    assert set(renderable) <= KNOWN
    assert renderable["PlanetRadius"] == 6377.0  # km, though documented in metres
    assert renderable["AtmosphereHeight"] == 70.0
    assert_allclose(renderable["Mie"]["Coefficients"]["Extinction"], 0.04 / 0.9, rtol=1e-4)
    made = planet_from_openspace(renderable, solution.planet.star, "again")
    medium, again = solution.medium, Medium.from_planet(made, NM)
    assert_allclose(again.vertical_optical_depth, medium.vertical_optical_depth, rtol=1e-6)
    assert_allclose([one.profile.scale_height for one in made.constituents],
                    [7.99575e3, 1.2e3], rtol=1e-4)  # fmt: skip
    mean = solution.medium.phase_moments(1)[1, :, 1]
    assert_allclose(again.phase_moments(1)[1, :, 1], mean, rtol=1e-6)
    colors = [row for row in export.errors if row.measure == "delta E 2000"]
    assert len(colors) == 3
    assert max(row.median for row in colors) < 3.0


def test_extinction_is_that_of_red_for_all(solved, tmp_path):
    # OpenSpace divides the scattering by one albedo, so what is written is what it uses.
    _, export, text = written(solved, tmp_path, "mars-openspace")
    renderable = run(text)[0]["Renderable"]
    assert "ShadowGroup" not in renderable  # as OpenSpace's own Mars
    mie = renderable["Mie"]["Coefficients"]
    ratio = [s / e for s, e in zip(mie["Scattering"], mie["Extinction"], strict=True)]
    assert_allclose(ratio, ratio[0], rtol=1e-7)
    fit = next(one for one in export.fitted if one.name == "particles: colour")
    assert_allclose(fit.parameters["albedo"], ratio[0], rtol=1e-7)


def test_ozone_is_written_off_and_said(solved, tmp_path):
    solution, export, text = written(solved, tmp_path, "earth-bruneton")
    ozone = run(text)[0]["Renderable"]["Ozone"]
    assert "H_O" not in ozone
    assert any("ozone" in note for note in export.notes)
    fit = next(one for one in export.fitted if "ozone" in one.name)
    height = 1e3 * fit.parameters["scale height [km]"]
    column = height * -np.expm1(-60e3 / height)
    beta = [1e-3 * OZONE_UNIT * one for one in ozone["Coefficients"]["Extinction"]]
    depth = solution.medium.vertical_optical_depth[2]
    assert_allclose([one * column for one in beta], depth, rtol=1e-4)


def test_reader_knows_ozone_that_is_on(solved):
    planet = load_planet("earth-bruneton")
    renderable = {
        "PlanetRadius": 6360.0, "AtmosphereHeight": 60.0, "PlanetAverageGroundReflectance": 0.1,
        "Rayleigh": {"Coefficients": {"Scattering": [0.0058, 0.0135, 0.0331]}, "H_R": 8.0},
        "Mie": {"Coefficients": {"Scattering": [0.004] * 3, "Extinction": [0.004 / 0.9] * 3},
                "H_M": 1.2, "G": 0.85},
        "Ozone": {"Coefficients": {"Extinction": [1000.0, 3000.0, 100.0]}, "H_O": 20.0},
    }  # fmt: skip
    made = planet_from_openspace(renderable, planet.star, "x")
    assert_allclose(made.constituents[2].absorption.values, [6e-7, 1.8e-6, 6e-8])
    renderable["Mie"]["Coefficients"]["Extinction"][0] = 0.001
    with pytest.raises(ParameterError, match="at most the extinction"):
        planet_from_openspace(renderable, planet.star, "x")
    del renderable["Mie"]
    with pytest.raises(ParameterError, match="Mie is 'missing'"):
        planet_from_openspace(renderable, planet.star, "x")


def test_manifest_has_the_account(solved, tmp_path):
    _, export, _ = written(solved, tmp_path, "earth-openspace")
    said = json.loads((tmp_path / "out" / "manifest.json").read_text(encoding="utf-8"))
    assert [row["name"] for row in said["errors"]] == [row.name for row in export.errors]
    assert said["program"] == "OpenSpace"
