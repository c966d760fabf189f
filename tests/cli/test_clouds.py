"""What each command does with three-dimensional clouds: it computes their light, or refuses."""

from __future__ import annotations

import csv
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
import xarray

from airlight.cli import main
from airlight.cli.planet_options import with_clouds
from airlight.errors import ConflictError, ParameterError
from airlight.image.exr import read_exr
from airlight.planets import load_planet
from airlight.render.solve_planet import solve_planet
from airlight.solver.independent_columns import IndependentColumns
from airlight.solver.moments.solution import moments_solution

QUICK = ["--quality", "preview", "--no-cache"]
REFUSED = "clouds cannot be used by"
COVERED = ["earth-atmosphere-plus", "--clouds", "stratocumulus"]


@pytest.fixture
def cloudy(tmp_path: Path) -> str:
    """Planet file with a broken layer of clouds."""
    file = tmp_path / "cloudy.toml"
    preset = files("airlight.planets").joinpath("presets/earth-atmosphere-plus.toml")
    text = preset.read_text(encoding="utf-8")
    file.write_text(f'{text}\n[[clouds]]\nkind = "stratocumulus"\ncover = 0.5\n', encoding="utf-8")
    return str(file)


@pytest.fixture
def small_clouds(tmp_path: Path) -> str:
    """File of a small box with heaps."""
    at = (np.arange(16) - 7.5) * 200.0
    values = 0.02 * (1.0 + np.sin(at / 500.0))[:, None, None] * np.ones((16, 4))
    axes = {"x": at, "y": at, "z": 1000.0 + 100.0 * (np.arange(4) + 0.5)}
    path = tmp_path / "small.nc"
    xarray.Dataset(
        {"extinction": (("x", "y", "z"), values, {"units": "m-1"})},
        {name: ((name,), one, {"units": "m"}) for name, one in axes.items()},
    ).to_netcdf(path, engine="scipy")
    return str(path)


#: View of a film of a planet.
AHEAD = ["--set", "view.look_zenith=50deg", "--set", "view.sun_zenith=40deg"]
SCENE = """
name = "Below clouds"
[[bodies]]
name = "earth"
planet = "earth-atmosphere-plus"
[[lights]]
star = { spectrum = "astm-g173" }
direction = [1, 0.5, 0.3]
[observer]
body = "earth"
[camera]
look_zenith = "50 deg"
look_bearing = "40 deg"
field_of_view = "60 deg"
"""


def scene_file(folder: Path) -> str:
    file = folder / "scene.toml"
    file.write_text(SCENE, encoding="utf-8")
    return str(file)


def wind(of: str, speed: str) -> str:
    """Argument of ``--set`` for a wind."""
    return f"{'earth.' if of == 'scene' else ''}clouds.wind_speed={speed}"


