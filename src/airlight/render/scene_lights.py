"""Illumination of the bodies of a scene: directions, irradiances and eclipses."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from threading import RLock
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConflictError
from airlight.geometry.disc_overlap import visible_discs
from airlight.geometry.quadrature import gauss_legendre
from airlight.planets.light_source import LightSource
from airlight.scene.system import System
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light
from airlight.solver.disc_light import disc_light
from airlight.solver.shadow_light import ShadowLight

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]

#: Nodes in angular separation of an eclipse by a planet with air: direct and scattered light.
_SEPARATIONS: Final = 192
_SCATTERED: Final = 12
#: Quadrature points over a star's disc.
_POINTS: Final = 16


class Shade(NamedTuple):
    """Body before a star, seen from another body.

    Attributes
    ----------
    body : Body
        Body before the star.
    separations : array, shape (n,)
        Even angles between its centre and the star's. [rad]
    left : array, shape (n, nl)
        Unocculted fraction of the star's irradiance, from the centre of the shaded body. [1]
    radius : float
        Sine of its angular radius there; 0 of a planet with air, whose size is not varied. [1]
    """

    body: Body
    separations: FloatArray
    left: FloatArray
    radius: float


@dataclass(frozen=True, eq=False)
class SceneLights:
    """Light sources of a scene, at any point.

    Attributes
    ----------
    system : System
        Bodies and lights.
    wavelengths : array, shape (nl,)
        Wavelengths. [nm]
    solutions : mapping
        Solutions of planets with an atmosphere by body name.
    """

    system: System
    wavelengths: FloatArray
    solutions: Mapping[str, MomentsSolution]
    _sources: dict[tuple[str, bool, str], LightSource] = field(default_factory=dict)
    _shadows: dict[tuple[str, str, str], tuple[FloatArray, FloatArray]] = field(
        default_factory=dict
    )
    # Reentrant: a source depends on shadows, and a shadow on sources.
    _lock: RLock = field(default_factory=RLock)

    @cached_property
    def stars(self) -> tuple[Light, ...]:
        """Stars among the lights."""
        return tuple(light for light in self.system.lights if light.star is not None)

    def on(self, body: Body) -> list[Light]:
        """All lights except the body itself."""
        return [light for light in self.system.lights if light.body != body.name]

    def towards(self, light: Light, points: FloatArray) -> FloatArray:
        """Unit vectors from points towards a light, shape (n, 3). [1]"""
        if light.body is not None:
            offset = self.system.body(light.body).centre - points
            return np.asarray(offset / np.linalg.norm(offset, axis=-1, keepdims=True))
        return light.towards(points)

    def place_of(self, light: Light) -> FloatArray | None:
        """Position of a light, shape (3,) [m]; None at infinity."""
        if light.body is not None:
            return self.system.body(light.body).centre
        return None if light.position is None else np.asarray(light.position, float)

    def seen_from(self, light: Light, body: Body) -> LightSource:
        """Light source as seen from the centre of a body, cached."""
        key = (light.body or light.name, light.star is None, body.name)
        with self._lock:
            if key not in self._sources:
                self._sources[key] = self.source(light, body.centre)
            return self._sources[key]

    def source(self, light: Light, point: FloatArray) -> LightSource:
        """Light source as seen from a point: irradiance, angular radius, spectrum.

        Parameters
        ----------
        light : Light
            Star, or reflecting body.
        point : array, shape (3,)
            Position. [m]
        """
        nm = self.wavelengths
        if light.star is not None:
            return light.star_at(point).source(light.name, nm)
        assert light.body is not None
        body = self.system.body(light.body)
        offset = point - body.centre
        distance = float(np.linalg.norm(offset))
        radius = self.system.radius(body)
        irradiance = np.zeros(nm.size)
        for star in self.stars:
            lit = self.seen_from(star, body)
            cosine = float(star.towards(body.centre) @ offset) / distance
            phase = float(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))
            if body.name in self.solutions:
                share = disc_light(self.solutions[body.name], phase)
            else:
                share = body.brightness(nm, phase)
            left = self.unshadowed(star, body.centre[None], body)[0]
            irradiance += lit.irradiance * left * share * (radius / distance) ** 2
        return LightSource(
            name=body.name,
            angular_radius=float(np.arcsin(min(radius / distance, 1.0))),
            wavelengths=nm,
            irradiance=irradiance,
        )

    def unshadowed(self, star: Light, points: FloatArray, own: Body) -> FloatArray:
        """Unocculted fraction of a star's irradiance at points, shape (n, nl). [1]

        Parameters
        ----------
        points : array, shape (n, 3)
            Positions on the surface or at the centre of a body. [m]
        own : Body
            That body, which does not occult.
        """
        left = np.ones((len(points), self.wavelengths.size))
        source = self.seen_from(star, own)
        alpha = source.angular_radius
        if alpha <= 0.0:
            return left
        darkening = source.darkenings
        bare = []
        for body in self.system.bodies:
            if body.name == own.name:
                continue
            offset = body.centre - points
            distance = np.linalg.norm(offset, axis=-1)
            cosine = np.einsum("nk,k->n", offset / distance[:, None], star.towards(own.centre))
            separation = np.arccos(np.clip(cosine, -1.0, 1.0))
            outer = np.arcsin(np.minimum(self.system.outer_radius(body) / distance, 1.0))
            if np.all(separation > outer + alpha):
                continue
            if body.name in self.solutions:
                left *= self._behind(body, own, source, separation)
            else:
                bare.append((offset / distance[:, None], separation, outer))
        if bare:
            left *= _beside(star.towards(own.centre), alpha, bare, darkening)
        return left

    def shade(self, star: Light, own: Body, *, whole: bool = False) -> Shade | None:
        """Body whose shadow falls on another body; None without one.

        Parameters
        ----------
        star, own : Light, Body
            Star, and body that it lights.
        whole : bool
            Whether the table has all separations, for bodies that move on.

        Raises
        ------
        ConflictError
            If there are several.
        """
        source, found = self.seen_from(star, own), None
        alpha, towards = source.angular_radius, star.towards(own.centre)
        for body in self.system.bodies:
            offset = body.centre - own.centre
            distance = float(np.linalg.norm(offset))
            if body.name == own.name or alpha <= 0.0:
                continue
            apart = math.atan2(
                float(np.linalg.norm(np.cross(offset, towards))), float(offset @ towards)
            )
            reach = 2.0 * math.asin(min(self.system.radius(own) / distance, 1.0))
            outer = math.asin(min(self.system.outer_radius(body) / distance, 1.0))
            if apart > outer + alpha + reach:
                continue
            if found is not None:
                raise ConflictError(own.name, f"is behind both {found.body.name} and {body.name}")
            if body.name in self.solutions:
                ends = np.array(
                    [0.0, math.pi] if whole else [max(apart - reach, 0.0), apart + reach]
                )
                self._behind(body, own, source, ends)
                fine, left = self._shadows[body.name, own.name, source.name]
                found = Shade(body, fine, left, 0.0)
            else:
                fine = np.linspace(max(outer - alpha, 0.0), outer + alpha, _SEPARATIONS)
                left = _beside_one(alpha, fine, outer, source.darkenings)
                found = Shade(body, fine, left, math.sin(outer))
        return found

    def _behind(
        self, body: Body, own: Body, source: LightSource, separation: FloatArray
    ) -> FloatArray:
        """Unocculted fraction behind an atmosphere, interpolated in angular separation. [1]"""
        with self._lock:
            key = (body.name, own.name, source.name)
            if key not in self._shadows:
                self._shadows[key] = self._shadow_table(body, own, source, separation)
            fine, direct = self._shadows[key]
        at = np.clip(separation, fine[0], fine[-1])
        found = np.stack([np.interp(at, fine, column) for column in direct.T], axis=-1)
        return np.asarray(np.where((separation > fine[-1])[:, None], 1.0, found))

    def _shadow_table(
        self, body: Body, own: Body, source: LightSource, separation: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Separations and unocculted fractions behind a planet, over another body's surface."""
        distance = float(np.linalg.norm(body.centre - own.centre))
        shadow = ShadowLight(self.solutions[body.name].with_light(source), distance)
        # Parallax of centre and star between any two points of the body.
        reach = 2.0 * float(np.arcsin(min(self.system.radius(own) / distance, 1.0)))
        low = max(float(separation.min()) - reach, 0.0)
        high = min(float(separation.max()) + reach, shadow.air_radius + source.angular_radius)
        fine, coarse = np.linspace(low, high, _SEPARATIONS), np.linspace(low, high, _SCATTERED)
        around = shadow.scattered(np.degrees(coarse))
        direct = shadow.at(np.degrees(fine))
        for k in range(direct.shape[1]):
            direct[:, k] += np.interp(fine, coarse, around[:, k])
        return fine, direct


