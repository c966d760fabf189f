r"""Direct irradiance at a point of the atmosphere, by quadrature without tables.

The star's disc is uniform. Transmittance is averaged over strips of equal elevation, so that a
setting disc with its vertical gradient is treated correctly; strips are assumed straight, an error
below 1e-5 for the sun.
"""

from __future__ import annotations

from math import acos, asin, cos, exp, pi, sin
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.path import MAX_EDGES, place_edges, place_nodes
from airlight.geometry.quadrature import gauss_legendre
from airlight.geometry.shell import chord
from airlight.geometry.sun_disc import star_elevation
from airlight.kernel import compiled_loop
from airlight.physics.optics.density_profile import relative_density
from airlight.solver.tables.columns import split_at_profile_edges

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]
Rule = tuple[FloatArray, FloatArray, FloatArray]

#: Points per panel and panels per leg of the ray to the star.
_NODES: Final = 20
PANELS: Final = 3
#: Number of strips of the star's disc.
_STRIPS: Final = 7
#: Elevation above the horizon from which a star is treated as a point: in clear air the mean over
#: strips differs by less than 1e-5. [rad]
_HIGH: Final = 0.7


class ShellOptics(NamedTuple):
    """Shell and its optics, for integrals along rays to the star.

    Attributes
    ----------
    shell : tuple of float
        Radii of the ground and of the top. [m]
    star_radius : float
        Angular radius of the star; 0 for a point. [rad]
    density : tuple of arrays
        Arrays of ``DensitySegments.arrays``.
    extinction : array, shape (nc, nl)
        Extinction coefficients. [m⁻¹]
    rules : tuple
        Rules for the ray to the star and for the strips of its disc.
    """

    shell: tuple[float, float]
    star_radius: float
    density: tuple[FloatArray, FloatArray, FloatArray]
    extinction: FloatArray
    rules: tuple[Rule, Rule]


def shell_optics(medium: Medium) -> ShellOptics:
    """Shell of a medium and its optics."""
    return ShellOptics(
        (medium.bottom_radius, medium.top_radius),
        medium.lights[0].angular_radius,
        medium.density.arrays,
        medium.extinction,
        star_rules(),
    )


@compiled_loop
def columns_to_space(r, mu, shell, density, rule, workspace, out):
    """Columns of all constituents from a point to the top, for a ray that misses the ground.

    Parameters
    ----------
    r, mu : float
        Start of the ray. [m], [1]
    shell : tuple of float
        Radii of the ground and of the top. [m]
    density : tuple of arrays
        Arrays of ``DensitySegments.arrays``.
    rule : tuple of arrays
        Gauss-Legendre rule.
    workspace : tuple of arrays
        Workspace from ``new_workspace``.
    out : array, shape (nc,)
        Receives the columns. [m]
    """
    edges, distance, radius, weight = workspace
    bottom, top = shell
    density_edges, coefficients, breakpoints = density
    length = max(-r * mu + chord(r, mu, top), 0.0)
    count = place_edges(r, mu, length, PANELS, 0.0, 0.0, edges)
    count = split_at_profile_edges(r, mu, bottom, breakpoints, edges, count)
    points = place_nodes(r, mu, edges, count, rule[0], rule[1], distance, radius, weight)
    for i in range(out.size):
        total = 0.0
        for k in range(points):
            total += weight[k] * relative_density(
                radius[k] - bottom, density_edges[i], coefficients[i]
            )
        out[i] = total


def new_workspace() -> tuple[FloatArray, ...]:
    """Workspace of one thread for ``columns_to_space``."""
    points = _NODES * MAX_EDGES
    return np.empty(MAX_EDGES), np.empty(points), np.empty(points), np.empty(points)


@compiled_loop
def star_light(r, mu_s, level, optics, workspace, light):
    """Direct irradiance at a point, averaged over the star's disc, per irradiance at the top.

    Parameters
    ----------
    r, mu_s : float
        Radius of the point, and zenith cosine of the star's centre there. [m], [1]
    level : bool
        Whether the irradiance is horizontal rather than normal to the beam.
    optics : ShellOptics
        Shell and its optics.
    workspace : tuple of arrays
        Argument of ``columns_to_space``.
    light : array, shape (nl,)
        Receives the light. [1]

    Returns
    -------
    bool
        Whether there is any light.
    """
    shell, star_radius, density, extinction, rules = optics
    bottom = shell[0]
    light[:] = 0.0
    elevation = star_elevation(r, mu_s, bottom)
    if elevation <= -star_radius or (elevation <= 0.0 and star_radius <= 0.0):
        return False
    column = np.empty(extinction.shape[0])
    if star_radius <= 0.0 or elevation > _HIGH + star_radius:
        columns_to_space(r, mu_s, shell, density, rules[0], workspace, column)
        for w in range(light.size):
            depth = 0.0
            for i in range(column.size):
                depth += column[i] * extinction[i, w]
            light[w] = exp(-depth) * (max(mu_s, 0.0) if level else 1.0)
        return True
    # Strips x = -cos t of the unit disc, (2/π) sin²t dt; those below the horizon are dark.
    first = acos(min(max(elevation / star_radius, -1.0), 1.0))
    centre = asin(min(max(mu_s, -1.0), 1.0))
    nodes, weights, _ = rules[1]
    for k in range(nodes.size):
        t = first + (pi - first) * nodes[k]
        solid_angle = (2.0 / pi) * (pi - first) * weights[k] * sin(t) * sin(t)
        strip = sin(centre - star_radius * cos(t))
        columns_to_space(r, strip, shell, density, rules[0], workspace, column)
        for w in range(light.size):
            depth = 0.0
            for i in range(column.size):
                depth += column[i] * extinction[i, w]
            light[w] += solid_angle * exp(-depth) * (max(strip, 0.0) if level else 1.0)
    return True


def star_rules() -> tuple[Rule, Rule]:
    """Rules for the rays to the star and for the strips of its disc."""
    return gauss_legendre(_NODES).as_tuple(), gauss_legendre(_STRIPS).as_tuple()


def direct_irradiance(medium: Medium, r: FloatArray, mu_s: FloatArray) -> FloatArray:
    """Direct horizontal irradiance, per irradiance of the star.

    Parameters
    ----------
    r, mu_s : array, shape (n,)
        Distance from the centre, inside the shell [m], and zenith cosine of the star [1].

    Returns
    -------
    array, shape (n, nl)
        Irradiance. [1]
    """
    out = np.empty((r.size, medium.wavelengths.size))
    optics, workspace = shell_optics(medium), new_workspace()
    for k in range(r.size):
        star_light(float(r[k]), float(mu_s[k]), True, optics, workspace, out[k])
    return out
