"""Remake ``docs/images/planets/*.png``: each planet from its ground and from space.

Run with ``python builders/planet_pictures.py``, or with the names of the planets wanted; it needs
airlight itself and nothing else. Every preset becomes three pictures: from the ground with the sun
20 degrees high, from the ground with the sun on the horizon, and from space. Mars's sunset is
painted once more beside the shortcut that some programs take, Rayleigh scattering with its colours
swapped. Planets without ground or without air are shown from space alone. ``--preview`` is quicker
and coarser.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from airlight import Camera, Constituent, Planet, Scene, load_planet, replace, solve, write_picture
from airlight.errors import ConvergenceError
from airlight.image.display import resolve_exposure
from airlight.image.spectral import default_wavelengths
from airlight.planets.matter.phases import Rayleigh
from airlight.planets.matter.profiles import Exponential
from airlight.planets.spectral import PerWavelength
from airlight.render import render
from airlight.solver.moments.solution import MomentsSolution

FOLDER = Path(__file__).parents[1] / "docs" / "images" / "planets"
WIDTH, HEIGHT = 480, 270
#: The presets with a section in docs/planets.md.
PLANETS = (
    "earth",
    "earth-hazy",
    "earth-volcanic",
    "mars",
    "venus",
    "titan",
    "early-earth",
    "exoplanet",
    "moon",
    "jupiter",
    "saturn",
    "uranus",
    "neptune",
    "triton",
    "pluto",
)
#: Presets that are shown from space alone, at these phase angles. [deg]
DISCS = ("moon", "jupiter", "saturn", "uranus", "neptune", "pluto", "triton")
PHASES = {"full": 5.0, "half": 90.0, "crescent": 140.0}
BACKLIT = {"full": 15.0, "crescent": 140.0, "backlit": 165.0}
#: Rayleigh coefficients of Mars at 680, 550, 440 nm, of which the shortcut keeps the ratios.
#: Collienne, Wolff, Gerz & Jacob (2013), VMV 2013, turn their order round. [m⁻¹]
RAYLEIGH_OF_MARS = (0.1023e-6, 0.2429e-6, 0.6081e-6)


def views(planet: Planet) -> Iterator[tuple[str, Scene]]:
    """Name and scene of the three pictures of a planet."""
    if planet.name.lower() in DISCS:
        phases = BACKLIT if planet.name.lower() in ("pluto", "triton") else PHASES
        for name, phase in phases.items():
            yield name, from_space(planet, sun_zenith=phase)
        return
    high = Camera(width=WIDTH, height=HEIGHT, look_zenith=72.0, field_of_view=80.0)
    low = Camera(width=WIDTH, height=HEIGHT, look_zenith=80.0, field_of_view=60.0)
    yield "day", Scene(camera=high, sun_zenith=70.0, ground="detailed")
    yield "sunset", Scene(camera=low, sun_zenith=89.0, ground="detailed")
    yield "space", from_space(planet, sun_zenith=55.0, latitude=15.0)


def from_space(planet: Planet, **given: float) -> Scene:
    """Planet from six radii, north above, the sun on the left; the height is 1.15 diameters.

    Rings are whole, and seen and lit from 20 degrees to the north.
    """
    distance = 6.0 * planet.bottom_radius
    half = 1.15 * math.asin(planet.top_radius / distance)
    rings = max((one.outer_radius for one in planet.rings), default=0.0)
    wide = max(WIDTH / HEIGHT * math.tan(half), 1.05 * rings / distance)
    sun = 270.0
    if rings > 0.0:
        sun, given = 290.0, {"latitude": 20.0} | given
    far = Camera(
        width=WIDTH,
        height=HEIGHT,
        look_zenith=180.0,
        look_azimuth=360.0 - sun,
        field_of_view=2.0 * math.degrees(math.atan(wide)),
    )
    altitude = distance - planet.bottom_radius
    return Scene(camera=far, altitude=altitude, sun_azimuth=sun, ground="detailed", **given)


def reversed_rayleigh(mars: Planet) -> Planet:
    """Mars whose dust is a gas that scatters red most, with the dust's optical depth at 550 nm."""
    scale = 0.5 / (RAYLEIGH_OF_MARS[1] * 11e3)
    fake = Constituent(
        name="reversed gas",
        profile=Exponential(scale_height=11e3),
        scattering=PerWavelength(
            wavelengths=(680.0, 550.0, 440.0),
            values=tuple(scale * value for value in reversed(RAYLEIGH_OF_MARS)),
        ),
        phase_function=Rayleigh(),
    )
    return replace(mars, name="Mars, reversed", constituents=(fake,))


def solution_of(planet: Planet, wavelengths: NDArray[np.float64], quality: str) -> MomentsSolution:
    """The solution, with a word on how many orders it took."""
    solution = solve(planet, wavelengths, quality)
    print(f"{planet.name}: {solution.report}")
    return solution


def save(name: str, rgb: NDArray[np.float32]) -> None:
    """Write one picture with automatic exposure."""
    written = write_picture(FOLDER / f"{name}.png", rgb, exposure="auto")
    print(f"  {written.path.name}: {written.size} bytes at {written.exposure:.2f} EV")


def beside(left: NDArray[np.float32], right: NDArray[np.float32]) -> NDArray[np.float32]:
    """Two pictures with a dark line between, the right one as bright as the left."""
    scale = 2.0 ** (resolve_exposure(right, "auto") - resolve_exposure(left, "auto"))
    line = np.zeros((left.shape[0], 4, 3), np.float32)
    return np.hstack([left, line, right * np.float32(scale)])


def mars_and_fake(quality: str) -> None:
    """The blue sunset of Mars beside the shortcut."""
    mars = load_planet("mars")
    scene = dict(views(mars))["sunset"]
    true = render(
        solution_of(mars, default_wavelengths(16, *mars.wavelength_limits), quality), scene
    )
    fake = solution_of(reversed_rayleigh(mars), np.array([680.0, 550.0, 440.0]), quality)
    save("mars-sunset-true-and-reversed", beside(true.rgb, render(fake, scene).rgb))


def main() -> None:
    """Solve for each planet and write its pictures."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("planets", nargs="*", default=list(PLANETS))
    parser.add_argument("--preview", action="store_true", help="quicker and coarser")
    chosen = parser.parse_args()
    FOLDER.mkdir(parents=True, exist_ok=True)
    quality, count = ("preview", 8) if chosen.preview else ("default", 16)
    for name in chosen.planets:
        planet = load_planet(name)
        wavelengths = default_wavelengths(count, *planet.wavelength_limits)
        try:
            solution = solution_of(planet, wavelengths, quality)
        except ConvergenceError as error:
            print(f"{planet.name}: {error}")
            continue
        for view, scene in views(planet):
            save(f"{name}-{view}", render(solution, scene).rgb)
    if "mars" in chosen.planets:
        mars_and_fake(quality)


if __name__ == "__main__":
    main()
