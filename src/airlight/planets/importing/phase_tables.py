"""Phase functions of tables: by angle in several forms, or by Legendre moments; normalised."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError, ParameterError, warn
from airlight.physics.data_tables.data_table import DataColumn, DataTable, Quantity
from airlight.planets.importing.thinning import thinned

FloatArray = NDArray[np.float64]

WAVELENGTH: Final = Quantity(
    name="wavelength",
    unit="nm",
    names=("wavelengths", "wavelen", "wl", "wvl", "lambda", "lam"),
    low=10.0,
    high=1e6,
    units="nm, um",
)
ANGLE: Final = Quantity(
    name="angle",
    unit="deg",
    names=("theta", "scatteringangle", "thetadeg"),
    low=0.0,
    high=180.0,
    units="deg",
    bare=True,
)
PHASE: Final = Quantity(
    name="phase_function",
    unit="1/sr",
    names=("phase", "p", "p11", "f11", "phasematrix"),
    low=0.0,
    units="1/sr",
    bare=True,
)
#: Further elements of the phase matrix, absolute like the first, by the key of a planet file.
ELEMENTS: Final = {
    key: Quantity(name=f"p{key[1:]}", unit="1/sr", names=(key,), bare=True)
    for key in ("f12", "f33", "f34")
}
#: Elements of a Mie phase matrix by index, as libRadtran orders them.
_MATRIX: Final = {1: "12", 2: "33", 3: "34"}
MOMENTS: Final = Quantity(
    name="moments", unit="1", names=("pmom", "legendre", "legendremoments", "phasemoments", "chi")
)
_MOMENT_COLUMN: Final = re.compile(r"(?:moment|pmom|legendre|chi|mom)s?_?(\d+)", re.IGNORECASE)
#: Integrals over the sphere of the two conventions. [1]
_CONVENTIONS: Final = (1.0, 4.0 * math.pi)
#: Deviations of the integral that are warned of, and refused. [1]
_WARNED: Final = 0.01
_REFUSED: Final = 0.1
#: Distance of the ends of a table from 0 and 180° over which the end value holds. [deg]
_BEYOND: Final = 2.0
#: Tolerance of thinned angles, of the logarithm; and number of angles that are not thinned.
_TOLERANCE: Final = 0.002
_MOST_ANGLES: Final = 400
#: Angles at which moments are summed: finer at both ends. [deg]
_GRID: Final = np.array(
    [*np.arange(50) / 10.0, *np.arange(10, 350) / 2.0, *np.linspace(175.0, 180.0, 51)]
)
#: Share of the negative values of a sum of moments that is clipped. [1]
_CLIPPED: Final = 1e-3


@dataclass(frozen=True, eq=False)
class PhaseRows:
    """Phase functions at wavelengths, of integral 1.

    Attributes
    ----------
    wavelengths : array, shape (nl,) or None
        Wavelengths; None for one that holds at all. [nm]
    angles : array, shape (na,)
        Scattering angles from 0 to 180. [deg]
    values : array, shape (nl, na)
        Values. [sr⁻¹]
    ratios : mapping of str to array, shape (nl, na)
        Elements of the phase matrix over the first, by the key of a planet file. [1]
    """

    wavelengths: FloatArray | None
    angles: FloatArray
    values: FloatArray
    ratios: dict[str, FloatArray]


def phase_rows(
    table: DataTable, wavelengths: FloatArray | None, notes: list[str]
) -> PhaseRows | None:
    """Phase functions of a table, None if it has none.

    Parameters
    ----------
    table : DataTable
        Columns of an angle and, by wavelength, of values; rows of wavelength, angle and value;
        arrays over wavelength and angle; columns named by angles (AERONET); or Legendre moments.
    wavelengths : array, shape (nl,), optional
        Wavelengths of the arrays of a dataset. [nm]
    notes : list of str
        Lines on what was done, extended.
    """
    by_angle = [one for one in table.columns if _is_angle(one)]
    if by_angle:
        return _named_by_angle(table, by_angle, notes)
    if table.find(ANGLE) is None:
        return _of_moments(table, wavelengths, notes)
    spectral = table.by_wavelength(PHASE)
    angle = table.required(ANGLE)
    if spectral:
        nm = np.array([one.heading.wavelength for one in spectral])
        rows = np.stack([table.numbers(PHASE, one) for one in spectral])
        return _checked(table, nm, table.numbers(ANGLE, angle), rows, {}, notes)
    column = table.find(PHASE)
    if column is None:
        return None
    others = {key: table.find(one) for key, one in ELEMENTS.items()}
    found = {key: one for key, one in others.items() if one is not None}
    if column.values.ndim == 1 and column.values.size == angle.values.size:
        return _long(table, column, found, notes)
    angles, rows = _shaped(table, angle, column)
    ratios = {}
    for key, one in found.items():
        at, values = _shaped(table, angle, one, ELEMENTS[key])
        ratios[key] = values
        if at.shape != angles.shape:
            raise ParameterError(one.heading.name, values.shape, f"{rows.shape}", table.source)
    if rows.ndim == 3:  # elements of the matrix on an axis of their own: P11, P12, P33, P34
        angles, matrix = _on_common_angles(angles, rows)
        rows = matrix[:, 0]
        ratios = {f"f{name}": matrix[:, k] for k, name in _MATRIX.items() if k < matrix.shape[1]}
    elif angles.ndim > 1:
        angles, matrix = _on_common_angles(angles[:, None], rows[:, None])
        rows = matrix[:, 0]
    of_rows = None if wavelengths is None or rows.shape[0] == 1 else wavelengths
    if of_rows is not None and len(of_rows) != len(rows):
        raise FileError(
            table.source, f"has {len(rows)} phase functions for {len(of_rows)} wavelengths"
        )
    return _checked(table, of_rows, angles, rows, ratios, notes)


def _is_angle(column: DataColumn) -> bool:
    return bool(re.fullmatch(r"\d+(\.\d+)?", column.heading.name)) and not math.isnan(
        column.heading.wavelength
    )


def _named_by_angle(table: DataTable, columns: Sequence[DataColumn], notes: list[str]) -> PhaseRows:
    """Columns ``180.000000[440nm]`` of AERONET, means over the rows."""
    wavelengths = np.unique([one.heading.wavelength for one in columns])
    angles = np.unique([float(one.heading.name) for one in columns])
    rows = np.full((wavelengths.size, angles.size), math.nan)
    for one in columns:
        wanted = Quantity(
            name=f"phase function at {one.heading.name}°", unit="1/sr", low=0.0, bare=True
        )
        part = table.where(~one.missing((-999.0,)))
        k = int(np.searchsorted(wavelengths, one.heading.wavelength))
        at = int(np.searchsorted(angles, float(one.heading.name)))
        rows[k, at] = part.numbers(wanted, part.columns[table.columns.index(one)]).mean()
    if np.isnan(rows).any():
        raise FileError(table.source, "has no phase function at some angles and wavelengths")
    return _checked(table, wavelengths, angles, rows, {}, notes)


def _long(
    table: DataTable, column: DataColumn, found: dict[str, DataColumn], notes: list[str]
) -> PhaseRows:
    """Rows of wavelength, angle and values, or of angle and values."""
    angle = table.numbers(ANGLE)
    value = table.numbers(PHASE, column)
    others = {key: table.numbers(ELEMENTS[key], one) for key, one in found.items()}
    if table.find(WAVELENGTH) is None:
        ratios = {key: one[None] for key, one in others.items()}
        return _checked(table, None, angle, value[None], ratios, notes)
    nm = table.numbers(WAVELENGTH)
    wavelengths = np.unique(nm)
    shape = wavelengths.size, nm.size // wavelengths.size
    order = np.lexsort((angle, nm))
    if shape[0] * shape[1] != nm.size or np.ptp(angle[order].reshape(shape), axis=0).any():
        raise FileError(table.source, "requires the same angles at every wavelength")
    ratios = {key: one[order].reshape(shape) for key, one in others.items()}
    angles = angle[order].reshape(shape)[0]
    return _checked(table, wavelengths, angles, value[order].reshape(shape), ratios, notes)


def _shaped(
    table: DataTable, angle: DataColumn, column: DataColumn, wanted: Quantity = PHASE
) -> tuple[FloatArray, FloatArray]:
    """Angles [deg], and an array with the wavelengths first and the angles last."""
    if angle.values.ndim > 1:  # angles of their own for each wavelength, as libRadtran's Mie tool
        if angle.values.shape != column.values.shape:
            shape = angle.values.shape
            raise ParameterError(column.heading.name, column.values.shape, f"{shape}", table.source)
        factor = table.conversion(ANGLE, angle)[0]
        return angle.values * factor, column.values
    angles, values = table.numbers(ANGLE, angle), table.numbers(wanted, column)
    if values.ndim == 1:
        values = values[None]
    named = [k for k, name in enumerate(column.dims) if "ang" in name or "theta" in name]
    fitting = [k for k, size in enumerate(values.shape) if size == angles.size]
    axis = next((k for k in (*named, *reversed(fitting)) if k in fitting), None)
    if axis is None:
        allowed = f"an axis of the {angles.size} angles"
        raise ParameterError(column.heading.name, values.shape, allowed, table.source)
    return angles, np.asarray(np.moveaxis(values, axis, -1))


def _on_common_angles(angles: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Arrays over wavelength, element and angle on one list of angles, linear between their own.

    A list ends where its angles ascend no more.
    """
    if angles.ndim == 1:
        return angles, values
    each = angles.reshape(-1, angles.shape[-1])
    lists = [one[: 1 + int(np.cumprod(np.diff(one) > 0.0).sum())] for one in each]
    common = np.unique(np.concatenate(lists))
    flat = values.reshape(-1, values.shape[-1])
    shared = [np.interp(common, one, row[: one.size]) for one, row in zip(lists, flat, strict=True)]
    return common, np.stack(shared).reshape(*values.shape[:-1], common.size)


