"""Parameter values of a constituent as a flat table, for comparison."""

from __future__ import annotations

import contextlib
import dataclasses
import re
import zlib
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from airlight.errors import ParameterError
from airlight.planets.matter.particle_sizes import ParticleSizes
from airlight.planets.matter.phases import PhaseFunction
from airlight.planets.matter.profiles import Profile
from airlight.planets.schema.toml_model import fields_of
from airlight.planets.spectral import PerWavelength

if TYPE_CHECKING:
    from airlight.planets.constituent import Constituent

#: Key of a value: name, unit, wavelength [nm] or None.
ValueKey = tuple[str, str, float | None]

#: Longest tuple that is listed; longer ones are shown by their length and checksum.
_LONGEST: Final = 8
#: Derived quantities of gases and particles, with their units.
_DERIVED: Final = {
    "molar_mass": "kg mol⁻¹",
    "scale_height": "m",
    "number_density": "m⁻³",
}
_DERIVED_SPECTRA: Final = {
    "refractivities": ("n - 1", ""),
    "king_factors": ("King factor", ""),
    "cross_sections": ("cross-section", "m²"),
    "depolarisations": ("depolarisation", ""),
}


def parameter_values(
    constituent: Constituent, thickness: float, wavelengths: tuple[float, ...]
) -> dict[ValueKey, float | str]:
    """Explicit values of a constituent and of its nested parameter objects, and its column.

    Parameters
    ----------
    thickness : float
        Thickness of the shell. [m]
    wavelengths : tuple of float
        Wavelengths within its limits, at which spectral values are taken. [nm]

    Returns
    -------
    dict
        Map from (name, unit, wavelength or None) to a number in that unit or a word.

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> haze = load_planet("earth-openspace").constituents[1]
    >>> values = parameter_values(haze, 70e3, (550.0,))
    >>> values["profile scale height", "m", None], values["phase function", "", None]
    (1200.0, 'henyey-greenstein')
    """
    nm = wavelengths
    found: dict[ValueKey, float | str] = {}
    for name in ("profile", "matter", "scattering", "absorption", "phase_function"):
        part = getattr(constituent, name)
        if dataclasses.is_dataclass(part) and not isinstance(part, PerWavelength):
            label = "given as" if name in ("matter", "scattering") else name.replace("_", " ")
            found[label, "", None] = _kind(part)
            inner = label if name in ("profile", "phase_function") else ""
            found.update(_fields(part, inner, nm))
        elif name == "scattering" and part != 0.0:
            found["given as", "", None] = "coefficients"
    for name in ("scattering", "absorption"):
        values = getattr(constituent, f"{name}_coefficients")(list(nm), thickness)
        for wavelength, value in zip(nm, np.atleast_1d(values), strict=True):
            found[f"{name} coefficient", "m⁻¹", wavelength] = float(value)
    found["column height", "m", None] = constituent.profile.column(thickness)
    return found


def _flattened(value: Any, label: str, unit: str, nm: tuple[float, ...]) -> Iterator[Any]:
    """Pairs of key and value of nested objects."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        yield (label, "", None), _kind(value)
        yield from _fields(value, label, nm)
    elif isinstance(value, Mapping):
        for key, item in value.items():
            yield from _flattened(item, _joined(label, str(key)), unit, nm)
    elif isinstance(value, (tuple, list)):
        yield from _listed(value, label, unit, nm)
    elif isinstance(value, (bool, str)):
        yield (label, "", None), str(value)
    elif isinstance(value, (int, float, np.number)):
        yield (label, unit, None), float(value)
    elif value is not None:
        yield (label, "", None), type(value).__name__


def _fields(value: Any, label: str, nm: tuple[float, ...]) -> Iterator[Any]:
    """Pairs of key and value of each field of a parameter object."""
    keys = fields_of(type(value))
    for field in dataclasses.fields(value):
        if not field.name.startswith("_"):
            key = keys.get(field.name)
            inner, unit = _joined(label, field.name), "" if key is None else key.unit_words
            own = getattr(value, field.name)
            if isinstance(own, PerWavelength):  # positive spectra are those edited on a log scale
                positive = key is not None and key.scale == "log"
                spectrum = own.at_power_law(nm) if positive else own.at(nm)
                for wavelength, number in zip(nm, spectrum, strict=True):
                    yield (inner, unit, wavelength), float(number)
            else:
                yield from _flattened(own, inner, unit, nm)
    yield from _derived(value, label, nm)


def _listed(values: Any, label: str, unit: str, nm: tuple[float, ...]) -> Iterator[Any]:
    pairs = all(isinstance(item, tuple) and len(item) == 2 for item in values)
    if values and pairs and all(isinstance(item[0], str) for item in values):
        yield from _flattened(dict(values), label, unit, nm)
    elif len(values) > _LONGEST:
        yield (label, "", None), f"{len(values)} values, {zlib.crc32(repr(values).encode()):08x}"
    else:
        for index, item in enumerate(values):
            yield from _flattened(item, f"{label} {index}", unit, nm)


def _derived(value: Any, label: str, nm: tuple[float, ...]) -> Iterator[Any]:
    """Derived quantities of a gas."""
    given = {field.name for field in dataclasses.fields(value)}
    for name, unit in _DERIVED.items():
        with contextlib.suppress(ParameterError):  # a gas without gravity has no scale height
            if name not in given and isinstance(number := getattr(value, name, None), float):
                yield (_joined(label, name), unit, None), number
    for name, (word, unit) in _DERIVED_SPECTRA.items():
        if name == "refractivities" and not getattr(value, "bends", True):
            continue
        method = getattr(value, name, None)
        given_itself = getattr(value, word, None) is not None
        numbers = method(list(nm)) if callable(method) and nm and not given_itself else None
        if isinstance(numbers, np.ndarray):  # particles give two cross-sections, listed otherwise
            for wavelength, number in zip(nm, numbers, strict=True):
                yield (_joined(label, word), unit, wavelength), float(number)


def _joined(label: str, name: str) -> str:
    return f"{label} {name.replace('_', ' ')}".strip()


def _kind(value: Any) -> str:
    """Kind in a planet file, ``henyey-greenstein``, or the class, ``ozone-absorption``."""
    if isinstance(value, (Profile, PhaseFunction, ParticleSizes)):
        return value.keyword
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "-", type(value).__name__).lower()


def composition_of(
    constituent: Constituent, wavelengths: tuple[float, ...] = ()
) -> dict[tuple[str, str], tuple[float | str, ...]]:
    """Explicit and derived values of a gas, particles or an absorber.

    Parameters
    ----------
    wavelengths : tuple of float
        Wavelengths at which spectral values are taken. [nm]

    Returns
    -------
    dict
        Map from (name, unit) to a value, or one per wavelength; empty for a constituent given by
        coefficients.

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> ozone = composition_of(load_planet("earth").constituents[2])
    >>> ozone["absorption", ""], ozone["temperature", "K"]
    (('ozone-absorption',), (225.0,))
    """
    found: dict[tuple[str, str], tuple[float | str, ...]] = {}
    for name in ("matter", "scattering", "absorption"):
        part = getattr(constituent, name)
        if dataclasses.is_dataclass(part) and not isinstance(part, PerWavelength):
            label = "made of" if name == "matter" else name
            found[label, ""] = (_kind(part),)
            for (quantity, unit, _), value in _fields(part, "", wavelengths):
                found[quantity, unit] = (*found.get((quantity, unit), ()), value)
    return found
