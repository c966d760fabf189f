"""Remake ``docs/images/engines/{earth,mars}.jpg``: planets as programs know them, beside the true.

Run with ``python builders/engine_pictures.py``; it needs airlight itself and nothing else. Each
column is the planet that stands in one program's file, read back from it and lit by airlight's own
solver at 680, 550 and 440 nm: what differs is the fit, not the program. Suns at 45°, 80° and 88°
from the zenith, all views of a row with the exposure of the first.
"""

from __future__ import annotations

import math
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from airlight import load_planet, write_picture
from airlight.paint.paint_scene import paint_scene
from airlight.planets import Planet, replace
from airlight.planets.medium import Medium
from airlight.planets.planet import RED_GREEN_BLUE
from airlight.scene.camera import Camera
from airlight.scene.metering import scene_exposure
from airlight.scene.scene import Scene
from airlight.targets import celestia, openspace, unreal
from airlight.targets.fits.formula_planet import Formulas, formula_planet
from airlight.targets.fits.lobe import CORNETTE_SHANKS, HENYEY_GREENSTEIN

FOLDER = Path(__file__).parents[1] / "docs" / "images" / "engines"
PLANETS = ("earth", "mars")
SUNS = (45.0, 80.0, 88.0)
WIDTH, HEIGHT, LINE = 240, 150, 18
QUALITY = 88


def columns(planet: Planet) -> dict[str, Planet]:
    """Planet itself, and as each program's file has it."""
    medium, name = Medium.from_planet(planet, RED_GREEN_BLUE), planet.name
    forms = {
        "unreal": Formulas(lobe=HENYEY_GREENSTEIN, absorber="tent"),
        "openspace": Formulas(lobe=CORNETTE_SHANKS, absorber="exponential", one_albedo=True),
        "celestia": Formulas(lobe=celestia.SCHLICK, absorber="with particles", grey=True),
    }
    fits = {key: formula_planet(medium, name, form) for key, form in forms.items()}
    star = fits["unreal"].planet.star
    plain = replace(planet, ground=fits["unreal"].planet.ground)
    made = fits["celestia"]
    return {
        "airlight": plain,
        "unreal": unreal.planet_from_unreal(unreal.properties_of(fits["unreal"]), star, name),
        "openspace": openspace.planet_from_openspace(
            openspace.renderable_of(fits["openspace"]), star, name
        ),
        "celestia": celestia.planet_from_celestia(
            celestia.atmosphere_of(made),
            star,
            planet.bottom_radius,
            made.planet.ground.albedo,
            name,
        ),
    }


def drawn(name: str) -> Image.Image:
    """Rows of suns by columns of programs."""
    planets = columns(replace(load_planet(name), refraction="none"))
    sheet = Image.new("RGB", (len(planets) * WIDTH, LINE + len(SUNS) * HEIGHT), "white")
    pen = ImageDraw.Draw(sheet)
    for column, label in enumerate(planets):
        pen.text((column * WIDTH + 6, 3), label, fill="black")
    camera = Camera(
        width=WIDTH, height=HEIGHT, field_of_view=100.0, look_zenith=70.0, look_azimuth=35.0
    )
    for row, sun in enumerate(SUNS):
        scene = Scene(camera=camera, altitude=10.0, sun_zenith=sun)
        exposure = None
        for column, planet in enumerate(planets.values()):
            frame = paint_scene(planet, scene, wavelengths=np.array(RED_GREEN_BLUE))
            if exposure is None:
                radius = math.radians(planet.star.angular_radius_degrees)
                exposure = scene_exposure(frame.rgb, scene, radius)
            with tempfile.TemporaryDirectory() as folder:
                file = Path(folder) / "picture.png"
                write_picture(file, frame.rgb, exposure=exposure)
                with Image.open(file) as picture:
                    sheet.paste(picture.convert("RGB"), (column * WIDTH, LINE + row * HEIGHT))
    return sheet


def main() -> None:
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name in PLANETS:
        file = FOLDER / f"{name}.jpg"
        drawn(name).save(file, quality=QUALITY)
        print(f"{file.name}  {file.stat().st_size / 1e3:.1f} kB", flush=True)


if __name__ == "__main__":
    main()
