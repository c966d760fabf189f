"""Parallel lines of sight of an observer at infinity, by impact parameter and position angle."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.path import ray_length
from airlight.geometry.shell import meets_ground
from airlight.kernel import vectorized
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.refracted_geometry import RefractedGeometry

FloatArray = NDArray[np.float64]


def lines_into_shell(
    impact: FloatArray, mu_s: FloatArray, nu: FloatArray, bottom: float, top: float
) -> LinesOfSight:
    """Lines of sight from their entry points into the shell.

    Parameters
    ----------
    impact : array, shape (n,)
        Impact parameter, 0 to ``top``. [m]
    mu_s, nu : array, shape (n,)
        Cosines of the sun's zenith angle at the entry point, and of the angle between line of sight
        and sun. [1]
    bottom, top : float
        Radii of the ground and of the shell's top. [m]
    """
    sine = np.minimum(impact / top, 1.0)
    mu = -np.sqrt((1.0 - sine) * (1.0 + sine))
    r = np.full(mu.shape, top)
    return LinesOfSight(
        r, mu, np.clip(mu_s, -1.0, 1.0), np.clip(nu, -1.0, 1.0),
        vectorized(ray_length)(r, mu, bottom, top), vectorized(meets_ground)(r, mu, bottom),
    )  # fmt: skip


def disc_lines(
    impact: FloatArray, position: FloatArray, phase: float, bottom: float, top: float
) -> LinesOfSight:
    """Lines of sight over the disc of a planet at a phase angle.

    With z towards the observer and x towards the sun's side of the disc, the sun is at
    (sin α, 0, cos α), a line enters at (b cos ψ, b sin ψ, √(top² - b²)) and runs along -z.

    Parameters
    ----------
    impact, position : array, shape (n,)
        Impact parameter b [m], and position angle ψ from the sun's side [rad].
    phase : float
        Phase angle α between star and observer at the planet. [rad]
    """
    height = np.sqrt(np.maximum(top * top - impact * impact, 0.0))
    mu_s = (impact * np.cos(position) * np.sin(phase) + height * np.cos(phase)) / top
    return lines_into_shell(impact, mu_s, np.full(mu_s.shape, -np.cos(phase)), bottom, top)


def ground_edge(geometry: RefractedGeometry) -> float:
    """Apparent radius of the ground from infinity, enlarged by refraction. [m]"""
    return geometry.medium.bottom_radius if geometry.shell is None else float(geometry.shell.bottom)
