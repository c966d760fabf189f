"""Constituent of a planet from a table of its optical properties over wavelength."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConflictError, FileError, ParameterError
from airlight.physics.data_tables.data_table import DataColumn, DataTable, Quantity
from airlight.planets.importing.phase_tables import WAVELENGTH, PhaseRows, phase_rows
from airlight.planets.importing.planet_tables import PlanetTables

if TYPE_CHECKING:
    from airlight.planets.constituent import Constituent

FloatArray = NDArray[np.float64]

EXTINCTION: Final = Quantity(
    name="extinction",
    unit="1/m",
    names=("ext", "extinctioncoefficient", "bext", "sigmaext", "kext"),
    low=0.0,
    high=1.0,
    units="1/km, 1/m (any beside optical_depth)",
)
SCATTERING: Final = Quantity(
    name="scattering",
    unit="1/m",
    names=("sca", "scatteringcoefficient", "bsca", "bscat"),
    low=0.0,
    high=1.0,
    units="1/km, 1/m",
)
ABSORPTION: Final = Quantity(
    name="absorption",
    unit="1/m",
    names=("abs", "absorptioncoefficient", "babs"),
    low=0.0,
    high=1.0,
    units="1/km, 1/m",
)
DEPTH: Final = Quantity(
    name="optical_depth",
    unit="1",
    names=("aod", "aot", "tau", "opticalthickness", "od", "aodextinctiontotal"),
    low=0.0,
    high=1e4,
)
ALBEDO: Final = Quantity(
    name="single_scattering_albedo",
    unit="1",
    names=("ssa", "omega", "omega0", "w0", "singlescatteringalbedo"),
    low=0.0,
    high=1.0,
)
ASYMMETRY: Final = Quantity(
    name="asymmetry",
    unit="1",
    names=("g", "gg", "asy", "asymmetryparameter", "asymmetryfactor", "asymmetryfactortotal"),
    low=-0.999,
    high=0.999,
)
_SPECTRA: Final = (EXTINCTION, SCATTERING, ABSORPTION, DEPTH, ALBEDO, ASYMMETRY)
#: Number for what was not retrieved. [1]
_ABSENT: Final = (-999.0,)
#: Scale height of a constituent without a profile. [m]
_SCALE_HEIGHT: Final = "2 km"
#: Largest difference between wavelengths of two tables of the same spectrum. [nm]
_SAME: Final = 5.0


@dataclass(frozen=True, eq=False)
class OpticalSpectra:
    """Spectra of a constituent by name, and its phase function.

    Attributes
    ----------
    wavelengths : array, shape (nl,), or None
        Wavelengths. [nm]
    spectra : dict of str to array, shape (nl,)
        Values by the name of the quantity.
    phase : PhaseRows or None
        Phase functions.
    """

    wavelengths: FloatArray | None
    spectra: dict[str, FloatArray]
    phase: PhaseRows | None


def import_aerosol(
    planet: PlanetTables,
    tables: Sequence[DataTable],
    name: str,
    optical_depth: float | None = None,
) -> None:
    """Replace or add a constituent by tables of its optical properties.

    Parameters
    ----------
    planet : PlanetTables
        Tables of the planet file, changed in place.
    tables : sequence of DataTable
        Tables of the same constituent, such as AERONET's files of one site.
    name : str
        Name of the constituent.
    optical_depth : float, optional
        Vertical optical depth at 550 nm, to which the extinction is scaled. [1]
    """
    found = _merged([_optics(one, planet.notes, optical_depth) for one in tables], tables)
    place, name = planet.constituent_of(name)
    old = any(one.name == name for one in planet.base.constituents)
    planet.notes.append(f"{name}: {'replaces that of' if old else 'added to'} {planet.base.name}")
    profile = place.get("profile")
    if profile is None:
        profile = {"kind": "exponential", "scale_height": _SCALE_HEIGHT}
        planet.notes.append(f"{name}: no profile in the table; a scale height of {_SCALE_HEIGHT}")
    if not found.spectra and found.phase is not None:
        found = _completed(planet, name, found)
    assert found.wavelengths is not None
    keys = _coefficients(found, tables[0].source, optical_depth)
    keys["phase_function"] = _phase_table(found, tables[0].source, keys)
    listed = any(
        isinstance(one, list) for one in (*keys.values(), *keys["phase_function"].values())
    )
    nm = {"wavelengths": _text(found.wavelengths, "nm")} if listed else {}
    planet.matter(place, {"profile": profile, **nm, **keys})
    planet.comment(name, f"{planet.source}")


def _optics(table: DataTable, notes: list[str], depth: float | None) -> OpticalSpectra:
    """Spectra and phase functions of a table."""
    nm = None
    spectral = {one.name: table.by_wavelength(one) for one in _SPECTRA}
    wide = {name: columns for name, columns in spectral.items() if columns}
    spectra: dict[str, FloatArray] = {}
    if wide:
        nm, spectra = _wide(table, wide, notes)
    elif table.find(WAVELENGTH) is not None or any(map(table.find, _SPECTRA)):
        column = table.required(WAVELENGTH)
        nm = table.numbers(WAVELENGTH, column)
        if column.values.ndim != 1:
            raise FileError(table.source, "has wavelengths in more than one axis")
        for one in _SPECTRA:
            of = table.find(one)
            if of is not None:
                spectra[one.name] = _spectrum(table, one, of, nm, depth)
    phase = phase_rows(table, nm, notes)
    if spectra and nm is not None and phase is not None and np.unique(nm).size < nm.size:
        nm, first = np.unique(nm, return_index=True)  # a row for each angle
        spectra = {key: one[first] for key, one in spectra.items()}
    if spectra and nm is not None and np.unique(nm).size < nm.size:
        k = next(k for k in range(nm.size) if nm[k] in nm[:k])
        where = f"{table.place(k)}, wavelength"
        raise ParameterError(where, f"{nm[k]:g} nm", "each wavelength once", table.source)
    if not spectra and phase is None:
        table.required(EXTINCTION)
    return OpticalSpectra(nm if spectra else None, spectra, phase)


def _spectrum(
    table: DataTable, wanted: Quantity, column: DataColumn, nm: FloatArray, depth: float | None
) -> FloatArray:
    if wanted is EXTINCTION and depth is not None:  # it is scaled
        values = table.own_numbers(replace(EXTINCTION, high=math.inf), column)
    else:
        values = table.numbers(wanted, column)
    if values.shape != nm.shape:
        allowed = f"one number for each of {nm.size} wavelengths (select a coordinate)"
        raise ParameterError(column.heading.name, values.shape, allowed, table.source)
    return values


def _wide(
    table: DataTable, wide: dict[str, list[DataColumn]], notes: list[str]
) -> tuple[FloatArray, dict[str, FloatArray]]:
    """Columns at wavelengths of their own, means over the rows."""
    named = {one.name: one for one in _SPECTRA}
    nm = np.unique([one.heading.wavelength for columns in wide.values() for one in columns])
    spectra = {name: np.full(nm.size, math.nan) for name in wide}
    columns = [one for several in wide.values() for one in several]
    missing = np.stack([one.missing(_ABSENT) for one in columns])
    empty = np.asarray(missing.all(axis=1), np.bool_)  # a wavelength that was not measured
    there = np.asarray(~missing[~empty].any(axis=0), np.bool_)
    if not there.any():
        raise FileError(table.source, f"has no row with {', '.join(wide)}")
    part = table.where(there)
    for name, several in wide.items():
        for one in several:
            if not empty[columns.index(one)]:
                values = part.numbers(named[name], part.columns[table.columns.index(one)])
                spectra[name][np.searchsorted(nm, one.heading.wavelength)] = values.mean()
    kept = ~np.any([np.isnan(one) for one in spectra.values()], axis=0)
    if not kept.any():
        raise FileError(table.source, f"has no wavelength with {', '.join(wide)}")
    if there.size > 1:
        notes.append(f"means of {there.sum()} of {there.size} rows")
    return nm[kept], {name: one[kept] for name, one in spectra.items()}


def _merged(parts: Sequence[OpticalSpectra], tables: Sequence[DataTable]) -> OpticalSpectra:
    """Spectra of several tables at the wavelengths of the first."""
    found = next((one for one in parts if one.spectra), parts[0])
    spectra, phase = dict(found.spectra), found.phase
    for one, table in zip(parts, tables, strict=True):
        phase = one.phase if phase is None else phase
        if one is found or one.wavelengths is None or found.wavelengths is None:
            continue
        for name, values in one.spectra.items():
            near = np.abs(one.wavelengths[:, None] - found.wavelengths).min(axis=0)
            if near.max() > _SAME:
                at = float(found.wavelengths[near.argmax()])
                raise FileError(table.source, f"has no {name} at {at:g} nm, as the other table has")
            order = np.argsort(one.wavelengths)
            at_first = np.interp(found.wavelengths, one.wavelengths[order], values[order])
            spectra.setdefault(name, at_first)
    return OpticalSpectra(found.wavelengths, spectra, phase)


def _completed(planet: PlanetTables, name: str, found: OpticalSpectra) -> OpticalSpectra:
    """Spectra of the base planet's constituent for a phase function alone."""
    own = next((one for one in planet.base.constituents if one.name == name), None)
    if own is None or found.phase is None:
        raise ConflictError(name, "requires an extinction or an optical depth", planet.source)
    nm = found.phase.wavelengths
    nm = np.array([550.0]) if nm is None else nm
    column = own.profile.column(planet.base.thickness)
    scattering = _scattering(own, nm, column)
    extinction = scattering + own.absorption_coefficients(nm, column)
    planet.notes.append(f"{name}: optical depth and albedo are those of {planet.base.name}")
    spectra = {"optical_depth": extinction * column, ALBEDO.name: scattering / extinction}
    return OpticalSpectra(nm, spectra, found.phase)


