"""Optical properties of a medium at one wavelength for histories, and the choice of quadrature."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.quadrature import gauss_legendre
from airlight.kernel import compiled_loop
from airlight.physics.optics.altitude_nodes import CELLS
from airlight.physics.optics.density_profile import DensitySegments
from airlight.physics.optics.reflection import Reflection
from airlight.planets.matter.phases import PhaseFunction
from airlight.solver.montecarlo.rays import (
    Extinction,
    most_panels,
    new_trace,
    point_at,
    trace_optical_depth,
)
from airlight.solver.montecarlo.refracted_paths import RefractionColumn, refraction_column
from airlight.solver.montecarlo.scattering_angles import Lobes, lobes
from airlight.solver.montecarlo.sun_biased_sampling import (
    StarTransmittance,
    star_transmittance_table,
)
from airlight.solver.refracted_geometry import RefractedGeometry
from airlight.solver.tables.columns import columns

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

#: Number of steps of the extinction table: of a smooth profile, and the most.
TABLE_STEPS: Final = 16384
MOST_STEPS: Final = 1 << 22
#: Points per panel, panels per leg and whether panels also end at breakpoints, from fast to fine;
#: the first rule of sufficient accuracy is used.
RULES: Final = (
    (12, 1, False),
    (16, 1, False),
    (20, 1, False),
    (8, 1, True),
    (12, 1, True),
    (16, 2, False),
    (16, 1, True),
    (20, 2, True),
    (24, 4, True),
)
#: Largest allowed maximum and RMS error of the attenuation up to each point of a ray, relative to
#: the total attenuation, over ``_test_rays``.
LARGEST_ERROR: Final = 1e-3
MEAN_ERROR: Final = 2e-4


class HistoryOptics(NamedTuple):
    """Optical properties of atmosphere and ground at one wavelength.

    Attributes
    ----------
    extinction : Extinction
        Extinction along rays.
    edges, coefficients : array, shapes (nc, ns + 1), (nc, ns, 4)
        Profiles as in ``DensitySegments``.
    scattering : array, shape (nc,)
        Coefficients at relative density 1; 0 for a constituent without phase function. [m⁻¹]
    lobes : Lobes
        Phase functions.
    ground : Reflection
        Reflectance of the ground.
    star_radius : float
        Angular radius of the star. [rad]
    star_transmittance : StarTransmittance
        Coarse table of transmittance to the star.
    refraction : RefractionColumn
        Refraction.
    polarised : bool
        Whether histories carry polarisation.
    """

    extinction: Extinction
    edges: FloatArray
    coefficients: FloatArray
    scattering: FloatArray
    lobes: Lobes
    ground: Reflection
    star_radius: float
    star_transmittance: StarTransmittance
    refraction: RefractionColumn
    polarised: bool


def history_optics(
    geometry: RefractedGeometry, wavelength: int, *, polarised: bool
) -> HistoryOptics:
    """Optical properties of a medium at one of its wavelengths.

    Parameters
    ----------
    polarised : bool
        Whether histories carry polarisation.
    """
    medium = geometry.medium
    density = medium.density
    finest = float(np.diff(density.first_nodes).max())
    steps = min(int(max(CELLS * finest, TABLE_STEPS)), MOST_STEPS)
    x = np.linspace(0.0, 1.0, steps + 1)
    coefficients = medium.extinction[:, wavelength]
    table = np.ascontiguousarray(coefficients @ density.at(medium.thickness * x * x))
    jumps = medium.bottom_radius + jump_altitudes(density)
    breakpoints = medium.bottom_radius + breakpoint_altitudes(density)
    r, mu, length = _test_rays(medium)
    whole = columns(r, mu, length, medium.bottom_radius, density) @ coefficients
    for points, panels, cut in RULES:
        rule = gauss_legendre(points)
        chosen = Extinction(
            medium.bottom_radius,
            medium.top_radius,
            table,
            breakpoints if cut else jumps,
            panels,
            rule.nodes,
            rule.weights,
            np.ascontiguousarray(rule.running),
        )
        distances = np.empty((r.size, most_panels(chosen) * (points + 1)))
        got = np.zeros_like(distances)
        distances[:] = length[:, None]
        got[:] = whole[:, None]
        running_depths(r, mu, chosen, new_trace(chosen), distances, got)
        exact = columns(r[:, None], mu[:, None], distances, medium.bottom_radius, density)
        lost = np.maximum(-np.expm1(-whole), 1e-300)[:, None]
        # A rule that is too coarse for a layer may give a depth far below 0: it is rejected.
        light = np.exp(-np.maximum(got, -1.0)) - np.exp(-(exact @ coefficients))
        error = np.where(whole[:, None] > 0.0, light / lost, 0.0)
        if np.abs(error).max() <= LARGEST_ERROR and np.sqrt(np.mean(error**2)) <= MEAN_ERROR:
            break
    return HistoryOptics(
        extinction=chosen,
        edges=density.edges,
        coefficients=density.coefficients,
        scattering=medium.scattering[:, wavelength].copy(),
        lobes=lobes(medium, wavelength),
        ground=medium.ground.at(slice(wavelength, wavelength + 1)),
        star_radius=medium.lights[0].angular_radius,
        star_transmittance=star_transmittance_table(chosen),
        refraction=refraction_column(geometry, steps + 1),
        polarised=polarised,
    )


def with_cloud_phases(
    air: HistoryOptics, medium: Medium, wavelength: int, phases: Sequence[PhaseFunction]
) -> HistoryOptics:
    """Optical properties of the air whose last phase functions are those of clouds."""
    count = len(phases)
    return air._replace(
        edges=np.concatenate([air.edges, air.edges[:1].repeat(count, axis=0)]),
        coefficients=np.concatenate([air.coefficients, air.coefficients[:1].repeat(count, axis=0)]),
        scattering=np.append(air.scattering, np.zeros(count)),
        lobes=lobes(medium, wavelength, phases),
    )


def jump_altitudes(density: DensitySegments) -> FloatArray:
    """Altitudes inside the shell at which a profile is discontinuous. [m]"""
    found: set[float] = set()
    for edges, rows in zip(density.edges, density.coefficients, strict=True):
        for k in range(1, len(rows)):
            width = edges[k] - edges[k - 1]
            if not 0.0 < edges[k] < edges[-1] or width <= 0.0:
                continue
            a, b, c, d = rows[k - 1]
            below = max(0.0, a * np.exp(b * width) + c * width + d)
            above = max(0.0, rows[k, 0] + rows[k, 3])
            if abs(above - below) > 1e-6 * max(above, below):
                found.add(float(edges[k]))
    return np.array(sorted(found))


def breakpoint_altitudes(density: DensitySegments) -> FloatArray:
    """Altitudes of jumps and breakpoints of the profiles. [m]"""
    return np.union1d(jump_altitudes(density), density.breakpoints)


def _test_rays(medium: Medium) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Rays to space from various altitudes, from the zenith to the horizon."""
    heights = np.array([0.0, 0.003, 0.01, 0.03, 0.06, 0.1, 0.2, 0.4])
    bottom, top = medium.bottom_radius, medium.top_radius
    r = (bottom + heights * medium.thickness)[:, None]
    horizon = -np.sqrt(np.maximum((r - bottom) * (r + bottom), 0.0)) / r
    upward = np.array([0.0, 0.003, 0.01, 0.03, 0.1, 0.3, 0.6, 1.0])
    mu = np.concatenate([horizon * np.array([0.999, 0.7, 0.3]), upward + 0.0 * r], axis=1)
    r = r + 0.0 * mu
    length = -r * mu + np.sqrt((top - r) * (top + r) + (r * mu) ** 2)
    return r.ravel(), mu.ravel(), length.ravel()


@compiled_loop
def running_depths(r, mu, extinction, path, distances, out):
    """Optical depths of rays to space up to the points and ends of their panels.

    Parameters
    ----------
    r, mu : array, shape (n,)
        Start of the rays. [m], [1]
    distances, out : array, shape (n, m)
        Receive distances [m] and depths [1].
    """
    nodes, running = extinction.nodes, extinction.running
    for k in range(r.size):
        count, _ = trace_optical_depth(r[k], mu[k], False, extinction, path)
        before, at = 0.0, 0
        for panel in range(count):
            for j in range(nodes.size + 1):
                t, depth = 1.0, path.panels[panel, 5]
                if j < nodes.size:
                    t, depth = nodes[j], 0.0
                    for i in range(nodes.size):
                        depth += running[j, i] * path.values[panel, i]
                distances[k, at] = point_at(path.panels[panel], t, r[k], mu[k], extinction)[0]
                out[k, at] = before + depth
                at += 1
            before += path.panels[panel, 5]
