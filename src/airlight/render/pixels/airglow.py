"""Airglow in a pixel: thin layers that shine behind, within or above the air.

Layers are lines or bands with the colour of their own wavelengths, not of those of the solution.
Their light is attenuated between observer and layer, on straight lines with the impact parameter
of the refracted ray, shines on the ground, and is scattered by the air. The source function of the
scattered light is the same everywhere in the air below the layers, the mean over all directions
with isotropic scattering: it is good to a fifth, as the layers are nearly as bright everywhere.
"""

from __future__ import annotations

from math import exp
from typing import TYPE_CHECKING, Final

import numpy as np
import numpy.typing as npt
from numpy.typing import NDArray

from airlight.geometry.quadrature import gauss_legendre
from airlight.geometry.vectors import Vec3
from airlight.image.spectral_color import wavelength_color
from airlight.kernel import inlined
from airlight.kernel.lanes import lane_view
from airlight.physics.optics.airglow import (
    Emission,
    airglow_emissions,
    layer_columns,
    line_radiance,
)
from airlight.render.pixels.ground import DAYLIGHT, reflectance
from airlight.render.pixels.ground_angles import ground_angles
from airlight.render.pixels.star_disc import leaving_air
from airlight.solver.moments.source import transmittance_columns

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]

#: Width of a layer over its full width at half maximum. [1]
_WHOLE: Final = 2.0**0.5
#: Number of values of a layer.
AIRGLOW_VALUES: Final = 7
#: Points over the cosine of the zenith angle for the irradiance of the ground.
_POINTS: Final = 16


def airglow_tables(
    solution: MomentsSolution, weights: npt.ArrayLike | None = None
) -> tuple[FloatArray, FloatArray]:
    """Layers of airglow of a solution; one black layer without airglow.

    Parameters
    ----------
    solution : MomentsSolution
        Solution.
    weights : array, shape (nl, 3), optional
        Argument of ``LightSource.colors``.

    Returns
    -------
    layers : array, shape (n, 7)
        Inner and outer radius [m], radiance per irradiance of the star at the zenith, as red, green
        and blue of ``basis`` [sr⁻¹], and over it the radiance of a white ground below and the
        source function of scattered light [1].
    extinction : array, shape (n, nc)
        Extinction of each constituent at the wavelength of the layer. [m⁻¹]
    """
    medium, bent = solution.medium, solution.geometry.medium
    if medium.surface.airglow == "none":
        return np.zeros((1, AIRGLOW_VALUES)), np.zeros((1, len(bent.names)))
    bottom, layers, extinction = medium.bottom_radius, [], []
    for one in airglow_emissions(medium.surface.airglow):
        nm = 0.5 * (one.first + one.last)
        at, extinct, scattering, albedo = (
            _at_wavelength(nm, medium.wavelengths, rows)
            for rows in (
                bent.extinction,
                medium.extinction,
                medium.scattering,
                medium.ground_albedo[None],
            )
        )
        depth, scattered = float(medium.columns @ extinct), float(medium.columns @ scattering)
        half = 0.5 * _WHOLE * one.width
        low, high = (bottom + one.altitude + side * half for side in (-1.0, 1.0))
        shares = _shares_below(low, high, bottom, depth, scattered, float(albedo[0]))
        layers.append([low, high, *basis_colors(solution, emission_color(one), weights), *shares])
        extinction.append(at)
    return np.array(layers), np.array(extinction)


def basis_colors(
    solution: MomentsSolution, rgb: FloatArray, weights: npt.ArrayLike | None = None
) -> FloatArray:
    """Red, green and blue of the ground's basis that have a colour, per irradiance of the star.

    Exact for any number of wavelengths from three.

    Parameters
    ----------
    rgb : array, shape (..., 3)
        Linear sRGB. [W m⁻² sr⁻¹]
    weights : array, shape (nl, 3), optional
        Argument of ``LightSource.colors``.
    """
    shown = solution.lights[0].colors(weights).T @ solution.medium.map_basis
    return np.asarray(rgb @ np.linalg.pinv(shown).T)


def emission_color(emission: Emission) -> FloatArray:
    """Linear sRGB of an emission at the zenith, without attenuation, shape (3,). [W m⁻² sr⁻¹]"""
    nm = np.linspace(emission.first, emission.last, 1 + round(emission.last - emission.first))
    light = np.array([line_radiance(emission.brightness, one) for one in nm])
    return np.asarray((light[:, None] * wavelength_color(nm)).mean(axis=0))


def _at_wavelength(nm: float, wavelengths: FloatArray, rows: FloatArray) -> FloatArray:
    """Values of rows (k, nl) at a wavelength, linear between those of the solution, shape (k,)."""
    order = np.argsort(wavelengths)
    return np.array([np.interp(nm, wavelengths[order], row[order]) for row in rows])