def _scattering(own: Constituent, nm: FloatArray, column: float) -> FloatArray:
    return np.asarray(own.scattering_coefficients(nm, column), np.float64)


def _coefficients(found: OpticalSpectra, source: str, depth: float | None) -> dict[str, Any]:
    """Keys of extinction or optical depth, and of the single-scattering albedo."""
    have = found.spectra
    extinction, albedo = have.get("extinction"), have.get(ALBEDO.name)
    scattering, absorption = have.get("scattering"), have.get("absorption")
    if extinction is None and scattering is not None and absorption is not None:
        extinction = scattering + absorption
    if extinction is None and scattering is not None and albedo is not None:
        extinction = scattering / np.maximum(albedo, 1e-6)
    if albedo is None and extinction is not None:
        if scattering is not None:
            albedo = scattering / np.maximum(extinction, 1e-300)
        elif absorption is not None:
            albedo = 1.0 - absorption / np.maximum(extinction, 1e-300)
    tau = have.get("optical_depth")
    if extinction is None and tau is None:
        raise FileError(source, "has no column extinction or optical_depth in its header")
    if albedo is None:
        raise FileError(source, f"has no column {ALBEDO.name} in its header")
    if albedo.min() < 0.0 or albedo.max() > 1.0 + 1e-9:
        k = int(np.abs(albedo - 0.5).argmax())
        raise ParameterError("scattering over extinction", float(albedo[k]), "0 to 1", source)
    spectrum = tau if tau is not None else extinction
    assert spectrum is not None
    assert found.wavelengths is not None
    keys: dict[str, Any] = {}
    if depth is not None:
        from airlight.planets.spectral import PerWavelength

        law = PerWavelength(wavelengths=tuple(found.wavelengths), values=tuple(spectrum))
        low, high = law.limits
        if not low <= 550.0 <= high:
            raise ConflictError("optical_depth", f"requires 550 nm in the wavelengths of {source}")
        at = float(law.at_power_law([550.0])[0])
        keys["optical_depth"] = _numbers(spectrum * (depth / at))
    elif tau is not None:
        keys["optical_depth"] = _numbers(tau)
    else:
        keys["extinction"] = [f"{1e3 * one:.6g} /km" for one in spectrum]
        if len(set(keys["extinction"])) == 1:
            keys["extinction"] = keys["extinction"][0]
    keys[ALBEDO.name] = _numbers(np.minimum(albedo, 1.0))
    return keys


