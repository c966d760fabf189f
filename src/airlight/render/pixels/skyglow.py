r"""Skyglow: city lights scattered by the air above and around an observer.

Each layer of air on a line of sight is lit by the ground below it. The upward intensity per area of
a town follows Garstang (1986): a Lambert ground of albedo G = 0.15 and lamps of which a share
F = 0.15 shines above the horizon, relative to the radiance L of the map, seen from the zenith,

.. math:: I(ψ) = L \left(\cos ψ + \frac{0.554\, F}{2 G (1 - F)}\, ψ^4\right)

The light of an area falls with its distance; it is a sum of means of the map around the foot of the
layer, read from its mip levels, within a fifth. Scattering is of first order, averaged over
azimuths, with the phase functions of all constituents, times the gain by higher orders of a uniform
source function. Light from beyond 200 km, that scattered between ground and air again, and
obstruction by hills are left out: together about a quarter.
"""

from __future__ import annotations

import itertools
from math import exp, log2, pi, sqrt
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.quadrature import gauss_legendre
from airlight.geometry.vectors import Vec3, components
from airlight.kernel import inlined, kernel
from airlight.scene.ground_place import latitude_longitude, map_channel

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

#: Edges of the layers of air. [m]
EDGES: Final = (0.0, 300.0, 800.0, 1600.0, 2800.0, 4500.0, 7000.0, 11000.0, 18000.0)
#: Sides of the texels of the means over the ground: the first [m], and ratio of successive ones.
FIRST: Final = 6e3
RATIO: Final = 2.2
MEANS: Final = 5
#: Distances between which the means follow the light of the ground. [m]
_NEAREST, _FARTHEST = 500.0, 1.5e5
#: Direct over reflected upward intensity, 0.554 F / (2 G (1 - F)). [1; Garstang 1986, PASP 98, 364,
#: eq. 1 with G = F = 0.15]
DIRECT: Final = 0.554 * 0.15 / (2.0 * 0.15 * (1.0 - 0.15))
#: Wavelengths of red, green and blue of the ground's basis. [nm]
CHANNELS: Final = (610.0, 545.0, 460.0)
#: Sizes of a row of the table.
SKYGLOW_VALUES: Final = 14 + MEANS
#: Points over an angle.
_POINTS: Final = 24
#: Smallest sine of the elevation for the air mass of a line to the ground. [1]
_FLATTEST: Final = 0.03
#: Mip levels between successive means.
_WIDER: Final = log2(RATIO)


def skyglow_table(medium: Medium) -> FloatArray:
    """Layers of air that scatter city lights.

    Parameters
    ----------
    medium : Medium
        Solved medium.

    Returns
    -------
    array, shape (layers, 14 + ``MEANS``)
        Edges [m]; optical depths from the ground to the middle for red, green and blue [1];
        scattered per incident light, horizontally, towards the nadir and towards the zenith, for
        each [m⁻¹ sr⁻¹]; irradiation by each mean per radiance of the map [sr]. One layer of zeros
        without lights.
    """
    if medium.surface.lights is None:
        return np.zeros((1, SKYGLOW_VALUES))
    lanes = [int(np.argmin(np.abs(medium.wavelengths - nm))) for nm in CHANNELS]
    extinction, scattering = medium.extinction[:, lanes], medium.scattering[:, lanes]
    rows = []
    depth = np.zeros(3)
    for low, high in itertools.pairwise(EDGES):
        points, weights = gauss_legendre(4).as_tuple()[:2]
        heights = np.minimum(low + (high - low) * points, medium.thickness)
        density = medium.density.at(heights) @ weights
        own = (high - low) * (density @ extinction)
        middle = depth + 0.5 * own
        angles, light = _upward_light(0.5 * (low + high), float(middle[1]))
        sides = [
            density @ (scattering * _mean_phase(medium, angles, light, lanes, turned))
            for turned in (0.0, -1.0, 1.0)
        ]
        total = depth + own
        gain = 1.0 / (1.0 - 0.5 * _half_space(medium, lanes))
        by_mean = _by_mean(0.5 * (low + high), float(middle[1]))
        by_mean[0] += max(light.sum() - by_mean.sum(), 0.0)  # from nearer than the finest mean
        rows.append([low, high, *middle, *np.multiply(gain, sides).ravel(), *by_mean])
        depth = total
    return np.array(rows)


