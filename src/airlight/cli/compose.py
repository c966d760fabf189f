"""``airlight compose``: atmosphere over another renderer's picture."""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from airlight.cli import options
from airlight.cli.console import examples, note, say, shown_progress
from airlight.cli.display_options import DisplayOptions
from airlight.cli.option_groups import OptionGroup, given_values, named_errors, option
from airlight.cli.place_options import PlaceOptions
from airlight.cli.planet_options import FileChanges, PlanetOptions
from airlight.cli.solve_options import Exact, SolveOptions
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from airlight.engines.composition import Composed, Pinhole, Placement
    from airlight.engines.composition.render_passes import RenderPasses
    from airlight.planets.planet import Planet
    from airlight.scene import Scene

EPILOG = examples(
    "airlight compose render.exr --camera camera.json --planet earth -o composed.exr",
    "airlight compose render.exr --depth depth.exr --camera transforms.json --sun-zenith 80 "
    "--sun-azimuth 250 -o composed.exr",
    "airlight compose beauty.exr --depth depth.exr --depth-kind inverse --camera camera.json "
    "--altitude 1500m --metres-per-unit 0.01 -o composed.png",
    "airlight compose render.exr --camera camera.json --at 46.6N,8E --time '2026-07-01 sunset' "
    "-o sunset.png",
    "airlight compose render.exr --albedo render.exr --normals render.exr --camera camera.json "
    "-o lit.exr",
)


@dataclass(frozen=True, kw_only=True)
class PassOptions(OptionGroup):
    """Options of the passes of a rendered picture, and of its camera."""

    color: Annotated[
        Path,
        typer.Argument(
            metavar="COLOR.exr", help="Rendered picture without atmosphere, linear sRGB."
        ),
    ]
    depth: Path | None = option("Depth pass, .exr (COLOR.exr).", "FILE")
    depth_kind: Literal["auto", "planar", "distance", "position", "inverse"] = option(
        "Depth kind: planar (along the camera's axis), distance (along the ray), position, "
        "inverse (1 / planar), or auto (by the channel's name).",
        "auto|planar|distance|position|inverse",
        "auto",
    )
    depth_channel: str | None = option("Channel of the depth, if it is not found.", "NAME")
    layer: str | None = option("Layer of the colour, if there are several.", "NAME")
    albedo: Path | None = option(
        "Albedo pass, to relight surfaces by the planet's sun and sky; requires --normals. An "
        ".exr with R, G, B or Blender's Diffuse Color; may be COLOR.exr.",
        "FILE",
    )
    normals: Path | None = option(
        "Normal pass in scene coordinates, an .exr with Normal; requires --albedo.", "FILE"
    )
    shadow: Path | None = option(
        "Shadow pass, visible fraction of the sun, 0 to 1; an .exr of one channel.", "FILE"
    )
    camera: Path | None = option(
        "Camera file transforms.json (default: worldToCamera and worldToNDC of COLOR.exr).", "FILE"
    )

    def read(self) -> tuple[RenderPasses, dict[str, Any]]:
        """Passes of the picture, and its depth as arguments of ``airlight.compose``."""
        from airlight.engines.composition.render_passes import read_render_passes

        passes = read_render_passes(self.color)
        holder = passes if self.depth is None else read_render_passes(self.depth)
        with named_errors("layer", "depth_channel"):
            rgb, alpha = passes.colors(self.layer)
            away, kind = holder.depth(self.depth_kind, self.depth_channel)
        return passes, {"rgb": rgb, "alpha": alpha, "depth": away, "depth_kind": kind}

    def surfaces(self) -> dict[str, Any]:
        """Passes by which surfaces are relit, as arguments of ``airlight.compose``."""
        from airlight.engines.composition.render_passes import read_render_passes

        for given, one, other, required in (
            ("--albedo", self.albedo, self.normals, "--normals"),
            ("--normals", self.normals, self.albedo, "--albedo"),
            ("--shadow", self.shadow, self.albedo, "--albedo and --normals"),
        ):
            if one is not None and other is None:
                raise ConflictError(given, f"requires {required}")
        if self.albedo is None or self.normals is None:
            return {}
        albedo, normals = read_render_passes(self.albedo), read_render_passes(self.normals)
        found: dict[str, Any] = {
            "albedo": albedo.vectors("RGB", ("Diffuse Color", "DiffCol", "")),
            "normals": normals.vectors("XYZ", ("Normal", "N", "")),
        }
        if self.shadow is not None:
            found["shadow"] = read_render_passes(self.shadow).only()
        return found

    def pinhole(self, passes: RenderPasses) -> tuple[Pinhole, dict[str, Any]]:
        """Camera of the picture at its size, and the block with the placement of the scene."""
        from airlight.engines.composition.pinhole import camera_from_json, camera_from_matrices

        width, height = passes.size
        if self.camera is not None:
            found, block = camera_from_json(self.camera, str(self.color), size=passes.size)
            try:
                return found.sized(width, height), block
            except ParameterError as error:
                raise error.in_file(self.camera) from None
        to_camera, to_ndc = (passes.header.get(name) for name in ("worldToCamera", "worldToNDC"))
        if to_camera is None or to_ndc is None:
            missing = f"is required: {self.color} lacks worldToCamera and worldToNDC"
            raise ConflictError("--camera", missing)
        return camera_from_matrices(to_camera, to_ndc, width, height), {}


