"""``SystemRenderer``: frames of scenes of several bodies on the CPU or the GPU."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from airlight.errors import ConflictError
from airlight.image.four_wavelengths import fitted_weights
from airlight.kernel.cache import Cache
from airlight.planets.picture_wavelengths import texel_wavelengths
from airlight.render.clouds.cloud_time import CloudTime
from airlight.render.gpu_system_renderer import GpuSystemRenderer, check_drawn_by_gpu
from airlight.render.render_scene import color_wavelengths
from airlight.render.render_system import render_system
from airlight.render.rendering_gpu import Choice, rendering_gpu
from airlight.render.solve_planet import solve_planets
from airlight.scene.frame import Frame
from airlight.scene.system import System

if TYPE_CHECKING:
    from airlight.render.gpu.device.device import Device

#: Renderer of the last frame on a GPU, with its shaders and maps.
_RENDERERS: Final[Cache[str, GpuSystemRenderer]] = Cache(1)
#: Wavelengths that the shaders hold.
_FOUR: Final = 4


@dataclass(frozen=True, kw_only=True)
class SystemRenderer:
    """Renderer of scenes of several bodies, which chooses the device.

    Attributes
    ----------
    device : "cpu", "gpu" or "auto"
        As for ``Renderer``: ``gpu`` falls back to the CPU for what the GPU does not draw.
    wavelengths : sequence of float, optional
        Wavelengths; by default those of ``render_system``, on the GPU the four of ``Renderer``.
        [nm]
    quality : str
        Quality as for ``airlight.solve``.
    samples : int, optional
        Samples per side of a pixel on an edge, as for ``render_system``.
    cache : bool
        Whether solutions are read from and stored on disk.
    refused : callable, optional
        Receives one line with the reason when ``gpu`` falls back to the CPU.
    """

    device: Choice = "cpu"
    wavelengths: Sequence[float] | None = None
    quality: str = "default"
    samples: int | None = None
    cache: bool = True
    refused: Callable[[str], None] | None = None

    def render(
        self,
        system: System,
        *,
        width: int = 1280,
        height: int = 720,
        crop: tuple[int, int, int, int] | None = None,
        clouds: Mapping[str, CloudTime] | None = None,
        **report: Any,
    ) -> Frame:
        """Render a scene.

        Parameters
        ----------
        system, width, height, crop, clouds :
            See ``render_system``.
        **report
            ``progress`` and ``cancel``, see ``airlight.kernel.threads``.
        """
        gpu = self._gpu(system, width if crop is None else crop[2])
        options: dict[str, Any] = {"quality": self.quality, "cache": self.cache, **report}
        size: dict[str, Any] = {"width": width, "height": height}
        size |= {"samples": self.samples, "crop": crop}
        if gpu is None:
            nm = self.wavelengths
            return render_system(system, wavelengths=nm, clouds=clouds, **size, **options)
        renderer = _RENDERERS.of(gpu.name, lambda: GpuSystemRenderer(gpu))
        set_live_solutions(renderer, system, self.wavelengths, **options)
        return renderer.render(system, **size, **report)

    def _gpu(self, system: System, width: int) -> Device | None:
        """GPU that can render a frame of so many columns; None for the CPU."""
        if self.device == "cpu":
            return None
        try:
            check_drawn_by_gpu(system)
        except ConflictError as reason:
            if self.device == "gpu" and self.refused is not None:
                self.refused(str(reason))
            return None
        count = _FOUR if self.wavelengths is None else len(self.wavelengths)
        found = None
        for planet in system.planets.values():
            found = rendering_gpu(self.device, planet, count, width, self.refused)
            if found is None:
                return None
        return found


def set_live_solutions(
    renderer: GpuSystemRenderer,
    system: System,
    wavelengths: Sequence[float] | None = None,
    quality: str = "default",
    **options: Any,
) -> None:
    """Solve the planets of a scene for a renderer on a GPU.

    Parameters
    ----------
    wavelengths : sequence of float, optional
        Wavelengths; by default four, with weights fitted to the first star. [nm]
    quality, **options :
        See ``solve_planets``.
    """
    weights = None
    if wavelengths is None:
        chosen = texel_wavelengths(next(iter(system.planets.values())))
        star = next(light for light in system.lights if light.star is not None)
        source = star.star_at(system.eye).source(star.name, chosen)
        nm = tuple(chosen.tolist())
        weights = fitted_weights(nm, source.spectrum)
    else:
        nm = color_wavelengths(wavelengths)
    renderer.set_solutions(solve_planets(system, nm, quality, **options), weights)
