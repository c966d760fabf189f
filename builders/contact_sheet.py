"""Contact sheet of 24 scenes of which everybody has seen photographs, shown as by default.

Run with ``python builders/contact_sheet.py FOLDER``: one PNG a scene, and the sheet of all that
are in the folder. ``--by window`` and ``--by page`` take the pictures from the window, drawn
offscreen, and from exported pages in Chromium, which needs playwright; names of scenes draw those
alone. ``--sheet docs/images/sheets/processor.jpg`` remakes the documentation's.
"""

from __future__ import annotations

import argparse
import base64
import io
import os
import shutil
import tempfile
import time
from collections.abc import Callable, Iterator
from itertools import groupby
from pathlib import Path
from typing import Any, NamedTuple

from PIL import Image, ImageDraw

from airlight import Camera, Scene, load_planet
from airlight.render.picture import write_picture
from airlight.render.render_scene import render_scene

#: Distance from which a whole planet fills most of a picture, in radii above the ground. [1]
FAR = 3.2
#: Pictures in a row of the sheet, their width there, and the height of a label. [pixel]
COLUMNS, WIDTH, LABEL = 4, 480, 22
#: The page's picture as a data URL.
PICTURE = """async ([width, height]) => {
  const blob = await airlight.png(width, height);
  const reader = new FileReader();
  return new Promise((resolve) => {
    reader.onload = () => resolve(reader.result);
    reader.readAsDataURL(blob);
  });
}"""
#: Limit of one picture, in software and on a busy machine. [s]
PATIENCE = 600.0
#: WebGL2 by Mesa where there is no GPU, as in tests/web.
FLAGS = ("--no-sandbox", "--use-angle=gl-egl", "--ignore-gpu-blocklist", "--disable-gpu-watchdog")


class View(NamedTuple):
    """View of the sheet.

    Attributes
    ----------
    planet : str
        Preset.
    altitude : float
        Altitude of the observer; negative: in radii of the planet. [m]
    sun : float
        Zenith angle of the sun. [deg]
    look : float
        Zenith angle of the line of sight. [deg]
    aside : float
        Azimuth of the line of sight from the sun. [deg]
    field : float
        Field of view. [deg]
    place : (float, float)
        Latitude and longitude below the observer. [deg]
    bearing : float
        Compass bearing of the sun. [deg]
    """

    planet: str
    altitude: float
    sun: float
    look: float
    aside: float = 0.0
    field: float = 60.0
    place: tuple[float, float] = (36.6, -122.1)
    bearing: float = 270.0


#: Views by name: dusk, noon and heights, orbit, discs, other planets, night.
VIEWS = {
    "sunset-85": View("earth", 2.0, 85.0, 82.0),
    "sunset-89": View("earth", 2.0, 89.0, 82.0),
    "sunset-91": View("earth", 2.0, 91.0, 82.0),
    "sunset-93": View("earth", 2.0, 93.0, 82.0),
    "sunset-96": View("earth", 2.0, 96.0, 82.0),
    "antisolar-90": View("earth", 2.0, 90.0, 82.0, 180.0),
    "antisolar-92": View("earth", 2.0, 92.0, 82.0, 180.0),
    "antisolar-94": View("earth", 2.0, 94.0, 82.0, 180.0),
    "noon": View("earth", 2.0, 35.0, 80.0, 90.0, place=(24.0, 45.0)),
    "12-km": View("earth", 12e3, 50.0, 92.0, 40.0),
    "35-km": View("earth", 35e3, 70.0, 93.0, 30.0),
    "limb-by-day": View("earth", 420e3, 60.0, 107.0, 60.0),
    "limb-after-sunset": View("earth", 420e3, 111.0, 109.0, 0.0, 30.0),
    "full-earth": View("earth", -FAR, 12.0, 180.0, -180.0, 52.0, (5.0, -30.0), 180.0),
    "half-earth": View("earth", -FAR, 90.0, 180.0, -90.0, 52.0, (15.0, 20.0), 90.0),
    "crescent-earth": View("earth", -FAR, 140.0, 180.0, -90.0, 52.0, (0.0, 180.0), 90.0),
    "mars-day": View("mars", 2.0, 40.0, 80.0, 70.0),
    "mars-sunset": View("mars", 2.0, 86.0, 82.0),
    "mars-limb": View("mars", 300e3, 60.0, 114.0, 60.0),
    "mars-disc": View("mars", -FAR, 35.0, 180.0, -90.0, 52.0, (0.0, 0.0), 90.0),
    "titan": View("titan", -4.5, 60.0, 180.0, -90.0, 52.0, (0.0, 0.0), 90.0),
    "venus": View("venus", -FAR, 70.0, 180.0, -90.0, 52.0, (0.0, 0.0), 90.0),
    "red-dwarf": View("exoplanet", 2.0, 85.0, 82.0),
    "moonless-night": View("earth", 2.0, 120.0, 82.0),
}  # fmt: skip


def scene_of(view: View, radius: float, width: int) -> Scene:
    """Scene of a view.

    Parameters
    ----------
    view : View
    radius : float
        Radius of the planet's ground. [m]
    width : int
        Width of the picture, in 16:9. [pixel]
    """
    altitude = view.altitude if view.altitude >= 0.0 else -view.altitude * radius
    camera = Camera(
        width=width, height=width * 9 // 16, field_of_view=view.field, look_zenith=view.look,
        look_azimuth=view.aside,
    )  # fmt: skip
    return Scene(
        camera=camera, altitude=altitude, sun_zenith=view.sun, latitude=view.place[0],
        longitude=view.place[1], sun_azimuth=view.bearing, ground="detailed",
    )  # fmt: skip


