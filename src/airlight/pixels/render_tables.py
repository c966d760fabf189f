"""Tables of a solution for pictures, and how much of them a shader holds."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.kernel.lanes import LANES
from airlight.solvers.moments.harmonics import EVEN
from airlight.solvers.moments.march_tables import MarchTables, quadratures
from airlight.solvers.moments.solution import MomentsSolution

Float32Array = NDArray[np.float32]

#: Number of wavelengths in a texel.
WAVELENGTHS: Final = 4
#: Largest number of constituents in a shader, including "bending", of points of a panel there, and
#: number of harmonics up to degree 24.
MAX_CONSTITUENTS: Final = 8
MAX_POINTS: Final = 24
MAX_TERMS: Final = 325
#: Numbers of points that may serve all lines; and loop iterations that Mesa's software renderer
#: allows a shader, less a reserve for other loops.
_EVEN: Final = (24, 20, 16, 12, 8)
_MOST_TURNS: Final = 60_000
#: Fraction scattered within 10° of straight on above which a constituent is peaked.
_PEAKED: Final = 0.08
#: Largest number of constituents whose peaks can be kept out of the sky-view LUT.
MAX_PEAKS: Final = 2


def separated_constituents(solution: MomentsSolution) -> tuple[int, ...]:
    """Constituents whose phase functions are too sharp for a sky-view LUT, at most two.

    They are those with a peak that scatter most: within 10° of straight on an even phase function
    has 0.8 % of its light, a Rayleigh one 1.1 %.

    Parameters
    ----------
    solution : MomentsSolution
        Solution of the planet.

    Returns
    -------
    tuple of int
        Indices in ``medium.names``, the strongest scatterer first.
    """
    medium = solution.paths.medium
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


def even_points(solution: MomentsSolution) -> tuple[int, int, int]:
    """Numbers of points of a panel, the same for all lines, for every device.

    Mesa's software renderer ends the loops of neighbouring lines as soon as those with the fewest
    points are done, and all loops of a shader after 65 535 iterations.
    """
    light, degree = solution.light, solution.moments.degree
    constituents = len(solution.paths.medium.names)
    # Two legs, the ends of the shadow and the cuts of a thick line; water's mirrored sky has one.
    legs, more = light.ends.size + 1, 5
    panels = 2 * legs + more + (legs + more if light.ground.wet else 0)
    terms = sum((l + 1) // 4 + (l + 1) % 4 for l in range(degree + 1))
    polarised = 2 * EVEN + 3 * constituents
    point = (degree + 1) * (constituents + 2) + 2 * terms + 12 * constituents + polarised
    fitting = [n for n in _EVEN if n * panels * (point + n * constituents // 4) <= _MOST_TURNS]
    chosen = fitting[0] if fitting else _EVEN[-1]
    return chosen, chosen, chosen


def render_tables(
    solution: MomentsSolution,
    *,
    peaks: bool = True,
    points: tuple[int, int, int] | None = None,
    panels: int = 1,
) -> MarchTables:
    """Tables of a solution for pictures.

    Parameters
    ----------
    solution : MomentsSolution
        Solution of any number of wavelengths and constituents; shaders accept few.
    peaks : bool
        Whether peaked constituents are kept separate.
    points : tuple of int
        Points of a panel, as in ``MarchPoints``; by default ``even_points``.
    panels : int
        Number of panels of a leg; shaders have one.
    """
    kept = (*(separated_constituents(solution) if peaks else ()), -1, -1)
    return solution.light._replace(
        separated_1=kept[0],
        separated_2=kept[1],
        rules=quadratures(even_points(solution) if points is None else points),
        panels=panels,
    )


def pack_texels(values: Float32Array, wavelengths: int) -> Float32Array:
    """Convert a spectral table of eight lanes to texels of four wavelengths, shape (n, 4).

    Parameters
    ----------
    values : array of float32, size n·8
        Table with eight lanes an element.
    wavelengths : int
        Number of lanes in use.

    Raises
    ------
    ParameterError
        If there are more wavelengths than a texel holds.
    """
    if wavelengths > WAVELENGTHS:
        raise ParameterError("wavelengths", wavelengths, f"at most {WAVELENGTHS} on the GPU")
    return np.ascontiguousarray(values.reshape(-1, LANES)[:, :WAVELENGTHS])
