"""Remake ``docs/images/engines/{earth,mars,mars-look-up}.jpg``: planets as programs know them.

Run with ``python builders/engine_pictures.py``; it needs airlight itself and nothing else. Each
column is the planet that stands in one program's file, read back from it and lit by airlight's own
solver at 680, 550 and 440 nm: what differs is the fit, not the program. Suns at 45°, 80° and 88°
from the zenith, all views of a row with the exposure of the first. ``mars-look-up.jpg`` has the
look-ups of ``--layout takram`` and ``bruneton-demo``, and on its right the solution.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from airlight import load_planet, solve, write_picture
from airlight.engines.baking.air_light import AirLight
from airlight.engines.targets import bruneton_demo, celestia, openspace, takram, unreal
from airlight.engines.targets.fits.formula_planet import Formulas, formula_planet
from airlight.engines.targets.fits.lobe import CORNETTE_SHANKS, HENYEY_GREENSTEIN
from airlight.engines.targets.fits.sky_colour import fit_sky_colour
from airlight.image.exposure import automatic_exposure
from airlight.planets import Planet, replace
from airlight.planets.medium import Medium
from airlight.planets.planet import RED_GREEN_BLUE
from airlight.render.render_scene import render_scene
from airlight.scene.camera import Camera
from airlight.scene.scene import Scene
from airlight.solver.tables.layout import Positions

FOLDER = Path(__file__).parents[1] / "docs" / "images" / "engines"
PLANETS = ("earth", "mars")
SUNS = (45.0, 80.0, 88.0)
WIDTH, HEIGHT, LINE = 240, 150, 18
#: Size of a picture of the look-ups. [pixel]
SIZE = (400, 260)
#: Views of the look-up: altitude [m], zenith angle of the sun, azimuth and zenith angle [deg].
VIEWS = ((2e3, 85.0, 0.0, 65.0), (400e3, 50.0, 180.0, 133.0))
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
            frame = render_scene(planet, scene, wavelengths=np.array(RED_GREEN_BLUE))
            if exposure is None:
                exposure = frame.exposure
            with tempfile.TemporaryDirectory() as folder:
                file = Path(folder) / "picture.png"
                write_picture(file, frame.rgb, exposure=exposure)
                with Image.open(file) as picture:
                    sheet.paste(picture.convert("RGB"), (column * WIDTH, LINE + row * HEIGHT))
    return sheet


def looked_up() -> Image.Image:
    """Mars by the tables of two programs and by the solution: the air alone, three bands."""
    planet = replace(load_planet("mars"), refraction="none")
    solution = solve(planet, takram.TARGET.wavelengths)
    tables = {}
    for label, program in (("three-atmosphere", takram), ("Bruneton's demo", bruneton_demo)):
        with tempfile.TemporaryDirectory() as folder:
            program.TARGET.write(solution, Path(folder) / "mars")
            tables[label] = program.read_tables(Path(folder) / "mars")
    star, factors = solution.medium.lights[0].irradiance, fit_sky_colour(solution).sky
    width, height = SIZE
    sheet = Image.new("RGB", (3 * width, LINE + len(VIEWS) * height), "white")
    pen = ImageDraw.Draw(sheet)
    for row, (altitude, sun, azimuth, zenith) in enumerate(VIEWS):
        camera = Camera(width=width, height=height, field_of_view=110.0, look_zenith=zenith,
                        look_azimuth=azimuth)  # fmt: skip
        ray = camera.directions().reshape(-1, 3)
        sight, _ = solution.lines_of_sight(
            altitude=altitude, sun_zenith=sun, view_zenith=np.degrees(np.arccos(ray[:, 2])),
            azimuth=np.degrees(np.arctan2(ray[:, 1], ray[:, 0])),
        )  # fmt: skip
        place = Positions(sight.r, sight.mu, sight.mu_s, sight.nu, sight.to_ground)
        true = AirLight(solution)(sight) * star
        seen = true.max(axis=-1) > 1e-3 * true.max()
        exposure = automatic_exposure((true * factors).reshape(height, width, 3))
        lights = {name: np.where(sight.length[:, None] > 0.0, one.radiance(place), 0.0)
                  for name, one in tables.items()}  # fmt: skip
        for column, (label, light) in enumerate((*lights.items(), ("airlight", true))):
            error = np.abs(light[seen] / true[seen] - 1.0)
            print(f"{label}, {altitude:g} m, sun {sun:g}: median {np.median(error):.3f}, 95 % "
                  f"{np.percentile(error, 95.0):.3f}, {(error.max(axis=-1) > 0.4).mean():.3f} of "
                  "the pixels above 0.4")  # fmt: skip
            pen.text((column * width + 6, 3), label, fill="black")
            rgb = (light * factors).reshape(height, width, 3).astype(np.float32)
            with tempfile.TemporaryDirectory() as folder:
                file = Path(folder) / "picture.png"
                write_picture(file, rgb, exposure=exposure, eye=False)
                with Image.open(file) as picture:
                    sheet.paste(picture.convert("RGB"), (column * width, LINE + row * height))
    return sheet


def main() -> None:
    FOLDER.mkdir(parents=True, exist_ok=True)
    looked_up().save(FOLDER / "mars-look-up.jpg", quality=QUALITY)
    for name in PLANETS:
        file = FOLDER / f"{name}.jpg"
        drawn(name).save(file, quality=QUALITY)
        print(f"{file.name}  {file.stat().st_size / 1e3:.1f} kB", flush=True)


if __name__ == "__main__":
    main()
