"""``GpuRenderer``: frames of a solution on the GPU, as radiance or displayed in a texture."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import Cancelled, ParameterError
from airlight.image.display_settings import DisplaySettings
from airlight.image.white_balance import White, star_white
from airlight.kernel.cost import DEVICE, timed
from airlight.kernel.large_arrays import release, zeros
from airlight.kernel.memory import check_drawn
from airlight.kernel.threads import Cancel, Progress
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import read_texture
from airlight.render.gpu.picture.bands import Window, bands_of, rows_at_once
from airlight.render.gpu.picture.display_passes import LINEAR, DisplayPasses, PictureLayer
from airlight.render.gpu.picture.frame_passes import FramePasses
from airlight.render.gpu.picture.shaders import transmittance_shader
from airlight.render.gpu.picture.sky_views import SkyViews
from airlight.render.gpu.picture.solution_textures import SolutionTextures
from airlight.render.gpu.picture.uniforms import FRAME, light_uniforms, weight_uniforms
from airlight.render.pixels.capacity import check_capacity
from airlight.render.pixels.march_points import FEW
from airlight.render.pixels.render_tables import render_tables
from airlight.render.pixels.scenes_by_light import SceneForLight, scenes_by_light
from airlight.render.pixels.sky_view_window import COARSEST
from airlight.render.pixels.view_uniforms import (
    checked_samples,
    display_uniforms,
    is_always_marched,
    order_number,
    view_uniforms,
)
from airlight.scene.frame import Frame
from airlight.scene.metering import unfiltered, white_luminance
from airlight.solver.moments.solution import MomentsSolution, moments_solution

if TYPE_CHECKING:
    from airlight.render.clouds.clouds_around import CloudsAround
    from airlight.scene import Scene

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Default size of the sky-view LUT: azimuths from 0 to π, and rows of each half.
SKY_VIEW_SIZE: Final = COARSEST
#: Size on a page while the view moves.
MEDIUM_SKY_VIEW_SIZE: Final = (128, 64)
#: Size on a software GPU while the view moves: within 2/255 of the marched picture.
QUICK_SKY_VIEW_SIZE: Final = (64, 32)


class GpuRenderer:
    """Renderer of the current solution, for any scene.

    Parameters
    ----------
    device : Device
        Device from ``open_device``.
    sky_view_size : (int, int)
        Azimuths and rows of the sky-view LUT; their product is a multiple of ``FLAT_WIDTH``.
    sky_view_on_cpu : bool, optional
        Whether the CPU fills the sky-view LUT; by default with software GPUs.

    Attributes
    ----------
    passes : FramePasses
        Passes of rendering.

    Examples
    --------
    >>> renderer = GpuRenderer(open_device())  # doctest: +SKIP
    >>> renderer.set_solution(solution)  # doctest: +SKIP
    >>> frame = renderer.render(Scene())  # doctest: +SKIP
    """

    def __init__(
        self,
        device: Device,
        sky_view_size: tuple[int, int] = SKY_VIEW_SIZE,
        *,
        sky_view_on_cpu: bool | None = None,
    ) -> None:
        self.device = device
        self.passes = FramePasses(device)
        on_cpu = device.software if sky_view_on_cpu is None else sky_view_on_cpu
        self._sky_views = SkyViews(device, self.passes, sky_view_size, on_cpu=on_cpu)
        self._solution: MomentsSolution | None = None
        self._textures: SolutionTextures | None = None
        self._given: FloatArray | None = None
        self._display = DisplayPasses(device)

    @property
    def sky_view_size(self) -> tuple[int, int]:
        """Azimuths, and rows of each half, of the sky-view LUT."""
        return self._sky_views.size

    def set_solution(
        self, solution: MomentsSolution, weights: FloatArray | None = None, *, maps: bool = True
    ) -> None:
        """Set the current solution.

        Parameters
        ----------
        solution : MomentsSolution
            Solution of at most four wavelengths; of one or two only with weights.
        weights : array, shape (nl, 3), optional
            Linear sRGB per radiance; by default ``picture_weights``.
        maps : bool
            Whether ground maps are used; they take up to 270 MB of GPU memory.
        """
        solution = moments_solution(solution, "a picture by a GPU")
        nm = solution.wavelengths
        check_capacity(nm.size)
        self._given = weights
        if weights is None:
            solution.lights[0].colors()  # refuses wavelengths without colours
        elif np.shape(weights) != (nm.size, 3):
            raise ParameterError("weights", np.shape(weights), f"an array of shape ({nm.size}, 3)")
        points = None if self.device.software else FEW.points
        tables = render_tables(solution, points=points)
        self._textures = SolutionTextures.of(
            self.device, solution, tables, maps=maps, weights=weights
        )
        self._solution = solution
        self._sky_views.load(solution, tables, self._textures)
        self._display.rendered = None

    def render(
        self,
        scene: Scene,
        *,
        exact: bool = False,
        orders: str = "all",
        disc: bool = True,
        samples: int = 1,
        clouds: CloudsAround | None = None,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> Frame:
        """Render a frame of linear radiance.

        Parameters
        ----------
        scene : Scene
            Observer, lights and camera; frames of several lights are added on the CPU.
        exact : bool
            Whether every pixel is marched; otherwise the sky-view LUT is read if it can be.
        orders : str
            ``all``, ``single`` or ``multiple``.
        disc : bool
            Whether the star's disc is rendered.
        samples : int
            Samples per side of every pixel, 1 to 16. Pixels on the horizon and the limb are
            supersampled anyway, except if a software GPU marches them, or clouds.
        clouds : CloudsAround, optional
            Three-dimensional clouds; the CPU solves their light.

        Returns
        -------
        Frame
            Linear sRGB radiance. [W m⁻² sr⁻¹]
        """
        camera = scene.camera
        width, height = camera.columns, camera.rows
        check_drawn(width, height)
        if width > (limit := self.device.device.limits["max-texture-dimension-2d"]):
            raise ParameterError("camera.width", width, f"at most {limit} pixels on the GPU")
        solution = self._require_solution()
        exact = exact or is_always_marched(scene, solution)
        lights = scenes_by_light(scene, solution)
        rendered = width * height * checked_samples(samples) ** 2 * len(lights)
        rgb = zeros((height, width, 3), np.float32)
        with timed(DEVICE, rendered, f"a picture of {width}x{height} pixels"):
            for number, light in enumerate(lights):
                uniforms = self.uniforms(light, (camera.width, camera.height), exact, orders, disc)
                if clouds is not None and self.device.software:
                    uniforms["edges"] = 0.0
                if samples > 1 and not uniforms["edges"]:
                    allowed = "1 for an exact picture, or clouds, of a software GPU"
                    raise ParameterError("samples", samples, allowed)
                uniforms |= {"first_column": camera.left, "samples": samples}
                if clouds is not None and light.air:
                    from airlight.render.gpu.picture.cloud_textures import set_clouds

                    number_of = scene.lights.index(light.light)
                    lit = clouds.lit(light.solution, light.scene, light=number_of)
                    uniforms |= set_clouds(self.passes, number, light, lit, uniforms, exact)
                    uniforms["flattening"] = 0.0
                for rows, strip in self._strips(number, light, uniforms, exact, cancel):
                    rgb[rows] += strip
                    release(rgb[rows])
                    if progress is not None:
                        progress(rows.stop, height, "rendering")
        return Frame.seen_by(
            camera,
            rgb,
            solution.wavelengths,
            {"solver": solution.report.provenance},
            device=self.device.name,
            scene=scene,
            star_radius=lights[0].solution.lights[0].angular_radius,
            star_white=star_white(lights[0].solution.lights[0].spectrum),
            white=white_luminance([one.light for one in lights], solution.lights, self._given),
            unfiltered=None
            if camera.polariser is None
            else self.render(unfiltered(scene), exact=exact, orders=orders, disc=disc),
        )

    def _strips(
        self,
        number: int,
        light: SceneForLight,
        uniforms: dict[str, float],
        exact: bool,
        cancel: Cancel | None,
    ) -> Iterator[tuple[slice, Float32Array]]:
        """Rows and linear sRGB of the strips of a frame of one light."""
        import wgpu

        camera = light.scene.camera
        width, height = camera.columns, camera.rows
        across = width * int(uniforms["samples"] ** 2)
        count = rows_at_once(across, height, exact, self.device.software)
        use = wgpu.TextureUsage
        target = self.device.device.create_texture(
            size=(width, count, 1), format=LINEAR, usage=use.RENDER_ATTACHMENT | use.COPY_SRC
        )
        view = target.create_view()
        try:
            if cancel is not None and cancel():
                raise Cancelled
            if count == height and camera.crop is None and uniforms["samples"] == 1:
                self._render_light(number, light, uniforms, exact, (width, height), view, LINEAR)
                yield slice(0, height), read_texture(self.device, target)[..., :3]
                return
            self._sky_views.fill(number, light, uniforms, exact)
            for first in range(0, height, count):
                if cancel is not None and cancel():
                    raise Cancelled
                rows = slice(first, min(first + count, height))
                strip = {**uniforms, "first_row": camera.top + first}
                self.passes.run(
                    self.passes.picture_shader(strip, exact, light=number),
                    strip,
                    [view],
                    (LINEAR,),
                    (0, 0, width, rows.stop - first),
                    light=number,
                )
                yield rows, read_texture(self.device, target)[: rows.stop - first, :, :3]
        finally:
            target.destroy()

    def display(
        self,
        scene: Scene,
        view: Any,
        target_format: str,
        *,
        exact: bool = False,
        orders: str = "all",
        disc: bool = True,
        exposure: float | None = None,
        size: tuple[int, int] | None = None,
        settings: DisplaySettings | None = None,
        scene_white: White | None = None,
    ) -> None:
        """Render and display into a texture.

        Linear radiance is cached: a change of display settings does not render again.

        Parameters
        ----------
        scene, exact, orders, disc :
            Arguments of ``render``.
        view : wgpu.GPUTextureView
            View of the target.
        exposure : float, optional
            Exposure; by default linear radiance is written. [EV]
        size : (int, int), optional
            Size of the target; by default the camera's. [pixel]
        settings : DisplaySettings, optional
            Display settings.
        scene_white : (float, float), optional
            Chromaticity of the scene's mean light, for the white balance ``scene``.
        """
        width, height = size or (scene.camera.width, scene.camera.height)
        lights = scenes_by_light(scene, self._require_solution())
        layer = self.layer(lights, (width, height), exact=exact, orders=orders, disc=disc)
        if exposure is None:
            self._display.add_layers([layer], view, (width, height), target_format)
            return
        self._display.render([layer], (width, height))
        values = {
            **display_uniforms(
                exposure,
                settings or DisplaySettings(),
                star_white(lights[0].solution.lights[0].spectrum),
                scene_white,
            ),
            "circle": scene.camera.circle is not None,
        }
        self._display.display(values, scene.camera.glare_angle, view, target_format)

    def layer(
        self,
        lights: Sequence[SceneForLight],
        size: tuple[int, int],
        *,
        exact: bool = False,
        orders: str = "all",
        disc: bool = True,
        window: Window | None = None,
    ) -> PictureLayer:
        """Passes of a frame of several lights.

        Parameters
        ----------
        lights : sequence of SceneForLight
            Scenes that add up, see ``scenes_by_light``.
        size : (int, int)
            Size of the frame. [pixel]
        exact, orders, disc :
            Arguments of ``render``.
        window : (int, int, int, int), optional
            First column and row, and size of the target in the frame; by default all. [pixel]
        """
        exact = exact or is_always_marched(lights[0].scene, self._require_solution())
        by_light = [self.uniforms(one, size, exact, orders, disc) for one in lights]
        target = size
        if window is not None:
            target = window[2:]
            for uniforms in by_light:
                uniforms |= {"first_column": window[0], "first_row": window[1]}
        return PictureLayer(
            [
                partial(self._render_light, *one, exact, target)
                for one in zip(range(len(lights)), lights, by_light, strict=True)
            ],
            lambda view, kind: self.passes.run(
                transmittance_shader(), by_light[0], [view], (kind,)
            ),
            (exact, tuple(self.passes.packed(one).tobytes() for one in by_light)),
        )

    def _render_light(
        self,
        number: int,
        light: SceneForLight,
        uniforms: dict[str, float],
        exact: bool,
        size: tuple[int, int],
        view: Any,
        target_format: str,
    ) -> None:
        """Render linear radiance of one light into a texture of a size."""
        width, height = size
        self._sky_views.fill(number, light, uniforms, exact)
        if self.device.software and not exact:
            # A software GPU evaluates both sides of every branch: each band has a shader with only
            # the branches that it needs.
            for band in bands_of(light, uniforms, size):
                seen = {
                    **uniforms,
                    "mapped": uniforms["mapped"] * band.ground,
                    "wet": uniforms["wet"] * band.ground,
                    "draws_disc": uniforms["draws_disc"] * band.star,
                    "edges": uniforms["edges"] * band.edge,
                }
                self.passes.run(
                    self.passes.picture_shader(uniforms, exact, FRAME.fixed(seen), number),
                    uniforms,
                    [view],
                    (target_format,),
                    (0, band.first, width, band.rows),
                    band.first > 0,
                    number,
                )
            return
        rows = rows_at_once(width, height, exact, self.device.software)
        for first in range(0, height, rows):
            self.passes.run(
                self.passes.picture_shader(uniforms, exact, light=number),
                uniforms,
                [view],
                (target_format,),
                (0, first, width, min(rows, height - first)),
                first > 0,
                number,
            )

    def uniforms(
        self,
        light: SceneForLight,
        size: tuple[int, int],
        exact: bool = False,
        orders: str = "all",
        disc: bool = False,
    ) -> dict[str, float]:
        """Uniforms of a frame of one light, without those of the display."""
        solution = light.solution
        assert self._solution is not None
        uniforms = view_uniforms(light.scene, solution) | self.textures.uniforms
        if solution is self._solution:
            uniforms |= weight_uniforms(solution.lights[0].colors(self._given))
        else:
            uniforms |= light_uniforms(self._solution, solution, self._given)
        peaks = 0.0 if exact else float(uniforms["separated_1"] >= 0)
        uniforms |= {
            "width": size[0],
            "height": size[1],
            "orders": order_number(orders),
            "draws_disc": float(disc and orders == "all" and uniforms["disc"] > 0.0),
            "sky_columns": self.sky_view_size[0],
            "sky_rows": self.sky_view_size[1],
            "separated_phases": peaks,
            "draws_air": float(light.air),
        }
        uniforms |= {} if orders == "all" else {"airglow": 0.0, "skyglow": 0.0}
        if exact and self.device.software:  # limited to 65 535 loop iterations per pixel
            uniforms["edges"] = 0.0
        return uniforms | ({"separated_1": -1.0, "separated_2": -1.0} if exact else {})

    @property
    def textures(self) -> SolutionTextures:
        """Textures of the solution."""
        self._require_solution()
        assert self._textures is not None
        return self._textures

    def _require_solution(self) -> MomentsSolution:
        if self._solution is None:
            raise ParameterError("solution", None, "a solution set by set_solution()")
        return self._solution