def _half_space(medium: Medium, lanes: list[int]) -> FloatArray:
    """Scattered share of isotropic light in the air, shape (3,). [1]"""
    mu, weights = gauss_legendre(_POINTS).as_tuple()[:2]
    depth = medium.vertical_optical_depth[:, lanes].sum(axis=0)
    albedo = medium.columns @ medium.scattering[:, lanes] / np.maximum(depth, 1e-30)
    return np.asarray(albedo * (weights @ (1.0 - np.exp(-depth / mu[:, None]))))


def _upward_light(height: float, depth: float) -> tuple[FloatArray, FloatArray]:
    """Angles ψ to the vertical [rad], and light from there per radiance of the ground [sr].

    Both of shape (points,); light is radiance times solid angle, through an optical depth.
    """
    points, weights = gauss_legendre(_POINTS).as_tuple()[:2]
    wide = np.arctan(_FARTHEST / height)
    psi = wide * points
    # area over squared distance, per angle: 2π ρ dρ / d² = 2π tan ψ dψ
    return psi, _per_solid_angle(psi, depth) * 2.0 * np.pi * np.tan(psi) * wide * weights


def _per_solid_angle(psi: FloatArray, depth: float) -> FloatArray:
    """Upward intensity per area and radiance of the map, attenuated. [1]"""
    cosine = np.cos(psi)
    return np.asarray((cosine + DIRECT * psi**4) * np.exp(-depth / cosine))


def _by_mean(height: float, depth: float) -> FloatArray:
    """Irradiation of a layer by each mean of the map. [sr]

    The weights, not below 0, reproduce the light of an area at any distance with the least relative
    error; a mean has the kernel of a mip level, read bilinearly.
    """
    from scipy.optimize import nnls

    rho = np.geomspace(_NEAREST, _FARTHEST, 40)
    light = _per_solid_angle(np.arctan(rho / height), depth) / (rho**2 + height**2)
    sides = FIRST * RATIO ** np.arange(MEANS)
    found = nnls(
        np.stack([_kernel(rho, side) for side in sides], axis=-1) / light[:, None],
        np.ones(rho.size),
    )
    return np.asarray(found[0])


def _kernel(rho: FloatArray, side: float) -> FloatArray:
    """Weight per area of a texel's bilinear mean, over directions and positions. [m⁻²]"""
    turn = (np.arange(16) + 0.5) * np.pi / 32.0
    x, y = (np.abs(rho[:, None] * one / side) for one in (np.cos(turn), np.sin(turn)))
    parts = (np.where(u < 0.5, 0.75 - u * u, 0.5 * np.maximum(1.5 - u, 0.0) ** 2) for u in (x, y))
    return np.asarray(np.prod(list(parts), axis=0).mean(axis=1) / side**2)


def _mean_phase(
    medium: Medium, angles: FloatArray, light: FloatArray, lanes: list[int], rise: float
) -> FloatArray:
    """Phase functions averaged over the upward light, (nc, 3). [sr⁻¹]

    Towards the side, the nadir or the zenith, which have the ``rise`` 0, -1 and 1.
    """
    turn = (np.arange(8) + 0.5) * np.pi / 8.0
    psi = angles.ravel()[:, None]
    nu = rise * np.cos(psi) * np.ones_like(turn)
    if rise == 0.0:
        nu = np.sin(psi) * np.cos(turn)
    found = medium.phase_function(nu)[..., lanes].mean(axis=1)
    share = light.ravel() / light.sum()
    return np.asarray(np.einsum("k,kcl->cl", share, found))


@kernel
def crossing(inner, outer, impact, start, falling):
    """Distances at which a line enters and leaves a layer; 0 before its start. [m]

    Parameters
    ----------
    inner, outer : float
        Radii of the layer. [m]
    impact, start : float
        Smallest distance of the line from the centre, and distance from there to its start. [m]
    falling : bool
        Whether the line crosses it on its way down.
    """
    low = sqrt(max((inner - impact) * (inner + impact), 0.0))
    high = sqrt(max((outer - impact) * (outer + impact), 0.0))
    if falling:
        return max(-high - start, 0.0), max(-low - start, 0.0)
    return max(low - start, 0.0), max(high - start, 0.0)