@dataclass(frozen=True, kw_only=True)
class PlacementOptions(PlaceOptions):
    """Options of the placement of a scene on a planet; the observer is at its origin."""

    altitude: float | None = option("Altitude of the scene's origin (0m).", "LENGTH")
    heading: float | None = option("Compass bearing of the scene's +Y: NE, 45deg (N).", "BEARING")
    metres_per_unit: float | None = option("Length of the scene's unit in metres (1).", "NUMBER")
    up: Literal["z", "y"] | None = option("Up axis of the scene (z).", "z|y")

    def placement(self, block: dict[str, Any], scene: Scene | None) -> Placement:
        """Placement by the camera's block, overridden by options."""
        from airlight.engines.composition import Placement

        given: dict[str, Any] = self.numbers()
        given |= given_values(self, "metres_per_unit", "up", "heading")
        if scene is not None:
            for name in ("latitude", "longitude", "sun_zenith", "sun_azimuth"):
                given[name] = getattr(scene, name)
            if self.altitude_in_at:
                given["altitude"] = scene.altitude
        with named_errors(*given):
            return Placement.from_block(block, **given)


@dataclass(frozen=True, kw_only=True)
class ComposeSolveOptions(SolveOptions):
    """Options of the solution and of the composition."""

    exact: Exact = False


@dataclass(frozen=True, kw_only=True)
class WorldOptions(FileChanges):
    """Planet of a picture, and overrides of its file."""

    planet: str | None = option(
        "Planet: preset or TOML file (that of the camera file, or earth).", "PLANET"
    )

    def of(self, block: dict[str, Any]) -> PlanetOptions:
        """Planet of the option, or of the camera's block."""
        name = self.planet or block.get("planet", "earth")
        return PlanetOptions(planet=name, set_=self.set_, clouds=self.clouds)


