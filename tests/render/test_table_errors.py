"""Pictures from the sky-view LUT against exact marching, for every kind of view."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from airlight import Planet
from airlight.render import render
from airlight.render.cpu_renderer import CpuRenderer
from airlight.scene import Camera, Scene
from airlight.solver.moments.solution import MomentsSolution
from picture_errors import CASES, NM, ROWS, errors

Lit = Callable[..., MomentsSolution]
#: Number of pixels to compare, at least four rows of them.
PIXELS = 16_384
#: A sky, a sunset and a limb; the others are marked slow.
QUICK = ("from 400 km, as by default", "limb from 400 km, 8° wide", "sunset from 30 m")


def marks(name: str) -> list[pytest.MarkDecorator]:
    """Marks of a case: whole domes have the largest tables, and one of them is checked."""
    if name.startswith("dome") and name.endswith("sun 60°"):
        return [pytest.mark.validation]
    return [] if name in QUICK else [pytest.mark.slow]


@pytest.fixture(scope="module")
def planets() -> dict[object, Planet]:
    """Planets, one of a kind, so that none is solved twice."""
    made: dict[object, Planet] = {}
    for case in CASES.values():
        key = (case.planet, case.changes)
        if key not in made:
            made[key] = case.world()
    return made


@pytest.mark.parametrize("name", [pytest.param(name, marks=marks(name)) for name in CASES])
def test_a_picture_from_the_table_is_the_marched_one(
    name: str, lit: Lit, planets: dict[object, Planet], tell: Callable[[str], None]
) -> None:
    # The second method: a march for each pixel. docs/pictures.md promises 0.5 % of the radiance in
    # the median and 2/255 of the displayed values; its table has the measured errors, 0.014 % at
    # most, so that 0.1 % indicates a fault.
    case = CASES[name]
    planet = planets[case.planet, case.changes]
    scene = case.scene(planet)
    rows = min(ROWS, max(4, PIXELS // scene.camera.width))
    found = errors(lit(planet, NM), scene, rows)
    tell(
        f"from the table, {name}: median {found.median:.1e}, 999 of 1000 {found.most:.1e}, "
        f"shown {found.shown}/255"
    )
    assert found.median < 1e-3
    assert found.shown <= 2


def test_a_picture_of_few_pixels_is_marched(lit: Lit) -> None:
    # A table has more texels than such a picture has pixels.
    scene = Scene(camera=Camera(width=32, height=18), altitude=2.0)
    assert CpuRenderer(lit(), scene).window is None
    exact, rendered = (render(lit(), scene, exact=choice).rgb for choice in (True, False))
    assert (exact == rendered).all()
