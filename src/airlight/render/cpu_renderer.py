"""``CpuRenderer``: radiance of pixels of one solution, scene and light on the CPU."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from airlight.kernel.threads import Cancel, Progress
from airlight.render.pixels.march_points import march_points
from airlight.render.pixels.night_tables import night_tables, no_night
from airlight.render.pixels.pixel import FrameTables, ViewUniforms
from airlight.render.pixels.polarising_filter import NONE
from airlight.render.pixels.render_cpu import march_pixels, render_pixels
from airlight.render.pixels.render_tables import render_tables
from airlight.render.pixels.ring_shine import no_shine, ring_shine
from airlight.render.pixels.sky_view_cpu import SkyViewLayers, fill_sky_view
from airlight.render.pixels.sky_view_window import (
    COARSEST,
    SkyViewWindow,
    coarse_window,
    sky_view_window,
)
from airlight.render.pixels.view_uniforms import (
    checked_samples,
    cpu_view_uniforms,
    is_always_marched,
    observer_from,
    order_number,
    overlay_uniforms,
    view_uniforms,
)
from airlight.scene.ground_overlay import ground_overlay
from airlight.scene.surface_map import surface_map
from airlight.solver.moments.march_tables import new_workspace

if TYPE_CHECKING:
    from airlight.render.clouds.before_surfaces import CloudsBefore
    from airlight.render.clouds.cloud_light import CloudLight
    from airlight.render.clouds.cloud_tables import CloudTables
    from airlight.scene import Scene
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]


@dataclass(eq=False)
class CpuRenderer:
    """Renderer of a scene under one light, row by row.

    Parameters
    ----------
    solution, scene, orders, exact :
        Arguments of ``render``.
    disc : bool
        Whether the star's own disc is rendered.
    samples : int
        Samples per side of every pixel.
    edges : bool
        Whether pixels on the horizon and the limb are supersampled.
    air : bool
        Whether atmosphere and ground are rendered; otherwise only the star's disc.
    stokes : bool
        Whether Stokes Q and U can be rendered too.
    clouds : sequence of CloudLight, optional
        Light of three-dimensional clouds, by ascending tops.
    cloud_directions, sky_view : (int, int), optional
        ``CloudsAround.directions`` and ``CloudsAround.sky_view``.

    Attributes
    ----------
    window : SkyViewWindow or None
        Window of the sky-view LUT; None where every pixel is marched.
    filled : SkyViewWindow or None
        The same, or a window without texels for the sea-sky LUT of marched pixels;
        None if there is nothing to fill.
    """

    solution: MomentsSolution
    scene: Scene
    _: KW_ONLY
    orders: str = "all"
    exact: bool = False
    disc: bool = True
    samples: int = 1
    edges: bool = True
    air: bool = True
    stokes: bool = False
    clouds: Sequence[CloudLight] = ()
    cloud_directions: tuple[int, int] | None = None
    sky_view: tuple[int, int] | None = None

    def __post_init__(self) -> None:
        solution, camera = self.solution, self.scene.camera
        tables, uniforms = solution.tables, view_uniforms(self.scene, solution)
        uniforms |= {
            "orders": order_number(self.orders),
            "draws_disc": float(self.disc and self.orders == "all" and uniforms["disc"] > 0.0),
            "draws_air": float(self.air),
            **overlay_uniforms(solution),
            "samples": float(checked_samples(self.samples)),
            "edges": float(self.edges),
        }
        if self.clouds:
            uniforms["flattening"] = 0.0
        if self.orders != "all":
            uniforms |= {"airglow": 0.0, "skyglow": 0.0}
        self._uniforms, self._camera = uniforms, camera
        self._polarised = self.stokes or uniforms["filter"] != NONE
        self._observer = observer_from(uniforms)
        self.window: SkyViewWindow | None = None
        if not self.exact and self.air and not is_always_marched(self.scene, solution):
            seen = camera, self._observer, tables.bottom, tables.top
            self.window = sky_view_window(*seen)
            if self.window is None and self.sky_view is not None:
                self.window = coarse_window(*seen, self.sky_view)
        self.filled, self._is_filled = self.window, False
        if self.window is None and self.air and tables.ground.wet:
            self.filled = SkyViewWindow(*COARSEST, 0, 1, 0, 0, 0, 0)
        resolution = march_points(solution)
        self._tables = render_tables(
            solution,
            peaks=self.window is not None,
            points=resolution.points,
            panels=resolution.panels,
        )
        name = solution.medium.surface.picture
        self._ground = None if name is None else surface_map(name)
        medium = solution.medium
        self._overlay = ground_overlay(*medium.surface.overlay)
        night = self._observer.sun_z < -self._observer.horizon_mu
        self._night = night_tables(solution) if night else no_night(tables.constituents)
        self._shine = no_shine(self._tables)
        if solution.medium.rings and self.air:
            sun = float(self.scene.ground_frame[2] @ self.scene.sun_direction)
            self._shine = ring_shine(self._tables, sun, solution.medium.flattening)
        self._view = cpu_view_uniforms(
            uniforms,
            camera,
            self._ground,
            self._overlay,
            SkyViewLayers.none(),
            self._night,
            self._shine,
        )
        self._weights = _lane_weights(solution)
        self._clouds: CloudTables | None = None
        alpha = solution.lights[0].angular_radius
        self._reach = 2.0 * (alpha + 3.0 * camera.pixel_angle) + solution.geometry.max_refraction

    def fill_sky_view(
        self, *, cancel: Cancel | None = None, progress: Progress | None = None
    ) -> None:
        """Fill the sky-view LUT, or what marched water needs; otherwise rendering does so."""
        if self.clouds and self._clouds is None and self.air:
            from airlight.render.clouds.air_table import DIRECTIONS
            from airlight.render.clouds.tables_of_frame import cloud_tables

            self._clouds = cloud_tables(
                self.clouds,
                self.solution,
                self.scene,
                self._tables,
                self._observer,
                directions=self.cloud_directions or DIRECTIONS,
                polarised=self._polarised,
                progress=progress,
                cancel=cancel,
            )
        if self.filled is None or self._is_filled:
            return
        layers = fill_sky_view(
            self._tables,
            self._observer,
            self.filled,
            polarised=self._polarised and self.window is not None,
            cancel=cancel,
            progress=progress,
        )
        self._view = cpu_view_uniforms(
            self._uniforms,
            self._camera,
            self._ground,
            self._overlay,
            layers,
            self._night,
            self._shine,
        )
        self._is_filled = True

    @property
    def clouds_before(self) -> CloudsBefore | None:
        """Clouds before surfaces of other pictures, after ``fill_sky_view``."""
        if self._clouds is None:
            return None
        from airlight.render.clouds.before_surfaces import CloudsBefore, diffuse_of

        return CloudsBefore(self._clouds, self._tables, self._observer, diffuse_of(self.clouds))

    def render_rows(
        self, first: int, last: int, rgb: Float32Array, element: int | None = None
    ) -> None:
        """Render rows ``first`` to ``last`` - 1, linear sRGB.

        Parameters
        ----------
        first, last : int
            Range of rows of the crop window.
        rgb : array, shape (rows, columns, 3)
            Receives the radiance. [W m⁻² sr⁻¹]
        element : int, optional
            ``ALONG`` or ``ASLANT`` of ``polarising_filter``: Q or U instead of I.
        """
        px = np.arange(rgb.shape[1]) + (self._camera.left + 0.5)
        py = np.arange(first, last) + (self._camera.top + 0.5)
        x, y = np.meshgrid(px, py)
        self.render_pixels(x.ravel(), y.ravel(), rgb[first:last].reshape(-1, 3), element)

    def render_pixels(
        self, px: FloatArray, py: FloatArray, rgb: Float32Array, element: int | None = None
    ) -> None:
        """Render pixels at given positions, linear sRGB.

        Parameters
        ----------
        px, py : array, shape (n,)
            Pixel centres, from the left and top edge of the uncropped frame. [pixel]
        rgb : array, shape (n, 3)
            Receives the radiance. [W m⁻² sr⁻¹]
        element : int, optional
            As in ``render_rows``.
        """
        self.fill_sky_view()
        view = self._view if element is None else self._view._replace(filter=element)
        frame, work = self._frame(view), new_workspace(self._tables)
        if self._clouds is not None:
            from airlight.render.clouds.cloud_tables import new_cloud_work
            from airlight.render.clouds.cloudy_pixel import BY_KINDS, CloudyWorkspace, march_cloudy

            kinds = len(self._clouds.layers)
            cloudy = march_cloudy if self.window is None else BY_KINDS[kinds - 1]
            with_clouds = CloudyWorkspace(work, self._clouds, new_cloud_work(self._clouds))
            cloudy(px, py, frame, with_clouds, self._weights, rgb)
            return
        pixels = march_pixels if self.window is None else render_pixels
        pixels(px, py, frame, work, self._weights, rgb)

    def _frame(self, view: ViewUniforms) -> FrameTables:
        window = SkyViewWindow.whole(0, 0) if self.filled is None else self.filled
        return FrameTables(self._reach, window, self._observer, view, self._tables)


def _lane_weights(solution: MomentsSolution) -> Float32Array:
    """Weights as the rows read them: shape (3, w), zero in lanes without a wavelength."""
    weights = solution.lights[0].colors()
    padded = np.zeros((3, solution.tables.lanes), np.float32)
    padded[:, : weights.shape[0]] = weights.T
    return padded
