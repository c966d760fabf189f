"""Tables of a solution for the shaders, under the names that the march uses."""

from __future__ import annotations

from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.geometry.quadrature import gauss_legendre
from airlight.kernel.lanes import LANES
from airlight.optics.reflection import Reflection
from airlight.solvers.moments.packing import pack
from airlight.solvers.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Number of wavelengths in a texel.
WAVELENGTHS: Final = 4
#: Largest number of constituents in a shader, including "bending".
MOST_CONSTITUENTS: Final = 8
#: Numbers of points that may serve all lines; and loop iterations that Mesa's software renderer
#: allows a shader, less a reserve for other loops.
_EVEN: Final = (24, 20, 16, 12, 8)
_MOST_TURNS: Final = 60_000
#: Fraction scattered within 10° of straight on above which a constituent is peaked.
_PEAKED: Final = 0.08
#: Largest number of constituents whose peaks can be kept out of the table of the sky.
MOST_PEAKS: Final = 2


class Shown(NamedTuple):
    """Solution as the march of the shaders reads it; names as in ``moments.march.Light``.

    On the CPU the arrays are flat and the spectral ones have eight lanes; on the GPU each is a
    part of a texture, and a spectral element is a texel of four wavelengths.

    Attributes
    ----------
    bottom, top : float
        Radii of the ground and of the shell's top, optical where light is bent. [m]
    star_radius, bend : float
        Angular radius of the star [rad]; bending as in ``Light`` [m⁻²].
    constituents, degree, radii, suns, phase_nodes : int
        Sizes of the tables.
    first_peak, second_peak : int
        Constituents whose single scattering is stored without its phase function; -1 for none.
    columns, density, strongest, brightest, lift, ends : array
        Fields of ``Light``.
    row, place : array
        Fields of ``Grid``.
    start, ahead, back : array
        Fields of ``Harmonics``.
    rules : array, flat
        Starts of three quadratures; then for each: n, nodes, weights, and running integrals over
        the weights, (n, n).
    extinction, scattering, moments, phase, basis, field, sky : array
        Spectral tables; the last two as in ``Light``, ``phase`` on even steps of sin(θ/2),
        ``basis`` as in ``shown_solution``.
    ground : Reflection
        Field of ``Air``; its ``albedo`` is a spectral table.
    """

    bottom: float
    top: float
    star_radius: float
    bend: float
    constituents: int
    degree: int
    radii: int
    suns: int
    phase_nodes: int
    first_peak: int
    second_peak: int
    columns: FloatArray
    density: FloatArray
    strongest: FloatArray
    brightest: FloatArray
    lift: FloatArray
    ends: FloatArray
    row: FloatArray
    place: FloatArray
    start: FloatArray
    ahead: FloatArray
    back: FloatArray
    rules: FloatArray
    extinction: Float32Array
    scattering: Float32Array
    moments: Float32Array
    phase: Float32Array
    basis: Float32Array
    field: Float32Array
    sky: Float32Array
    ground: Reflection

    def flat(self) -> dict[str, Any]:
        """Fields by name, those of the ground beside the others."""
        fields: dict[str, Any] = self._asdict()
        del fields["ground"]
        return fields | self.ground._asdict()


#: Tables of plain numbers, with their ranks, and spectral ones; two of these change with each
#: solution alone and have separate textures.
SCALAR_TABLES: Final = {
    "columns": 4, "density": 2, "strongest": 1, "brightest": 1, "lift": 3, "ends": 1, "row": 1,
    "place": 1, "start": 1, "ahead": 1, "back": 1, "rules": 1,
}  # fmt: skip
SPECTRAL_TABLES: Final = ("extinction", "scattering", "moments", "albedo", "phase", "basis")
FIELD_TABLES: Final = ("field", "sky")


def quadratures(counts: tuple[int, ...]) -> FloatArray:
    """Concatenate the rules of the march, see ``Shown.rules``.

    Parameters
    ----------
    counts : tuple of int
        Number of points of each rule.

    Returns
    -------
    array, shape (n,)
        Starts and rules.
    """
    parts = []
    starts = []
    at = len(counts)
    for count in counts:
        nodes, weights, running = gauss_legendre(count).as_tuple()
        # The value of a point, divided by its share of the rule, is the integrand on [0, 1].
        part = np.concatenate([[count], nodes, weights, (running / weights).ravel()])
        parts.append(part)
        starts.append(float(at))
        at += part.size
    return np.concatenate([starts, *parts])


def peaked_constituents(solution: MomentsSolution) -> tuple[int, ...]:
    """Constituents whose phase functions are too sharp for a table of the sky, at most two.

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
    return tuple(order[:MOST_PEAKS])


def even_points(solution: MomentsSolution) -> tuple[int, int, int]:
    """Numbers of points of a panel, the same for all lines, for every device.

    Mesa's software renderer ends the loops of neighbouring lines as soon as those with the fewest
    points are done, and all loops of a shader after 65 535 iterations.
    """
    light, degree = solution.light, solution.moments.degree
    constituents = len(solution.paths.medium.names)
    panels = 2 * (light.ends.size + 1) + 2
    terms = sum((l + 1) // 4 + (l + 1) % 4 for l in range(degree + 1))
    point = (degree + 1) * (constituents + 2) + 2 * terms + 12 * constituents
    fitting = [n for n in _EVEN if n * panels * (point + n * constituents // 4) <= _MOST_TURNS]
    chosen = fitting[0] if fitting else _EVEN[-1]
    return chosen, chosen, chosen


def shown_solution(
    solution: MomentsSolution,
    basis: FloatArray,
    *,
    peaks: bool = True,
    points: tuple[int, int, int] | None = None,
) -> Shown:
    """Make the tables of a solution.

    Parameters
    ----------
    solution : MomentsSolution
        Solution of any number of wavelengths and constituents; shaders accept few.
    basis : array, shape (nl, 3)
        Reflectance of a red, a green and a blue ground. [1]
    peaks : bool
        Whether peaked constituents are kept separate.
    points : tuple of int
        Points of a panel, as in ``MarchPoints``; by default ``even_points``.
    """
    light, medium = solution.light, solution.paths.medium
    count = len(medium.names)
    kept = (*(peaked_constituents(solution) if peaks else ()), -1, -1)
    expansion = light.expansion
    return Shown(
        bottom=light.grid.bottom_radius,
        top=light.grid.top_radius,
        star_radius=light.air.star_radius,
        bend=light.bend,
        constituents=count,
        degree=expansion.degree,
        radii=light.grid.radii.size,
        suns=light.grid.sun_cosines.size,
        phase_nodes=medium.phase_table.shape[2],
        first_peak=kept[0],
        second_peak=kept[1],
        columns=light.columns,
        density=light.density,
        strongest=light.strongest,
        brightest=light.brightest,
        lift=light.lift,
        ends=light.ends,
        row=light.grid.row,
        place=light.grid.place,
        start=expansion.start,
        ahead=expansion.ahead,
        back=expansion.back,
        rules=quadratures(even_points(solution) if points is None else points),
        extinction=light.air.extinction,
        scattering=light.scattering,
        moments=light.air.moments,
        phase=pack(np.moveaxis(medium.phase_table, 2, 0)),
        basis=pack(basis.T),
        field=light.field,
        sky=light.sky,
        ground=light.air.ground,
    )


def as_texels(values: Float32Array, wavelengths: int) -> Float32Array:
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
