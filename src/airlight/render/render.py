"""``render``: frame of a solution, in blocks of rows on all CPU cores."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.image.white_balance import star_white
from airlight.kernel.cost import LINES, timed
from airlight.kernel.large_arrays import release, zeros
from airlight.kernel.memory import check_drawn
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.planets.picture_wavelengths import picture_wavelengths
from airlight.planets.reading.reader import PlanetLike, load_planet
from airlight.render.cpu_renderer import CpuRenderer
from airlight.render.pixels.polarising_filter import ALONG, ASLANT
from airlight.render.pixels.scenes_by_light import scenes_by_light
from airlight.scene import Scene
from airlight.scene.frame import Frame
from airlight.scene.local_ground import local_ground
from airlight.scene.metering import unfiltered, white_luminance
from airlight.solver import Solution
from airlight.solver.moments.solution import moments_solution
from airlight.solver.solve import solution_of

if TYPE_CHECKING:
    from airlight.render.clouds.clouds_around import CloudsAround

Float32Array = NDArray[np.float32]

#: Pixels in one block of rows: small, for load balancing between cores.
_BLOCK_PIXELS: Final = 1 << 13


def render(
    solution: Solution | PlanetLike,
    scene: Scene,
    *,
    orders: str = "all",
    exact: bool = False,
    disc: bool = True,
    samples: int = 1,
    stokes: bool = False,
    clouds: CloudsAround | None = None,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Frame:
    """Render a camera's view of a planet's air, its ground and the discs of its lights.

    Parameters
    ----------
    solution : MomentsSolution, Planet, str or Path
        Solution of at least three wavelengths; or a planet, preset name or path, which is solved
        as by ``render_scene``, with the albedo around the observer, at sixteen wavelengths.
    scene : Scene
        Observer, lights and camera; time is proportional to the number of lights.
    orders : str
        Orders of scattering and reflection: ``"all"``; ``"single"``, the first; or ``"multiple"``,
        the second and higher. The star's disc is visible only with ``"all"``.
    exact : bool
        Whether every pixel is marched. Otherwise radiance is interpolated in a sky-view LUT of the
        same march, see docs/pictures.md for its errors. Small frames are always marched.
    disc : bool
        Whether the discs of the lights are rendered.
    samples : int
        Samples per side of every pixel, 1 to 16. 1 suffices: pixels on the horizon and the limb
        are supersampled anyway.
    stokes : bool
        Whether the frame also has Stokes Q and U, in the meridian plane of each line of sight.
    clouds : CloudsAround, optional
        Three-dimensional clouds; by default those of a planet, and none of a solution.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.

    Returns
    -------
    Frame
        Linear sRGB radiance. [W m⁻² sr⁻¹]

    Raises
    ------
    ParameterError
        If the solution is not of the moments solver, ``orders`` or ``samples`` is out of range, or
        polarisation is requested of scalar transfer or behind a filter.
    CostError
        If the frame needs more memory than is free.
    Cancelled
        If ``cancel`` requested it.

    Examples
    --------
    >>> import airlight
    >>> solution = airlight.solve("mars-rayleigh", quality="preview")
    >>> scene = airlight.Scene(camera=airlight.Camera(width=16, height=9))
    >>> red, _, blue = render(solution, scene).rgb[0, 0]
    >>> bool(blue > red)  # gas alone scatters blue
    True
    """
    if not isinstance(scene, Scene):
        raise ParameterError("scene", scene, "a Scene")
    if not isinstance(solution, Solution):
        latitude, longitude, altitude = scene.place
        planet = load_planet(solution)
        if planet.clouds and clouds is None:
            from airlight.render.clouds.clouds_around import CloudsAround

            clouds = CloudsAround.of(planet, scene)
        planet = planet.without_clouds
        planet = local_ground(planet, latitude=latitude, longitude=longitude, altitude=altitude)
        solution = solution_of(planet, picture_wavelengths, progress=progress, cancel=cancel)
    solution = moments_solution(solution, "a renderer of a solution")
    if (stokes or scene.camera.polariser is not None) and not solution.polarised:
        field = "stokes" if stokes else "camera.polariser"
        value = True if stokes else scene.camera.polariser
        raise ParameterError(field, value, "a solution with polarised transfer")
    if stokes and scene.camera.polariser is not None:
        raise ParameterError("camera.polariser", scene.camera.polariser, "none with Q and U")
    width, height = scene.camera.columns, scene.camera.rows
    elements = (None, ALONG, ASLANT) if stokes else (None,)
    check_drawn(width, height, len(elements))
    pictures = scenes_by_light(scene, solution)
    rendered = width * height * samples**2 * len(elements) * len(pictures)
    kind = LINES if exact else "picture"
    layers = zeros((len(elements), height, width, 3), np.float32)
    with timed(kind, rendered * solution.wavelengths.size, f"a picture of {width}x{height} pixels"):
        for number, (seen, lit, air, light) in enumerate(pictures):
            renderer = CpuRenderer(
                lit,
                seen,
                orders=orders,
                exact=exact,
                disc=disc,
                samples=samples,
                air=air,
                stokes=stokes,
                clouds=()
                if clouds is None or not air
                else clouds.lit(
                    lit, seen, light=scene.lights.index(light), progress=progress, cancel=cancel
                ),
                cloud_directions=None if clouds is None else clouds.directions,
                sky_view=None if clouds is None else clouds.sky_view,
            )
            share = None if progress is None else _shared(progress, number, len(pictures))
            add_rendered(layers, renderer, elements, share, cancel, black=number == 0)
    return Frame.seen_by(
        scene.camera,
        layers[0],
        solution.wavelengths,
        {"solver": solution.report.provenance},
        polarised=layers[1:] if stokes else None,
        scene=scene,
        star_radius=solution.lights[0].angular_radius,
        star_white=star_white(solution.lights[0].spectrum),
        white=white_luminance([one.light for one in pictures], solution.lights),
        unfiltered=None
        if scene.camera.polariser is None
        else render(
            solution, unfiltered(scene), orders=orders, exact=exact, disc=disc, clouds=clouds
        ),
    )


def _shared(progress: Progress, number: int, count: int) -> Progress:
    """Progress callback for one of several lights."""
    return lambda done, total, message: progress(number * total + done, count * total, message)


def add_rendered(
    layers: Float32Array,
    renderer: CpuRenderer,
    elements: Sequence[int | None],
    progress: Progress | None,
    cancel: Cancel | None,
    *,
    black: bool,
) -> None:
    """Add the frame of one light to ``layers``, in blocks of rows.

    Parameters
    ----------
    layers : array, shape (elements, height, width, 3)
        Linear sRGB of each Stokes element. [W m⁻² sr⁻¹]
    renderer : CpuRenderer
        Renderer of the light.
    elements : sequence of int or None
        Stokes elements, see ``CpuRenderer.render_rows``.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.
    black : bool
        Whether ``layers`` are zero.
    """
    height, width = layers.shape[1:3]
    lit = layers if black else zeros(layers.shape, np.float32)
    step = max(1, _BLOCK_PIXELS // width)
    blocks = -(-height // step)
    # The sky-view LUT counts as half of the progress.
    total = blocks if renderer.filled is None else 2 * blocks

    def filling(done: int, count: int, message: str) -> None:
        if progress is not None:
            progress(blocks * done // count, total, message)

    def rendering(done: int, _: int, message: str) -> None:
        if progress is not None:
            progress(total - blocks + done, total, message)

    renderer.fill_sky_view(cancel=cancel, progress=filling)

    def render_block(k: int) -> None:
        first, last = k * step, min((k + 1) * step, height)
        for element, rgb, whole in zip(elements, lit, layers, strict=True):
            renderer.render_rows(first, last, rgb, element)
            if not black:
                whole[first:last] += rgb[first:last]
                release(whole[first:last])
            release(rgb[first:last])

    run_blocks(render_block, blocks, cancel=cancel, progress=rendering, message="rendering")
