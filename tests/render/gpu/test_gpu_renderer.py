"""Pictures of the GPU against those of the CPU's renderer, which has its own line march.

Both march the same solution; the GPU in single precision, panel by panel, and from a sky-view LUT
unless it is asked to march every pixel. Pixels on the rim of the star's disc are left out; their
total is compared with a disc that is sampled many times a pixel.
"""

from __future__ import annotations

import gc
import weakref
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from marched_pictures import marched
from numpy.testing import assert_allclose, assert_array_equal
from sampled_disc import add_sun_disc

from airlight import (
    Camera,
    Cancelled,
    ParameterError,
    Planet,
    Scene,
    load_planet,
    look_at,
    render,
    replace,
    solve,
)
from airlight.image.display import to_display
from airlight.image.display_settings import DisplaySettings
from airlight.image.exposure import automatic_exposure
from airlight.image.four_wavelengths import four_wavelengths
from airlight.image.white_balance import star_white
from airlight.kernel.cache import Cache
from airlight.planets import Constituent
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import read_texture
from airlight.render.gpu.device.fragment_pass import FragmentPass
from airlight.render.gpu.picture import bands
from airlight.render.gpu.picture.gpu_renderer import GpuRenderer
from airlight.render.gpu.picture.uniforms import LAYERS
from airlight.render.pixels import march_points
from airlight.render.through_air import leaving_direction
from airlight.solver.moments.solution import MomentsSolution

NM = (440.0, 500.0, 560.0, 620.0)
#: Size of pictures of a camera. [px]
WIDTH, HEIGHT = 48, 27
Lit = Callable[..., MomentsSolution]
Shows = Callable[..., GpuRenderer]


def _many() -> Planet:
    """Earth with six constituents, two of them peaked."""
    earth = load_planet("earth-atmosphere-plus")
    gas, dust, ozone = earth.constituents
    more = [
        Constituent(
            name=f"{dust.name} {k}",
            profile=replace(dust.profile, scale_height=height),
            scattering=amount,
            absorption=0.1 * amount,
            phase_function=replace(dust.phase_function, asymmetry=asymmetry),
        )
        for k, (height, amount, asymmetry) in enumerate(
            [(500.0, 2e-5, 0.6), (3e3, 1e-6, -0.3), (15e3, 5e-7, 0.85)]
        )
    ]
    return replace(earth, constituents=(gas, dust, ozone, *more))


PLANETS: dict[str, Callable[[], Planet]] = {
    "earth, with a map": lambda: load_planet("earth"),
    "mars": lambda: load_planet("mars-standard"),
    "titan": lambda: load_planet("titan"),
    "earth, light straight": lambda: load_planet("earth", {"refraction": "none"}),
    "six constituents": _many,
    "ground of rock, light bent": lambda: load_planet("earth", {"ground.law": "lommel-seeliger"}),
    "sea, light bent": lambda: load_planet(
        "earth", {"ground.law": "water", "ground.wind": "8 m/s"}
    ),
}


@pytest.fixture(scope="module")
def lit(solved: Callable[..., MomentsSolution]) -> Lit:
    """Solution of one of ``PLANETS`` at four wavelengths, preview."""
    planets = {name: make() for name, make in PLANETS.items()}
    return lambda name="earth, with a map": solved(planets[name], NM, "preview")


@pytest.fixture(scope="module")
def shows(device: Device, lit: Lit) -> Shows:
    """Pictures that show one of ``PLANETS``."""
    pictures = GpuRenderer(device)

    def make(name: str = "earth, with a map") -> GpuRenderer:
        solution = lit(name)
        if pictures._solution is not solution:
            pictures.set_solution(solution)
        return pictures

    return make


