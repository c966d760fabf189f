"""Live frames with clouds: coarse ones, the final one, and the loops that they need."""

from __future__ import annotations

from collections.abc import Callable
from typing import NoReturn

import numpy as np
import pytest

from airlight import Camera, Scene, replace
from airlight.clouds.planet_clouds import Box, clouds_of
from airlight.planets.clouds import CumulusHumilis
from airlight.render import render
from airlight.render.clouds import cloudy_pixel
from airlight.render.clouds.cloud_deck import CloudDeck
from airlight.render.clouds.cloud_light import FIRST
from airlight.render.clouds.clouds_around import CloudsAround
from airlight.render.clouds.lit_clouds import LitClouds
from airlight.render.live_renderer import LiveRenderer
from airlight.scene.picture_size import scaled
from airlight.solver.moments.solution import MomentsSolution

SCENE = Scene(
    camera=Camera(width=96, height=54, field_of_view=70.0, look_zenith=80.0, look_azimuth=60.0),
    altitude=2.0,
    sun_zenith=50.0,
)


@pytest.fixture(scope="module")
def clouds(lit: Callable[..., MomentsSolution]) -> LitClouds:
    """Cumuli of a small box, in a first light."""
    solution = lit()
    planet = replace(solution.planet, clouds=(CumulusHumilis(cover=0.4),))
    (field, _), *_ = clouds_of(planet, [550.0], Box(size=6400.0, spacing=100.0, levels=16))
    deck = CloudDeck(field, lambda nm: clouds_of(planet, nm, Box(size=6400.0))[0][1])
    around = CloudsAround((deck,), cache=False)
    return LitClouds.solve(around, planet, solution, SCENE, detail=FIRST)


def never() -> bool:
    return False


def test_no_live_frame_marches_its_pixels(
    clouds: LitClouds, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Reference: still pictures of the same sizes, whose pixels are marched.
    sizes = [(one.camera.width, one.camera.height) for one in (scaled(SCENE, 0.25), SCENE)]
    stills = {
        width: render(
            clouds.solution,
            replace(SCENE, camera=replace(SCENE.camera, width=width, height=height)),
            clouds=clouds,
        ).rgb
        for width, height in sizes
    }

    def marched(*_: object) -> NoReturn:
        raise AssertionError("marched")

    monkeypatch.setattr(cloudy_pixel, "march_cloudy", marched)
    monkeypatch.setattr(LiveRenderer, "_scales", lambda *_: iter([0.25, 1.0]))
    renderer = LiveRenderer()
    frames = list(renderer.live(clouds.solution, SCENE, clouds=clouds, stale=never))
    renderer.close()
    assert [one.finished for one in frames] == [False, True]
    for one, most in zip(frames, (0.02, 0.01), strict=True):
        assert one.frame is not None
        still = stills[one.frame.rgb.shape[1]]
        off = np.abs(one.frame.rgb - still) / still.mean()
        assert np.quantile(off, 0.95) < most
