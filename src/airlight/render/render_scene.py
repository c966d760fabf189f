"""``Renderer``: frames of a planet, solved and rendered on the CPU or the GPU."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import KW_ONLY, dataclass, replace
from typing import TYPE_CHECKING, Any, Final, NamedTuple

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
from airlight.render import render
from airlight.render.background_compilation import (
    MARCH_LOOPS,
    SKY_VIEW_LOOPS,
    cloudy_loops,
    start_cloudy_compiler,
    start_sky_view_compiler,
)
from airlight.render.pixels.scenes_by_light import scenes_by_light
from airlight.render.pixels.sky_view_window import is_always_read
from airlight.render.rendering_gpu import Choice, rendering_gpu
from airlight.render.solve_planet import solve_planet
from airlight.render.star_points import add_catalogue, check_stars
from airlight.scene.frame import Frame

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from airlight.kernel.threads import Cancel, Progress
    from airlight.physics.units import Measures
    from airlight.planets.planet import Planet
    from airlight.render.clouds.clouds_around import CloudsAround
    from airlight.render.gpu.device.device import Device
    from airlight.scene import Scene
    from airlight.solver.moments.solution import MomentsSolution

#: Value of the frame's metadata ``device`` for the CPU.
CPU: Final = "CPU"
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


@dataclass(frozen=True)
class Renderer:
    """Renderer of a planet, which chooses solver, device, wavelengths and local ground.

    Attributes
    ----------
    planet : Planet, str, Path or Solution
        Planet to solve, see ``load_planet``.
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
    disc : bool
        Whether the discs of the lights are rendered.
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
    """

    planet: PlanetLike
    _: KW_ONLY
    wavelengths: Measures | None = None
    quality: str = "default"
    polarisation: bool = True
    device: Choice = "cpu"
    exact: bool = False
    orders: str = "all"
    disc: bool = True
    samples: int = 1
    stokes: bool = False
    cache: bool = True
    local: bool = True
    stars: bool = False
    refused: Callable[[str], None] | None = None

    def render(
        self, scene: Scene, *, progress: Progress | None = None, cancel: Cancel | None = None
    ) -> RenderedScene:
        """Solve the planet for a scene and render it.

        Parameters
        ----------
        scene : Scene
            Observer, star and camera.
        progress, cancel : callable, optional
            See ``airlight.kernel.threads``.

        Raises
        ------
        ParameterError, ConvergenceError, Cancelled
            As ``render_scene``.
        """
        planet = load_planet(self.planet, progress=progress, cancel=cancel)
        clouds = self._clouds_around(planet, scene)
        planet = planet.without_clouds
        camera = scene.camera
        if self.stars:
            check_stars(planet.body, camera.projection)
        nm = None if self.wavelengths is None else color_wavelengths(self.wavelengths)
        check_drawn(camera.columns, camera.rows, 3 if self.stokes else 1)
        device = None
        if clouds is None or self._draws_clouds(clouds, scene):
            device = self._chosen_device(planet, LIVE if nm is None else len(nm), camera.columns)
        weights, metadata = None, {}
        if nm is None:
            by_default = picture_wavelengths if device is None else texel_wavelengths
            nm = tuple(by_default(planet).tolist())
            if device is not None:
                from airlight.image.four_wavelengths import fitted_weights

                weights = fitted_weights(nm, planet.lights(nm)[0].spectrum)
                metadata = {"colour": "from four wavelengths, fitted to the star"}
        if scene.altitude < 0.0:
            requested = scene.altitude
            planet, scene = scene.on_basin_floor(planet)
            metadata["solved_floor"] = f"ground lowered to {requested - scene.altitude:.10g} m"
        reads_table = device is None and not self.exact and is_always_read(camera)
        with _compiling(reads_table, clouds, cancel):
            solution = solve_planet(
                planet,
                nm,
                self.quality,
                polarisation=self.polarisation,
                cache=self.cache,
                around=scene.place if self.local else None,
                progress=progress,
                cancel=cancel,
            )
            if clouds is not None and len(scene.lights) == 1:
                # kept for the picture, while its loops are compiled
                seen, lit, _, _ = scenes_by_light(scene, solution)[0]
                clouds.lit(lit, seen, progress=progress, cancel=cancel)
        names = ("exact", "orders", "disc", "samples", *(["stokes"] if self.stokes else []))
        options = {name: getattr(self, name) for name in names}
        if clouds is not None:
            options["clouds"] = clouds
        frame = render_solution(
            solution, scene, device, weights, progress=progress, cancel=cancel, **options
        )
        if self.stars:
            add_catalogue(frame.rgb, scene, solution, planet.body, clouds)
            metadata["stars"] = "to magnitude 6.5"
        if solution.report.ground:
            metadata["solved_ground"] = solution.report.ground
        return RenderedScene(replace(frame, metadata={**frame.metadata, **metadata}), solution)

    def _clouds_around(self, planet: Planet, scene: Scene) -> CloudsAround | None:
        """Three-dimensional clouds."""
        if not planet.clouds:
            return None
        from airlight.render.clouds.clouds_around import CloudsAround

        return CloudsAround.of(planet, scene, quality=self.quality, cache=self.cache)

    def _draws_clouds(self, clouds: CloudsAround, scene: Scene) -> bool:
        """Whether the GPU is to draw clouds, and can."""
        if self.device != "gpu":
            return False
        from airlight.render.rendering_gpu import check_clouds

        try:
            check_clouds(clouds, scene)
        except ParameterError as reason:
            if self.refused is not None:
                self.refused(str(reason))
            return False
        return True

    def _chosen_device(self, planet: Planet, count: int, width: int) -> Device | None:
        """GPU for a frame of so many wavelengths and columns; None for the CPU."""
        if not self.stokes:
            return rendering_gpu(self.device, planet, count, width, self.refused)
        if self.device == "gpu" and self.refused is not None:
            self.refused("the GPU does not render Q and U")
        return None


def render_scene(
    planet: PlanetLike,
    scene: Scene,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
    **options: Any,
) -> Frame:
    """Solve a planet and render a scene.

    Parameters
    ----------
    planet : Planet, str, Path or Solution
        Planet to solve, see ``load_planet``.
    scene : Scene
        Observer, star and camera.
    **options
        Further attributes of ``Renderer``.

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
    return Renderer(planet, **options).render(scene, progress=progress, cancel=cancel).frame