def scene_of(planet: Planet, name: str) -> Scene:
    """Scene by name; heights as fractions of the planet.

    Radii in the shader are multiples of half a metre. So are heights where light is not refracted;
    where it is, optical ones are rounded, which near the ground would change the path to it by a
    per cent: there the observer is higher.
    """
    bottom, thick = planet.bottom_radius, planet.top_radius - planet.bottom_radius
    low = 20.0 if planet.refraction == "none" else 200.0
    limb, _ = look_at("horizon", altitude=4.0 * thick, sun_zenith=75.0, bottom_radius=bottom)
    view = {
        "noon": (low, 30.0, "perspective", 75.0, 30.0, None),
        "sunset": (low, 90.0, "perspective", 85.0, 10.0, None),
        "twilight": (low, 94.0, "perspective", 80.0, 10.0, None),
        "aloft": (0.35 * thick, 80.0, "perspective", 95.0, -20.0, None),
        "at the top": (thick, 80.0, "perspective", 95.0, -20.0, None),
        "in orbit": (4.0 * thick, 75.0, "perspective", limb, 20.0, None),
        "whole planet": (3.0 * bottom, 60.0, "perspective", 180.0, 20.0, 35.0),
        "far away": (1e8, 60.0, "perspective", 180.0, 20.0, 200.0 * bottom / 1e8),
        "dome": (low, 60.0, "fisheye", None, 0.0, None),
        "nadir": (0.5 * thick, 0.0, "fisheye", 180.0, 0.0, 220.0),
        "panorama": (0.1 * thick, 85.0, "equirectangular", None, 0.0, None),
        "cube": (4.0 * thick, 85.0, "cubemap", None, 0.0, None),
        "midnight": (0.2 * thick, 180.0, "perspective", 90.0, 0.0, None),
    }
    altitude, sun, projection, look, azimuth, fov = view[name]
    width, height = {"perspective": (WIDTH, HEIGHT), "fisheye": (36, 36), "cubemap": (72, 12),
                     "equirectangular": (48, 24)}[projection]  # fmt: skip
    camera = Camera(
        projection=projection, width=width, height=height, look_zenith=look, look_azimuth=azimuth,
        field_of_view=fov,
    )  # fmt: skip
    return Scene(altitude=altitude, sun_zenith=sun, camera=camera)


SCENES = ("noon", "sunset", "twilight", "aloft", "at the top", "in orbit", "whole planet",
          "far away", "dome", "nadir", "panorama", "cube", "midnight")  # fmt: skip
#: Scenes of the other planets: of each, two are marched and two drawn from the table, turn about,
#: the second in the validation.
PAIRS = (("noon", "aloft"), ("sunset", "in orbit"))


def cases(first: int) -> list[Any]:
    """All scenes of the Earth, and a pair of each other planet, beginning with the given one."""
    earth, *others = PLANETS
    pairs = [(name, PAIRS[(first + n) % 2]) for n, name in enumerate(others)]
    later = [pytest.param(n, one, marks=pytest.mark.validation) for n, (_, one) in pairs]
    return [(earth, scene) for scene in SCENES] + [(n, one) for n, (one, _) in pairs] + later


def away_from_the_rim(solution: MomentsSolution, scene: Scene) -> np.ndarray:
    """Pixels farther than two from the rim of the star's disc, unaffected by its distribution."""
    rays = scene.camera.directions()
    there = leaving_direction(rays.reshape(-1, 3), solution, scene.altitude)
    half = 0.5 * np.linalg.norm(there - scene.sun_direction, axis=-1)
    angle = 2.0 * np.arcsin(np.minimum(half, 1.0)).reshape(rays.shape[:2])
    reach = 2.0 * scene.camera.pixel_angle
    return np.asarray(np.abs(angle - solution.medium.star_angular_radius) > reach)


def solid_angles(camera: Camera) -> np.ndarray:
    """Solid angle of each pixel, from the corners' directions. [sr]"""
    a, b, c, d = (
        camera.directions(offset=(dx, dy))
        for dx, dy in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))
    )
    return 0.5 * np.linalg.norm(np.cross(c - a, d - b), axis=-1)


