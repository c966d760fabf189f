"""The answers of the worksheets are those of the light that the page draws."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from numpy.testing import assert_allclose

import airlight
from airlight.image.spectral import rgb_weights
from airlight.image.xyz import chromaticity, luminance, rgb_to_xyz
from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.planets.picture_wavelengths import picture_wavelengths

PAGE = Path(__file__).parents[2] / "docs" / "tutorials" / "teacher.md"
#: A table of answers: names of columns, and rows of numbers.
_TABLE = re.compile(r"^```{csv-table}\n:header: (.*)\n\n((?:.*\n)+?)```$", re.MULTILINE)
#: Keys of the planet file that columns stand for.
KEYS = {"air": "air.amount", "aerosol optical depth": "aerosol.optical_depth",
        "dust optical depth": "dust.particles.optical_depth"}  # fmt: skip


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
    # the sky's spectrum at sixteen wavelengths by the matching functions: no page is involved
    planet, view_zenith = LESSONS[lesson]
    tables = _tables()
    assert len(tables) == len(LESSONS)
    for given in tables[lesson]:
        changes = {KEYS[name]: value for name, value in given.items() if name in KEYS}
        world = airlight.load_planet(planet, changes)
        solution = airlight.solve(world, picture_wavelengths(world), quality="preview")
        sky = solution.radiance(
            altitude=2.0,
            sun_zenith=given.get("sun zenith", 60.0),
            view_zenith=view_zenith,
            azimuth=270.0 - given.get("heading", 270.0),
        )
        rgb = sky.values @ rgb_weights(solution.wavelengths, world.star.irradiances)
        # three digits are printed
        light = LUMINOUS_EFFICACY * luminance(rgb)
        assert_allclose(given["luminance [cd/m²]"], light, rtol=6e-3, err_msg=f"{given}")
        x = chromaticity(rgb_to_xyz(rgb))[0]
        assert_allclose(given["x"], x, rtol=0, atol=1e-3, err_msg=f"{given}")