def color_wavelengths(wavelengths: Measures) -> tuple[float, ...]:
    """Wavelengths of a frame. [nm]

    Raises
    ------
    ParameterError
        If there are fewer than ``FEWEST``.
    """
    nm = tuple(np.atleast_1d(values_in(wavelengths, "nm", "wavelengths")).tolist())
    if len(nm) < FEWEST:
        raise ParameterError("wavelengths", list(nm), f"{FEWEST} or more, or none given")
    return nm


def render_solution(
    solution: MomentsSolution,
    scene: Scene,
    device: Device | None = None,
    weights: NDArray[np.float64] | None = None,
    **options: Any,
) -> Frame:
    """Render a still frame of a solution, at once and at full resolution.

    Parameters
    ----------
    solution : MomentsSolution
        Solution of a planet.
    scene : Scene
        Observer, star and camera.
    device : Device, optional
        GPU, see ``rendering_gpu``; by default the CPU renders.
    weights : array, shape (nl, 3), optional
        Linear sRGB per radiance, on the GPU; by default ``picture_weights``.
    **options
        Further arguments of ``airlight.render`` or ``GpuRenderer.render``.

    Returns
    -------
    Frame
        Linear sRGB radiance [W m⁻² sr⁻¹]; its metadata name the device.

    Raises
    ------
    ParameterError
        If the solution or the frame exceeds the capacity of the GPU.
    Cancelled
        If ``cancel`` requested it.
    """
    if device is None:
        frame = render(solution, scene, **options)
    else:
        from airlight.render.gpu.picture.gpu_renderer import GpuRenderer

        gpu = GpuRenderer(device)
        gpu.set_solution(solution, weights)
        frame = gpu.render(scene, **options)
    return replace(frame, metadata={"device": CPU, **frame.metadata})


@contextmanager
def _compiling(
    reads_table: bool, clouds: CloudsAround | None, cancel: Cancel | None
) -> Iterator[None]:
    """Compile the rendering loops in another process meanwhile, unless they are on disk.

    The first frame on a machine takes longer to compile than to solve and render. Numba compiles
    one function at a time per process, so a second core needs a second process.
    """
    if not reads_table or thread_count() < 2:
        if clouds is None:
            FIRST_COMPILATION.expect(SKY_VIEW_LOOPS if reads_table else MARCH_LOOPS)
        yield
        return
    if clouds is None:
        loops, compiler = SKY_VIEW_LOOPS, start_sky_view_compiler()
    else:
        kinds = len(clouds.decks)
        loops, compiler = cloudy_loops(kinds), start_cloudy_compiler(kinds)
    try:
        with FIRST_COMPILATION.elsewhere(loops):
            yield
            for loop in loops:
                if not compiler.wait(loop, cancel or (lambda: False)):
                    raise Cancelled("cancelled")
    finally:
        compiler.close()
