"""Oblate planets in pictures against Monte Carlo in the spheroid, which has nothing from airlight.

Reference: paths backward from the camera along straight lines, null collisions, sunlight at every
collision and on the ground. Altitude over a convex body is convex along a line, so a density
extrapolated at its slope is never exceeded: the majorant of Woodcock et al. (1965). Lengths in km.
"""

from __future__ import annotations

from functools import cache
from math import cos, exp, log, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
import pytest
from numba import njit
from numpy.testing import assert_allclose

import airlight
from airlight import Camera, Scene
from airlight.planets import load_planet, replace
from airlight.render import render

A, H, TOP, ALBEDO = 60000.0, 60.0, 600.0, 0.5
FAR = 600000.0  # camera above the radius of the equator
SUN = np.array([cos(0.35) * cos(0.8), cos(0.35) * sin(0.8), sin(0.35)])  # 20° N, 46° E
#: Share by which solver and pixels may err.
SOLVER = 0.005
NM = (680.0, 550.0, 440.0)
FILE = """
name = "Spheroid"
[shell]
bottom_radius = "60000 km"
top_radius = "60600 km"
[ground]
albedo = 0.5
[star]
spectrum = "astm-g173"
angular_radius = "0.001 deg"
[[constituents]]
name = "air"
profile = { kind = "exponential", scale_height = "60 km" }
scattering = "1e-9 /m"
phase_function = { kind = "henyey-greenstein", asymmetry = 0.0 }
"""


class Line(NamedTuple):
    """Line of sight: camera's latitude, longitude and latitude of the normal, altitude passed."""

    camera: float
    longitude: float
    latitude: float | None  # None: at the limb, by ``cosine`` and bearing from north
    cosine: float = 0.0
    altitude: float = 0.0


LINES = {
    "disc centre": Line(0.0, 0.0, 0.0),
    "mid-disc, equator": Line(0.0, 40.0, 0.0),
    "mid-disc, 50° N": Line(0.0, 0.0, 50.0),
    "near the limb, equator": Line(0.0, 90.0, None, 0.1),
    "near the limb, pole": Line(0.0, 0.0, None, 0.1),
    "limb, equator": Line(0.0, 90.0, None, 0.0, 240.0),
    "limb, pole": Line(0.0, 0.0, None, 0.0, 240.0),
    "before the terminator": Line(0.0, -42.0, 0.0),
    "behind the terminator": Line(0.0, -46.0, 0.0),
    "near the limb, from the pole": Line(90.0, 30.0, None, 0.1),
    "limb, from the pole": Line(90.0, 30.0, None, 0.0, 240.0),
    "limb, low sun, from the pole": Line(90.0, 120.0, None, 0.0, 240.0),
    "dusk near the south pole": Line(0.0, 45.8, -71.7),
    "dusk at the south pole": Line(0.0, 45.8, -73.4),
}


@njit
def place(x, y, z, f):
    """Geodetic altitude and normal by Bowring (1985), twice."""
    rho = sqrt(x * x + y * y)
    b, e2 = A * (1.0 - f), f * (2.0 - f)
    up, out = z, rho * (1.0 - f)
    for _ in range(2):
        size = sqrt(up * up + out * out)
        s, c = up / size, out / size
        p = z + e2 / (1.0 - e2) * b * s * s * s
        q = rho - e2 * A * c * c * c
        up, out = p * (1.0 - f), q
    size = sqrt(p * p + q * q)
    s, c = p / size, q / size
    h = rho * c + z * s - A * sqrt(1.0 - e2 * s * s)
    level = c / max(rho, 1e-9)
    return h, x * level, y * level, s


@njit
def to_ground(x, y, z, u, v, w, f):
    """Distance to the spheroid ahead, or -1."""
    g = 1.0 / (1.0 - f)
    z, w = z * g, w * g
    a, b = u * u + v * v + w * w, x * u + y * v + z * w
    t = -b / a
    px, py, pz = x + t * u, y + t * v, z + t * w
    room = A * A - (px * px + py * py + pz * pz)
    if room < 0.0 or t < 0.0:
        return -1.0
    return max(t - sqrt(room / a), 0.0)


