"""Tables of a solution for the ray march, and its workspace, with the same names in all backends.

On the CPU the spectral arrays have whole groups of eight lanes on the last axis. On a GPU each
table is a part of a texture, and a spectral element is a texel of four wavelengths.
"""

from __future__ import annotations

from typing import Annotated, Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.path import MAX_EDGES
from airlight.geometry.quadrature import gauss_legendre
from airlight.kernel.shader_fields import (
    CHOICE,
    DISC,
    FACE,
    FIELDS,
    SPECTRA,
    Always,
    scalars,
    spectra,
)
from airlight.physics.optics.reflection import Reflection
from airlight.solver.tables.ring_shadow import RingLine, Rings

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]


#: Indices, in units of w, after the result of a march: mean radiance of the sky that a sea mirrors,
#: and mean light of the facets of its resolved waves.
MIRRORED: Final = 6
FACETS: Final = 7


class Segment(NamedTuple):
    """Segment of a line of sight inside the shell.

    Attributes
    ----------
    r, mu : float
        Radius of the start, and zenith cosine. [m], [1]
    mu_s, nu : float
        Cosines of the star's zenith angle at the start, and between line and star. [1]
    half_sine : float
        sin(θ/2) of the angle to the apparent star, for which the phase functions are given. [1]
    length : float
        Length, to the ground or to the top. [m]
    ring : RingLine
        The line among the rings.
    """

    r: float
    mu: float
    mu_s: float
    nu: float
    half_sine: float
    length: float
    ring: RingLine


class MarchTerms(NamedTuple):
    """Terms of the radiance that a march computes; constants in a shader.

    Attributes
    ----------
    air : bool
        Path radiance.
    peaks : bool
        Single scattering of separated constituents, without their phase functions.
    polarised : bool
        Q and U.
    """

    air: bool
    peaks: bool
    polarised: bool


