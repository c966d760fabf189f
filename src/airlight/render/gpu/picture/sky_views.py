"""Sky-view LUTs of the lights of a scene on the GPU."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import empty_flat_texture, flat_texture, update_flat
from airlight.render.gpu.emit.shader_types import FLAT_WIDTH
from airlight.render.gpu.emit.uniform_struct import Place
from airlight.render.gpu.picture.display_passes import LINEAR
from airlight.render.gpu.picture.frame_passes import FramePasses
from airlight.render.gpu.picture.shaders import (
    sky_air_shader,
    sky_mirrored_shader,
    sky_peaks_shader,
    sky_polarised_shader,
)
from airlight.render.gpu.picture.solution_textures import SolutionTextures
from airlight.render.gpu.picture.uniforms import FRAME, LAYERS
from airlight.render.pixels.march_points import FEW
from airlight.render.pixels.render_tables import WAVELENGTHS, pack_texels
from airlight.render.pixels.scenes_by_light import SceneForLight
from airlight.render.pixels.sky_view_cpu import fill_sky_view
from airlight.render.pixels.sky_view_lut import Observer
from airlight.render.pixels.sky_view_window import SkyViewWindow
from airlight.render.pixels.view_uniforms import observer_from
from airlight.solver.moments.march_tables import MarchTables, quadratures

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution


@dataclass(frozen=True, eq=False)
class DiscTables:
    """Tables of a light's disc, in the layout of the shaders.

    Attributes
    ----------
    texels : array, shape (n, 4)
        Contents of the texture ``disc``: limb darkening, and the face of a moon.
    places : dict
        Start and axes of both.
    """

    texels: NDArray[np.float32]
    places: dict[str, Place]

    @classmethod
    def of(cls, lit: MomentsSolution) -> DiscTables:
        """Tables of the first light of a solution."""
        count = lit.wavelengths.size
        tables = {"darkening": lit.tables.darkening, "face": lit.tables.face}
        textures, places = FRAME.laid_out({k: pack_texels(x, count) for k, x in tables.items()})
        return cls(textures["disc"], places)


@dataclass(eq=False)
class SkyView:
    """Sky-view LUT of one light.

    Attributes
    ----------
    layers : dict
        Textures by name.
    law : DiscTables or None
        Tables of the light's disc; None for those of the solution's star.
    seen : tuple or None
        Key of the current contents; None before they are computed.
    """

    layers: dict[str, Any]
    law: DiscTables | None = None
    seen: tuple[Observer, float, float, bool] | None = None


class SkyViews:
    """Sky-view LUTs by light, renewed when observer, light or solution change.

    Parameters
    ----------
    device : Device
        Device from ``open_device``.
    passes : FramePasses
        Passes that read them.
    size : (int, int)
        Azimuths, and rows of each half; their product is a multiple of ``FLAT_WIDTH``.
    on_cpu : bool
        Whether the CPU fills them.
    """

    def __init__(
        self, device: Device, passes: FramePasses, size: tuple[int, int], *, on_cpu: bool
    ) -> None:
        columns, rows = size
        whole = columns >= 2 and rows >= 2 and 3 * columns * rows % FLAT_WIDTH == 0
        if not whole or 3 * columns * rows > FLAT_WIDTH * 4096:
            raise ParameterError(
                "sky_view_size", size, ("columns and rows whose product fills texture rows")
            )
        self.size = (columns, rows)
        self._device, self._passes, self._on_cpu = device, passes, on_cpu
        self._by_light: list[SkyView] = []

    def __getitem__(self, number: int) -> SkyView:
        return self._by_light[number]

    def load(
        self, solution: MomentsSolution, tables: MarchTables, textures: SolutionTextures
    ) -> None:
        """Set the solution, which invalidates all contents."""
        self._solution, self._tables, self._textures = solution, tables, textures
        for number in range(max(len(self._by_light), 1)):
            self._read(number, None)

    def _read(self, number: int, law: DiscTables | None) -> None:
        """Bind the tables of the solution, and those of a light's disc, to its passes."""
        if number == len(self._by_light):
            count = 3 * self.size[0] * self.size[1]
            layers = {one: empty_flat_texture(self._device, count, 4, one) for one in LAYERS}
            self._by_light.append(SkyView(layers))
        sky = self._by_light[number]
        textures, places = {**self._textures.textures, **sky.layers}, self._textures.places
        if law is not None:
            textures["disc"] = flat_texture(self._device, law.texels, "disc")
            places = {**places, **law.places}
        sky.law, sky.seen = law, None
        self._passes.read(textures, places, number)

    def _of(self, number: int, lit: MomentsSolution) -> SkyView:
        """Sky-view LUT of a light."""
        while len(self._by_light) <= number:
            self._read(len(self._by_light), None)
        sky, law = self._by_light[number], None
        if lit is not self._solution:
            law = DiscTables.of(lit)
        same = law is sky.law or (
            law is not None and sky.law is not None and np.array_equal(law.texels, sky.law.texels)
        )
        if not same:
            self._read(number, law)
        return sky

    def fill(
        self, number: int, light: SceneForLight, uniforms: Mapping[str, float], exact: bool
    ) -> None:
        """Fill the sky-view LUT of a light if it is out of date.

        Parameters
        ----------
        number : int
            Index of the light.
        light : SceneForLight
            Light.
        uniforms : mapping
            Uniforms of the frame.
        exact : bool
            Whether every pixel is marched, so that the LUT is read over water only.
        """
        sky = self._of(number, light.solution)
        peaks, polarised = uniforms["separated_phases"], uniforms["filter"] > 0
        seen = observer_from(uniforms), peaks, uniforms["star_radius"], polarised
        wet = uniforms["wet"] > 0 and uniforms["orders"] != 1
        if (exact and not wet) or not light.air or seen == sky.seen:
            return
        if self._on_cpu:
            self._upload(sky, uniforms)
        else:
            passes = [(sky_air_shader(), LAYERS[:2])]
            if peaks:
                passes.append((sky_peaks_shader(), LAYERS[2:4]))
            if polarised:
                passes.append((sky_polarised_shader(), LAYERS[4:6]))
            if wet:
                passes.append((sky_mirrored_shader(), LAYERS[6:]))
            for shader, layers in passes:
                targets = [sky.layers[name] for name in layers]
                formats = (LINEAR,) * len(targets)
                self._passes.run(shader, uniforms, targets, formats, light=number)
        sky.seen = seen

    def _upload(self, sky: SkyView, uniforms: Mapping[str, float]) -> None:
        """Fill a sky-view LUT on the CPU and upload it."""
        tables = self._tables._replace(
            rules=quadratures(FEW.points), panels=FEW.panels, star_radius=uniforms["star_radius"]
        )
        layers = fill_sky_view(
            tables,
            observer_from(uniforms),
            SkyViewWindow.whole(*self.size),
            polarised=uniforms["filter"] > 0,
        )
        unread = () if uniforms["separated_phases"] else LAYERS[2:4]
        for name, layer in zip(LAYERS, layers, strict=True):
            if len(layer) > 1 and name not in unread:
                update_flat(self._device, sky.layers[name], 0, pack_texels(layer, WAVELENGTHS))
