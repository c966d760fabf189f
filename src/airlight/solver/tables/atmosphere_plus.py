"""Layout of a three-dimensional scattering table, Atmosphere Plus: (h, φ, δ).

The axes are altitude and the cosines of the view's and of the sun's zenith angle, by the linear,
the power or the weighted power mapping; there is no azimuth. In a texture, altitude is the width,
view the height and sun the depth. Source: Atmosphere Plus notes, second print, section 3.

The horizon falls between texels and moves with altitude. A look-up reads the rows of texels below
and above its altitude, each at the same coordinate within its own regions, and only texels on its
own side of the horizon.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.geometry.mappings.power import (
    altitude_coordinate,
    altitude_from_coordinate,
    cosine_coordinate,
    cosine_from_coordinate,
)
from airlight.geometry.mappings.texels import cell, index_coordinate
from airlight.geometry.mappings.weighted_power import (
    DEFAULT_LOWER_WEIGHT,
    DEFAULT_POWER,
    DEFAULT_SURFACE_OFFSET,
    DEFAULT_SURFACE_SLOPE,
    lower_weight,
    region_coordinate,
    surface_weight,
    view_from_coordinate,
    view_region,
)
from airlight.geometry.shell import horizon_cosine, meets_ground
from airlight.kernel import compiled_loop, kernel
from airlight.solver.tables.layout import Axis, FloatArray, Positions, TableLayout

#: Names of the mappings.
MAPPINGS = ("linear", "power", "weighted-power")
#: Largest exponent of a mapping.
_LARGEST_POWER = 10.0


class AtmospherePlusGrid(NamedTuple):
    """Parameters of the layout, for compiled loops.

    Attributes
    ----------
    bottom_radius, top_radius : float
        Radii of the ground and of the top of the shell. [m]
    weighted : bool
        Whether the views follow the weighted power mapping.
    altitude_power, view_power, sun_power : float
        Powers of the power mappings, 1 for linear; ``view_power`` also of all three regions. [1]
    lower, slope, offset : float
        Weights w_L1, w_S1, w_S0 of the regions. [1]
    altitudes, views, sun_angles : int
        Texels along each axis.
    first_sky : array, shape (altitudes,)
        Index of the first view texel above the horizon at each altitude.
    """

    bottom_radius: float
    top_radius: float
    weighted: bool
    altitude_power: float
    view_power: float
    sun_power: float
    lower: float
    slope: float
    offset: float
    altitudes: int
    views: int
    sun_angles: int
    first_sky: NDArray[np.int64]


@kernel
def view_of_texel(i, j, grid):
    """Cosine and side of the horizon of view texel j at altitude texel i: (mu, to_ground)."""
    u = index_coordinate(i, grid.altitudes)
    v = index_coordinate(j, grid.views)
    bottom = grid.bottom_radius
    thickness = grid.top_radius - bottom
    r = bottom + altitude_from_coordinate(u, thickness, grid.altitude_power)
    if grid.weighted:
        p = grid.view_power
        w_lower = lower_weight(u, grid.lower)
        w_surface = surface_weight(u, grid.slope, grid.offset)
        return view_from_coordinate(v, horizon_cosine(r, bottom), p, p, p, w_lower, w_surface)
    mu = cosine_from_coordinate(v, grid.view_power)
    return mu, meets_ground(r, mu, bottom)


@kernel
def _view_cell(row, region, x, v, to_ground, grid):
    """Texels next to a view in the row of one altitude, on its side of the horizon."""
    coordinate = v
    if grid.weighted:
        u = index_coordinate(row, grid.altitudes)
        w_lower = lower_weight(u, grid.lower)
        coordinate = region_coordinate(
            region, x, w_lower, surface_weight(u, grid.slope, grid.offset)
        )
    sky = grid.first_sky[row]
    first, last = sky, grid.views - 1
    if to_ground:
        first, last = 0, max(sky - 1, 0)
    return cell(coordinate * (grid.views - 1), first, max(first, last))


@kernel
def atmosphere_plus_corners(r, mu, mu_s, to_ground, grid):
    """Texels next to a point: (lower, upper, weight of the upper) of four axes.

    Parameters
    ----------
    r, mu, mu_s : float
        Radius [m]; cosines of the view's and of the sun's zenith angle [1].
    to_ground : bool
        Whether the line of sight ends on the ground: only such texels are read.
    grid : AtmospherePlusGrid
        Parameters of the layout.

    Returns
    -------
    altitude, view_below, view_above, sun : tuples of (int, int, float)
        Cells of the altitude, of the view in the lower and in the upper altitude's row, of the sun.
    """
    bottom = grid.bottom_radius
    u = altitude_coordinate(r - bottom, grid.top_radius - bottom, grid.altitude_power)
    altitude = cell(u * (grid.altitudes - 1), 0, grid.altitudes - 1)
    p = grid.view_power
    region, x, v = 0, 0.0, 0.0
    if grid.weighted:
        region, x = view_region(mu, to_ground, horizon_cosine(r, bottom), p, p, p)
    else:
        v = cosine_coordinate(mu, p)
    w = cosine_coordinate(mu_s, grid.sun_power)
    lower, upper, share = altitude
    if to_ground and grid.first_sky[lower] == 0:  # no texel there looks at the ground: w_S0 = 0
        share = 1.0
    altitude = lower, upper, share
    return (
        altitude,
        _view_cell(altitude[0], region, x, v, to_ground, grid),
        _view_cell(altitude[1], region, x, v, to_ground, grid),
        cell(w * (grid.sun_angles - 1), 0, grid.sun_angles - 1),
    )


@compiled_loop
def atmosphere_plus_look_up(values, r, mu, mu_s, to_ground, grid, out):
    """Interpolate all channels at one point.

    Parameters
    ----------
    values : array, shape (altitudes, views, sun_angles, channels)
    r, mu, mu_s, to_ground, grid
        Arguments of ``atmosphere_plus_corners``.
    out : array, shape (channels,)
        Receives the values.
    """
    altitude, below, above, sun = atmosphere_plus_corners(r, mu, mu_s, to_ground, grid)
    out[:] = 0.0
    for corner in range(8):
        up, along, around = corner & 1, corner & 2, corner & 4
        i = altitude[1] if up else altitude[0]
        weight = altitude[2] if up else 1.0 - altitude[2]
        share = above[2] if up else below[2]
        if along:
            j = above[1] if up else below[1]
            weight *= share
        else:
            j = above[0] if up else below[0]
            weight *= 1.0 - share
        k = sun[1] if around else sun[0]
        weight *= sun[2] if around else 1.0 - sun[2]
        if weight != 0.0:
            for c in range(out.size):
                out[c] += weight * values[i, j, k, c]


@compiled_loop
def _look_up_all(values, r, mu, mu_s, to_ground, grid, out):
    for p in range(r.size):
        atmosphere_plus_look_up(values, r[p], mu[p], mu_s[p], to_ground[p], grid, out[p])


@compiled_loop
def _find_first_sky(grid, first_sky):
    for i in range(grid.altitudes):
        first_sky[i] = grid.views - 1
        for j in range(grid.views):
            if not view_of_texel(i, j, grid)[1]:
                first_sky[i] = j
                break


@compiled_loop
def _fill_positions(grid, r, mu, mu_s, to_ground):
    bottom, thickness = grid.bottom_radius, grid.top_radius - grid.bottom_radius
    at = 0
    for i in range(grid.altitudes):
        u = index_coordinate(i, grid.altitudes)
        h = altitude_from_coordinate(u, thickness, grid.altitude_power)
        for j in range(grid.views):
            cosine, ground = view_of_texel(i, j, grid)
            for k in range(grid.sun_angles):
                r[at] = min(bottom + h, grid.top_radius)
                mu[at], to_ground[at] = cosine, ground
                w = index_coordinate(k, grid.sun_angles)
                mu_s[at] = cosine_from_coordinate(w, grid.sun_power)
                at += 1


@dataclass(frozen=True, kw_only=True)
class AtmospherePlusLayout(TableLayout):
    """Layout with the axes (altitude, mu, mu_s).

    Parameters
    ----------
    bottom_radius, top_radius : float
        Radii of the ground and of the top of the shell. [m]
    mapping : str
        Name of the mapping: ``linear``, ``power`` or ``weighted-power``.
    altitudes, views, sun_angles : int
        Texels along each axis.
    altitude_power, view_power, sun_power : float
        Powers, 1 to 10; ``linear`` takes 1 for all. [1]
    lower_weight, surface_slope, surface_offset : float
        Weights w_L1, w_S1 and w_S0 of the weighted power mapping, 0 or more, together below 1. [1]
    azimuth : float
        Azimuth of the texels; 0 towards the sun. [deg]
    """

    kind: ClassVar[str] = "atmosphere-plus"
    bottom_radius: float
    top_radius: float
    mapping: str = "weighted-power"
    altitudes: int = 32
    views: int = 256
    sun_angles: int = 32
    altitude_power: float = DEFAULT_POWER
    view_power: float = DEFAULT_POWER
    sun_power: float = DEFAULT_POWER
    lower_weight: float = DEFAULT_LOWER_WEIGHT
    surface_slope: float = DEFAULT_SURFACE_SLOPE
    surface_offset: float = DEFAULT_SURFACE_OFFSET
    azimuth: float = 0.0

    def __post_init__(self) -> None:
        if self.mapping not in MAPPINGS:
            raise ParameterError("mapping", self.mapping, ", ".join(MAPPINGS))
        self._check_shell()
        for name in ("altitude_power", "view_power", "sun_power"):
            if not 1.0 <= getattr(self, name) <= _LARGEST_POWER:
                raise ParameterError(name, getattr(self, name), f"1 to {_LARGEST_POWER:g}")
        weights = (self.lower_weight, self.surface_slope, self.surface_offset)
        if min(weights) < 0.0 or not sum(weights) < 1.0:
            raise ParameterError(
                "lower_weight, surface_slope, surface_offset",
                weights,
                "0 or more, with a sum below 1; the rest is the weight above the horizontal",
            )
        if weights[1] + weights[2] <= 0.0:
            raise ParameterError(
                "surface_slope, surface_offset", weights[1:], "at least one above 0"
            )
        if not -360.0 <= self.azimuth <= 360.0:
            raise ParameterError("azimuth", self.azimuth, "-360 to 360 deg")

    @cached_property
    def grid(self) -> AtmospherePlusGrid:
        """Parameters of the layout, for compiled loops."""
        linear = self.mapping == "linear"
        first_sky = np.zeros(self.altitudes, np.int64)
        grid = AtmospherePlusGrid(
            self.bottom_radius,
            self.top_radius,
            self.mapping == "weighted-power",
            1.0 if linear else self.altitude_power,
            1.0 if linear else self.view_power,
            1.0 if linear else self.sun_power,
            self.lower_weight,
            self.surface_slope,
            self.surface_offset,
            self.altitudes,
            self.views,
            self.sun_angles,
            first_sky,
        )
        _find_first_sky(grid, first_sky)
        return grid

    @property
    def axes(self) -> tuple[Axis, ...]:
        """See ``TableLayout``."""
        linear = self.mapping == "linear"
        thickness = self.top_radius - self.bottom_radius
        view: dict[str, float] = {} if linear else {"power": self.view_power}
        of_view = "(mu + 1) / 2" if linear else "(sign(mu) |mu|^(1/power) + 1) / 2"
        if self.mapping == "weighted-power":
            of_view = (
                "w_S (1 - ((mu_H - mu) / (1 + mu_H))^(1/power)) for views to the ground; w_L (1 - "
                "mu / mu_H)^(1/power) + w_S from the horizon to the horizontal; w_U "
                "mu^(1/power) + w_L + w_S above; mu_H: cosine of the horizon at this altitude, "
                "x: coordinate of the altitude, w_L = w_L1 x, w_S = w_S1 x + w_S0, w_U = 1 - w_L "
                "- w_S"
            )
            view |= {
                "w_L1": self.lower_weight,
                "w_S1": self.surface_slope,
                "w_S0": self.surface_offset,
                "bottom_radius": self.bottom_radius,
            }
        return (
            Axis(
                name="altitude",
                size=self.altitudes,
                unit="m",
                parameters={"thickness": thickness}
                | ({} if linear else {"power": self.altitude_power}),
                mapping="h / thickness" if linear else "(h / thickness)^(1/power)",
            ),
            Axis(name="mu", size=self.views, unit="1", parameters=view, mapping=of_view),
            Axis(
                name="mu_s",
                size=self.sun_angles,
                unit="1",
                parameters={} if linear else {"power": self.sun_power},
                mapping="(mu_s + 1) / 2" if linear else "(sign(mu_s) |mu_s|^(1/power) + 1) / 2",
            ),
        )

    @property
    def texture_axes(self) -> tuple[tuple[str, ...], ...]:
        """See ``TableLayout``."""
        return (("altitude",), ("mu",), ("mu_s",))

    def positions(self) -> Positions:
        """See ``TableLayout``; at the layout's azimuth."""
        count = int(np.prod(self.shape))
        r, mu, mu_s = (np.empty(count) for _ in range(3))
        to_ground = np.empty(count, bool)
        _fill_positions(self.grid, r, mu, mu_s, to_ground)
        return at_azimuth(Positions(r, mu, mu_s, mu, to_ground), self.azimuth)

    def interpolate(self, values: NDArray[Any], positions: Positions) -> FloatArray:
        """See ``TableLayout``; ``nu`` is ignored."""
        out = np.empty((len(positions), values.shape[-1]))
        _look_up_all(
            values, positions.r, positions.mu, positions.mu_s, positions.to_ground, self.grid, out
        )
        return out

    def parameters(self) -> dict[str, Any]:
        """See ``TableLayout``."""
        return {
            "bottom_radius": self.bottom_radius,
            "top_radius": self.top_radius,
            "mapping": self.mapping,
            "altitudes": self.altitudes,
            "views": self.views,
            "suns": self.sun_angles,
            "altitude_power": self.altitude_power,
            "view_power": self.view_power,
            "sun_power": self.sun_power,
            "lower_weight": self.lower_weight,
            "surface_slope": self.surface_slope,
            "surface_offset": self.surface_offset,
            "azimuth": self.azimuth,
        }


def at_azimuth(positions: Positions, azimuth: float) -> Positions:
    """Points with views at this azimuth from the sun. [deg]"""
    mu, mu_s = positions.mu, positions.mu_s
    spread = np.sqrt(np.maximum((1.0 - mu) * (1.0 + mu) * (1.0 - mu_s) * (1.0 + mu_s), 0.0))
    nu = np.clip(mu * mu_s + spread * np.cos(np.radians(azimuth)), -1.0, 1.0)
    return Positions(positions.r, mu, mu_s, nu, positions.to_ground)