def sheet(files: dict[str, Path], target: Path) -> None:
    """Put pictures with their names on one sheet.

    Parameters
    ----------
    files : dict from str to Path
        Pictures by name.
    target : Path
        File of the sheet.
    """
    rows, high = -(-len(files) // COLUMNS), WIDTH * 9 // 16
    page = Image.new("RGB", (COLUMNS * WIDTH, rows * (high + LABEL)), (24, 24, 24))
    pen = ImageDraw.Draw(page)
    for number, (name, file) in enumerate(files.items()):
        left, top = number % COLUMNS * WIDTH, number // COLUMNS * (high + LABEL)
        page.paste(Image.open(file).convert("RGB").resize((WIDTH, high)), (left, top))
        pen.text((left + 6, top + high + 5), name, (220, 220, 220))
    page.save(target, quality=85)


def by_processor(names: list[str], width: int) -> Iterator[tuple[str, Image.Image]]:
    """Pictures as ``airlight render`` writes them."""
    for name in names:
        planet = load_planet(VIEWS[name].planet)
        scene = scene_of(VIEWS[name], planet.bottom_radius, width)
        frame = render_scene(planet, scene)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "picture.png"
            write_picture(file, frame)
            yield name, Image.open(file).convert("RGB")


def view_values(scene: Scene) -> dict[str, Any]:
    """Values of a scene by their paths in window and page."""
    camera = scene.camera
    return {
        "view.altitude": scene.altitude,
        "view.sun_zenith": scene.sun_zenith,
        "view.sun_azimuth": scene.sun_azimuth % 360.0,
        "view.latitude": scene.latitude,
        "view.longitude": scene.longitude,
        "view.look_zenith": camera.look_zenith,
        "view.heading": (scene.sun_azimuth + camera.look_azimuth) % 360.0,
        "view.field_of_view": camera.field_of_view,
    }


def by_window(names: list[str], width: int) -> Iterator[tuple[str, Image.Image]]:
    """Pictures as the window shows them, without its panels."""
    from airlight.render.gpu.device.device import open_device
    from airlight.render.solve_planet import live_solver
    from airlight.viewer.window.canvas import OffscreenCanvas
    from airlight.viewer.window.start import Start, opened, renderer_by
    from airlight.viewer.window.window import Window

    device = open_device()
    for planet, of_planet in groupby(names, lambda name: VIEWS[name].planet):
        canvas = OffscreenCanvas((width, width * 9 // 16))
        session = opened(Start(planet=planet))
        window = Window(
            session, canvas, device.device, renderer_by("auto", device),
            live_solver("auto", device),
        )  # fmt: skip
        window.actions.shows_panels = False
        try:
            for name in of_planet:
                radius = load_planet(planet).bottom_radius
                session.move(view_values(scene_of(VIEWS[name], radius, width)))
                until = time.monotonic() + PATIENCE
                rested = 0
                while rested < 5:
                    canvas.run(window.draw)
                    time.sleep(0.05)
                    done = window.settled and window.shown() is not None and not canvas.wanted
                    rested = rested + 1 if done else 0
                    if time.monotonic() > until:
                        raise SystemExit(f"{name}: not finished after {PATIENCE:.0f} s")
                assert canvas.picture is not None
                yield name, Image.fromarray(canvas.picture).convert("RGB")
        finally:
            window.close()


def by_page(names: list[str], width: int) -> Iterator[tuple[str, Image.Image]]:
    """Pictures as exported pages show them, one page a planet."""
    from playwright.sync_api import sync_playwright

    from airlight.viewer.browser.page import export_page

    program = os.environ.get("AIRLIGHT_CHROMIUM") or shutil.which("chromium")
    size = {"width": width, "height": width * 9 // 16}
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as play:
        browser = play.chromium.launch(executable_path=program, headless=True, args=list(FLAGS))
        for planet, of_planet in groupby(names, lambda name: VIEWS[name].planet):
            file = Path(folder) / f"{planet}.html"
            export_page(planet, file)
            page = browser.new_page(viewport=size)
            page.set_default_timeout(1e3 * PATIENCE)
            page.goto(f"{file.as_uri()}?device=webgl2")
            page.wait_for_function("window.airlight !== undefined")
            for name in of_planet:
                scene = scene_of(VIEWS[name], load_planet(planet).bottom_radius, width)
                page.evaluate("(values) => airlight.state.move(values)", view_values(scene))
                page.evaluate("airlight.settled()")
                address = page.evaluate(PICTURE, list(size.values()))
                picture = base64.b64decode(address.partition(",")[2])
                yield name, Image.open(io.BytesIO(picture)).convert("RGB")
            page.close()
        browser.close()


BY: dict[str, Callable[[list[str], int], Iterator[tuple[str, Image.Image]]]] = {
    "processor": by_processor,
    "window": by_window,
    "page": by_page,
}


def main() -> None:
    """Draw the views and the sheet."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("names", nargs="*", default=list(VIEWS), help="views, by default all")
    parser.add_argument("--by", default="processor", choices=list(BY))
    parser.add_argument("--width", type=int, default=960, help="width of a picture [pixel]")
    parser.add_argument("--sheet", type=Path, help="file of the sheet, by default in the folder")
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    files = {name: given.folder / f"{name}.png" for name in VIEWS}
    started = time.perf_counter()
    for name, picture in BY[given.by](given.names, given.width):
        picture.save(files[name])
        print(f"{name}: {time.perf_counter() - started:.1f} s", flush=True)
        started = time.perf_counter()
    there = {name: file for name, file in files.items() if file.is_file()}
    sheet(there, given.sheet or given.folder / "sheet.png")


if __name__ == "__main__":
    main()
