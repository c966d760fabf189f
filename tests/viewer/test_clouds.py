"""Clouds in the viewer: its controls, its files, and its probe."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PIL import Image

from airlight import Camera, Ground, Medium, Scene, load_planet, solve
from airlight.errors import ParameterError
from airlight.planets.cloud_cover import mean_cover
from airlight.planets.reading.reader import planet_text, read_planet
from airlight.render import render
from airlight.scene.ground_overlay import ground_overlay
from airlight.solver.moments.solution import MomentsSolution
from airlight.viewer.painting.probe import probe_pixel
from airlight.viewer.session.session import Session

NM = (440.0, 510.0, 550.0, 680.0)
PLANET = "earth-atmosphere-plus"


@pytest.fixture
def clouds(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """Name of a picture of clouds in waves."""
    monkeypatch.chdir(tmp_path)
    ground_overlay.cache_clear()
    mean_cover.cache_clear()
    row, column = np.mgrid[0:90, 0:180]
    cover = 0.5 + 0.5 * np.sin(np.pi * column / 12.0) * np.cos(np.pi * row / 9.0)
    Image.fromarray((255.0 * cover).astype(np.uint8)).save("clouds.png")
    return "./clouds.png"


@pytest.fixture
def session(clouds: str) -> Session:
    """Session of a planet file that names clouds."""
    text, _, _ = planet_text(PLANET)
    Path("cloudy.toml").write_text(
        text.replace("[ground]\n", f'[ground]\nclouds = "{clouds}"\n'), encoding="utf-8"
    )
    return Session("cloudy.toml")


def ground_of(session: Session) -> Ground:
    """Ground of the planet that a session sends to the solver."""
    return read_planet(session.planet.text, "edited.toml").ground


def test_a_planet_with_clouds_has_their_controls(session: Session) -> None:
    # Offered with their defaults; an edit reaches the solver's ground, and is undone.
    assert session.value("ground.cloud_altitude") == 4.0
    before = ground_of(session).reflection
    session.set("ground.cloud_optical_depth", 30.0)
    session.set("ground.cloud_altitude", 10.0)
    ground = ground_of(session)
    assert (ground.cloud_optical_depth, ground.cloud_altitude) == (30.0, 1e4)
    assert ground.reflection == before._replace(cloud_optical_depth=30.0)
    with pytest.raises(ParameterError, match=r"ground\.cloud_optical_depth"):
        session.set("ground.cloud_optical_depth", -1.5)
    session.undo()
    session.undo()
    assert ground_of(session).reflection == before
    with pytest.raises(ParameterError):
        Session(PLANET).set("ground.cloud_altitude", 10.0)


def test_a_file_with_clouds_is_read_as_it_was_written(session: Session, clouds: str) -> None:
    # Round trip: parameters, a file's text, parameters.
    session.set("ground.cloud_optical_depth", 4.5)
    session.set("ground.cloud_altitude", 6.5)
    text = session.planet.text
    assert tomllib.loads(text)["ground"]["clouds"] == clouds
    ground = read_planet(text, "again.toml").ground
    assert (ground.clouds, ground.cloud_altitude) == (clouds, 6500.0)
    assert ground.cloud_optical_depth == 4.5


@pytest.mark.parametrize("ground", [{}, {"ground.law": "water", "ground.albedo": 0.02}])
def test_clouds_are_probed_as_they_are_drawn(clouds: str, ground: dict[str, object]) -> None:
    # The picture's own pixels, which draw from a sky-view LUT; water by one direction.
    changes = {"ground.clouds": clouds, "ground.cloud_altitude": "20 km", **ground}
    solution = solve(load_planet(PLANET, changes), NM, "preview", cache=False)
    assert isinstance(solution, MomentsSolution)
    camera = Camera(width=16, height=16, field_of_view=60.0, look_zenith=150.0, look_azimuth=70.0)
    for altitude in (4e5, 1.5e4):
        scene = Scene(camera=camera, altitude=altitude, sun_zenith=50.0, latitude=20.0,
                      longitude=10.0)  # fmt: skip
        rgb = render(solution, scene).rgb.astype(float)
        for x, y in ((4, 8), (8, 8), (11, 12)):
            seen = probe_pixel(solution, scene, x + 0.5, y + 0.5)
            assert seen is not None
            assert_allclose(seen.rgb, rgb[y, x], rtol=0.02 if ground else 5e-3)
    assert Medium.from_planet(load_planet(PLANET, changes), NM).ground.cover > 0.4