@inlined
def scattered_lamps(k, channel, rise, slant, depth, view):
    """Light that a layer scatters towards the observer, attenuated. [m⁻¹ sr⁻¹]

    Parameters
    ----------
    k, channel : int
        Layer, and red, green or blue.
    rise, slant : float
        Sine of the elevation of the line there, negative where it falls, and air mass. [1]
    depth : float
        Vertical optical depth of the air below the observer. [1]
    view : ViewUniforms
        Camera with the layers.
    """
    level = view.skyglow_layers[k, 5 + channel]
    end = view.skyglow_layers[k, (8 if rise > 0.0 else 11) + channel]
    between = slant * abs(view.skyglow_layers[k, 2 + channel] - depth)
    return (level + abs(rise) * (end - level)) * exp(-between)


@inlined
def lamps_below(ray, reach, length, k, observer, frame):
    """Light of the ground that irradiates a layer, times the length of the line in it. [m sr]

    Parameters
    ----------
    ray, observer, frame :
        Arguments of ``skyglow_color``.
    reach, length : float
        Distance to the layer, and length of the line in it. [m]
    k : int
        Layer.
    """
    view = frame.camera
    end = Vec3(reach * ray.x, reach * ray.y, observer.r + reach * ray.z)
    latitude, longitude = latitude_longitude(
        components(end, observer.ground_x, observer.ground_y, observer.ground_z)
    )
    level = log2(FIRST * view.over_rows / (pi * frame.tables.bottom))
    # a layer is crossed over many texels near the horizon: no mean is narrower than that
    wide = log2(max(0.5 * length / FIRST, 1.0))
    light = 0.0
    for mean in range(MEANS):
        lamps = map_channel(
            view.over_texels, view.over_rows, view.over_columns, view.over_levels,
            latitude, longitude, level + max(mean * _WIDER, wide), 0,
        )  # fmt: skip
        light += lamps * view.skyglow_layers[k, 14 + mean]
    return light * length


@inlined
def skyglow_color(ray, sine, to_ground, observer, frame):
    """Skyglow along a line of sight through the air, as colour of ``basis``. [sr⁻¹]

    Parameters
    ----------
    ray : Vec3
        Direction in the observer's frame. [1]
    sine : float
        Sine of its zenith angle. [1]
    to_ground : bool
        Whether it ends on the ground.
    observer, frame : Observer, FrameTables
        Observer, and what the pixels read.
    """
    view, bottom = frame.camera, frame.tables.bottom
    red, green, blue = 0.0, 0.0, 0.0
    impact, start = observer.r * sine, observer.r * ray.z
    height = observer.optical_altitude
    first, second, third = 0.0, 0.0, 0.0
    for k in range(view.skyglow_layers.shape[0]):
        if view.skyglow_layers[k, 0] + view.skyglow_layers[k, 1] < 2.0 * height:
            first = view.skyglow_layers[k, 2]
            second = view.skyglow_layers[k, 3]
            third = view.skyglow_layers[k, 4]
    for part in range(2):
        falling = part == 0
        # a line that falls rises again beyond its lowest point, unless it ends on the ground
        if (falling and start < 0.0) or not (falling or to_ground):
            for k in range(view.skyglow_layers.shape[0]):
                low, high = view.skyglow_layers[k, 0], view.skyglow_layers[k, 1]
                if falling:
                    high = min(high, height)
                elif start >= 0.0:
                    low = max(low, height)
                near, far = crossing(bottom + low, bottom + max(high, low), impact, start, falling)
                if far > near:
                    half = 0.5 * (near + far)
                    light = lamps_below(ray, half, far - near, k, observer, frame)
                    rise = (half + start) / (bottom + 0.5 * (low + high))
                    slant = half / max(0.5 * (low + high) - height, 1.0)
                    if start < 0.0:
                        slant = 1.0 / max(abs(rise), _FLATTEST)
                    red += light * scattered_lamps(k, 0, rise, slant, first, view)
                    green += light * scattered_lamps(k, 1, rise, slant, second, view)
                    blue += light * scattered_lamps(k, 2, rise, slant, third, view)
    red, green, blue = red * view.lamp.red, green * view.lamp.green, blue * view.lamp.blue
    return Vec3(red * view.skyglow, green * view.skyglow, blue * view.skyglow)
