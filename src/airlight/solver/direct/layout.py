"""Axes of the table of gathered radiance, and coordinates on them."""

from __future__ import annotations

from math import acos, cos, pi
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.mappings import linear, power, scattering, transmittance, weighted_power
from airlight.geometry.mappings.texels import cell, index_coordinate
from airlight.geometry.shell import horizon_cosine, meets_ground
from airlight.kernel import compiled_loop, kernel
from airlight.solver.direct.settings import MAPPINGS, DirectSettings

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

_ANGLE, _BRUNETON, _LINEAR, _POWER, _WEIGHTED = range(len(MAPPINGS))
_LOWER_WEIGHT = weighted_power.DEFAULT_LOWER_WEIGHT
_SURFACE_SLOPE = weighted_power.DEFAULT_SURFACE_SLOPE
_SURFACE_OFFSET = weighted_power.DEFAULT_SURFACE_OFFSET

# Kernels call kernels by name, not through a module.
_linear_altitude = linear.altitude_coordinate
_linear_altitude_back = linear.altitude_from_coordinate
_power_altitude = power.altitude_coordinate
_power_altitude_back = power.altitude_from_coordinate
_power_cosine = power.cosine_coordinate
_power_cosine_back = power.cosine_from_coordinate
_horizon_radius = transmittance.altitude_coordinate
_horizon_radius_back = transmittance.radius_from_coordinate
_bruneton_view = scattering.view_coordinate
_bruneton_view_back = scattering.cosine_from_view
_view_index = scattering.view_index
_view_from_index = scattering.view_from_index
_sun = scattering.sun_coordinate
_sun_back = scattering.sun_from_coordinate
_weighted_view = weighted_power.view_coordinate
_weighted_view_back = weighted_power.view_from_coordinate
_lower_weight = weighted_power.lower_weight
_surface_weight = weighted_power.surface_weight


class Layout(NamedTuple):
    """Axes of the table of gathered radiance.

    Attributes
    ----------
    kind : int
        Index of the mapping in ``MAPPINGS``.
    radii, views, sun_angles, angles : int
        Numbers of nodes; one angle for the 3-D mappings.
    power : float
        Exponent of the power mappings. [1]
    bottom, top : float
        Radii of the ground and of the top. [m]
    lowest : float
        Smallest cosine of the sun's zenith angle on the 4-D axes. [1]
    """

    kind: int
    radii: int
    views: int
    sun_angles: int
    angles: int
    power: float
    bottom: float
    top: float
    lowest: float


def layout_for(medium: Medium, settings: DirectSettings) -> Layout:
    """Axes by the settings, for a medium's shell."""
    bottom, top = medium.bottom_radius, medium.top_radius
    return Layout(
        MAPPINGS.index(settings.mapping),
        settings.radii,
        settings.views,
        settings.sun_angles,
        settings.scatter_angles,
        settings.power,
        bottom,
        top,
        scattering.lowest_sun_cosine(bottom, top),
    )


@compiled_loop
def radius_cell(r, axes):
    """Nodes around a radius, and weight of the upper."""
    if axes.kind <= _BRUNETON:
        x = _horizon_radius(r, axes.bottom, axes.top)
    elif axes.kind == _LINEAR:
        x = _linear_altitude(r - axes.bottom, axes.top - axes.bottom)
    else:
        x = _power_altitude(r - axes.bottom, axes.top - axes.bottom, axes.power)
    return cell(x * (axes.radii - 1.0), 0, axes.radii - 1)


@compiled_loop
def radius_of(i, axes):
    """Radius of a node, exact at both ends. [m]"""
    if i == 0:
        return axes.bottom
    if i == axes.radii - 1:
        return axes.top
    x = index_coordinate(i, axes.radii)
    if axes.kind <= _BRUNETON:
        return _horizon_radius_back(x, axes.bottom, axes.top)
    if axes.kind == _LINEAR:
        return axes.bottom + _linear_altitude_back(x, axes.top - axes.bottom)
    return axes.bottom + _power_altitude_back(x, axes.top - axes.bottom, axes.power)


@compiled_loop
def _weights(r, axes):
    u = _power_altitude(r - axes.bottom, axes.top - axes.bottom, axes.power)
    return _lower_weight(u, _LOWER_WEIGHT), _surface_weight(u, _SURFACE_SLOPE, _SURFACE_OFFSET)


