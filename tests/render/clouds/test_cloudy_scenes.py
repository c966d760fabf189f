"""Clouds in scenes of several bodies, and before what is behind the air."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import xarray
from numpy.testing import assert_allclose

import airlight
from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics, droplets
from airlight.errors import ConflictError
from airlight.render.clouds.cloud_deck import CloudDeck
from airlight.render.clouds.clouds_around import CloudsAround
from airlight.render.render_scene import render_scene
from airlight.render.render_system import render_system
from airlight.render.solve_planet import solve_planet
from airlight.scene import Camera, Scene
from airlight.scene.system import System, load_system
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light
from airlight.scene.system.viewpoint import SceneObserver, View

pytestmark = pytest.mark.slow

NM = (680.0, 550.0, 440.0)
PLANET = "earth-atmosphere-plus"
SIZE = {"width": 48, "height": 36}


@pytest.fixture(scope="module")
def clouds(tmp_path_factory: pytest.TempPathFactory) -> list[dict[str, object]]:
    """Table of clouds: a wavy layer whose optical depth is 0.5 to 2.5."""
    at = (np.arange(16) - 7.5) * 200.0
    values = (1.5 + np.sin(2.0 * np.pi * at / 3200.0))[:, None, None] / 400.0 * np.ones((16, 4))
    axes = {"x": at, "y": at, "z": 1000.0 + 100.0 * (np.arange(4) + 0.5)}
    path = tmp_path_factory.mktemp("clouds") / "waves.nc"
    xarray.Dataset(
        {"extinction": (("x", "y", "z"), values, {"units": "m-1"})},
        {name: ((name,), one, {"units": "m"}) for name, one in axes.items()},
    ).to_netcdf(path, engine="scipy")
    return [{"file": str(path), "beyond": "periodic", "effective_radius": "6 um"}]


def test_a_planet_alone_in_a_scene_has_the_clouds_of_its_picture(
    clouds: list[dict[str, object]],
) -> None:
    """The sun in the east, 50 degrees high and in view; its disc is dimmed by the clouds."""
    sun = np.array([np.sin(np.radians(50.0)), np.cos(np.radians(50.0)), 0.0])
    system = System(
        name="x",
        bodies=(Body(name="earth", planet=PLANET),),
        lights=(Light(star=airlight.Star(spectrum="astm-g173"), direction=tuple(sun)),),
        observer=SceneObserver(body="earth"),
        view=View(look_zenith=40.5, look_bearing=90.0, field_of_view=4.0),
        changes={"earth": {"clouds": clouds}},
    )
    got, alone = (
        render_system(one, **SIZE, wavelengths=NM, quality="preview").rgb
        for one in (system, replace(system, changes={}))
    )
    seen = Camera(**SIZE, field_of_view=4.0, look_zenith=40.5, look_azimuth=0.0)
    scene = Scene(camera=seen, sun_zenith=40.0, sun_azimuth=90.0, ground="detailed")
    planet = airlight.load_planet(PLANET, {"clouds": clouds})
    wanted, clear = (
        render_scene(one, scene, wavelengths=NM, quality="preview").rgb
        for one in (planet, planet.without_clouds)
    )
    disc = clear.max(axis=-1) > 20.0 * np.median(clear)
    assert disc.any()
    assert_allclose(got[~disc], wanted[~disc], rtol=2e-3)
    dimmed = wanted[disc].sum(0) / clear[disc].sum(0)
    # noise below the cells is sampled once in a pixel there, and sixteen times here
    assert_allclose(got[disc].sum(0) / alone[disc].sum(0), dimmed, rtol=0.05)
    assert wanted[disc].max() < 0.7 * clear[disc].max()


def test_transmittance_to_space_is_that_of_the_slant_path() -> None:
    """Beer's law with the unscaled extinction, of an even layer; the shell curves by 0.4 %."""
    depth, zenith = 2.0, np.radians([0.0, 40.0, 65.0])
    field = CloudField(
        extinction=np.full((4, 4, 8), depth / 500.0, np.float32),
        spacing=(500.0, 500.0, 62.5),
        base=1000.0,
        beyond="periodic",
    )
    drops = droplets(10e-6, 0.1)
    deck = CloudDeck(field, lambda nm: CloudOptics.of_particles(drops, nm))
    around = CloudsAround((deck,))
    solution = solve_planet(airlight.load_planet(PLANET), NM, "preview", polarisation=False)
    through = around.before_space(solution, Scene(ground="plain"))
    rays = np.stack([np.sin(zenith), 0.0 * zenith, np.cos(zenith)], axis=-1)
    ratio = deck.optics_at(solution.wavelengths).extinction
    expected = np.exp(-depth * ratio / np.cos(zenith)[:, None])
    assert_allclose(through(rays), expected, rtol=0.01)
    assert_allclose(through(-rays[:1]), 1.0)


def test_clouds_in_a_moons_shadow_are_refused(clouds: list[dict[str, object]]) -> None:
    scene = load_system("solar-eclipse-2017", {"earth.clouds": clouds})
    with pytest.raises(ConflictError, match="clouds cannot be rendered in a moon's shadow"):
        render_system(scene, width=8, height=6, wavelengths=NM, quality="preview")