@pytest.mark.parametrize(("name", "scene"), cases(0))
def test_a_marched_picture_has_the_cpu_s_radiance(
    name: str, scene: str, device: Device, lit: Lit, shows: Shows, tell: Callable[[str], None],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    # The CPU marches with the points of its finest quality: those of its own preview err by 1 % at
    # low haze by day. 1 %, of the pixel's brightest channel: the others may be differences of
    # larger numbers.
    # Single precision contributes 1e-4, on lines that graze the ground 2e-3, fewer points 5e-3.
    # Light below 1e-4 of the picture's is negligible.
    monkeypatch.setitem(march_points.BY_PANELS, 1, march_points.MANY)
    solution, seen = lit(name), scene_of(PLANETS[name](), scene)
    wanted = marched(solution, seen, device).astype(float)
    rgb = shows(name).render(seen, exact=True).rgb
    assert np.isfinite(rgb).all()
    bright = np.abs(wanted).max(axis=2)
    error = np.abs(rgb - wanted).max(axis=2) / (bright + 1e-4 * np.quantile(bright, 0.99))
    error = error[away_from_the_rim(solution, seen)]
    tell(f"marched on the GPU, {name}, {scene}: {np.median(error):.1e}, at most {error.max():.1e}")
    assert bright.max() > 0.0
    # the gap under Titan's detached haze is a fraction of a step of the march
    assert error.max() < (0.04 if name == "titan" else 0.01)


@pytest.mark.parametrize(("name", "scene"), cases(1))
def test_a_picture_from_the_table_is_shown_as_the_cpu_s(
    name: str, scene: str, lit: Lit, shows: Shows
) -> None:
    # 2/255, tone mapped and encoded: invisible. The table has a quarter of the texels that it has
    # by default.
    solution, seen = lit(name), scene_of(PLANETS[name](), scene)
    wanted = render(solution, seen, exact=True).rgb
    exposure = automatic_exposure(wanted)
    shown = to_display(shows(name).render(seen).rgb, exposure).astype(int)
    difference = np.abs(shown - to_display(wanted, exposure)).max(axis=2)
    assert difference[away_from_the_rim(solution, seen)].max() <= 2


def test_without_the_maps_the_ground_is_alike_all_round(device: Device, lit: Lit) -> None:
    # By symmetry: under the sun in the zenith a ground of one colour is the same to all sides.
    seen = replace(scene_of(PLANETS["earth, with a map"](), "whole planet"), sun_zenith=0.0)
    pictures, uneven = GpuRenderer(device), []
    for maps in (True, False):
        pictures.set_solution(lit(), maps=maps)
        middle = pictures.render(seen, exact=True).rgb[10:17, 20:28]
        uneven.append(np.abs(middle / middle[:, ::-1] - 1.0).max())
    assert uneven[0] > 0.05
    assert uneven[1] < 1e-3


@pytest.mark.parametrize("exact", [False, True])
def test_a_filter_lets_the_same_light_through_as_the_cpu_s(
    exact: bool, lit: Lit, shows: Shows
) -> None:
    # bounds as above, of the table and of the march
    seen = scene_of(PLANETS["earth, with a map"](), "noon")
    for angle in (0.0, 55.0):
        camera = replace(seen.camera, polariser=angle, look_azimuth=90.0)
        filtered = replace(seen, camera=camera)
        wanted = render(lit(), filtered, exact=True).rgb
        rgb = shows().render(filtered, exact=exact).rgb
        bright = np.abs(wanted).max(axis=2, keepdims=True) + 1e-4 * np.abs(wanted).max()
        horizon = np.abs(camera.directions()[..., 2:]) < 2.0 * camera.pixel_angle
        assert (np.abs(rgb - wanted) < (0.01 if exact else 0.005) * bright + horizon).all()


@pytest.mark.parametrize("orders", ["single", "multiple"])
def test_orders_are_drawn_apart_as_by_the_cpu(
    orders: str, device: Device, lit: Lit, shows: Shows, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Bounds and points as above: of the march, and of the table.
    monkeypatch.setitem(march_points.BY_PANELS, 1, march_points.MANY)
    seen = scene_of(PLANETS["earth, with a map"](), "in orbit")
    wanted = render(lit(), seen, orders=orders, exact=True).rgb
    rgb = shows().render(seen, exact=True, orders=orders).rgb
    bright = np.abs(wanted).max(axis=2, keepdims=True) + 1e-4 * np.abs(wanted).max()
    error = np.abs(rgb - marched(lit(), seen, device, orders=orders))
    assert_array_equal(error < 0.01 * bright, True)
    exposure = automatic_exposure(wanted)
    shown = to_display(shows().render(seen, orders=orders).rgb, exposure).astype(int)
    assert np.abs(shown - to_display(wanted, exposure)).max() <= 2


def test_default_quality_is_drawn_as_well(
    device: Device, solved: Callable[..., MomentsSolution]
) -> None:
    # More radii, angles and harmonics than in preview: bounds as above, the table as by default.
    solution = solved(load_planet("earth"), NM, "default")
    seen = scene_of(load_planet("earth"), "aloft")
    pictures = GpuRenderer(device)
    pictures.set_solution(solution)
    wanted = render(solution, seen, exact=True).rgb
    free = away_from_the_rim(solution, seen)
    bright = np.abs(wanted).max(axis=2, keepdims=True) + 1e-4 * np.quantile(wanted, 0.99)
    error = np.abs(pictures.render(seen, exact=True).rgb - marched(solution, seen, device)) / bright
    assert error[free].max() < 0.01
    exposure = automatic_exposure(wanted)
    shown = to_display(pictures.render(seen).rgb, exposure).astype(int)
    assert np.abs(shown - to_display(wanted, exposure))[free].max() <= 2


#: Radius of the sun's disc in pixels: 26, 3.2, 2.3, 1.3, 0.4, 0.2.
FIELDS = (1.0, 8.0, 11.0, 20.0, 60.0, 100.0)


@pytest.mark.parametrize(
    ("name", "field"),
    [
        *(("earth, with a map", field) for field in FIELDS),
        *(("earth, light straight", field) for field in FIELDS[::2]),
    ],
)
def test_the_disc_s_light_does_not_depend_on_how_it_is_shared_out(
    name: str, field: float, lit: Lit, shows: Shows
) -> None:
    # The law: all pixels together hold the star's irradiance, whatever their size. 2 %: the CPU
    # counts 25 samples in each pixel of the rim, 48 points where it is small; the transmittance
    # comes from a table, accurate to 1 % where the sun is 70° high.
    solution = lit(name)
    camera = Camera(
        width=96, height=54, look_zenith=20.0 + 0.003 * field, look_azimuth=0.02 * field,
        field_of_view=field,
    )  # fmt: skip
    seen = Scene(altitude=0.0, sun_zenith=20.0, camera=camera)
    total = disc_total(shows(name), seen)
    assert_allclose(total, cpu_total(solution, seen), rtol=0.02)


@pytest.mark.parametrize("projection", ["fisheye", "equirectangular", "cubemap"])
@pytest.mark.parametrize("sun_zenith", [30.0, 60.0])
def test_a_small_disc_has_its_light_on_every_projection(
    projection: str, sun_zenith: float, lit: Lit, shows: Shows
) -> None:
    # As above, where pixels are neither square nor upright.
    width, height = {"fisheye": (64, 64), "equirectangular": (96, 48), "cubemap": (288, 48)}[
        projection
    ]
    camera = Camera(projection=projection, width=width, height=height)
    seen = Scene(altitude=0.0, sun_zenith=sun_zenith, camera=camera)
    assert_allclose(disc_total(shows(), seen), cpu_total(lit(), seen), rtol=0.02)


def test_the_setting_disc_has_the_cpu_s_light(
    device: Device, solved: Callable[..., MomentsSolution]
) -> None:
    # 1 % at 85°, where extinction without forward peaks makes it 1.5 % brighter; on the horizon
    # 4 %: there the depth is 15, and its table is accurate to 2e-3.
    solution = solved(load_planet("earth"), NM, "default")
    pictures = GpuRenderer(device, (64, 64))
    pictures.set_solution(solution)
    for sun_zenith, tolerance in ((85.0, 0.01), (90.0, 0.04)):
        camera = Camera(width=96, height=54, look_zenith=sun_zenith, field_of_view=3.0)
        seen = Scene(altitude=20.0, sun_zenith=sun_zenith, camera=camera)
        wanted = cpu_total(solution, seen)
        assert_allclose(disc_total(pictures, seen), wanted, rtol=tolerance)


def disc_total(pictures: GpuRenderer, seen: Scene) -> np.ndarray:
    """Contribution of the disc to all pixels of a picture of the GPU. [W m⁻²]"""
    with_disc = pictures.render(seen).rgb.astype(float)
    only = with_disc - pictures.render(seen, disc=False).rgb
    return np.asarray((only * solid_angles(seen.camera)[..., None]).sum(axis=(0, 1)))


def cpu_total(solution: MomentsSolution, seen: Scene) -> np.ndarray:
    """Contribution of the disc by samples. [W m⁻²]"""
    rgb = np.zeros((seen.camera.height, seen.camera.width, 3), np.float32)
    add_sun_disc(rgb, solution, seen, solution.lights[0].colors())
    return np.asarray((rgb * solid_angles(seen.camera)[..., None]).sum(axis=(0, 1)))


def test_a_point_star_has_no_disc(device: Device, lit: Lit) -> None:
    # A radius of 0 has no solid angle: only the light of the air is drawn.
    planet = PLANETS["six constituents"]()
    planet = replace(planet, star=replace(planet.star, angular_radius=0.0))
    pictures = GpuRenderer(device, (64, 64))
    solution = solve(planet, NM, quality="preview", cache=False)
    pictures.set_solution(solution)
    seen = scene_of(planet, "sunset")
    rgb = pictures.render(seen, exact=True).rgb
    wanted = marched(solution, seen, device)
    bright = np.abs(wanted).max(axis=2, keepdims=True)
    assert_array_equal(np.abs(rgb - wanted) <= 0.01 * bright, True)


def test_outside_the_circle_a_dome_is_black(shows: Shows) -> None:
    seen = scene_of(PLANETS["earth, with a map"](), "dome")
    outside = ~np.any(seen.camera.directions() != 0.0, axis=-1)
    assert outside.mean() > 0.17
    for exact in (True, False):
        assert_array_equal(shows().render(seen, exact=exact).rgb[outside], 0.0)


def test_the_shader_fills_the_table_as_the_cpu_does(device: Device, lit: Lit) -> None:
    # Two marches of the same light: fourth roots that agree to a quarter of 1 %. A filter asks for
    # all layers.
    layers = []
    scene = scene_of(PLANETS["earth, with a map"](), "aloft")
    scene = replace(scene, camera=replace(scene.camera, polariser=0.0))
    for by_cpu in (True, False):
        pictures = GpuRenderer(device, (64, 32), sky_view_on_cpu=by_cpu)
        pictures.set_solution(lit())
        pictures.render(scene)
        layers.append([read_texture(device, one) for one in pictures._sky_views[0].layers.values()])
    for name, cpu, shader in zip(LAYERS, *layers, strict=True):
        atol = 1e-3 * cpu.max(axis=(0, 1))
        near = np.abs(shader - cpu) <= 2.5e-3 * cpu + atol
        if name in LAYERS[:4]:
            assert near.all()
        else:  # single precision loses the sine of azimuths 0 and 180 next to the zenith
            assert near.mean() > 0.998


@pytest.mark.parametrize("exact", [True, False])
def test_a_picture_in_strips_is_the_whole_one(
    exact: bool, shows: Shows, monkeypatch: pytest.MonkeyPatch
) -> None:
    # The same arithmetic for each pixel: bit for bit.
    seen = scene_of(PLANETS["earth, with a map"](), "sunset")
    whole = shows().render(seen, exact=exact).rgb
    monkeypatch.setattr(bands, "_PIXELS_AT_ONCE", (WIDTH * 5,) * 3)
    said: list[tuple[int, int]] = []
    rgb = shows().render(seen, exact=exact, progress=lambda *one: said.append(one[:2])).rgb
    assert_array_equal(rgb.view(np.uint32), whole.view(np.uint32))
    assert said == [(min(5 * (k + 1), HEIGHT), HEIGHT) for k in range(6)]


def test_a_picture_can_be_cancelled_and_one_too_wide_is_refused(shows: Shows) -> None:
    with pytest.raises(Cancelled):
        shows().render(Scene(camera=Camera(width=8, height=8)), cancel=lambda: True)
    with pytest.raises(ParameterError, match=r"camera\.width is 16384; allowed: at most 8192"):
        shows().render(Scene(camera=Camera(width=16384, height=1)))


def test_bands_draw_the_same_picture(device: Device, shows: Shows) -> None:
    # Shaders with fewer choices, for the same numbers: only rounding may differ.
    import wgpu

    seen = scene_of(PLANETS["earth, with a map"](), "sunset")
    use = wgpu.TextureUsage.RENDER_ATTACHMENT | wgpu.TextureUsage.COPY_SRC
    target = device.device.create_texture(size=(WIDTH, HEIGHT, 1), format="rgba32float", usage=use)
    shows().display(seen, target.create_view(), "rgba32float")
    whole = replace(seen.camera, crop=(0, 0, WIDTH, HEIGHT))  # crops are drawn without bands
    rgb = shows().render(replace(seen, camera=whole)).rgb
    assert_allclose(read_texture(device, target)[..., :3], rgb, rtol=1e-4, atol=1e-6 * rgb.max())


@pytest.mark.parametrize(
    ("tone_map", "name", "exposure", "eye", "white"),
    [
        ("hable", "aloft", -2.0, False, "d65"),
        ("aces", "aloft", -2.0, False, 3500.0),
        ("natural", "aloft", -4.0, False, "auto"),
        ("natural", "dusk", 8.0, True, 3500.0),
    ],
)
def test_what_is_drawn_is_exposed_and_tone_mapped(
    tone_map: str,
    name: str,
    exposure: float,
    eye: bool,
    white: str | float,
    device: Device,
    shows: Shows,
) -> None:
    # The array functions by name, in double precision, of the same linear light: half of 1/255 for
    # rounding to 8 bits, each.
    import wgpu

    seen = scene_of(PLANETS["earth, with a map"](), "sunset" if name == "dusk" else name)
    seen = replace(seen, sun_zenith=99.0) if name == "dusk" else seen
    use = wgpu.TextureUsage.RENDER_ATTACHMENT | wgpu.TextureUsage.COPY_SRC
    target = device.device.create_texture(size=(WIDTH, HEIGHT, 1), format="rgba8unorm", usage=use)
    shows().display(
        seen, target.create_view(), "rgba8unorm", exposure=exposure,
        settings=DisplaySettings(tone_map=tone_map, eye=eye, glare=0.0, white_balance=white),
    )  # fmt: skip
    rgb = shows().render(seen).rgb
    star = star_white(None)
    wanted = to_display(rgb, exposure, tone_map, eye=eye, white_balance=white, star_white=star)
    # dither is the same number of the same pixel; the eye counts where it is dark
    other = to_display(rgb, exposure, tone_map, eye=not eye, white_balance=white, star_white=star)
    assert np.any(wanted != other) == eye
    shown = np.rint(255.0 * read_texture(device, target)[..., :3])
    assert_allclose(shown, wanted, rtol=0.0, atol=1.0)


def test_another_display_draws_no_light_again(
    device: Device, lit: Lit, monkeypatch: pytest.MonkeyPatch
) -> None:
    # What is kept in linear light has to give what is drawn anew, bit for bit; and another scene
    # or solution is drawn.
    import wgpu

    seen = scene_of(PLANETS["earth, with a map"](), "aloft")
    use = wgpu.TextureUsage.RENDER_ATTACHMENT | wgpu.TextureUsage.COPY_SRC
    target = device.device.create_texture(size=(WIDTH, HEIGHT, 1), format="rgba8unorm", usage=use)

    def shown(pictures: GpuRenderer, exposure: float, tone_map: str, scene: Scene) -> np.ndarray:
        settings = DisplaySettings(tone_map=tone_map, glare=0.0)
        pictures.display(
            scene, target.create_view(), "rgba8unorm", exposure=exposure, settings=settings
        )
        return read_texture(device, target)

    drawn: list[Scene] = []
    draw_light = GpuRenderer._render_light
    monkeypatch.setattr(
        GpuRenderer, "_render_light",
        lambda self, number, light, *others: (
            drawn.append(light.scene), draw_light(self, number, light, *others)
        ),
    )  # fmt: skip
    kept, other = (GpuRenderer(device, (64, 64)) for _ in range(2))
    kept.set_solution(lit())
    shown(kept, -2.0, "hable", seen)
    brighter = shown(kept, 1.0, "aces", seen)
    assert drawn == [seen]
    other.set_solution(lit())
    assert_array_equal(brighter, shown(other, 1.0, "aces", seen))
    turned = replace(seen, sun_zenith=seen.sun_zenith + 1.0)
    assert np.any(shown(kept, 1.0, "aces", turned) != brighter)
    kept.set_solution(lit("mars"))
    shown(kept, 1.0, "aces", turned)
    assert drawn == [seen, seen, turned, turned]


def test_fewer_wavelengths_leave_the_others_dark(device: Device, lit: Lit) -> None:
    # Light is linear in the wavelengths: one with its weights gives its contribution to the
    # picture of four. 2e-3: each solution has its own number of sweeps.
    planet = PLANETS["mars"]()
    seen = scene_of(planet, "noon")
    _, weights = four_wavelengths(planet.star.irradiances)
    whole = GpuRenderer(device, (64, 64))
    only = np.zeros_like(weights)
    only[2] = weights[2]
    whole.set_solution(lit("mars"), only)
    one = GpuRenderer(device, (64, 64))
    one.set_solution(solve(planet, NM[2:3], quality="preview", cache=False), weights[2:3])
    rgb = one.render(seen).rgb
    assert_allclose(rgb, whole.render(seen).rgb, rtol=2e-3, atol=1e-4 * np.abs(rgb).max())


def test_more_wavelengths_than_four_are_refused(device: Device) -> None:
    planet = load_planet("earth")
    solution = solve(planet, (400.0, *NM), quality="preview", cache=False)
    with pytest.raises(ParameterError, match="wavelengths is 5; allowed: at most 4 on the GPU"):
        GpuRenderer(device, (64, 64)).set_solution(solution)


def test_another_planet_leaves_nothing_of_the_first_and_an_edit_compiles_nothing(
    device: Device, lit: Lit, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Nobody else has the textures; the passes of a frame serve the next solution, although the
    # device keeps only the last of those not used lately.
    apart = device.duplicate()
    monkeypatch.setitem(vars(apart), "last_passes", Cache(1, 60.0))
    pictures = GpuRenderer(apart, (64, 64))
    pictures.set_solution(lit())
    pictures.render(scene_of(PLANETS["earth, with a map"](), "noon"))
    shown = {name: weakref.ref(one) for name, one in pictures.textures.textures.items()}
    beside = GpuRenderer(apart, (64, 64))
    beside.set_solution(lit())
    assert all(beside.textures.textures[one] is shown[one]() for one in ("ground", "overlay"))
    del beside
    seen = scene_of(PLANETS["mars"](), "noon")
    for _ in range(2):
        pictures.set_solution(lit("mars"))
        pictures.render(seen)
    gc.collect()
    assert [name for name, one in shown.items() if one() is not None] == []
    made = []
    monkeypatch.setattr(FragmentPass, "__init__", lambda *_: made.append(_))
    pictures.set_solution(lit("mars"))
    assert np.isfinite(pictures.render(seen).rgb).all()
    assert made == []