# --- moments ----------------------------------------------------------------------------------


def _of_moments(
    table: DataTable, wavelengths: FloatArray | None, notes: list[str]
) -> PhaseRows | None:
    """Phase functions from Legendre moments, in an array or in numbered columns."""
    column = table.find(MOMENTS)
    numbered = {
        int(match[1]): one
        for one in table.columns
        if (match := _MOMENT_COLUMN.fullmatch(one.heading.name)) is not None
    }
    if column is not None and column.values.ndim >= 2:
        moments = table.numbers(MOMENTS, column)
        if moments.ndim == 3:  # elements of the phase matrix: the first is P11
            moments = moments[:, 0]
        scaled = column.heading.key == "pmom"
    elif numbered:
        if sorted(numbered) != list(range(len(numbered))):
            raise FileError(table.source, "has no moments of all degrees from 0 up")
        lists = [table.numbers(MOMENTS, numbered[k]) for k in range(len(numbered))]
        moments, scaled = np.stack(lists, axis=1), False
    else:
        return None
    degrees = np.arange(moments.shape[1])
    if scaled or np.abs(moments).max() > 1.0 + 1e-6:
        moments = moments / (2 * degrees + 1)
        notes.append("moments are taken to include the factor 2l + 1")
    off = np.abs(moments[:, 0] - 1.0)
    if off.max() > _REFUSED:
        k = int(off.argmax())
        raise ParameterError(f"moment 0 of row {k}", moments[k, 0], "1 within 10 %", table.source)
    moments = moments / moments[:, :1]
    series = (2 * degrees + 1) * moments / (4.0 * math.pi)
    nu = np.cos(np.radians(_GRID))
    rows = np.polynomial.legendre.legval(nu, series.T)
    negative = -np.trapezoid(np.minimum(rows, 0.0), nu[::-1], axis=1) * 2.0 * math.pi
    if np.abs(negative).max() > _CLIPPED:
        raise FileError(
            table.source,
            f"has {degrees.size} moments, whose sum is negative at some angles; allowed: more of"
            " them, or the phase function by angle, or g alone",
        )
    if (rows < 0.0).any():
        warn(f"{table.source}: the sum of its {degrees.size} moments is clipped at 0")
    nm = wavelengths if wavelengths is not None and len(rows) > 1 else None
    return _checked(table, nm, _GRID, np.maximum(rows, 0.0), {}, notes)