def _beside(
    star: FloatArray,
    alpha: float,
    bare: list[tuple[FloatArray, FloatArray, FloatArray]],
    darkening: FloatArray,
) -> FloatArray:
    """Fraction of a star's irradiance not occulted by airless bodies, shape (n, nl). [1]"""
    across = np.cross(star, [0.0, 0.0, 1.0] if abs(star[2]) < 0.9 else [1.0, 0.0, 0.0])
    across /= np.linalg.norm(across)
    above = np.cross(star, across)
    occluders = np.stack(
        [
            np.stack([separation, np.arctan2(towards @ above, towards @ across), radius], axis=-1)
            for towards, separation, radius in bare
        ],
        axis=1,
    )
    return _left(alpha, occluders, darkening)


def _beside_one(
    alpha: float, separation: FloatArray, radius: float, darkening: FloatArray
) -> FloatArray:
    """Fraction of a star's irradiance left by one airless body, by separation, (n, nl). [1]"""
    occluders = np.zeros((separation.size, 1, 3))
    occluders[:, 0, 0], occluders[:, 0, 2] = separation, radius
    return _left(alpha, occluders, darkening)


def _left(alpha: float, occluders: FloatArray, darkening: FloatArray) -> FloatArray:
    """Result of ``visible_discs`` for stars of one size, shape (n, nl). [1]"""
    rule = gauss_legendre(_POINTS)
    out = np.empty((len(occluders), len(darkening)))
    visible_discs(
        np.full(len(occluders), alpha),
        np.ascontiguousarray(occluders),
        np.ascontiguousarray(darkening),
        rule.nodes,
        rule.weights,
        out,
    )
    return np.clip(out, 0.0, 1.0)