class MarchTables(NamedTuple):
    """Solution in the form read by the ray march; w is the number of lanes.

    Attributes
    ----------
    bottom, top : float
        Radii of the ground and of the top of the shell; optical radii with refraction. [m]
    star_radius : float
        Angular radius of the star. [rad]
    refraction_strength : float
        See ``RefractedGeometry``. [m⁻²]
    lanes : int
        Number of lanes w: a multiple of ``LANES``; in a shader one texel is one group of lanes.
    panels : int
        Number of panels per leg of a line; 1 in a shader.
    culls_opaque : int
        1 if opaque panels are culled; 0 in a shader, where lines run in lockstep.
    constituents, degree, radii, sun_angles, phase_nodes : int
        Sizes of the tables.
    separated_1, separated_2 : int
        Constituents whose single scattering is returned separately, without its phase function; -1
        for none.
    broadened : bool
        Whether the forward-peak gain applies to single scattering, see ``forward_peak``.
    first_nodes : array, shape (CELLS + 1,)
        Index of the first altitude node of each cell, see ``altitude_nodes``. [1]
    column_rows : array, shape (n,)
        Rows of ``columns`` at the altitude nodes. [1]
    columns : array, shape (radii, directions, nc, 2)
        Column table from ``rational_mean_density``. [1]
    density : array, shape (n, nc)
        Densities from ``density_table``. [1]
    strongest, brightest : array, shape (nc,)
        Largest extinction and largest scattering of each constituent at any wavelength. [m⁻¹]
    refraction_table : array, shape (rows, columns, 2)
        Table from ``refraction_table``; empty without refraction. [1]
    ends : array, shape (n,)
        Altitudes at which panels end, from ``panel_ends``. [m]
    row, place : array
        Fields of ``MomentsGrid``.
    start, ahead, back : array
        Fields of ``Harmonics``.
    rules : array, flat
        Quadratures of a panel, from ``quadratures``.
    scaled_extinction : array, shape (nc, w)
        Delta-M scaled extinction. [m⁻¹]
    extinction : array, shape (nc, w)
        Unscaled extinction, which attenuates the star's disc. [m⁻¹]
    scattering : array, shape (nc, w)
        Unscaled scattering coefficients. [m⁻¹]
    moments : array, shape (nc, N + 1, w)
        Scattering coefficient times Legendre moment, both scaled. [m⁻¹]
    polarised_moments : array, shape (nc, 4, w)
        Scattering coefficient times expansion coefficients of Q and U, see ``ScaledOptics``. [m⁻¹]
    phase : array, shape (phase_nodes, nc, w)
        Phase functions on even steps of sin(θ/2). [sr⁻¹]
    phase_f12 : array, shape (phase_nodes, nc, w)
        Elements F₁₂ of the phase matrices on these steps; 0 in scalar transfer. [sr⁻¹]
    inverse_peak_fraction : array, shape (nc, w)
        Reciprocal of the truncated fraction f, from ``forward_peak``. [1]
    broadening : array, shape (depths, angles, w)
        Forward-peak gain, from ``peak_broadening``; one element if not ``broadened``. [1]
    darkening : array, shape (6, w)
        Radiance of the star's disc over its mean, by powers of the cosine of emergence. [1]
    face : array, shape (rows, columns, w)
        Reflectance of the Moon's disc over its mean, a pyramid (``LightSource.face``). [1]
    basis : array, shape (3, w)
        Reflectance of a red, a green and a blue ground. [1]
    field : array, shape (r, s, 1 + k, w)
        Moments of all orders together, as (s, M·s) per node; see ``sweep``.
    sky : array, shape (r, s, 2, w)
        Irradiance of a level surface by scattered light, as (s, E·s) per node; the first radius
        is the ground.
    ground : Reflection
        Reflectance of the ground.
    rings : Rings
        Rings of the planet.
    """

    bottom: float
    top: float
    star_radius: float
    refraction_strength: float
    lanes: Annotated[int, Always(1)]
    panels: Annotated[int, Always(1)]
    culls_opaque: Annotated[int, Always(0)]
    constituents: int
    degree: int
    radii: int
    sun_angles: int
    phase_nodes: int
    separated_1: Annotated[int, CHOICE]
    separated_2: Annotated[int, CHOICE]
    broadened: bool
    first_nodes: Annotated[FloatArray, scalars()]
    column_rows: Annotated[FloatArray, scalars()]
    columns: Annotated[FloatArray, scalars(4)]
    density: Annotated[FloatArray, scalars(2)]
    strongest: Annotated[FloatArray, scalars()]
    brightest: Annotated[FloatArray, scalars()]
    refraction_table: Annotated[FloatArray, scalars(3)]
    ends: Annotated[FloatArray, scalars()]
    row: Annotated[FloatArray, scalars()]
    place: Annotated[FloatArray, scalars()]
    start: Annotated[FloatArray, scalars()]
    ahead: Annotated[FloatArray, scalars()]
    back: Annotated[FloatArray, scalars()]
    rules: Annotated[FloatArray, scalars()]
    scaled_extinction: Annotated[Float32Array, SPECTRA]
    extinction: Annotated[Float32Array, SPECTRA]
    scattering: Annotated[Float32Array, SPECTRA]
    moments: Annotated[Float32Array, spectra(2)]
    polarised_moments: Annotated[Float32Array, spectra(2)]
    phase: Annotated[Float32Array, spectra(2)]
    phase_f12: Annotated[Float32Array, spectra(2)]
    inverse_peak_fraction: Annotated[Float32Array, SPECTRA]
    broadening: Annotated[Float32Array, spectra(2)]
    darkening: Annotated[Float32Array, DISC]
    face: Annotated[Float32Array, FACE]
    basis: Annotated[Float32Array, SPECTRA]
    field: Annotated[Float32Array, FIELDS]
    sky: Annotated[Float32Array, FIELDS]
    ground: Reflection
    rings: Rings