@njit
def to_sun(x, y, z, sun, f, density):
    """Transmittance to the sun by Gauss's rule, three points for each scale height at most."""
    if to_ground(x, y, z, sun[0], sun[1], sun[2], f) >= 0.0:
        return 0.0
    depth = 0.0
    for _ in range(1000):
        h, nx, ny, nz = place(x, y, z, f)
        mu = nx * sun[0] + ny * sun[1] + nz * sun[2]
        if depth > 40.0 or (h > TOP and mu > 0.0):
            break
        step = 1.0 / (abs(mu) / H + 1.0 / 1500.0)
        for k in range(3):
            t = step * (0.5 + (k - 1) * 0.3872983346207417)
            h, nx, ny, nz = place(x + t * sun[0], y + t * sun[1], z + t * sun[2], f)
            if h < TOP:
                depth += (8.0 if k == 1 else 5.0) / 18.0 * step * density * exp(-h / H)
        x, y, z = x + step * sun[0], y + step * sun[1], z + step * sun[2]
    return exp(-depth)


@njit
def path(eye, ray, sun, f, density, random):
    """Radiance along one path, for an irradiance of 1."""
    x, y, z = eye
    u, v, w = ray
    light = 0.0
    while True:
        ground = to_ground(x, y, z, u, v, w, f)
        hit = False
        while True:  # null collisions
            h, nx, ny, nz = place(x, y, z, f)
            mu = nx * u + ny * v + nz * w
            if h > TOP + 1e-6:
                if mu >= 0.0:
                    return light
                step = max((h - TOP) / -mu, 1.0)
                if ground >= 0.0 and step > ground:
                    step = ground
            else:
                step, rate = 1000.0, density * exp(-h / H) * (1.0 + 1e-9)
                if 0.0 <= ground < step:
                    step = ground
                wanted = -log(1.0 - random.random())
                slope = mu / H  # majorant rate·exp(-slope t)
                if abs(slope) * 1000.0 < 1e-6:
                    t = wanted / rate
                else:
                    rest = 1.0 - wanted * slope / rate
                    t = 1e30 if rest <= 0.0 else -log(rest) / slope
                if t < step:
                    x, y, z = x + t * u, y + t * v, z + t * w
                    ground -= t if ground >= 0.0 else 0.0
                    h, nx, ny, nz = place(x, y, z, f)
                    real = density * exp(-h / H) if h < TOP else 0.0
                    if random.random() * rate * exp(-slope * t) < real:
                        break
                    continue
            x, y, z = x + step * u, y + step * v, z + step * w
            if ground >= 0.0:
                ground -= step
                if ground <= 0.0:
                    hit = True
                    break
        if not hit:
            light += to_sun(x, y, z, sun, f, density) / (4.0 * pi)
            w = 2.0 * random.random() - 1.0
            turn, level = 2.0 * pi * random.random(), sqrt((1.0 - w) * (1.0 + w))
            u, v = level * cos(turn), level * sin(turn)
            continue
        h, nx, ny, nz = place(x, y, z, f)
        x, y, z = x + (1e-6 - h) * nx, y + (1e-6 - h) * ny, z + (1e-6 - h) * nz
        rise = nx * sun[0] + ny * sun[1] + nz * sun[2]
        if rise > 0.0:
            light += ALBEDO / pi * rise * to_sun(x, y, z, sun, f, density)
        if random.random() > ALBEDO:
            return light
        # Lambert: the normal plus a point of the unit sphere
        w = 2.0 * random.random() - 1.0
        turn, level = 2.0 * pi * random.random(), sqrt((1.0 - w) * (1.0 + w))
        u, v, w = nx + level * cos(turn), ny + level * sin(turn), nz + w
        size = sqrt(u * u + v * v + w * w)
        u, v, w = u / size, v / size, w / size


@njit
def traced(eye, ray, sun, f, density, number, random):
    """Mean radiance of paths, and its standard error."""
    total = square = 0.0
    for _ in range(number):
        one = path(eye, ray, sun, f, density, random)
        total += one
        square += one * one
    mean = total / number
    return mean, sqrt(max(square / number - mean * mean, 0.0) / number)


def direction(latitude: float, longitude: float) -> np.ndarray:
    f, g = np.radians([latitude, longitude])
    return np.array([cos(f) * cos(g), cos(f) * sin(g), sin(f)])


