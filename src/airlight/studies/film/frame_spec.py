"""Frame specifications: all parameters of a frame of a film, and its rendering."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Protocol

from airlight.errors import ConflictError
from airlight.image.four_wavelengths import fitted_weights
from airlight.kernel.cache import Cache
from airlight.kernel.cost import LINES
from airlight.planets.cloud_cover import cloud_file
from airlight.planets.clouds import CloudFile
from airlight.planets.parameters import replace as replaced
from airlight.planets.picture_wavelengths import picture_wavelengths, texel_wavelengths
from airlight.planets.planet import Planet
from airlight.render.clouds.cloud_time import CloudTime, clouds_at
from airlight.render.render_scene import render_solution
from airlight.render.rendering_gpu import Choice, rendering_gpu
from airlight.render.solve_planet import solve_planet
from airlight.render.star_points import add_catalogue
from airlight.render.system_renderer import SystemRenderer
from airlight.scene import Scene
from airlight.scene.frame import Frame
from airlight.scene.ground_overlay import lights_file, relief_file
from airlight.scene.picture_size import reduced
from airlight.scene.surface_map import map_file, water_file
from airlight.scene.system import System
from airlight.solver.moments.solve import solve_work
from airlight.studies.distribution.fingerprint import digest

if TYPE_CHECKING:
    from airlight.kernel.threads import Progress
    from airlight.render.gpu.device.device import Device
    from airlight.solver.moments.solution import MomentsSolution

#: Cost of a sky-view LUT, in pixels times wavelengths. [1]
_TABLE: Final = 1.5e6
#: Width of a frame that only prepares others. [pixel]
_SMALL: Final = 16
#: Solution of the last rendered frame, which the next frame usually shares.
_SOLUTIONS: Final[Cache[str, MomentsSolution]] = Cache(1)


@dataclass(frozen=True, kw_only=True)
class Quality:
    """Size and accuracy of the frames of a film.

    Attributes
    ----------
    width, height : int
        Size of a frame. [pixel]
    wavelengths : tuple of float, optional
        Wavelengths; by default ``picture_wavelengths``. [nm]
    quality : str
        Quality of the solutions.
    samples : int, optional
        Samples per side of a pixel; by default 1 of a planet, 4 at the edges of a scene.
    exact : bool
        Whether every pixel of a planet's frame is marched.
    device : "cpu", "gpu" or "auto"
        Renderer, as for ``render_scene``; a frame of a scene that the GPU does not draw is
        refused.
    """

    width: int = 1280
    height: int = 720
    wavelengths: tuple[float, ...] | None = None
    quality: str = "default"
    samples: int | None = None
    exact: bool = False
    device: Choice = "cpu"


class FrameSpec(Protocol):
    """Specification of one frame."""

    def render(self, width: int | None = None) -> Frame:
        """Render the frame.

        Parameters
        ----------
        width : int, optional
            Width of a smaller frame, for metering. [pixel]
        """

    def prepare(self, progress: Progress | None = None) -> None:
        """Solve and store the solution on disk."""

    def cost(self) -> dict[str, float]:
        """Work of rendering and solving, by kinds of ``kernel.cost``."""

    @property
    def solved_for(self) -> object:
        """Key of the solution, equal for frames that share it."""

    @property
    def defined_by(self) -> object:
        """All parameters of the frame."""

    @property
    def files(self) -> tuple[Path, ...]:
        """Input files of the frame."""

    def metadata(self) -> dict[str, str]:
        """Metadata for the file header."""

    def of_radiance(self) -> FrameSpec:
        """Specification of the frame with all its haze."""


@dataclass(frozen=True, kw_only=True)
class PlanetFrameSpec:
    """Frame of one planet.

    Solved with the star of the planet file, rendered with the irradiance at the scene's time.

    Attributes
    ----------
    planet : Planet
        Planet.
    scene : Scene
        Observer, sun and camera.
    how : Quality
        Size and accuracy.
    stars : bool
        Whether the star catalogue is added.
    clouds : CloudTime, optional
        Time of three-dimensional clouds; by default that of the first frame.
    """

    planet: Planet
    scene: Scene
    how: Quality
    stars: bool = False
    clouds: CloudTime | None = None

    def render(self, width: int | None = None) -> Frame:
        """See ``FrameSpec``."""
        solution, scene = self._solution(), self.scene
        if scene.time is not None:
            now = self.planet.lit_at(scene.time)
            solution = solution.with_light(now.lights(solution.wavelengths)[0])
        if width is not None:
            camera = scene.camera
            columns, rows = reduced(camera.projection, camera.width, camera.height, width)
            scene = replace(scene, camera=replace(camera, width=columns, height=rows))
        clouds = clouds_at(self.planet, scene, self.clouds, quality=self.how.quality)
        options: dict[str, Any] = {"exact": self.how.exact, "samples": self.how.samples or 1}
        gpu, weights = self._gpu, None
        if gpu is None:
            options["clouds"] = clouds
        elif self.how.wavelengths is None:
            weights = fitted_weights(solution.wavelengths, solution.lights[0].spectrum)
        frame = render_solution(solution, scene, gpu, weights, **options)
        if self.stars:
            add_catalogue(frame.rgb, scene, solution, self.planet.body, clouds)
        return frame

    def prepare(self, progress: Progress | None = None) -> None:
        """See ``FrameSpec``."""
        self._solution(progress)
        if self.planet.clouds:
            self.render(_SMALL)

    def cost(self) -> dict[str, float]:
        """See ``FrameSpec``."""
        how, camera = self.how, self.scene.camera
        nm = picture_wavelengths(self.planet) if how.wavelengths is None else how.wavelengths
        rendered = camera.width * camera.height * (how.samples or 1) ** 2 * len(nm)
        kind = LINES if how.exact else "picture"
        return {kind: float(rendered) + _TABLE, "solve": solve_work(how.quality, len(nm))}

    @property
    def _gpu(self) -> Device | None:
        """GPU that renders the frame; None for the CPU."""
        device, nm = self.how.device, self.how.wavelengths
        if self.planet.clouds:
            if device == "gpu":
                _refuse("the GPU does not render three-dimensional clouds")
            return None
        count = 4 if nm is None else len(nm)
        return rendering_gpu(device, self.planet, count, self.scene.camera.columns, _refuse)

    def _solution(self, progress: Progress | None = None) -> MomentsSolution:
        how, place, planet = self.how, self.scene.place, self.planet.without_clouds
        key = digest((planet, place, how), self.files)
        nm = how.wavelengths
        if nm is None and self._gpu is not None:
            nm = tuple(texel_wavelengths(planet).tolist())
        return _SOLUTIONS.of(
            key,
            lambda: solve_planet(planet, nm, how.quality, around=place, progress=progress),
        )

    @property
    def solved_for(self) -> object:
        """See ``FrameSpec``."""
        mapped = self.planet.ground.map is not None or self.planet.ground.clouds is not None
        return self.planet.without_clouds, self.scene.place if mapped else None

    @property
    def defined_by(self) -> object:
        """See ``FrameSpec``."""
        return self.planet, self.scene, self.how, self.stars, self.clouds

    @property
    def files(self) -> tuple[Path, ...]:
        """See ``FrameSpec``."""
        return _planet_files(self.planet)

    def metadata(self) -> dict[str, str]:
        """See ``FrameSpec``."""
        return {"planet": self.planet.name, **self.scene.metadata()}

    def of_radiance(self) -> PlanetFrameSpec:
        """See ``FrameSpec``."""
        hazy = replace(self.scene.camera, dehaze=0.0)
        return replace(self, scene=replace(self.scene, camera=hazy))


@dataclass(frozen=True, kw_only=True)
class SystemFrameSpec:
    """Frame of a scene of several bodies.

    Attributes
    ----------
    system : System
        Bodies, lights, observer and camera.
    how : Quality
        Size and accuracy.
    clouds : mapping
        Times of three-dimensional clouds by the names of planets; by default that of the first
        frame.
    """

    system: System
    how: Quality
    clouds: Mapping[str, CloudTime] = field(default_factory=dict)

    def render(self, width: int | None = None) -> Frame:
        """See ``FrameSpec``."""
        columns, rows = self.how.width, self.how.height
        if width is not None:
            columns, rows = reduced(self.system.view.projection, columns, rows, width)
        return self._render(columns, rows)

    def _render(self, width: int, height: int, progress: Progress | None = None) -> Frame:
        how = self.how
        renderer = SystemRenderer(
            device=how.device,
            wavelengths=how.wavelengths,
            quality=how.quality,
            samples=how.samples,
            refused=_refuse,
        )
        return renderer.render(
            self.system, width=width, height=height, clouds=self.clouds, progress=progress
        )

    def cost(self) -> dict[str, float]:
        """See ``FrameSpec``; samples at the edges of bodies are not counted."""
        how, planets = self.how, self.system.planets.values()
        counts = [
            len(picture_wavelengths(one) if how.wavelengths is None else how.wavelengths)
            for one in planets
        ]
        solves = sum(solve_work(how.quality, count) for count in counts)
        pixels = how.width * how.height
        return {"picture": float(pixels * max(counts, default=3)), "solve": solves}

    def prepare(self, progress: Progress | None = None) -> None:
        """See ``FrameSpec``."""
        how, projection = self.how, self.system.view.projection
        self._render(*reduced(projection, how.width, how.height, _SMALL), progress)

    @property
    def solved_for(self) -> object:
        """See ``FrameSpec``."""
        observer, changes = self.system.observer, self.system.changes
        moving = any(body.ground.map is not None for body in self.system.planets.values())
        return changes, self.system.bodies if moving else None, observer if moving else None

    @property
    def defined_by(self) -> object:
        """See ``FrameSpec``."""
        return self.system, self.system.planets, self.how, self.clouds

    @property
    def files(self) -> tuple[Path, ...]:
        """See ``FrameSpec``."""
        found = [file for one in self.system.planets.values() for file in _planet_files(one)]
        maps = [body.map for body in self.system.bodies if body.map is not None]
        return (*found, *(map_file(self.system.path_of(name)) for name in maps))

    def metadata(self) -> dict[str, str]:
        """See ``FrameSpec``."""
        moment = self.system.time
        return {} if moment is None else {"time": moment.isoformat()}

    def of_radiance(self) -> SystemFrameSpec:
        """See ``FrameSpec``."""
        return replace(
            self, system=replace(self.system, view=replaced(self.system.view, dehaze=0.0))
        )


def _refuse(reason: str) -> None:
    """Raise: frames of two devices in a film differ."""
    raise ConflictError("device", f"gpu cannot render a frame: {reason}")


def _planet_files(planet: Planet) -> tuple[Path, ...]:
    ground, found = planet.ground, []
    if ground.map is not None:
        found += [map_file(ground.map), water_file(ground.map)]
    if ground.deck is not None:
        found.append(map_file(ground.deck))
    if ground.lights is not None:
        found.append(lights_file(ground.lights))
    found += [cloud_file(one) for one in (ground.clouds, ground.clouds_from_space) if one]
    if ground.relief is not None:
        found.append(relief_file(ground.relief))
    for one in planet.clouds:
        if isinstance(one, CloudFile):
            path = Path(one.file)
            found += sorted(path.rglob("*")) if path.is_dir() else [path]
    return tuple(file for file in found if file.is_file())


def distinct_solutions(specs: Sequence[FrameSpec]) -> int:
    """Number of runs of successive frames with the same solution."""
    keys = [one.solved_for for one in specs]
    return 1 + sum(a != b for a, b in pairwise(keys))