@compiled_loop
def view_cell(r, mu, axes):
    """Nodes around a view direction at a radius, and weight of the second."""
    n = axes.views
    if axes.kind <= _BRUNETON:
        to_ground = meets_ground(r, mu, axes.bottom)
        if axes.kind == _BRUNETON:
            x = _bruneton_view(r, mu, to_ground, axes.bottom, axes.top)
            first = 0 if to_ground else n // 2
            return cell(_view_index(x, to_ground, n), first, first + n // 2 - 1)
        zenith = acos(min(max(mu, -1.0), 1.0))
        horizon = acos(horizon_cosine(r, axes.bottom))
        half = n // 2
        if zenith <= horizon:
            return cell(zenith / horizon * half, 0, half)
        return cell(half + (zenith - horizon) / (pi - horizon) * (n - 1 - half), half, n - 1)
    if axes.kind == _LINEAR:
        x = 0.5 * (mu + 1.0)
    elif axes.kind == _POWER:
        x = _power_cosine(mu, axes.power)
    else:
        to_ground = meets_ground(r, mu, axes.bottom)
        horizon = horizon_cosine(r, axes.bottom)
        lower, surface = _weights(r, axes)
        p = axes.power
        x = _weighted_view(mu, to_ground, horizon, p, p, p, lower, surface)
    return cell(x * (n - 1.0), 0, n - 1)


@compiled_loop
def view_of(j, r, axes):
    """Cosine of the view's zenith angle at a node and a radius. [1]"""
    n = axes.views
    if axes.kind == _ANGLE:
        half = n // 2
        horizon = acos(horizon_cosine(r, axes.bottom))
        if j <= half:
            return cos(horizon * j / half)
        return cos(horizon + (pi - horizon) * (j - half) / (n - 1 - half))
    if axes.kind == _BRUNETON:
        x, to_ground = _view_from_index(float(j), n)
        return _bruneton_view_back(x, to_ground, r, axes.bottom, axes.top)
    x = index_coordinate(j, n)
    if axes.kind == _LINEAR:
        return 2.0 * x - 1.0
    if axes.kind == _POWER:
        return _power_cosine_back(x, axes.power)
    lower, surface = _weights(r, axes)
    p = axes.power
    return _weighted_view_back(x, horizon_cosine(r, axes.bottom), p, p, p, lower, surface)[0]


@compiled_loop
def sun_cell(mu_s, axes):
    """Nodes around a sun cosine, and weight of the second."""
    if axes.kind <= _BRUNETON:
        x = _sun(mu_s, axes.lowest, axes.bottom, axes.top)
    elif axes.kind == _LINEAR:
        x = 0.5 * (mu_s + 1.0)
    else:
        x = _power_cosine(mu_s, axes.power)
    return cell(x * (axes.sun_angles - 1.0), 0, axes.sun_angles - 1)


@compiled_loop
def sun_of(k, axes):
    """Cosine of the sun's zenith angle at a node. [1]"""
    x = index_coordinate(k, axes.sun_angles)
    if axes.kind <= _BRUNETON:
        return _sun_back(x, axes.lowest, axes.bottom, axes.top)
    if axes.kind == _LINEAR:
        return 2.0 * x - 1.0
    return _power_cosine_back(x, axes.power)


@kernel
def _angle_index(nu, kind, n):
    if n == 1:
        return 0.0
    if kind == _BRUNETON:
        return 0.5 * (min(max(nu, -1.0), 1.0) + 1.0) * (n - 1.0)
    return acos(min(max(nu, -1.0), 1.0)) / pi * (n - 1.0)


@compiled_loop
def angle_cell(nu, axes):
    """Nodes around the cosine between view and sun, and weight of the second."""
    return cell(_angle_index(nu, axes.kind, axes.angles), 0, axes.angles - 1)


@compiled_loop
def angle_of(m, axes):
    """Cosine of the angle between view and sun at a node. [1]"""
    x = index_coordinate(m, axes.angles)
    if axes.kind == _BRUNETON:
        return 2.0 * x - 1.0
    return cos(pi * x)


@compiled_loop
def angle_index(nu, axes):
    """Fractional index on the axis of angles, between 0 and the last index. [1]"""
    return _angle_index(nu, axes.kind, axes.angles)