def refusal(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    """The only line of an error."""
    assert main(list(words)) == 2
    line = capsys.readouterr().err.strip()
    assert line.count("\n") == 0
    return line


@pytest.mark.parametrize(
    "words",
    [
        ["bake", *COVERED, "--layout", "bruneton", "-o", "tables"],
        ["bake", *COVERED, "--layout", "celestia", "-o", "celestia"],
        ["aerial", *COVERED, *QUICK, "-o", "air"],
        ["export-page", *COVERED, *QUICK, "-o", "page.html"],
        ["plot", *COVERED, "density", "-o", "density.png"],
        ["plot", *COVERED, "phase", "-o", "phases.png"],
        ["plot", *COVERED, "optical-depth", "-o", "depth.png"],
    ],
    ids=lambda words: " ".join((words[0], *words[4:6])),
)
def test_commands_without_clouds_refuse_them_in_one_line(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    if words[0] == "plot":
        pytest.importorskip("matplotlib")
        words = ["plot", words[1], words[4], *words[2:4], *words[5:]]
    assert REFUSED in refusal(capsys, *words)
    assert not list(tmp_path.iterdir())


SMALL = ["--size", "24x16", "--quality", "preview", "--wavelengths", "rgb", "--workers", "1"]


@pytest.mark.slow
@pytest.mark.parametrize("of", ["planet", "scene"])
def test_a_film_has_clouds_of_a_file_that_drift(of: str, small_clouds: str, tmp_path: Path) -> None:
    """Without wind the frames are the same light, and without clouds another one."""
    pictures = {}
    for name, words in (
        ("still", ["--clouds", small_clouds]),
        ("drift", ["--clouds", small_clouds, "--set", wind(of, "150 m/s")]),
        ("clear", ["--clouds", "none"]),
    ):
        folder = tmp_path / name
        film = ["earth-atmosphere-plus", *AHEAD] if of == "planet" else [scene_file(tmp_path)]
        given = ["--frames", "2", "--rate", "1", "--format", "exr"]
        assert main(["animate", *film, *words, *given, *SMALL, "-o", str(folder)]) == 0
        pictures[name] = [read_exr(one)[0] for one in sorted(folder.glob("*.exr"))]
    np.testing.assert_array_equal(*pictures["still"])
    assert np.abs(pictures["drift"][1] / pictures["still"][1] - 1.0).max() > 0.02
    np.testing.assert_array_equal(pictures["drift"][0], pictures["still"][0])
    assert np.abs(pictures["clear"][0] / pictures["still"][0] - 1.0).max() > 0.1


def radiance_of(capsys: pytest.CaptureFixture[str], *words: str) -> float:
    """Radiance of the zenith under the sun at 40°. [W m⁻² sr⁻¹ nm⁻¹]"""
    view = ["--sun-zenith", "40", "--view-zenith", "0", "--wavelengths", "550"]
    assert main(["radiance", "earth-atmosphere-plus", *words, *view, *QUICK]) == 0
    return float(capsys.readouterr().out.split()[2])


@pytest.mark.slow
def test_radiances_are_the_means_of_independent_columns(
    capsys: pytest.CaptureFixture[str],
) -> None:
    cover = ["--clouds", "stratocumulus", "--set"]
    clear, half, full = (
        radiance_of(capsys, *words)
        for words in ([], [*cover, "clouds.cover=0.5"], [*cover, "clouds.cover=1"])
    )
    assert half == pytest.approx(0.5 * (clear + full), rel=1e-5)
    assert full > 3.0 * clear


@pytest.mark.slow
def test_a_sweep_and_a_spectrum_have_clouds(cloudy: str, tmp_path: Path) -> None:
    store = tmp_path / "sweep.zarr"
    axes = ["--sun-zenith", "40", "--view-zenith", "0", "--azimuth", "0", "--wavelengths", "550"]
    words = ["sweep", cloudy, "--vary", "clouds.optical_depth=1,20", *axes]
    assert main([*words, "--quality", "preview", "--workers", "1", "-o", str(store)]) == 0
    with xarray.open_zarr(store) as data:
        values = np.ravel(data["radiance"].values)
    assert values.size == 2
    assert abs(values[1] / values[0] - 1.0) > 0.05
    albedos: list[float] = []
    for number, planet in enumerate((cloudy, "earth-atmosphere-plus")):
        table = tmp_path / f"albedo-{number}.csv"
        of = ["--of", "geometric-albedo", "--wavelengths", "550"]
        assert main(["spectrum", planet, *of, *QUICK, "-o", str(table)]) == 0
        with table.open(newline="") as stream:
            albedos.append(float(list(csv.reader(stream))[-1][1]))
    assert albedos[0] > 1.3 * albedos[1]


@pytest.mark.slow
def test_clouds_of_an_option_are_those_of_a_file_in_a_sweep(cloudy: str, tmp_path: Path) -> None:
    axes = ["--sun-zenith", "40", "--view-zenith", "0", "--wavelengths", "550", "--workers", "1"]
    varied = ["--vary", "clouds.optical_depth=1,20", "--quality", "preview"]
    option = ["earth-atmosphere-plus", "--clouds", "stratocumulus", "--set", "clouds.cover=0.5"]
    found = []
    for name, words in (("file", [cloudy]), ("option", option)):
        store = tmp_path / f"{name}.zarr"
        assert main(["sweep", *words, *varied, *axes, "-o", str(store)]) == 0
        with xarray.open_zarr(store) as data:
            found.append(data["radiance"].values)
            assert data["clouds.optical_depth"].attrs["units"] == "1"
    np.testing.assert_array_equal(*found)


def test_clouds_with_commas_are_several_kinds() -> None:
    found = with_clouds("cumulus,cirrus", None)
    assert found == ['clouds=[{ kind = "cumulus" }, { kind = "cirrus" }]']
    for text in ("cumulus,cirus", "cumulus,none", "cumulus,"):
        with pytest.raises(ParameterError, match="--clouds is"):
            with_clouds(text, None)


def test_show_lists_clouds_beside_the_numbers_of_clear_air(
    capsys: pytest.CaptureFixture[str],
) -> None:
    shown = []
    for words in (COVERED, COVERED[:1]):
        assert main(["show", *words]) == 0
        shown.append(capsys.readouterr().out.splitlines())
    extra = [line for line in shown[0] if line not in shown[1]]
    assert any("stratocumulus" in line and "cover 0.9" in line for line in extra)
    assert [line for line in shown[1] if line not in shown[0]] == []


def test_a_fit_refuses_clouds(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "sky.csv"
    header = "altitude_m,wavelength_nm,sun_zenith_deg,view_zenith_deg,azimuth_deg,radiance"
    file.write_text(f"{header}\n0,550,40,10,60,0.05\n0,550,40,60,60,0.06\n", encoding="utf-8")
    words = ["fit", *COVERED[:1], "--data", str(file), "--free", "aerosol.optical_depth"]
    clouds = ["--set", 'clouds=[{ kind = "stratocumulus" }]']
    output = ["--uncertainty", "1%", "-o", str(tmp_path / "fitted.toml")]
    assert REFUSED in refusal(capsys, *words, *clouds, *output, *QUICK)


def test_a_solution_with_clouds_is_refused_by_who_reads_moments() -> None:
    planet = load_planet("earth-atmosphere-plus", {"clouds": [{"kind": "stratocumulus"}]})
    with pytest.raises(ConflictError, match=REFUSED):
        solve_planet(planet, [550.0], "preview")
    solved = StandIn()
    solved.planet = planet
    with pytest.raises(ConflictError, match="cannot be used by compose"):
        moments_solution(solved, "compose")


class StandIn(IndependentColumns):
    """Mean of columns that are not solved."""

    def __init__(self) -> None:
        """No columns."""