def _phase_table(found: OpticalSpectra, source: str, keys: dict[str, Any]) -> dict[str, Any]:
    """Table of the phase function at the wavelengths of the spectra."""
    wavelengths = found.wavelengths
    assert wavelengths is not None
    if found.phase is None:
        if ASYMMETRY.name not in found.spectra:
            raise FileError(source, "has no column asymmetry, phase_function or moments")
        g = _numbers(found.spectra[ASYMMETRY.name])
        return {"kind": "henyey-greenstein", "asymmetry": g}
    phase = found.phase
    table: dict[str, Any] = {"kind": "tabulated", "angles": _text(phase.angles, "deg")}
    nm = phase.wavelengths
    single = nm is None or len(phase.values) == 1

    def rows(values: FloatArray, digits: int) -> Any:
        if single:
            return [float(f"{one:.{digits}g}") for one in values[0]]
        assert nm is not None
        order = np.argsort(nm)
        weights = np.stack([np.interp(wavelengths, nm[order], unit) for unit in np.eye(len(nm))])
        at = weights.T @ values[order]
        return [[float(f"{one:.{digits}g}") for one in row] for row in at]

    table["values"] = rows(phase.values, 7)
    for key, ratio in phase.ratios.items():
        table[key] = rows(ratio, 5)
    return table


def _numbers(values: FloatArray) -> Any:
    """Numbers of a list, or the one number that all are."""
    listed = [float(f"{one:.6g}") for one in values]
    return listed[0] if len(set(listed)) == 1 else listed


def _text(values: FloatArray, unit: str) -> str:
    return f"{', '.join(f'{one:.8g}' for one in values)} {unit}"