class MarchWorkspace(NamedTuple):
    """Workspace of one thread; p is the largest number of points of a panel.

    Attributes
    ----------
    edges : array, shape (MAX_EDGES,)
        Ends of the panels, from the line's start. [m]
    cuts : array, shape (3,)
        Distances to the optical depths at which panels of a thick line end. [m]
    distance, radius, weight : array, shape (p,)
        Points of a panel: distances from the line's start, radii, and weights. [m]
    density, amounts, columns : array, shape (nc·p,)
        Densities at the points [1], the same times weight, and columns up to the points [m]; one
        constituent after another.
    columns_so_far, columns_total : array, shape (nc,)
        Columns up to the end of a panel, and of the whole line. [m]
    point_density, depths : array, shape (nc,)
        Relative densities at a point [1], and columns up to it [m].
    columns_to_sun_low, columns_to_sun_high : array, shape (nc,)
        Columns from a point towards the two points that represent the star. [m]
    functions : array, shape (k,)
        Harmonics of the line at a point. [1]
    irradiance : array, shape (2, w)
        Direct and diffuse irradiance of the ground. [1]
    azimuth : array, shape (1,)
        Cosine of the line's azimuth at a point. [1]
    phase, phase_f12 : array, shape (nc, w)
        Phase functions and elements F₁₂ of a line. [sr⁻¹]
    peaks : array, shape (3, w)
        Sums over a line from ``forward_peak.add_peaks``.
    radiance : array, shape (8, w)
        Result of a march, and that of the mirrored sky at ``MIRRORED`` and ``FACETS``.
    """

    edges: FloatArray
    cuts: FloatArray
    distance: FloatArray
    radius: FloatArray
    weight: FloatArray
    density: FloatArray
    amounts: FloatArray
    columns: FloatArray
    columns_so_far: FloatArray
    columns_total: FloatArray
    point_density: Float32Array
    depths: Float32Array
    columns_to_sun_low: FloatArray
    columns_to_sun_high: FloatArray
    functions: Float32Array
    irradiance: Float32Array
    azimuth: FloatArray
    phase: Float32Array
    phase_f12: Float32Array
    peaks: Float32Array
    radiance: Float32Array


def workspace_sizes(constituents: int, points: int, terms: int) -> dict[str, int]:
    """Sizes of the workspace's scalar arrays.

    Parameters
    ----------
    constituents, points, terms : int
        Numbers of constituents, of points of a panel and of harmonics, or upper limits.
    """
    return {
        "edges": MAX_EDGES,
        "cuts": 3,
        **dict.fromkeys(("distance", "radius", "weight"), points),
        **dict.fromkeys(("density", "amounts", "columns"), constituents * points),
        **dict.fromkeys(
            (
                "columns_so_far",
                "columns_total",
                "point_density",
                "depths",
                "columns_to_sun_low",
                "columns_to_sun_high",
            ),
            constituents,
        ),
        "functions": terms,
        "azimuth": 1,
    }


def spectral_sizes(constituents: int) -> dict[str, int]:
    """Sizes of the workspace's spectral arrays, in elements of all wavelengths.

    Parameters
    ----------
    constituents : int
        Number of constituents, or an upper limit.
    """
    each = dict.fromkeys(("phase", "phase_f12"), constituents)
    return {"irradiance": 2, **each, "peaks": 3, "radiance": FACETS + 1}


def new_workspace(tables: MarchTables) -> MarchWorkspace:
    """Workspace of one CPU thread."""
    count = tables.constituents
    points = max(int(tables.rules[int(tables.rules[k])]) for k in range(4))
    single = ("point_density", "depths", "functions")
    arrays: dict[str, Any] = {
        name: np.empty(size, np.float32 if name in single else np.float64)
        for name, size in workspace_sizes(count, points, tables.ahead.size).items()
    }
    lanes: dict[str, Any] = {
        name: np.empty((size, tables.lanes), np.float32)
        for name, size in spectral_sizes(count).items()
    }
    return MarchWorkspace(**arrays, **lanes)


def quadratures(counts: tuple[int, ...]) -> FloatArray:
    """Quadrature rules of the march, concatenated.

    Parameters
    ----------
    counts : tuple of int
        Number of points of each rule: for steep lines in full daylight, where the source function
        is smooth; for most lines; for those that graze the ground; and for those of the first that
        have many panels.

    Returns
    -------
    array, shape (n,)
        Starts of the rules; then for each: n, nodes, weights, and running integrals over the
        weights, (n, n).
    """
    parts = []
    starts = []
    at = len(counts)
    for count in counts:
        nodes, weights, running = gauss_legendre(count).as_tuple()
        # The value of a point, divided by its weight in the rule, is the integrand on [0, 1].
        part = np.concatenate([[count], nodes, weights, (running / weights).ravel()])
        parts.append(part)
        starts.append(float(at))
        at += part.size
    return np.concatenate([starts, *parts])
