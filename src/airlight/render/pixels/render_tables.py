"""March tables of a solution for rendering, and the capacity of shaders."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.solver.moments.harmonics import EVEN
from airlight.solver.moments.march_tables import MarchTables, quadratures

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution

Float32Array = NDArray[np.float32]

#: Wavelengths per texel.
WAVELENGTHS: Final = 4
#: Capacity of a shader: constituents including refraction, quadrature points of a panel, and
#: harmonics (up to degree 24).
MAX_CONSTITUENTS: Final = 8
MAX_POINTS: Final = 24
MAX_TERMS: Final = 325
#: Candidate numbers of quadrature points for all lines; and loop iterations that Mesa's software
#: renderer allows a shader, less a reserve.
_EVEN: Final = (24, 20, 16, 12, 8)
_MOST_TURNS: Final = 60_000
#: Fraction scattered within 10° of forward above which a phase function is peaked.
_PEAKED: Final = 0.08
#: Largest number of constituents with a separated phase function.
MAX_PEAKS: Final = 2


def separated_constituents(solution: MomentsSolution) -> tuple[int, ...]:
    """Constituents whose single scattering is stored without phase function in the sky-view LUT.

    The strongest scatterers with a forward peak, at most two; within 10° of forward an isotropic
    phase function scatters 0.8 %, Rayleigh's 1.1 %.

    Returns
    -------
    tuple of int
        Indices in ``medium.names``, the strongest scatterer first.
    """
    medium = solution.geometry.medium
    u = np.linspace(0.0, np.sin(np.radians(5.0)), 201)
    at = np.linspace(0.0, 1.0, medium.phase_table.shape[2])
    depth = medium.scattering.max(axis=1) * medium.columns
    strength = np.zeros(len(medium.names))
    for c in range(strength.size):
        values = np.interp(u, at, medium.phase_table[c].max(axis=0))
        # dΩ = 8π u du for u = sin(θ/2)
        share = float(np.trapezoid(8.0 * np.pi * u * values, u))
        if share > _PEAKED:
            strength[c] = depth[c] * share
    order = [int(c) for c in np.argsort(-strength) if strength[c] > 0.0]
    return tuple(order[:MAX_PEAKS])


def even_points(solution: MomentsSolution) -> tuple[int, int, int, int]:
    """Equal numbers of quadrature points for all lines, as software GPUs require.

    Mesa's software renderer ends the loops of neighbouring pixels with the shortest one, and all
    loops of a shader after 65 535 iterations.
    """
    tables, degree = solution.tables, solution.moments.degree
    constituents = len(solution.geometry.medium.names)
    # Two legs, the ends of the shadow and the cuts of a thick line; water's mirrored sky has one.
    legs, more = tables.ends.size + 1, 5
    panels = 2 * legs + more + (legs + more if tables.ground.wet else 0)
    terms = sum((l + 1) // 4 + (l + 1) % 4 for l in range(degree + 1))
    polarised = 2 * EVEN + 3 * constituents
    point = (degree + 1) * (constituents + 2) + 2 * terms + 12 * constituents + polarised
    fitting = [n for n in _EVEN if n * panels * (point + n * constituents // 4) <= _MOST_TURNS]
    chosen = fitting[0] if fitting else _EVEN[-1]
    return chosen, chosen, chosen, chosen


def render_tables(
    solution: MomentsSolution,
    *,
    peaks: bool = True,
    points: tuple[int, int, int, int] | None = None,
    panels: int = 1,
) -> MarchTables:
    """March tables of a solution for rendering.

    Parameters
    ----------
    solution : MomentsSolution
        Solution; shaders have a limited capacity.
    peaks : bool
        Whether peaked phase functions are separated.
    points : tuple of int
        Quadrature points, as in ``MarchPoints``; by default ``even_points``.
    panels : int
        Panels of a leg; 1 in shaders.
    """
    kept = (*(separated_constituents(solution) if peaks else ()), -1, -1)
    return solution.tables._replace(
        separated_1=kept[0],
        separated_2=kept[1],
        rules=quadratures(even_points(solution) if points is None else points),
        panels=panels,
    )


def pack_texels(values: Float32Array, wavelengths: int) -> Float32Array:
    """Convert a spectral table of eight lanes to texels of four wavelengths, shape (..., 4).

    Parameters
    ----------
    values : array of float32, shape (..., 8)
        Table with eight lanes per element.
    wavelengths : int
        Number of lanes in use.
    """
    if wavelengths > WAVELENGTHS:
        raise ParameterError("wavelengths", wavelengths, f"at most {WAVELENGTHS} on the GPU")
    return np.ascontiguousarray(values[..., :WAVELENGTHS])
