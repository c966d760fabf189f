"""Properties of ``render`` as a whole: the solution's radiance in every pixel, on any machine."""

from __future__ import annotations

import dataclasses
import subprocess
import sys
import tracemalloc
from collections.abc import Callable

import numpy as np
import pytest
from marched_pictures import centres
from numpy.testing import assert_allclose, assert_array_equal

from airlight import Camera, Cancelled, Scene
from airlight.image.spectral import rgb_weights
from airlight.render import render
from airlight.solver.moments.solution import MomentsSolution

Lit = Callable[..., MomentsSolution]

CAMERAS = {
    "perspective": Camera(width=48, height=27, look_azimuth=60.0),
    "fisheye": Camera(projection="fisheye", width=40, height=30, field_of_view=360.0),
    "equirectangular": Camera(projection="equirectangular", width=48, height=24, look_azimuth=70.0),
    "cubemap": Camera(projection="cubemap", width=72, height=12, look_azimuth=30.0),
}


def by_query(
    solution: MomentsSolution, scene: Scene, directions: np.ndarray, **settings: int
) -> np.ndarray:
    """Second path: radiance from the solution at the angles of the directions, as linear sRGB."""
    finer = MomentsSolution(
        solution.medium,
        dataclasses.replace(solution.settings, **settings),
        solution.moments,
        0.0,
    )
    x, y, z = np.moveaxis(directions, -1, 0)
    radiance = finer.radiance(
        altitude=scene.altitude,
        sun_zenith=scene.sun_zenith,
        view_zenith=np.degrees(np.arctan2(np.hypot(x, y), z)),
        azimuth=np.degrees(np.arctan2(y, x)),
    )
    return np.asarray(radiance) @ rgb_weights(
        solution.wavelengths, solution.planet.star.irradiances
    )


@pytest.mark.parametrize("projection", CAMERAS)
@pytest.mark.parametrize(("altitude", "sun_zenith"), [(2.0, 50.0), (35e3, 92.0), (400e3, 100.0)])
def test_a_pixel_is_the_radiance_of_its_direction(
    projection: str, altitude: float, sun_zenith: float, lit: Lit, tell: Callable[[str], None]
) -> None:
    solution, camera = lit(), CAMERAS[projection]
    scene = Scene(camera=camera, altitude=altitude, sun_zenith=sun_zenith)
    rgb = centres(solution, scene)
    directions = camera.directions()
    clear = directions @ scene.sun_direction < np.cos(4.0 * camera.pixel_angle + 0.01)
    clear &= (directions**2).sum(axis=-1) > 0.5
    chosen = np.random.default_rng(1).permutation(np.argwhere(clear))[:200]
    row, column = chosen.T
    expected = by_query(solution, scene, directions[row, column], march_nodes=24, march_panels=4)
    seen = rgb[row, column]
    scale = expected.max()
    error = np.abs(seen - expected) / (np.abs(expected) + 1e-4 * scale)
    tell(
        f"render preview, {projection} from {altitude:g} m, sun {sun_zenith:g}: "
        f"median {np.median(error):.1e}, worst {error.max():.1e}"
    )
    # preview marches with 8 points a leg; the solver's own tolerance for one case is 5 %
    assert_allclose(seen, expected, rtol=5e-2, atol=1e-4 * scale)
    assert np.median(error) < 3e-3


def test_the_picture_does_not_depend_on_the_number_of_threads(
    lit: Lit, monkeypatch: pytest.MonkeyPatch
) -> None:
    # each block writes its own rows, and a row's arithmetic is independent of the others
    scene = Scene(camera=CAMERAS["perspective"], altitude=35e3, sun_zenith=88.0)
    pictures = []
    monkeypatch.setattr(sys.modules["airlight.render.render"], "_BLOCK_PIXELS", 48)
    for threads in ("1", "3"):
        monkeypatch.setenv("AIRLIGHT_THREADS", threads)
        pictures.append(render(lit(), scene).rgb)
    assert_array_equal(pictures[0].view(np.uint32), pictures[1].view(np.uint32))


@pytest.mark.parametrize("pixels", [1, 100, 500])
def test_the_picture_does_not_depend_on_the_size_of_a_block(
    pixels: int, lit: Lit, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = Scene(camera=CAMERAS["perspective"], altitude=35e3, sun_zenith=88.0)
    whole = render(lit(), scene).rgb
    monkeypatch.setattr(sys.modules["airlight.render.render"], "_BLOCK_PIXELS", pixels)
    assert_array_equal(render(lit(), scene).rgb.view(np.uint32), whole.view(np.uint32))


def test_a_frame_says_how_it_was_made(lit: Lit) -> None:
    solution = lit()
    frame = render(solution, Scene(camera=Camera(width=4, height=2)))
    assert frame.rgb.dtype == np.float32
    assert frame.rgb.shape == (2, 4, 3)
    assert frame.metadata["wavelengths"] == "680, 550, 440 nm"
    assert frame.metadata["solver"] == solution.report.provenance
    assert "W m-2 sr-1" in frame.metadata["unit"]


def test_cancel_stops_the_picture(lit: Lit) -> None:
    with pytest.raises(Cancelled):
        render(lit(), Scene(camera=Camera(width=8, height=8)), cancel=lambda: True)


def test_progress_only_grows_and_ends_at_the_total(
    lit: Lit, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys.modules["airlight.render.render"], "_BLOCK_PIXELS", 16)
    reported: list[tuple[int, int, str]] = []
    render(
        lit(), Scene(camera=Camera(width=8, height=9)), progress=lambda *now: reported.append(now)
    )
    done = [now[0] for now in reported]
    assert done == sorted(set(done))
    assert reported[-1][:2] == (5, 5)  # nine rows, two a block
    assert {now[1:] for now in reported} == {(5, "rendering")}


def test_a_wide_strip_needs_little_more_than_its_pixels(lit: Lit) -> None:
    # blocks of 65 536 pixels: directions and their parts, float64, a few times 1.6 MB a thread;
    # the whole strip's directions alone would be 25 MB more for each doubling of the height
    solution = lit()
    camera = Camera(width=8192, height=64, field_of_view=10.0, look_zenith=30.0)
    scene = Scene(camera=camera, altitude=400e3)
    solution.tables  # noqa: B018  made once, before the measurement
    tracemalloc.start()
    try:
        frame = render(solution, scene)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak - frame.rgb.nbytes < 48e6


@pytest.mark.parametrize(
    "statement",
    [
        "from airlight import Frame, render",
        "import airlight.render; render = airlight.render",
        "import airlight; import airlight.scene.frame; render = airlight.render",
    ],
)
def test_render_is_a_function_however_it_was_imported(statement: str) -> None:
    code = f"{statement}; import sys; sys.exit(not callable(render))"
    subprocess.run([sys.executable, "-c", code], check=True)