def _shares_below(
    low: float, high: float, bottom: float, depth: float, scattered: float, albedo: float
) -> tuple[float, float]:
    """Radiance of a white ground, and source function of the air, over a layer at the zenith. [1]

    Plane-parallel air with the optical depths ``depth`` of extinction and ``scattered`` of
    scattering, over a ground of that albedo.
    """
    mu, weights = gauss_legendre(_POINTS).as_tuple()[:2]
    sine = np.sqrt(1.0 - mu * mu)
    clear = np.exp(-depth / mu)
    seen = clear * [
        layer_columns(low, high, bottom * s, bottom * m)[1]
        for s, m in zip(sine.tolist(), mu.tolist(), strict=True)
    ]
    ground = float(2.0 * mu * weights @ seen)
    half = 0.5 * scattered / max(depth, 1e-30)
    source = half * (float(weights @ seen) + albedo * ground)
    source /= 1.0 - half * float(weights @ (1.0 - clear))
    return ground + source * float(2.0 * mu * weights @ (1.0 - clear)), source


@inlined
def by_night(ray, sine, to_ground, observer, frame):
    """Whether airglow and skyglow are drawn: where an observer sees a part of the night.

    By day they are 10⁻⁸ and 10⁻⁶ of the sky; also lines that end on ground in daylight lack them.

    Parameters
    ----------
    ray, sine, to_ground, observer, frame :
        Arguments of ``airglow_color``.
    """
    view = frame.camera
    shines = view.airglow > 0.0 or view.skyglow > 0.0
    dark = shines and view.draws_air and observer.sun_z < -observer.horizon_mu
    if dark and to_ground:
        star, _, _ = ground_angles(ray.x, ray.z, sine, 0.0, observer, frame.tables)
        dark = star < DAYLIGHT
    return dark


@inlined
def airglow_color(ray, sine, to_ground, observer, frame, columns):
    """Radiance of all layers along a line of sight, as colour of ``basis``. [sr⁻¹]

    Parameters
    ----------
    ray : Vec3
        Direction in the observer's frame; zero vector for none. [1]
    sine : float
        Sine of its zenith angle. [1]
    to_ground : bool
        Whether the line ends on the ground.
    observer, frame : Observer, FrameTables
        Observer, and what the pixels read.
    columns : array, shape (nc,)
        Columns up to the ground, from ``columns_to_ground``; otherwise receives those of the whole
        line. [m]
    """
    view, tables = frame.camera, frame.tables
    red, green, blue = 0.0, 0.0, 0.0
    if ray.x != 0.0 or ray.y != 0.0 or ray.z != 0.0:
        impact, start = observer.r * sine, observer.r * ray.z
        # layers finer than a pixel are widened to it, or they would flicker
        wider = 0.5 * view.pixel_angle * max(-start, 0.0)
        if not to_ground:
            leaving_air(ray, observer, tables, columns)
        for k in range(view.airglow_layers.shape[0]):
            low = max(view.airglow_layers[k, 0] - wider, tables.bottom)
            near, far = layer_columns(low, view.airglow_layers[k, 1] + wider, impact, start)
            depth = 0.0
            for c in range(tables.constituents):
                depth += columns[c] * view.airglow_extinction[k, c]
            clear = exp(-depth)
            near += (1.0 - clear) * view.airglow_layers[k, 6]
            if not to_ground:
                near += far * clear
            red += near * view.airglow_layers[k, 2]
            green += near * view.airglow_layers[k, 3]
            blue += near * view.airglow_layers[k, 4]
    return Vec3(red * view.airglow, green * view.airglow, blue * view.airglow)


@inlined
def airglow_on_ground(view):
    """Radiance of a white ground in the light of all layers, as colour of ``basis``. [sr⁻¹]"""
    red, green, blue = 0.0, 0.0, 0.0
    for k in range(view.airglow_layers.shape[0]):
        share = view.airglow_layers[k, 5] * view.airglow
        red += share * view.airglow_layers[k, 2]
        green += share * view.airglow_layers[k, 3]
        blue += share * view.airglow_layers[k, 4]
    return Vec3(red, green, blue)


@inlined
def night_light(glow, lit, to_ground, color, view, tables, columns, at):
    """Spectral radiance of the light of the night and of the ground in it, per irradiance. [sr⁻¹]

    Parameters
    ----------
    glow, lit : Vec3
        Airglow and skyglow along the line, and ``airglow_on_ground``, as colours of ``basis``.
        [sr⁻¹]
    to_ground : bool
        Whether the line ends on the ground.
    color, view, tables, columns, at :
        Arguments of ``lamp_light``.
    """
    basis = lane_view(tables.basis, at)
    total = basis[0] * np.float32(glow.x)
    total = total + basis[1] * np.float32(glow.y)
    total = total + basis[2] * np.float32(glow.z)
    if to_ground:
        ground = basis[0] * np.float32(lit.x)
        ground = ground + basis[1] * np.float32(lit.y)
        ground = ground + basis[2] * np.float32(lit.z)
        clear = transmittance_columns(
            columns, lane_view(tables.scaled_extinction, at), tables.constituents
        )
        total = total + ground * clear * reflectance(color, view.mapped, tables, at)
    return total
