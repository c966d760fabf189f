"""``airlight radiance`` in the shadow of rings."""

from __future__ import annotations

from pathlib import Path

import pytest
from numpy.testing import assert_allclose

import airlight
from airlight.cli import main

PLANET = """name = "ringed"
[shell]
bottom_radius = "6000 km"
top_radius = "6060 km"
[star]
temperature = "5800 K"
radius = "7e5 km"
distance = "1 au"
[[constituents]]
name = "air"
scattering = "1e-5 /m"
profile = { kind = "exponential", scale_height = "8 km" }
phase_function = { kind = "rayleigh" }
[ground]
albedo = 0.3
[[rings]]
inner_radius = "7000 km"
outer_radius = "14000 km"
optical_depth = 0.7
"""
SUN = ["--sun-zenith", "30", "--view-zenith", "20", "--quality", "preview"]
UNDER = ["--latitude", "15", "--sun-azimuth", "S"]


@pytest.mark.filterwarnings("ignore:.*without rings")
def test_the_shadow_is_that_of_python(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "ringed.toml"
    file.write_text(PLANET)
    found = []
    for words in ([], UNDER):
        assert main(["radiance", str(file), *SUN, *words]) == 0
        found.append(float(capsys.readouterr().out.split()[2]))
    where = {"altitude": 0, "sun_zenith": 30, "view_zenith": 20, "azimuth": 0}
    solution = airlight.solve(str(file), quality="preview")
    under = solution.radiance(**where, latitude=15, sun_azimuth=180)
    assert_allclose(found, [solution.radiance(**where)[0], under[0]], rtol=1e-7)
    assert found[1] < 0.3 * found[0]


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (["saturn", *SUN, "--sun-azimuth", "180"], "--sun-azimuth requires --latitude"),
        (["earth", *SUN, *UNDER], "--sun-azimuth requires a planet with rings"),
        (
            ["saturn", *SUN, *UNDER, "--solver", "montecarlo"],
            "--sun-azimuth cannot be combined with --solver montecarlo",
        ),
        (
            [
                "earth",
                "--view-zenith",
                "20",
                "--at",
                "10N,5E",
                "--time",
                "2026-01-01T12:00Z",
                "--sun-azimuth",
                "S",
            ],
            "--sun-azimuth cannot be combined with --at",
        ),
    ],
)
def test_what_cannot_have_a_shadow_is_a_line(
    words: list[str], line: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["radiance", *words]) != 0
    assert line in capsys.readouterr().err
