"""``Incident``: light that falls on a cloud field from above, and directions at its place."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.geometry.vectors import Vec3
from airlight.render.clouds.cloud_deck import CloudDeck
from airlight.render.clouds.mean_layer import MeanLayer
from airlight.solver.lines_of_sight import enter_shell

if TYPE_CHECKING:
    from airlight.scene import Scene
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]


class Dimming(Protocol):
    """What dims the beam above clouds: others with higher tops."""

    def visibility(self, altitude: float) -> FloatArray:
        """Share of the beam that reaches an altitude [m], shape (nl,). [1]"""


def field_axes(field: CloudField, scene: Scene) -> tuple[Vec3, Vec3, Vec3]:
    """Axes of a field's place in the observer's frame: east, north, up. [1]"""
    lat, lon = math.radians(field.latitude), math.radians(field.longitude)
    up = np.array([math.cos(lat) * math.cos(lon), math.cos(lat) * math.sin(lon), math.sin(lat)])
    east = np.array([-math.sin(lon), math.cos(lon), 0.0])
    rows = np.array([east, np.cross(up, east), up]) @ scene.ground_frame
    return tuple(Vec3(*row) for row in rows.tolist())  # type: ignore[return-value]


def sun_in_frame(scene: Scene) -> Vec3:
    """Direction to the light in the observer's frame, whose first axis is below it. [1]"""
    sun = scene.sun_direction
    return Vec3(float(np.hypot(sun[0], sun[1])), 0.0, float(sun[2]))


class OtherClouds(NamedTuple):
    """Clouds around those of a kind, which act on them by their mean.

    Attributes
    ----------
    layer : MeanLayer or None
        Mean layer of all clouds.
    higher : sequence of Dimming
        Those with higher tops, which dim the beam.
    decks : sequence of CloudDeck
        All of them; parts below the top of the box are even layers in it.
    """

    layer: MeanLayer | None = None
    higher: Sequence[Dimming] = ()
    decks: Sequence[CloudDeck] = ()


class Incident(NamedTuple):
    """Light that falls on a field from above.

    Attributes
    ----------
    towards : tuple of three float
        Unit vector to the light at the place of the field: east, north, up. [1]
    beam, sky : array, shape (nl,)
        Direct normal irradiance at the top, and diffuse irradiance, over that of the star. [1]
    direct : callable
        Direct normal irradiance of altitudes [m], shape (n,) to (n, nl). [1]
    radiance : callable
        Diffuse radiance from directions of propagation, shape (n, 3) to (n, nl). [sr⁻¹]
    """

    towards: tuple[float, float, float]
    beam: FloatArray
    sky: FloatArray
    direct: Callable[[FloatArray], FloatArray]
    radiance: Callable[[FloatArray], FloatArray]

    @property
    def irradiance(self) -> FloatArray:
        """Irradiance of the horizontal top over that of the star, shape (nl,). [1]"""
        return np.asarray(np.maximum(self.sky + self.beam * max(self.towards[2], 0.0), 1e-30))


def incident(
    solution: MomentsSolution,
    field: CloudField,
    towards: tuple[float, float, float],
    around: OtherClouds,
) -> Incident:
    """Light on a field under a light in a direction, with clouds around it.

    Parameters
    ----------
    solution, field : MomentsSolution, CloudField
        Planet without clouds, and clouds.
    towards : tuple of three float
        Unit vector to the light at the place of the field: east, north, up. [1]
    around : OtherClouds
        Other clouds.
    """
    medium = solution.medium
    top, mu_s = np.array([medium.bottom_radius + field.top]), np.array([towards[2]])

    def radiance(along: FloatArray) -> FloatArray:
        looking = -np.asarray(along, float)
        count = looking.shape[0]
        lines = enter_shell(
            np.full(count, top[0]),
            looking[:, 2],
            np.hypot(looking[:, 0], looking[:, 1]),
            np.full(count, towards[2]),
            np.clip(looking @ np.array(towards), -1.0, 1.0),
            medium.bottom_radius,
            medium.top_radius,
        )
        found = np.maximum(solution.relative_radiance(lines), 0.0)
        ratio = 1.0 if around.layer is None else around.layer.radiance_ratio(lines)
        return np.asarray(found * ratio)

    sky, layer = solution.relative_sky_irradiance(top, mu_s), around.layer
    seen = np.ones(medium.wavelengths.size)
    for one in around.higher:
        seen = seen * one.visibility(field.top)

    def direct(altitudes: FloatArray) -> FloatArray:
        r = medium.bottom_radius + np.asarray(altitudes, float)
        found = solution.relative_normal_irradiance(r, np.full(r.size, towards[2]))
        return np.asarray(np.maximum(found, 0.0) * seen)

    return Incident(
        towards,
        direct(np.array([field.top]))[0],
        (sky if layer is None else sky * layer.sky_ratio(top, mu_s))[0],
        direct,
        radiance,
    )


def sun_over(field: CloudField, scene: Scene) -> tuple[float, float, float]:
    """Direction to a scene's light at the place of a field: east, north, up. [1]"""
    sun = np.array(sun_in_frame(scene))
    east, north, up = (float(sun @ np.array(axis)) for axis in field_axes(field, scene))
    return east, north, up