# --- normalisation ----------------------------------------------------------------------------


def _checked(
    table: DataTable,
    wavelengths: FloatArray | None,
    angles: FloatArray,
    rows: FloatArray,
    elements: dict[str, FloatArray],
    notes: list[str],
) -> PhaseRows:
    """Rows by ascending angle from 0 to 180°, divided by their integrals, thinned."""
    from airlight.physics.optics.phase_table import moments

    order = np.argsort(angles)
    angles, rows = angles[order], rows[:, order]
    elements = {key: one[:, order] for key, one in elements.items()}
    if not (np.diff(angles) > 0.0).all():
        k = int(np.argmin(np.diff(angles)))
        raise ParameterError("angle", float(angles[k]), "each angle once", table.source)
    if angles[0] > _BEYOND or angles[-1] < 180.0 - _BEYOND or angles.size < 3:
        shown = f"{angles[0]:g} to {angles[-1]:g} deg"
        raise ParameterError("angle", shown, "0 to 180 deg", table.source)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratios = {key: np.where(rows > 0.0, one / rows, 0.0) for key, one in elements.items()}
    for end, at in ((0.0, 0), (180.0, angles.size)):
        if end not in angles:
            notes.append(f"the phase function at {end:g}° is that of the nearest angle")
            angles = np.insert(angles, at, end)
            at = min(at, rows.shape[1] - 1)
            rows, ratios = (
                _extended(rows, at, at != 0),
                {key: _extended(one, at, at != 0) for key, one in ratios.items()},
            )
    integrals = moments(angles, rows, 0)[:, 0]
    if not (integrals > 0.0).all():
        raise FileError(table.source, "has a phase function that is 0 everywhere")
    convention = min(_CONVENTIONS, key=lambda one: abs(math.log(one / float(integrals.mean()))))
    off = np.abs(integrals / convention - 1.0)
    k = int(off.argmax())
    at_nm = "" if wavelengths is None else f" at {wavelengths[k]:g} nm"
    if off[k] > _REFUSED:
        raise ParameterError(
            f"integral of the phase function{at_nm}",
            float(integrals[k]),
            "1 or 4π within 10 %",
            table.source,
        )
    if off[k] > _WARNED:
        name = "4π" if convention > 2.0 else "1"
        percent = f"{100.0 * off[k]:.2g} %"
        warn(
            f"{table.source}: the integral of its phase function{at_nm} is off {name} by {percent}"
        )
    values = rows / integrals[:, None]
    if convention > 2.0:
        notes.append("the phase function, normalised to 4π in the table, is divided by that")
    largest = max((float(np.abs(one).max()) for one in ratios.values()), default=0.0)
    if largest > 1.0 + 1e-3:
        raise ParameterError("largest element over P11", largest, "at most 1", table.source)
    ratios = {key: np.clip(one, -1.0, 1.0) for key, one in ratios.items()}
    return _thinned(PhaseRows(wavelengths, angles, values, ratios), notes)


def _extended(rows: FloatArray, at: int, after: bool) -> FloatArray:
    """Rows with the end repeated."""
    return np.insert(rows, rows.shape[1] if after else 0, rows[:, at], axis=1)


def _thinned(phase: PhaseRows, notes: list[str]) -> PhaseRows:
    """Phase functions at fewer angles, if there are many; integrals are kept."""
    from airlight.physics.optics.phase_table import moments

    if phase.angles.size <= _MOST_ANGLES:
        return phase
    kept = np.array([], np.intp)
    errors: list[float] = []
    for row in np.log(np.maximum(phase.values, 1e-30)):
        rows, error = thinned(phase.angles, row, _TOLERANCE, most=_MOST_ANGLES)
        kept, errors = np.union1d(kept, rows), [*errors, error]
    values = phase.values[:, kept]
    values = values / moments(phase.angles[kept], values, 0)
    notes.append(
        f"phase function: {kept.size} of {phase.angles.size} angles kept, within"
        f" {100.0 * max(errors):.2g} %"
    )
    ratios = {key: one[:, kept] for key, one in phase.ratios.items()}
    return PhaseRows(phase.wavelengths, phase.angles[kept], values, ratios)