def seen(line: Line, f: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Eye, direction of the line of sight, and normal of the spheroid where it meets it."""
    eye = (A + FAR) * direction(line.camera, 0.0)

    def way(latitude: float, longitude: float) -> tuple[np.ndarray, np.ndarray]:
        normal = direction(latitude, longitude)
        form = np.array([A, A, A * (1.0 - f)])
        point = form**2 * normal / np.linalg.norm(form * normal) + line.altitude * normal
        return (point - eye) / np.linalg.norm(point - eye), normal

    if line.latitude is not None:
        ray, normal = way(line.latitude, line.longitude)
        return eye, ray, normal

    # along a meridian or the equator, to where the line's zenith angle has the cosine
    def at(x: float) -> tuple[np.ndarray, np.ndarray]:
        if line.camera == 90.0:
            return way(90.0 - x, line.longitude)
        return way(0.0, x) if line.longitude == 90.0 else way(x, 0.0)

    low, high = 0.0, 95.0
    for _ in range(60):
        middle = (low + high) / 2.0
        ray, normal = at(middle)
        low, high = (middle, high) if -ray @ normal > line.cosine else (low, middle)
    ray, normal = at(low)
    return eye, ray, normal


def bound(line: Line) -> float:
    """Share of the radiance that the treatment of curvature may leave.

    Chosen after the comparison: columns at the limb within 1 %, and with the sun below the horizon,
    whose beam has half of the change of its columns, within 3 %.
    """
    _, ray, normal = seen(line, 0.1)
    dusk = 0.02 if float(SUN @ normal) < 0.0 else 0.0
    return dusk + (0.005 if float(-ray @ normal) < 0.05 else 0.0)


def pixel(line: Line, f: float, solution: airlight.Solution) -> float:
    """Light of a picture of one pixel on a line of sight."""
    _, ray, _ = seen(line, f)
    up = direction(line.camera, 0.0)
    north = direction(line.camera + 90.0, 0.0)
    scene = Scene(
        altitude=FAR * 1e3,
        latitude=line.camera,
        sun_zenith=float(np.degrees(np.arccos(SUN @ up))),
        sun_azimuth=float(np.degrees(np.arctan2(SUN @ np.cross(north, up), SUN @ north))),
    )
    turn = scene.ground_frame
    assert_allclose(turn @ scene.sun_direction, SUN, atol=1e-9)
    assert_allclose(turn[:, 2], up, atol=1e-12)
    x, y, z = turn.T @ ray
    camera = Camera(
        look_zenith=float(np.degrees(np.arctan2(np.hypot(x, y), z))),
        look_azimuth=float(np.degrees(-np.arctan2(y, x))),
        width=1,
        height=1,
        field_of_view=1e-3,
    )
    assert_allclose(turn @ camera.axes[2], ray, atol=1e-9)  # 0.6 m at the planet
    frame = render(solution, replace(scene, camera=camera), disc=False, exact=True)
    return float(frame.rgb[0, 0, 1])


@pytest.fixture(scope="module")
def painted(tmp_path_factory):
    """Radiance by ``render`` for an irradiance of 1."""
    file = tmp_path_factory.mktemp("spheroid") / "spheroid.toml"
    file.write_text(FILE)
    planet = load_planet(file)

    @cache
    def solved(depth: float, f: float, quality: str) -> airlight.Solution:
        air = replace(planet.constituents[0], scattering=depth / (H * 1e3))
        one = replace(planet, constituents=(air,), flattening=f)
        return airlight.solve(one, NM, quality=quality, polarisation=False)

    # Lambert's law in hardly any air
    centre = LINES["disc centre"]
    unit = pixel(centre, 0.0, solved(1e-7, 0.0, "preview")) * pi / (ALBEDO * SUN[0])
    return lambda name, depth, f, quality: pixel(LINES[name], f, solved(depth, f, quality)) / unit


def difference(painted, name: str, depth: float, f: float, quality: str, number: int):
    """Relative difference of a picture from the reference, its standard error and tolerance."""
    line = LINES[name]
    eye, ray, _ = seen(line, f)
    random = np.random.default_rng([list(LINES).index(name), int(1e3 * f), int(10.0 * depth)])
    mean, error = traced(tuple(eye), tuple(ray), SUN, f, depth / H, number, random)
    error /= mean
    allowed = 3.0 * error + (SOLVER + bound(line) if f > 0.0 else 0.0)
    return painted(name, depth, f, quality) / mean - 1.0, error, allowed


@pytest.mark.parametrize("f", [0.0, 0.1])
@pytest.mark.parametrize("name", ["mid-disc, 50° N", "limb, pole", "limb, from the pole"])
def test_disc_and_limb_are_those_of_the_spheroid(painted, name, f):
    found, _, allowed = difference(painted, name, 0.3, f, "preview", 60_000)
    assert abs(found) < allowed


@pytest.mark.validation
@pytest.mark.parametrize("name", LINES)
@pytest.mark.parametrize("depth", [0.3, 3.0])
@pytest.mark.parametrize("f", [0.0, 0.065, 0.1])
def test_lines_of_sight_to_the_spheroid(painted, name, depth, f):
    found, error, allowed = difference(painted, name, depth, f, "default", 300_000)
    print(f"{f} {depth} {name}: {found:+.2%} ± {error:.2%}, allowed {allowed:.2%}")
    assert abs(found) < allowed
