"""Lines of sight inside the shell, and entry points for observers outside."""

from __future__ import annotations

from dataclasses import dataclass, field, fields

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.path import ray_length
from airlight.geometry.shell import meets_ground
from airlight.kernel import vectorized

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class LinesOfSight:
    """Lines of sight inside the shell, as flat arrays.

    Attributes
    ----------
    r, mu, mu_s, nu : array, shape (n,)
        Radius of the start [m]; cosines of view zenith angle, sun zenith angle and the angle
        between view and sun [1].
    length : array, shape (n,)
        Length inside the shell, 0 where the line misses it. [m]
    to_ground : array of bool, shape (n,)
        Whether the line ends on the ground.
    pole : array, shape (n, 3), optional
        North pole in the frame of ``start_frame``, for the shadow of rings; 0 without. [1]
    """

    r: FloatArray
    mu: FloatArray
    mu_s: FloatArray
    nu: FloatArray
    length: FloatArray
    to_ground: NDArray[np.bool_]
    pole: FloatArray = field(default_factory=lambda: np.zeros((0, 3)))

    def __post_init__(self) -> None:
        if len(self.pole) != self.r.size:
            object.__setattr__(self, "pole", np.zeros((self.r.size, 3)))
        # marches are compiled for contiguous writable arrays, and would be again for any other kind
        for one in fields(self):
            array = np.require(getattr(self, one.name), requirements=("C", "W"))
            object.__setattr__(self, one.name, array)


def start_frame(up: FloatArray, along: FloatArray, towards: FloatArray) -> FloatArray:
    """Axes at the start of a line: x towards the star, y sideways, z up, shape (3, 3). [1]

    Parameters
    ----------
    up, along, towards : array, shape (3,)
        Vertical, and directions of the line and of the star. [1]
    """
    flat = towards - (towards @ up) * up
    if np.linalg.norm(flat) < 1e-12:
        flat = along - (along @ up) * up
    if np.linalg.norm(flat) < 1e-12:
        flat = np.cross(up, [0.0, 0.0, 1.0] if abs(up[2]) < 0.9 else [1.0, 0.0, 0.0])
    x = flat / np.linalg.norm(flat)
    y = np.cross(up, x)
    return np.stack([x, y if along @ y >= 0.0 else -y, up])


def distance_to_shell(
    r: FloatArray, mu: FloatArray, sine: FloatArray, top: float | FloatArray
) -> FloatArray:
    """Distances from observers to where their lines enter the shell, 0 from within. [m]

    Parameters
    ----------
    r, mu, sine, top :
        Arguments of ``enter_shell``.
    """
    half_chord = np.sqrt(np.maximum(np.square(top) - np.square(r * sine), 0.0))
    return np.where(r > top, -r * mu - half_chord, 0.0)


def enter_shell(
    r: FloatArray,
    mu: FloatArray,
    sine: FloatArray,
    mu_s: FloatArray,
    nu: FloatArray,
    bottom: float,
    top: float,
) -> LinesOfSight:
    """Move observers outside the shell to the point where their line of sight enters it.

    Parameters
    ----------
    r, mu, sine, mu_s, nu : array, shape (n,)
        Coordinates of the observers; r may be larger than ``top``. ``sine`` is the sine of the
        view zenith angle, which the cosine loses far away. [m], [1]
    bottom, top : float
        Radii of the ground and of the top of the shell. [m]
    """
    outside = r > top
    nearest = -r * mu
    impact_squared = np.square(r * sine)
    half_chord = np.sqrt(np.maximum((top * top) - impact_squared, 0.0))
    meets = (nearest > 0.0) & (impact_squared < top * top)
    enters = outside & meets
    way = np.where(enters, nearest - half_chord, 0.0)
    inside_r = np.where(outside, top, r)
    inside_mu = np.where(enters, -half_chord / top, mu)
    inside_mu_s = np.where(enters, np.clip((r * mu_s + way * nu) / top, -1.0, 1.0), mu_s)
    to_ground = vectorized(meets_ground)(inside_r, inside_mu, bottom)
    length = vectorized(ray_length)(inside_r, inside_mu, bottom, top)
    missed = outside & ~meets
    return LinesOfSight(
        inside_r, inside_mu, inside_mu_s, nu, np.where(missed, 0.0, length), to_ground & ~missed
    )
