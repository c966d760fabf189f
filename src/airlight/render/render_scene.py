"""``render_scene``: frame of a planet, solved and rendered on the CPU or the GPU."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np

from airlight.errors import Cancelled, ParameterError
from airlight.kernel.first_compilation import FIRST_COMPILATION
from airlight.kernel.memory import check_drawn
from airlight.kernel.threads import thread_count
from airlight.physics.units import values_in
from airlight.planets.picture_wavelengths import (
    LIVE,
    picture_wavelengths,
    texel_wavelengths,
)
from airlight.planets.reading.reader import PlanetLike, load_planet
from airlight.render.background_compilation import SKY_VIEW_LOOPS, start_sky_view_compiler
from airlight.render.pixels.sky_view_window import is_always_read
from airlight.render.renderer import Renderer
from airlight.render.rendering_gpu import Choice, rendering_gpu
from airlight.render.solve_planet import solve_planet
from airlight.render.star_points import add_catalogue, check_stars
from airlight.scene.basin import on_basin_floor
from airlight.scene.frame import Frame
from airlight.scene.local_ground import local_ground

if TYPE_CHECKING:
    from airlight.kernel.threads import Cancel, Progress
    from airlight.physics.units import Measures
    from airlight.scene import Scene
    from airlight.solver.moments.solution import MomentsSolution

#: Smallest number of wavelengths that gives colours.
FEWEST: Final = 3


class RenderedScene(NamedTuple):
    """Frame and the solution from which it was rendered.

    Attributes
    ----------
    frame : Frame
        Linear sRGB radiance. [W m⁻² sr⁻¹]
    solution : MomentsSolution
        Solution of the planet.
    """

    frame: Frame
    solution: MomentsSolution


def render_scene(
    planet: PlanetLike,
    scene: Scene,
    *,
    wavelengths: Measures | None = None,
    quality: str = "default",
    polarisation: bool = True,
    device: Choice = "cpu",
    exact: bool = False,
    orders: str = "all",
    samples: int = 1,
    stokes: bool = False,
    cache: bool = True,
    local: bool = True,
    stars: bool = False,
    refused: Callable[[str], None] | None = None,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Frame:
    """Solve a planet and render a scene.

    Parameters
    ----------
    planet : Planet, str, Path or Solution
        Planet to solve, see ``load_planet``.
    scene : Scene
        Observer, star and camera.
    wavelengths : array, shape (nl,), optional
        Wavelengths, at least three. By default sixteen over the visible; on the GPU the four that
        reproduce colours best, with a colour matrix fitted to the star. [nm]
    quality : str
        Quality as for ``airlight.solve``.
    polarisation : bool
        Whether transfer is vectorial, as for ``airlight.solve``.
    device : "cpu", "gpu" or "auto"
        ``gpu`` falls back to the CPU beyond the GPU's capacity; ``auto`` takes a hardware GPU.
    exact : bool
        Whether every pixel is marched; otherwise a sky-view LUT is interpolated.
    orders : str
        Orders of scattering as for ``airlight.render``.
    samples : int
        Samples per side of every pixel, as for ``airlight.render``.
    stokes : bool
        Whether the frame also has Stokes Q and U; CPU only.
    cache : bool
        Whether the CPU reads and stores solutions on disk.
    local : bool
        Whether a planet with a ground map is solved with the albedo around the observer
        (``airlight.local_ground``) instead of the planet's mean.
    stars : bool
        Whether the star catalogue is added, for planets with a known ``body``.
    refused : callable, optional
        Receives one line with the reason when ``gpu`` falls back to the CPU.

    Returns
    -------
    Frame
        Linear sRGB radiance [W m⁻² sr⁻¹]; its metadata name the device and the local ground.

    Examples
    --------
    >>> from airlight import Camera, Scene, load_planet
    >>> earth = load_planet("earth-atmosphere-plus")
    >>> scene = Scene(altitude=2.0, sun_zenith=60.0, camera=Camera(width=8, height=6))
    >>> frame = render_scene(earth, scene, wavelengths=(680, 550, 440), quality="preview")
    >>> frame.rgb.shape, frame.metadata["device"]
    ((6, 8, 3), 'CPU')
    """
    rendered = render_with_solution(
        planet, scene, wavelengths=wavelengths, quality=quality, polarisation=polarisation,
        device=device, exact=exact, orders=orders, samples=samples, stokes=stokes, cache=cache,
        local=local, stars=stars, refused=refused, progress=progress, cancel=cancel,
    )  # fmt: skip
    return rendered.frame


def render_with_solution(
    planet: PlanetLike,
    scene: Scene,
    *,
    wavelengths: Measures | None = None,
    quality: str = "default",
    polarisation: bool = True,
    device: Choice = "cpu",
    exact: bool = False,
    orders: str = "all",
    disc: bool = True,
    samples: int = 1,
    stokes: bool = False,
    cache: bool = True,
    local: bool = True,
    stars: bool = False,
    refused: Callable[[str], None] | None = None,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> RenderedScene:
    """Frame of ``render_scene`` together with its solution.

    Parameters
    ----------
    planet, scene, wavelengths, quality, polarisation, device, exact, orders, samples, stokes :
        Arguments of ``render_scene``.
    cache, local, stars :
        Arguments of ``render_scene``.
    disc : bool
        Whether the discs of the lights are rendered.
    refused, progress, cancel :
        Arguments of ``render_scene``.
    """
    planet = load_planet(planet, progress=progress, cancel=cancel)
    if stars:
        check_stars(planet.body, scene.camera.projection)
    nm: tuple[float, ...] | None = None
    if wavelengths is not None:
        nm = tuple(np.atleast_1d(values_in(wavelengths, "nm", "wavelengths")).tolist())
        if len(nm) < FEWEST:
            raise ParameterError("wavelengths", list(nm), f"{FEWEST} or more, or none given")
    if stokes and device != "cpu":
        if device == "gpu" and refused is not None:
            refused("the GPU does not render Q and U")
        device = "cpu"
    check_drawn(scene.camera.columns, scene.camera.rows, 3 if stokes else 1)
    count = LIVE if nm is None else len(nm)
    chosen = rendering_gpu(device, planet, count, scene.camera.columns, refused)
    weights, metadata = None, {}
    if nm is None:
        by_default = picture_wavelengths if chosen is None else texel_wavelengths
        nm = tuple(by_default(planet).tolist())
        if chosen is not None:
            from airlight.image.four_wavelengths import fitted_weights

            weights = fitted_weights(nm, planet.lights(nm)[0].spectrum)
            metadata = {"colour": "from four wavelengths, fitted to the star"}
    if scene.altitude < 0.0:
        requested = scene.altitude
        planet, scene = on_basin_floor(planet, scene)
        metadata["solved_floor"] = f"ground lowered to {requested - scene.altitude:.10g} m"
    if local:
        planet = local_ground(
            planet,
            latitude=scene.latitude,
            longitude=scene.longitude,
            altitude=scene.altitude,
        )
    with _compiling(chosen is None and not exact and is_always_read(scene.camera), cancel):
        solution = solve_planet(
            planet, nm, quality, polarisation=polarisation, cache=cache, progress=progress,
            cancel=cancel,
        )  # fmt: skip
    frame = Renderer(chosen).render(
        solution, scene, exact=exact, orders=orders, disc=disc, samples=samples, stokes=stokes,
        weights=weights, progress=progress, cancel=cancel,
    )  # fmt: skip
    if stars:
        add_catalogue(frame.rgb, scene, solution, planet.body)
        metadata["stars"] = "to magnitude 6.5"
    if solution.report.ground:
        metadata["solved_ground"] = solution.report.ground
    return RenderedScene(replace(frame, metadata={**frame.metadata, **metadata}), solution)


@contextmanager
def _compiling(reads_table: bool, cancel: Cancel | None) -> Iterator[None]:
    """Compile the rendering loops in another process meanwhile, unless they are on disk.

    The first frame on a machine takes longer to compile than to solve and render. Numba compiles
    one function at a time per process, so a second core needs a second process.
    """
    if not reads_table or thread_count() < 2:
        yield
        return
    ahead = start_sky_view_compiler()
    try:
        with FIRST_COMPILATION.elsewhere(SKY_VIEW_LOOPS):
            yield
            for loop in SKY_VIEW_LOOPS:
                if not ahead.wait(loop, cancel or (lambda: False)):
                    raise Cancelled("cancelled")
    finally:
        ahead.close()
