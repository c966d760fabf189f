"""``GpuRenderer``: frames of a solution on the GPU, as radiance or displayed in a texture."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import Cancelled, ParameterError
from airlight.image.glare import checked_amount
from airlight.kernel.cost import DEVICE, timed
from airlight.kernel.large_arrays import release, zeros
from airlight.kernel.memory import check_drawn
from airlight.kernel.threads import Cancel, Progress
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import (
    empty_flat_texture,
    flat_texture,
    read_texture,
    update_flat,
)
from airlight.render.gpu.emit.shader_types import FLAT_WIDTH
from airlight.render.gpu.picture.bands import Band, bands
from airlight.render.gpu.picture.display_passes import LINEAR, DisplayPasses
from airlight.render.gpu.picture.frame_passes import FramePasses
from airlight.render.gpu.picture.light_sum import LightSum
from airlight.render.gpu.picture.shaders import (
    picture_shader,
    sky_air_shader,
    sky_peaks_shader,
    sky_polarised_shader,
)
from airlight.render.gpu.picture.solution_textures import SolutionTextures
from airlight.render.gpu.picture.uniforms import FRAME, LAYERS
from airlight.render.pixels.capacity import check_capacity
from airlight.render.pixels.march_points import FEW
from airlight.render.pixels.render_tables import WAVELENGTHS, pack_texels, render_tables
from airlight.render.pixels.scenes_by_light import SceneForLight, scenes_by_light
from airlight.render.pixels.sky_view_cpu import fill_sky_view
from airlight.render.pixels.sky_view_lut import Observer
from airlight.render.pixels.sky_view_window import COARSEST, SkyViewWindow
from airlight.render.pixels.view_uniforms import (
    checked_samples,
    display_uniforms,
    lamp_uniforms,
    observer_from,
    order_number,
    view_uniforms,
)
from airlight.scene import Scene
from airlight.scene.frame import Frame
from airlight.solver.moments.march_tables import MarchTables, quadratures
from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Default size of the sky-view LUT: azimuths from 0 to π, and rows of each half.
SKY_VIEW_SIZE: Final = COARSEST
#: Size on a page while the view moves.
MEDIUM_SKY_VIEW_SIZE: Final = (128, 64)
#: Size on a software GPU while the view moves.
QUICK_SKY_VIEW_SIZE: Final = (64, 64)
#: Pixels per submission: interpolated, marched, and marched in software. It stays below the
#: watchdog limits of drivers, and a strip that is read back takes 64 MiB at most.
_PIXELS_AT_ONCE: Final = (1 << 22, 1 << 20, 1 << 16)
#: Entry point of the pixel shaders.
_ENTRY: Final = "linear_picture"


@dataclass(eq=False)
class _SkyView:
    """Sky-view LUT of one light.

    Attributes
    ----------
    shape : (int, int)
        Azimuths, and rows of each half.
    layers : dict
        Textures by name.
    law : array or None
        Limb darkening of the light; None for that of the solution's star.
    disc : wgpu.GPUTexture or None
        Texture of ``law``.
    seen : tuple or None
        Key of the current contents; None before they are computed.
    """

    shape: tuple[int, int]
    layers: dict[str, Any]
    law: Float32Array | None = None
    disc: Any = None
    seen: tuple[Observer, float, float, bool] | None = None

    @classmethod
    def of(cls, device: Device, shape: tuple[int, int]) -> _SkyView:
        count = 3 * shape[0] * shape[1]
        return cls(shape, {name: empty_flat_texture(device, count, 4, name) for name in LAYERS})


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

    Examples
    --------
    >>> from airlight.render.gpu.device.device import open_device  # doctest: +SKIP
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
        self._sky_view_on_cpu = device.software if sky_view_on_cpu is None else sky_view_on_cpu
        self._passes = FramePasses(device)
        self._sum = LightSum(device)
        self._sky_views: list[_SkyView] = []
        self._solution: MomentsSolution | None = None
        self._textures: SolutionTextures | None = None
        self._given: FloatArray | None = None
        self._tables: MarchTables | None = None
        self._display = DisplayPasses(device)
        self.sky_view_size = sky_view_size

    @property
    def sky_view_size(self) -> tuple[int, int]:
        """Azimuths, and rows of each half, of the sky-view LUT."""
        return self._sky_view_size

    @sky_view_size.setter
    def sky_view_size(self, shape: tuple[int, int]) -> None:
        columns, rows = shape
        whole = columns >= 2 and rows >= 2 and 3 * columns * rows % FLAT_WIDTH == 0
        if not whole or 3 * columns * rows > FLAT_WIDTH * 4096:
            raise ParameterError(
                "sky_view_size", shape, "columns and rows whose product fills texture rows"
            )
        self._sky_view_size = (columns, rows)
        self._forget()

    def _forget(self) -> None:
        """Invalidate the sky-view LUTs and the displayed frame."""
        self._sky_views = [one for one in self._sky_views if one.shape == self._sky_view_size]
        if self._textures is not None and not self._sky_views:
            self._sky_views.append(_SkyView.of(self.device, self._sky_view_size))
        for number in range(len(self._sky_views)):
            self._read(number, None)
        self._display.rendered = None

    def _read(self, number: int, law: Float32Array | None) -> None:
        """Bind the tables of the solution, and the limb darkening of a light, to its passes."""
        assert self._textures is not None
        sky = self._sky_views[number]
        textures = {**self._textures.textures, **sky.layers}
        if law is not None:
            sky.disc = textures["disc"] = flat_texture(self.device, law, "disc")
        sky.law, sky.seen = law, None
        self._passes.read(textures, self._textures.places, number)

    def _sky(self, number: int, lit: MomentsSolution) -> _SkyView:
        """Sky-view LUT of a light."""
        while len(self._sky_views) <= number:
            self._sky_views.append(_SkyView.of(self.device, self._sky_view_size))
            self._read(len(self._sky_views) - 1, None)
        sky, law = self._sky_views[number], None
        if lit is not self._solution:
            law = pack_texels(lit.tables.darkening, lit.wavelengths.size)
        same = law is sky.law or (
            law is not None and sky.law is not None and np.array_equal(law, sky.law)
        )
        if not same:
            self._read(number, law)
        return sky

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
        if not isinstance(solution, MomentsSolution):
            raise ParameterError("solution", type(solution), "a solution of the moments solver")
        nm = solution.wavelengths
        check_capacity(nm.size)
        self._given = weights
        if weights is None:
            solution.lights[0].colors()  # refuses wavelengths without colours
        elif np.shape(weights) != (nm.size, 3):
            raise ParameterError("weights", np.shape(weights), f"an array of shape ({nm.size}, 3)")
        points = None if self.device.software else FEW.points
        self._tables = render_tables(solution, points=points)
        self._textures = SolutionTextures.of(
            self.device, solution, self._tables, self._textures, maps=maps
        )
        self._solution = solution
        self._forget()

    def render(
        self,
        scene: Scene,
        *,
        exact: bool = False,
        orders: str = "all",
        disc: bool = True,
        samples: int = 1,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> Frame:
        """Render a frame of linear radiance.

        Parameters
        ----------
        scene : Scene
            Observer, lights and camera; frames of several lights are added on the CPU.
        exact : bool
            Whether every pixel is marched; otherwise the sky-view LUT is interpolated.
        orders : str
            ``all``, ``single`` or ``multiple``.
        disc : bool
            Whether the star's disc is rendered.
        samples : int
            Samples per side of every pixel, 1 to 16. Pixels on the horizon and the limb are
            supersampled anyway, except if a software GPU marches them.

        Returns
        -------
        Frame
            Linear sRGB radiance. [W m⁻² sr⁻¹]
        """
        width, height = scene.camera.columns, scene.camera.rows
        check_drawn(width, height)
        lights = scenes_by_light(scene, self._require_solution())
        rendered = width * height * checked_samples(samples) ** 2 * len(lights)
        with timed(DEVICE, rendered, f"a picture of {width}x{height} pixels"):
            frames = [
                self._render(number, one, exact, orders, disc, samples, progress, cancel)
                for number, one in enumerate(lights)
            ]
        if len(frames) == 1:
            return frames[0]
        for one in frames[1:]:
            np.add(frames[0].rgb, one.rgb, out=frames[0].rgb)
        return replace(frames[0], scene=scene)

    def _render(
        self,
        number: int,
        light: SceneForLight,
        exact: bool,
        orders: str,
        disc: bool,
        samples: int,
        progress: Progress | None,
        cancel: Cancel | None,
    ) -> Frame:
        """Frame of one light; arguments of ``render``."""
        import wgpu

        scene, solution = light.scene, light.solution
        camera = scene.camera
        width, height = camera.columns, camera.rows
        limit = self.device.device.limits["max-texture-dimension-2d"]
        if width > limit:
            raise ParameterError("camera.width", width, f"at most {limit} pixels on the GPU")
        uniforms = self._uniforms(light, (camera.width, camera.height), exact, orders, disc)
        uniforms["first_column"] = camera.left
        if checked_samples(samples) > 1 and not uniforms["edges"]:
            raise ParameterError("samples", samples, "1 for an exact picture of a software GPU")
        uniforms["samples"] = samples
        rows = self._rows_at_once(samples * samples * width, height, exact)
        use = wgpu.TextureUsage
        target = self.device.device.create_texture(
            size=(width, rows, 1), format=LINEAR, usage=use.RENDER_ATTACHMENT | use.COPY_SRC
        )
        view = target.create_view()
        rgb = zeros((height, width, 3), np.float32)
        self._fill_sky_view(number, light, uniforms, exact)
        try:
            for first in range(0, height, rows):
                if cancel is not None and cancel():
                    raise Cancelled
                count = min(rows, height - first)
                strip = {**uniforms, "first_row": camera.top + first}
                self._passes.run(
                    picture_shader(exact), _ENTRY, strip, [view], (LINEAR,),
                    (0, 0, width, count), light=number,
                )  # fmt: skip
                rgb[first : first + count] = read_texture(self.device, target)[:count, :, :3]
                release(rgb[first : first + count])
                if progress is not None:
                    progress(first + count, height, "rendering")
        finally:
            target.destroy()
        return Frame(
            rgb=rgb,
            metadata={
                "solver": solution.report.provenance,
                "wavelengths": ", ".join(f"{nm:g}" for nm in solution.wavelengths) + " nm",
                "unit": "W m-2 sr-1, linear sRGB weighted by CIE 1931",
                "device": self.device.name,
            },
            pixel_angle=scene.camera.glare_angle,
            circle=scene.camera.circle,
            scene=scene,
            star_radius=solution.lights[0].angular_radius,
            origin=(camera.left, camera.top),
        )

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
        tone_map: str = "natural",
        encoding: str | None = "srgb",
        glare: float = 0.0,
        size: tuple[int, int] | None = None,
        uniforms: Mapping[str, float] | None = None,
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
        tone_map : str
            Name from ``TONE_MAPS``.
        encoding : str or None
            Name from ``ENCODINGS``; None for a target with its own encoding.
        glare : float
            Glare relative to a typical lens. [1]
        size : (int, int), optional
            Size of the target; by default the camera's. [pixel]
        uniforms : mapping, optional
            Further uniforms of the display, by name.

        Raises
        ------
        ParameterError
            If the amount of glare is not 0 to 10.
        """
        width, height = size or (scene.camera.width, scene.camera.height)
        lights = scenes_by_light(scene, self._require_solution())
        by_light = [self._uniforms(one, (width, height), exact, orders, disc) for one in lights]
        parts = [
            partial(self._render_light, *one, exact)
            for one in zip(range(len(lights)), lights, by_light, strict=True)
        ]
        if exposure is None:
            self._sum.render(parts, view, (width, height), target_format)
            return
        display = self._display
        picture = display.picture(width, height)
        rendered = exact, tuple(self._passes.packed(one).tobytes() for one in by_light)
        if display.rendered != rendered:
            display.rendered = None
            self._sum.render(parts, picture, (width, height), LINEAR)
            display.rendered = rendered
        values = {
            **display_uniforms(exposure, tone_map, encoding), "glare": checked_amount(glare),
            "circle": scene.camera.circle is not None, **(uniforms or {}),
        }  # fmt: skip
        display.display(values, scene.camera.glare_angle, view, target_format)

    def _render_light(
        self,
        number: int,
        light: SceneForLight,
        uniforms: dict[str, float],
        exact: bool,
        view: Any,
        target_format: str,
    ) -> None:
        """Render linear radiance of one light into a texture."""
        width, height = int(uniforms["width"]), int(uniforms["height"])
        self._fill_sky_view(number, light, uniforms, exact)
        if self.device.software and not exact:
            # A software GPU evaluates both sides of every branch: each band has a shader with only
            # the branches that it needs.
            for band in self._bands(light, uniforms):
                seen = {
                    **uniforms,
                    "mapped": uniforms["mapped"] * band.ground,
                    "wet": uniforms["wet"] * band.ground,
                    "draws_disc": uniforms["draws_disc"] * band.star,
                    "edges": uniforms["edges"] * band.edge,
                }
                self._passes.run(
                    picture_shader(exact, FRAME.fixed(seen)), _ENTRY, uniforms, [view],
                    (target_format,), (0, band.first, width, band.rows), band.first > 0, number,
                )  # fmt: skip
            return
        rows = self._rows_at_once(width, height, exact)
        for first in range(0, height, rows):
            self._passes.run(
                picture_shader(exact), _ENTRY, uniforms, [view], (target_format,),
                (0, first, width, min(rows, height - first)), first > 0, number,
            )  # fmt: skip

    def _uniforms(
        self, light: SceneForLight, size: tuple[int, int], exact: bool, orders: str, disc: bool
    ) -> dict[str, float]:
        """Uniforms of a frame of one light, without those of the display."""
        solution = light.solution
        assert self._textures is not None
        uniforms = view_uniforms(light.scene, solution) | self._textures.uniforms
        if solution is not self._solution:
            uniforms |= lamp_uniforms(solution) | {"star_radius": solution.tables.star_radius}
        peaks = 0.0 if exact else float(uniforms["separated_1"] >= 0)
        uniforms |= {
            "width": size[0],
            "height": size[1],
            "orders": order_number(orders),
            "draws_disc": float(disc and orders == "all" and uniforms["disc"] > 0.0),
            "sky_columns": self._sky_view_size[0],
            "sky_rows": self._sky_view_size[1],
            "separated_phases": peaks,
            "draws_air": float(light.air),
        }
        if exact and self.device.software:  # limited to 65 535 loop iterations per pixel
            uniforms["edges"] = 0.0
        if exact:
            uniforms |= {"separated_1": -1.0, "separated_2": -1.0}
        weights = np.zeros((WAVELENGTHS, 3))
        weights[: solution.wavelengths.size] = solution.lights[0].colors(self._given)
        for channel, column in zip(("red", "green", "blue"), weights.T, strict=True):
            uniforms |= {f"{channel}_{i}": float(value) for i, value in enumerate(column)}
        return uniforms

    def _rows_at_once(self, width: int, height: int, exact: bool) -> int:
        """Rows per submission."""
        pixels = _PIXELS_AT_ONCE[(2 if self.device.software else 1) if exact else 0]
        return min(max(1, pixels // width), height)

    def _bands(self, light: SceneForLight, uniforms: Mapping[str, float]) -> list[Band]:
        """Bands of rows, by what may be visible in them."""
        scene, solution = light.scene, light.solution
        width, height = int(uniforms["width"]), int(uniforms["height"])
        if (width, height) != (scene.camera.width, scene.camera.height):
            return [Band(0, height, True, True, True)]
        star = (uniforms["seen_x"], 0.0, uniforms["seen_z"])
        reach = 2.0 * solution.lights[0].angular_radius + 3.0 * uniforms["pixel_angle"]
        return bands(scene, uniforms["horizon_mu"], star, reach + solution.geometry.max_refraction)

    def _fill_sky_view(
        self, number: int, light: SceneForLight, uniforms: Mapping[str, float], exact: bool
    ) -> None:
        """Fill the sky-view LUT of a light if it is out of date."""
        sky = self._sky(number, light.solution)
        polarised = uniforms["filter"] > 0
        seen = (
            observer_from(uniforms),
            uniforms["separated_phases"],
            uniforms["star_radius"],
            polarised,
        )
        if exact or not light.air or seen == sky.seen:
            return
        if self._sky_view_on_cpu:
            self._upload_sky_view(sky, uniforms)
            sky.seen = seen
            return
        passes = [(sky_air_shader(), LAYERS[:2])]
        if uniforms["separated_phases"]:
            passes.append((sky_peaks_shader(), LAYERS[2:4]))
        if polarised:
            passes.append((sky_polarised_shader(), LAYERS[4:]))
        for shader, layers in passes:
            targets = [sky.layers[name] for name in layers]
            self._passes.run(
                shader, next(iter(shader.entries)), uniforms, targets, (LINEAR, LINEAR),
                light=number,
            )  # fmt: skip
        sky.seen = seen

    def _upload_sky_view(self, sky: _SkyView, uniforms: Mapping[str, float]) -> None:
        """Fill the sky-view LUT on the CPU and upload it."""
        assert self._tables is not None
        tables = self._tables._replace(
            rules=quadratures(FEW.points), panels=FEW.panels, star_radius=uniforms["star_radius"]
        )
        layers = fill_sky_view(
            tables, observer_from(uniforms), SkyViewWindow.whole(*self._sky_view_size),
            polarised=uniforms["filter"] > 0,
        )  # fmt: skip
        unread = () if uniforms["separated_phases"] else LAYERS[2:4]
        for name, layer in zip(LAYERS, layers, strict=True):
            if len(layer) > 1 and name not in unread:
                update_flat(self.device, sky.layers[name], 0, pack_texels(layer, WAVELENGTHS))

    def _require_solution(self) -> MomentsSolution:
        if self._solution is None:
            raise ParameterError("solution", None, "a solution set by set_solution()")
        return self._solution
