"""Errors of pictures that the CPU reads from the sky-view LUT, against exact marching.

``python benchmarks/picture_errors.py`` prints the table of docs/pictures.md; some minutes. The
tests measure the same scenes, solved more coarsely.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from airlight import Camera, Planet, Scene, load_planet, look_at, solve
from airlight.image.display import to_display
from airlight.image.exposure import automatic_exposure
from airlight.render.cpu_renderer import CpuRenderer
from airlight.solver.moments.solution import MomentsSolution

Float32Array = NDArray[np.float32]

#: Wavelengths that every planet is solved at. [nm]
NM = (440.0, 500.0, 560.0, 620.0)
#: Rows of each picture that are compared.
ROWS = 16


@dataclass(frozen=True, kw_only=True)
class Case:
    """A planet, and what is seen of it."""

    planet: str
    altitude: float
    sun: float
    camera: Callable[[Planet, float], Camera]
    changes: tuple[tuple[str, str], ...] = ()

    def world(self) -> Planet:
        """The planet."""
        return load_planet(self.planet, dict(self.changes))

    def scene(self, planet: Planet) -> Scene:
        """What is seen of it."""
        return Scene(
            altitude=self.altitude, sun_zenith=self.sun, camera=self.camera(planet, self.altitude)
        )


def across(**options: Any) -> Callable[[Planet, float], Camera]:
    """A picture of 1280 x 720 around the horizon; or what the options say."""

    def make(planet: Planet, altitude: float) -> Camera:
        zenith, _ = look_at(
            "horizon", altitude=altitude, sun_zenith=60.0, bottom_radius=planet.bottom_radius
        )
        return Camera(**{"width": 1280, "height": 720, "look_zenith": zenith, **options})

    return make


CUBE = {"projection": "cubemap", "width": 6 * 768, "height": 768, "look_zenith": None}
DOME = {"projection": "fisheye", "width": 8192, "height": 8192, "look_zenith": None}
BENT = (("refraction", "bouguer"),)

CASES = {
    "from 400 km, as by default": Case(
        planet="earth", altitude=400e3, sun=60.0, camera=across(look_azimuth=-75.0)),
    "limb from 400 km, 8° wide": Case(
        planet="earth", altitude=400e3, sun=85.0, camera=across(field_of_view=8.0)),
    "limb, sun behind it": Case(
        planet="earth", altitude=400e3, sun=108.0, camera=across(field_of_view=30.0)),
    "terminator from 400 km": Case(
        planet="earth", altitude=400e3, sun=92.0, camera=across(look_azimuth=60.0)),
    "terminator, whole planet": Case(
        planet="earth", altitude=1.5e7, sun=90.0,
        camera=across(look_zenith=180.0, field_of_view=45.0)),
    "from 100 000 km": Case(
        planet="earth", altitude=1e8, sun=60.0,
        camera=across(look_zenith=180.0, field_of_view=8.0)),
    "hazy, towards the sun": Case(
        planet="earth-hazy", altitude=2.0, sun=50.0,
        camera=across(look_zenith=50.0, field_of_view=40.0)),
    "Mars, towards the sun": Case(
        planet="mars", altitude=2.0, sun=75.0,
        camera=across(look_zenith=75.0, field_of_view=40.0)),
    "Mars from 300 km": Case(planet="mars", altitude=300e3, sun=60.0, camera=across()),
    "Titan from 50 km": Case(planet="titan", altitude=50e3, sun=60.0, camera=across()),
    "30 m above the ground": Case(
        planet="earth", altitude=30.0, sun=60.0, camera=across(look_azimuth=60.0)),
    "12 km above the ground": Case(planet="earth", altitude=12e3, sun=80.0, camera=across()),
    "sunset from 30 m": Case(planet="earth", altitude=30.0, sun=90.0, camera=across()),
    "sun 5° below the horizon": Case(planet="earth", altitude=30.0, sun=95.0, camera=across()),
    "sunset, light bent": Case(
        planet="earth", altitude=30.0, sun=90.2, camera=across(field_of_view=20.0), changes=BENT),
    "limb from 400 km, light bent": Case(
        planet="earth", altitude=400e3, sun=70.0, camera=across(field_of_view=20.0),
        changes=BENT),
    "cube map, 10 km, sun 80°": Case(
        planet="earth", altitude=10e3, sun=80.0, camera=across(**CUBE)),
    "cube map, 400 km, sun 95°": Case(
        planet="earth", altitude=400e3, sun=95.0, camera=across(**CUBE)),
    "dome of 8192², sun 60°": Case(
        planet="earth", altitude=2.0, sun=60.0, camera=across(**DOME)),
    "dome of 8192², sun 93°": Case(
        planet="earth", altitude=2.0, sun=93.0, camera=across(**DOME)),
}  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Errors:
    """Errors of a picture: relative ones of the radiance, and those of what is shown."""

    median: float
    most: float
    shown: int
    texels: int


def rows_of(renderer: CpuRenderer, camera: Camera, rows: range) -> Float32Array:
    """Some rows of a picture, shape (n, width, 3)."""
    whole = np.zeros((camera.height, camera.width, 3), np.float32)
    renderer.fill_sky_view()
    for row in rows:
        renderer.render_rows(row, row + 1, whole)
    return whole[rows.start : rows.stop : rows.step]


def errors(solution: MomentsSolution, scene: Scene, count: int = ROWS) -> Errors:
    """Compare ``count`` rows of a picture with the same rows marched.

    Light below 1e-4 of the picture's brightest hundredth counts as if it were so bright.
    """
    camera = scene.camera
    step = max(1, camera.height // count)
    rows = range(step // 2, camera.height, step)
    quick = CpuRenderer(solution, scene)
    assert quick.window is not None
    drawn = rows_of(quick, camera, rows)
    exact = rows_of(CpuRenderer(solution, scene, exact=True), camera, rows)
    bright = np.abs(exact).max(axis=-1)
    lit = bright > 0.0
    floor = 1e-4 * np.quantile(bright[lit], 0.99)
    relative = np.abs(drawn.astype(float) - exact).max(axis=-1)[lit] / (bright[lit] + floor)
    exposure = automatic_exposure(exact)
    shown = np.abs(to_display(drawn, exposure).astype(int) - to_display(exact, exposure))
    return Errors(
        median=float(np.median(relative)),
        most=float(np.quantile(relative, 0.999)),
        shown=int(shown.max()),
        texels=quick.window.texels,
    )


def main() -> None:
    """Print the table."""
    solutions: dict[Any, MomentsSolution] = {}
    print("| picture | texels | median | 999 of 1000 | shown |\n|---|---:|---:|---:|---:|")
    for name, case in CASES.items():
        planet = case.world()
        key = (case.planet, case.changes)
        if key not in solutions:
            solutions[key] = solve(planet, NM, "preview")
        found = errors(solutions[key], case.scene(planet))
        print(
            f"| {name} | {found.texels} | {100.0 * found.median:.3f} % | "
            f"{100.0 * found.most:.2f} % | {found.shown}/255 |",
            flush=True,
        )


if __name__ == "__main__":
    main()
