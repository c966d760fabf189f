"""The answers of the worksheets are those of the light that the page draws."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from numpy.testing import assert_allclose

import airlight
from airlight.image.four_wavelengths import picture_weights
from airlight.image.xyz import chromaticity, luminance, rgb_to_xyz
from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.planets.picture_wavelengths import picture_wavelengths

PAGE = Path(__file__).parents[2] / "docs" / "tutorials" / "teacher.md"
#: A table of answers: names of columns, and rows of numbers.
_TABLE = re.compile(r"^```{csv-table}\n:header: (.*)\n\n((?:.*\n)+?)```$", re.MULTILINE)
#: Sliders that columns stand for: keys of the planet file, and their values where the factor is 1.
KEYS = {
    "air": ("air.amount", 1.0),
    "aerosol optical depth": ("aerosol.amount", 0.064),
    "dust optical depth": ("dust.amount", 0.5),
}


#: Lessons, in the order of the page: planet, zenith angle of the middle of the picture. [deg]
LESSONS = (("earth", 0.0), ("earth", 84.0), ("mars", 84.0))


def _tables() -> list[list[dict[str, float]]]:
    """Rows of each table of answers, numbers by the names of their columns."""
    return [
        [
            dict(zip(heads.split(","), map(float, row.split(",")), strict=True))
            for row in rows.splitlines()
        ]
        for heads, rows in _TABLE.findall(PAGE.read_text(encoding="utf-8"))
    ]


@pytest.mark.slow
@pytest.mark.parametrize("lesson", range(3), ids=("blue sky", "red sunset", "mars"))
def test_answers_are_those_of_the_solver(lesson: int) -> None:
    # a second method: the CPU's radiance at the wavelengths of the page, which is not opened
    planet, view_zenith = LESSONS[lesson]
    tables = _tables()
    assert len(tables) == len(LESSONS)
    for given in tables[lesson]:
        changes = {path: given[name] / one for name, (path, one) in KEYS.items() if name in given}
        world = airlight.load_planet(planet, changes)
        solution = airlight.solve(world, picture_wavelengths(world, "four"), quality="preview")
        sky = solution.radiance(
            altitude=2.0,
            sun_zenith=given.get("sun zenith", 60.0),
            view_zenith=view_zenith,
            azimuth=270.0 - given.get("heading", 270.0),
        )
        rgb = sky.values @ picture_weights(solution.wavelengths, world.star.irradiances)
        # three digits are printed
        light = LUMINOUS_EFFICACY * luminance(rgb)
        assert_allclose(given["luminance [cd/m²]"], light, rtol=6e-3, err_msg=f"{given}")
        x = chromaticity(rgb_to_xyz(rgb))[0]
        assert_allclose(given["x"], x, rtol=0, atol=1e-3, err_msg=f"{given}")
