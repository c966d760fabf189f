"""Craters of the ground of a planet, and the share of highlands by its map."""

from __future__ import annotations

from math import sqrt

from airlight.geometry.vectors import dot, minus, scaled
from airlight.kernel import inlined
from airlight.scene.craters import FLATTEST, LOWEST, REGIONAL, craters, highland
from airlight.scene.ground_place import map_channel


@inlined
def highlands(spot, view):
    """Share of highlands by the map around a place, 1 without a map. [1]

    Parameters
    ----------
    spot : MapSpot
        Place in the map.
    view : ViewUniforms
        Camera with its maps.
    """
    share = 1.0
    if view.mapped:
        share = highland(
            map_channel(
                view.texels, view.map_rows, view.map_columns, view.map_levels,
                spot.latitude, spot.longitude, REGIONAL, 1,
            )
        )  # fmt: skip
    return share


@inlined
def land_craters(place, up, finest, whole, way, mu_s, cosine, width, bare, view):
    """``Cratered`` of a place.

    Parameters
    ----------
    place : Vec3
        Place relative to the point below the observer, ``faced``. [m]
    up, way : Vec3
        Vertical, and horizontal direction towards the star, ``faced``. [1]
    finest, whole : Vec3
        Place from the observer's lattice point, and that point, ``faced``. [finest cell]
    mu_s, cosine : float
        Cosines of the zenith angles of the star and of the observer. [1]
    width : float
        Width of the pixel across the line of sight. [m]
    bare : float
        Result of ``highlands``. [1]
    view : ViewUniforms
        Camera.
    """
    cell, low = view.detail_cell, 0.0
    if mu_s > 0.0:
        low = min(sqrt(max(1.0 - mu_s * mu_s, 0.0)) / max(mu_s, 1e-3), LOWEST)
    beyond = minus(place, scaled(up, dot(place, up)))
    flat = sqrt(max(1.0 - cosine * cosine, 0.0)) / max(cosine, FLATTEST)
    ray = scaled(beyond, flat / max(sqrt(dot(beyond, beyond)), 1e-3 * cell))
    return craters(
        finest, whole, up, scaled(way, low), width / cell, cell, view.craters, bare, ray,
        view.weathered,
    )  # fmt: skip
