"""Belts and zones of a cloud deck in a pixel, by its map.

The light of a line of sight that meets the deck from above is multiplied by the map there, over
the map's mean over the full disc. A column of air is taken for itself: light wanders some tens of
kilometres, belts are thousands wide. The factor is the same at all angles, which errs where haze
above the deck dominates, towards the limb and in the ultraviolet. Lines of sight are straight.
"""

from __future__ import annotations

from functools import lru_cache
from math import sqrt
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.vectors import Vec3, components
from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, lane_view, load, maximum, splat, store
from airlight.scene.ground_place import latitude_longitude, map_color, map_level
from airlight.scene.surface_map import SurfaceMap, surface_map

if TYPE_CHECKING:
    from airlight.planets.medium import Medium


@lru_cache(maxsize=8)
def deck_altitude(medium: Medium) -> float:
    """Altitude of the deck: where a horizontal line of sight has an optical depth of 1. [m]

    That of the wavelength nearest to 550 nm; 0 if no line has it.

    Parameters
    ----------
    medium : Medium
        Medium, whose rays are taken as straight.
    """
    nearest = int(np.argmin(np.abs(medium.wavelengths - 550.0)))
    altitudes = np.linspace(0.0, medium.thickness, 1001)
    extinction = medium.extinction[:, nearest] @ medium.density.at(altitudes)
    radii = medium.bottom_radius + altitudes
    for i in range(len(radii) - 2, -1, -1):
        half = np.sqrt((radii[i:] - radii[i]) * (radii[i:] + radii[i]))
        if 2.0 * np.trapezoid(extinction[i:], half) >= 1.0:
            return float(altitudes[i])
    return 0.0


def full_disc_mean(picture: SurfaceMap) -> NDArray[np.float64]:
    """Mean of a map over the full disc by Lambert's law, seen from the equator, shape (3,). [1]

    A ring of latitude has the weight cos³φ; longitudes are averaged, as by a day.
    """
    zonal = picture.zonal(0)[:, :3]
    weights = np.sin(np.pi * (np.arange(len(zonal)) + 0.5) / len(zonal)) ** 3
    return np.asarray(weights @ zonal / weights.sum())


def deck_uniforms(medium: Medium) -> dict[str, float]:
    """Uniforms of the deck; zero without one.

    Parameters
    ----------
    medium : Medium
        Medium of the solution.
    """
    altitude, gains = 0.0, np.zeros(3)
    if medium.surface.deck is not None:
        altitude = deck_altitude(medium)
        mean = full_disc_mean(surface_map(medium.surface.deck))
        gains = 1.0 / np.maximum(medium.surface.brightness * mean, 1e-6)
    return {
        "deck_altitude": altitude,
        "deck_radius": medium.bottom_radius + altitude,
        **{f"deck_gain_{c}": float(gain) for c, gain in zip("xyz", gains, strict=True)},
    }


@inlined
def meets_deck(ray, found, observer, frame, color):
    """Whether a line of sight meets the deck from above; the map's colour there, into ``color``.

    Parameters
    ----------
    ray, found : Vec3, ClassifiedRay
        Direction in the observer's frame, and class of the line. [1]
    observer, frame : Observer, FrameTables
        Observer, and what the pixels read.
    color : array, shape (12,)
        Its first values receive the linear sRGB of the map. [1]
    """
    view = frame.camera
    deck = view.deck_radius
    above = observer.optical_altitude - view.deck_altitude
    impact = observer.r * found.sine
    meets = found.through_air and above > 0.0 and ray.z < 0.0 and impact < deck
    if meets:
        half = sqrt((deck - impact) * (deck + impact))
        reach = above * (observer.r + deck) / (half - observer.r * ray.z)
        end = Vec3(reach * ray.x, reach * ray.y, observer.r + reach * ray.z)
        latitude, longitude = latitude_longitude(
            components(end, observer.ground_x, observer.ground_y, observer.ground_z)
        )
        level = map_level(view.pixel_angle, reach, half / deck, deck, view.map_rows)
        map_color(
            view.texels, view.map_rows, view.map_columns, view.map_levels, latitude, longitude,
            level, color, 0,
        )  # fmt: skip
    return meets


@inlined
def shade_deck(ray, found, observer, frame, color, result):
    """Multiply the light of a line of sight by the deck's map, if it meets the deck.

    Parameters
    ----------
    ray, found, observer, frame, color :
        Arguments of ``meets_deck``.
    result : array, shape (w,)
        Radiance of the pixel. [sr⁻¹]
    """
    if frame.camera.decked and meets_deck(ray, found, observer, frame, color):
        gain = frame.camera.deck_gain
        red, green, blue = color[0] * gain.x, color[1] * gain.y, color[2] * gain.z
        for at in range(0, frame.tables.lanes, LANES):
            basis = lane_view(frame.tables.basis, at)
            factor = basis[0] * np.float32(red)
            factor = factor + basis[1] * np.float32(green) + basis[2] * np.float32(blue)
            store(result, at, load(result, at) * maximum(factor, splat(0.0)))