def compose(
    passes: PassOptions,
    output: Annotated[
        Path, options.output_option("FILE", "Output picture: linear .exr or .hdr, or .png.")
    ],
    place: PlacementOptions,
    display: DisplayOptions,
    solve: ComposeSolveOptions,
    planet: WorldOptions,
    white: Annotated[
        str,
        typer.Option(
            metavar="NUMBER|radiance",
            help="Pixel value of a white surface facing the sun outside the atmosphere; or "
            "radiance, for pixels in W m⁻² sr⁻¹.",
        ),
    ] = "1",
    disc: Annotated[bool, typer.Option("--disc/--no-disc", help="Solar disc in the sky.")] = True,
) -> None:
    """Composite a planet's atmosphere over a rendered picture by its depth pass.

    The brightness scale of the picture is preserved; see docs/compose.md.
    """
    started = time.perf_counter()
    from airlight.engines.composition import compose as composed_over
    from airlight.render.clouds.cloud_time import clouds_at
    from airlight.render.picture import picture_suffix
    from airlight.scene import Scene

    suffix = picture_suffix(output)
    display.check(suffix)
    per_white = _white(white)
    picture, layers = passes.read()
    surfaces = passes.surfaces()
    pinhole, block = passes.pinhole(picture)
    chosen = planet.of(block)
    world = chosen.load()
    scene = place.scene(world) if place.timed else None
    if scene is not None:
        world = place.lit(world, scene)
    placement = place.placement(block, scene)
    solution = _solved(world.without_clouds, placement, solve)
    kind, passed = layers["depth_kind"], (layers.pop("rgb"), layers.pop("depth"))
    clouds = clouds_at(
        world,
        Scene(latitude=placement.latitude, longitude=placement.longitude),
        quality=solve.quality,
        cache=not solve.no_cache,
    )
    settings = {
        "clouds": clouds,
        "white": per_white,
        "exact": solve.exact,
        "disc": disc,
        **layers,
        **surfaces,
    }
    with shown_progress() as report:
        composed = composed_over(*passed, pinhole, solution, placement, progress=report, **settings)
    metadata = {
        "planet": solution.planet.name,
        "picture": passes.color.name,
        "depth_kind": kind,
        "white": white,
        "altitude": f"{composed.scene.altitude:.10g} m",
        "sun_zenith": f"{composed.scene.sun_zenith:.10g} deg",
        **chosen.changes(),
    }
    _write(output, suffix, composed, metadata, display)
    seconds = time.perf_counter() - started
    width, height = pinhole.width, pinhole.height
    how = f"{100.0 * composed.marched:.0f} % of the surfaces marched"
    if composed.error > 0.0:
        how += f", others within {100.0 * composed.error:.2f} %"
    say(f"{output}  {width}x{height}  {seconds:.1f} s  depth {kind}  {how}")
    if solution.report.ground:
        note(solution.report.ground)


def _white(text: str) -> float | None:
    """Parse ``--white``: a number above 0, or None for radiance."""
    if text.strip().lower() == "radiance":
        return None
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0.0 < value < 1e30:
        raise ParameterError("--white", text, "a number above 0, or radiance")
    return value


def _solved(world: Planet, place: Placement, solve: SolveOptions) -> Any:
    """Solution of the planet with the albedo around the scene."""
    from airlight.render.solve_planet import solve_planet

    nm = solve.picture_nm(world)
    around = place.latitude, place.longitude, max(place.altitude, 0.0)
    with shown_progress() as report:
        return solve_planet(world, nm, around=around, progress=report, **solve.keywords())


def _write(
    output: Path, suffix: str, composed: Composed, metadata: dict[str, str], display: DisplayOptions
) -> None:
    """Write the picture: linear on the scale of the input, or exposed."""
    from airlight.render.picture import LINEAR

    if suffix in LINEAR:
        from airlight.image.exr import write_exr
        from airlight.image.hdr import write_hdr
        from airlight.image.xyz import luminance
        from airlight.physics.constants import LUMINOUS_EFFICACY

        scale = ", ".join(f"{one:.6g}" for one in composed.scale)
        note = {"radiance_of_1": f"{scale} W m-2 sr-1, linear sRGB"}
        if suffix == ".hdr":
            write_hdr(output, composed.rgb, metadata | note)
            return
        white = LUMINOUS_EFFICACY * float(luminance(composed.scale))
        write_exr(output, composed.rgb, metadata | note, attributes={"whiteLuminance": white})
        return
    from airlight.render.picture import write_picture

    write_picture(output, composed.frame, metadata, **display.keywords())
