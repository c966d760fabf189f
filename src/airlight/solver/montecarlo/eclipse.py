"""Monte Carlo radiance in the shadow of a moon or of rings: reference for pictures of these.

Direct irradiance at each event is multiplied by what the moon and the rings leave of the star
there. Lines of sight have positions in space, not only angles.
"""

from __future__ import annotations

from time import perf_counter

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.geometry.occulted_star import OccultedStar
from airlight.geometry.shell import distance_to_top
from airlight.geometry.vectors import Vec3
from airlight.kernel import vectorized
from airlight.solver.lines_of_sight import LinesOfSight, enter_shell, start_frame
from airlight.solver.montecarlo.estimate import Estimate, Query
from airlight.solver.montecarlo.solution import MonteCarloSolution
from airlight.solver.tables.ring_shadow import RingShadow

FloatArray = NDArray[np.float64]


def eclipsed_estimate(
    solution: MonteCarloSolution,
    star: OccultedStar,
    points: ArrayLike,
    directions: ArrayLike | None = None,
    *,
    rings: RingShadow | None = None,
) -> Estimate:
    """Radiance, or diffuse horizontal irradiance, per irradiance of the unocculted star.

    Parameters
    ----------
    solution : MonteCarloSolution
        Planet lit by the star.
    star : OccultedStar
        Star and moon, in a frame around the planet's centre; only its direction counts without
        lanes.
    points : array, shape (n, 3)
        Observers in that frame, inside the shell. [m]
    directions : array, shape (n, 3), optional
        Unit vectors; default: irradiances. [1]
    rings : RingShadow, optional
        Rings, in that frame.

    Returns
    -------
    Estimate
        Estimate with all orders sampled.
    """
    started = perf_counter()
    at = np.atleast_2d(np.asarray(points, float))
    hemisphere = directions is None
    r = np.linalg.norm(at, axis=-1)
    up = at / r[:, None]
    along = up if directions is None else np.atleast_2d(np.asarray(directions, float))
    towards = np.array([star.star_x, star.star_y, star.star_z])
    mu, mu_s, nu = (
        np.clip(np.einsum("nk,nk->n", *pair), -1.0, 1.0)
        for pair in ((up, along), (up, towards + 0.0 * up), (along, towards + 0.0 * along))
    )
    medium, geometry = solution.medium, solution.geometry
    scale = medium.bottom_radius / geometry.medium.bottom_radius
    axes = [start_frame(up[k], along[k], towards) for k in range(len(at))]
    moons = [star.moved(one, scale) for one in axes] if star.lanes > 0 else None
    shadows = None
    if rings is not None:
        pole = np.array(rings.pole)
        shadows = [rings._replace(pole=Vec3(*(one @ pole).tolist())) for one in axes]
    if hemisphere:
        r = geometry.optical_radius(r)
        lengths = vectorized(distance_to_top)(r, mu, geometry.medium.top_radius)
        starts = np.stack([r, mu, mu_s, mu_s], axis=1)
    else:
        sine = np.linalg.norm(np.cross(up, along), axis=-1)
        lines: LinesOfSight = geometry.optical_lines(
            enter_shell(r, mu, sine, mu_s, nu, medium.bottom_radius, medium.top_radius)
        )
        lengths = np.maximum(lines.length, np.where(lines.to_ground, 1e-3, 0.0))
        starts = np.stack([lines.r, lines.mu, lines.mu_s, lines.nu], axis=1)
    query = Query(starts, lengths, hemisphere, None, None, moons, shadows)
    return solution.answer(query, started)
