"""Layout of a four-dimensional scattering table, Bruneton's 2017 (r, mu, mu_s, nu).

The axis of views has two halves, one on each side of the horizon. In a texture, mu_s and nu share
the width, mu_s running fastest, mu is the height and r the depth: 256 x 128 x 32 for the usual
32 x 128 x 32 x 8.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.geometry.mappings.scattering import (
    angle_coordinate,
    angle_from_coordinate,
    cosine_from_view,
    lowest_sun_cosine,
    possible_angle,
    sun_coordinate,
    sun_from_coordinate,
    view_coordinate,
    view_from_index,
    view_index,
)
from airlight.geometry.mappings.texels import cell, index_coordinate
from airlight.geometry.mappings.transmittance import altitude_coordinate, radius_from_coordinate
from airlight.kernel import compiled_loop, kernel
from airlight.solver.tables.layout import Axis, FloatArray, Positions, TableLayout


class BrunetonGrid(NamedTuple):
    """Parameters of the layout, for compiled loops.

    Attributes
    ----------
    bottom_radius, top_radius : float
        Radii of the ground and of the top of the shell. [m]
    lowest : float
        Smallest zenith cosine of the sun. [1]
    radii, views, sun_angles, angles : int
        Texels along r, mu, mu_s, nu.
    """

    bottom_radius: float
    top_radius: float
    lowest: float
    radii: int
    views: int
    sun_angles: int
    angles: int


@kernel
def bruneton_corners(r, mu, mu_s, nu, to_ground, grid):
    """Texels next to a point: (lower, upper, weight of the upper) of r, mu, mu_s and nu.

    Parameters
    ----------
    r, mu, mu_s, nu : float
        Radius [m]; cosines of the zenith angles of view and sun, and of the angle between them [1].
    to_ground : bool
        Whether the line of sight ends on the ground, which selects the half of the views.
    grid : BrunetonGrid
        Parameters of the layout.
    """
    bottom, top = grid.bottom_radius, grid.top_radius
    x = view_coordinate(r, mu, to_ground, bottom, top)
    half, last = grid.views // 2, grid.sun_angles - 1
    first = 0 if to_ground else half
    return (
        cell(altitude_coordinate(r, bottom, top) * (grid.radii - 1), 0, grid.radii - 1),
        cell(view_index(x, to_ground, grid.views), first, first + half - 1),
        cell(sun_coordinate(mu_s, grid.lowest, bottom, top) * last, 0, last),
        cell(angle_coordinate(nu) * (grid.angles - 1), 0, grid.angles - 1),
    )


@compiled_loop
def bruneton_look_up(values, r, mu, mu_s, nu, to_ground, grid, out):
    """Interpolate all channels at many points.

    Parameters
    ----------
    values : array, shape (radii, views, sun_angles, angles, channels)
    r, mu, mu_s, nu, to_ground : array, shape (n,)
        Arguments of ``bruneton_corners``.
    out : array, shape (n, channels)
        Receives the values.
    """
    flat, found = values.reshape(-1), out.reshape(-1)
    channels = out.shape[1]
    by_sun = grid.angles * channels
    by_view = grid.sun_angles * by_sun
    by_radius = grid.views * by_view
    for p in range(r.size):
        radius, view, sun, angle = bruneton_corners(r[p], mu[p], mu_s[p], nu[p], to_ground[p], grid)
        low, high = radius[0] * by_radius, radius[1] * by_radius
        near, far = view[0] * by_view, view[1] * by_view
        one, two = sun[0] * by_sun, sun[1] * by_sun
        first, second = angle[0] * channels, angle[1] * channels
        f, e, d, c = radius[2], view[2], sun[2], angle[2]
        g, b, a = 1.0 - e, 1.0 - d, 1.0 - c
        for channel in range(channels):
            at, after = first + channel, second + channel
            below = g * (
                b * (a * flat[low + near + one + at] + c * flat[low + near + one + after])
                + d * (a * flat[low + near + two + at] + c * flat[low + near + two + after])
            ) + e * (
                b * (a * flat[low + far + one + at] + c * flat[low + far + one + after])
                + d * (a * flat[low + far + two + at] + c * flat[low + far + two + after])
            )
            above = g * (
                b * (a * flat[high + near + one + at] + c * flat[high + near + one + after])
                + d * (a * flat[high + near + two + at] + c * flat[high + near + two + after])
            ) + e * (
                b * (a * flat[high + far + one + at] + c * flat[high + far + one + after])
                + d * (a * flat[high + far + two + at] + c * flat[high + far + two + after])
            )
            found[p * channels + channel] = (1.0 - f) * below + f * above


@compiled_loop
def _fill_positions(grid, r, mu, mu_s, nu, to_ground):
    bottom, top = grid.bottom_radius, grid.top_radius
    at = 0
    for i in range(grid.radii):
        radius = radius_from_coordinate(index_coordinate(i, grid.radii), bottom, top)
        radius = min(max(radius, bottom), top)
        for j in range(grid.views):
            x, ground = view_from_index(float(j), grid.views)
            cosine = cosine_from_view(x, ground, radius, bottom, top)
            for k in range(grid.sun_angles):
                x_s = index_coordinate(k, grid.sun_angles)
                sun = sun_from_coordinate(x_s, grid.lowest, bottom, top)
                for l in range(grid.angles):
                    angle = angle_from_coordinate(index_coordinate(l, grid.angles))
                    r[at], mu[at], mu_s[at], to_ground[at] = radius, cosine, sun, ground
                    nu[at] = possible_angle(angle, cosine, sun)
                    at += 1


@dataclass(frozen=True, kw_only=True)
class BrunetonLayout(TableLayout):
    """Layout with the axes (r, mu, mu_s, nu).

    Parameters
    ----------
    bottom_radius, top_radius : float
        Radii of the ground and of the top of the shell. [m]
    radii, views, sun_angles, angles : int
        Texels along each axis; ``views`` is even and at least 4.
    mu_s_min : float, optional
        Lowest cosine of the sun's zenith angle in the table, -1 to 0; default: the end of twilight
        (``geometry.mappings.scattering.lowest_sun_cosine``). [1]
    """

    kind: ClassVar[str] = "bruneton-scattering"
    bottom_radius: float
    top_radius: float
    radii: int = 32
    views: int = 128
    sun_angles: int = 32
    angles: int = 8
    mu_s_min: float | None = None

    def __post_init__(self) -> None:
        if self.mu_s_min is not None and not -1.0 <= self.mu_s_min <= 0.0:
            raise ParameterError("mu_s_min", self.mu_s_min, "-1 to 0")
        self._check_shell()
        if self.views % 2 or self.views < 4:
            raise ParameterError("size of axis mu", self.views, "an even number from 4")

    @cached_property
    def grid(self) -> BrunetonGrid:
        """Parameters of the layout, for compiled loops."""
        lowest = self.mu_s_min
        if lowest is None:
            lowest = lowest_sun_cosine(self.bottom_radius, self.top_radius)
        return BrunetonGrid(
            self.bottom_radius,
            self.top_radius,
            float(lowest),
            self.radii,
            self.views,
            self.sun_angles,
            self.angles,
        )

    @property
    def axes(self) -> tuple[Axis, ...]:
        """See ``TableLayout``."""
        shell = {"bottom_radius": self.bottom_radius, "top_radius": self.top_radius}
        return (
            Axis(
                name="r",
                size=self.radii,
                unit="m",
                parameters=shell,
                mapping="sqrt((r² - bottom²) / (top² - bottom²))",
            ),
            Axis(
                name="mu",
                size=self.views,
                unit="1",
                parameters=shell,
                mapping="two halves of x = (d - d_min) / (d_max - d_min): texels 0 to n/2 - 1 for "
                "views to the ground, x from 1 to 0, d: distance to the ground, d_min = r - "
                "bottom, d_max = sqrt(r² - bottom²); texels n/2 to n - 1 for views to the sky, x "
                "from 0 to 1, d: distance to the top, d_min = top - r, d_max = sqrt(r² - bottom²) "
                "+ sqrt(top² - bottom²); no interpolation between the halves",
            ),
            Axis(
                name="mu_s",
                size=self.sun_angles,
                unit="1",
                parameters={**shell, "lowest_mu_s": self.grid.lowest},
                mapping="max(1 - a/A, 0) / (1 + a), a = (d - d_min) / (d_max - d_min), d: "
                "distance to the top from the ground towards the sun, d_min = top - bottom, d_max "
                "= sqrt(top² - bottom²), A: the same for lowest_mu_s",
            ),
            Axis(name="nu", size=self.angles, unit="1", mapping="(nu + 1) / 2"),
        )

    @property
    def texture_axes(self) -> tuple[tuple[str, ...], ...]:
        """See ``TableLayout``."""
        return (("nu", "mu_s"), ("mu",), ("r",))

    def positions(self) -> Positions:
        """See ``TableLayout``; impossible angles are moved to the nearest possible angle."""
        count = int(np.prod(self.shape))
        r, mu, mu_s, nu = (np.empty(count) for _ in range(4))
        to_ground = np.empty(count, bool)
        _fill_positions(self.grid, r, mu, mu_s, nu, to_ground)
        return Positions(r, mu, mu_s, nu, to_ground)

    def interpolate(self, values: NDArray[Any], positions: Positions) -> FloatArray:
        """See ``TableLayout``."""
        out = np.empty((len(positions), values.shape[-1]))
        bruneton_look_up(
            values,
            positions.r,
            positions.mu,
            positions.mu_s,
            positions.nu,
            positions.to_ground,
            self.grid,
            out,
        )
        return out

    def parameters(self) -> dict[str, Any]:
        """See ``TableLayout``."""
        return {
            "bottom_radius": self.bottom_radius,
            "top_radius": self.top_radius,
            "radii": self.radii,
            "views": self.views,
            "suns": self.sun_angles,
            "angles": self.angles,
            "mu_s_min": self.mu_s_min,
        }
