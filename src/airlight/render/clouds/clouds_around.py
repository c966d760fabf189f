"""``CloudsAround``: the three-dimensional clouds of a picture."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass

from airlight.clouds.cloud_field import CloudField
from airlight.kernel.threads import Cancel, Progress
from airlight.render.clouds.cloud_light import CloudLight, OpticsAt, solve_clouds
from airlight.scene import Scene
from airlight.solver.moments.solution import MomentsSolution


@dataclass(frozen=True, eq=False)
class CloudsAround:
    """Clouds of a picture, whose light is solved for each light of the scene.

    Parameters
    ----------
    field : CloudField
        Extinction.
    optics_at : callable
        Optical properties of the particles at wavelengths, as ``CloudOptics.of_particles``.
    quality : str
        Quality of ``solve_box``.
    cache : bool
        Whether solutions are read from and stored on disk.
    """

    field: CloudField
    optics_at: OpticsAt
    _: KW_ONLY
    quality: str = "preview"
    cache: bool = True

    def lit(
        self,
        solution: MomentsSolution,
        scene: Scene,
        *,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> CloudLight:
        """Light of the clouds; parameters as those of ``solve_clouds``."""
        return solve_clouds(
            solution, scene, self.field, self.optics_at, quality=self.quality, cache=self.cache,
            progress=progress, cancel=cancel,
        )  # fmt: skip
