"""Headings of columns: name, unit and wavelength; and units as tables spell them."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from typing import Final

from airlight.physics.units import quantity, with_powers

#: Units that a name may end with after ``_``.
_SUFFIXES: Final = (
    *("nm", "um", "m", "km", "hPa", "Pa", "mPa", "mbar", "mb", "K", "C", "degC", "deg", "DU"),
    *("ppm", "ppmv", "ppb", "ppbv", "cm-3", "m-3", "percent"),
)
_BRACKETS: Final = re.compile(r"\s*(.*?)\s*[\[(]((?:[^\[\]()]|\([^()]*\))*)[\])]\s*")
_SUFFIX: Final = re.compile(rf"(.*[^_])_({'|'.join(map(re.escape, _SUFFIXES))})")
_IN_NAME: Final = re.compile(r"(.+?)_(\d+(?:\.\d+)?)\s*nm")
#: A wavelength in place of the unit; AERONET also writes ``[440m]``.
_IN_UNIT: Final = re.compile(r"(\d+(?:\.\d+)?)\s*n?m")
#: Spellings of units by that of ``physics.units``.
_SPELLED: Final = {
    **dict.fromkeys(("mb", "millibar", "millibars"), "mbar"),
    **dict.fromkeys(("micrometers", "micrometer", "micrometres", "micrometre"), "um"),
    **dict.fromkeys(("microns", "micron", "micro-meter"), "um"),
    **dict.fromkeys(("nanometers", "nanometer", "nanometres", "nanometre"), "nm"),
    **dict.fromkeys(("meters", "meter", "metres", "metre", "gpm"), "m"),
    **dict.fromkeys(("angstroms", "Angstrom", "A", "Å"), "angstrom"),
    **dict.fromkeys(("degrees", "degree", "Degrees"), "deg"),
    **dict.fromkeys(("kelvin", "Kelvin", "degK"), "K"),
}
#: Factors of units of ratios.
_RATIOS: Final = {
    **dict.fromkeys(("%", "percent", "percentage", "per cent"), 1e-2),
    **dict.fromkeys(("ppm", "ppmv", "ppmV", "umol/mol"), 1e-6),
    **dict.fromkeys(("ppb", "ppbv", "ppbV", "nmol/mol"), 1e-9),
    **dict.fromkeys(("", "1", "fraction", "unitless", "dimensionless", "none", "mol/mol"), 1.0),
}
#: Spellings of degrees Celsius, whose zero is at 273.15 K.
_CELSIUS: Final = ("C", "°C", "℃", "degC", "deg C", "deg_C", "degrees C", "celsius", "Celsius")
_POWERS: Final = str.maketrans({"⁻": "^-", "¹": "1", "²": "2", "³": "3", "·": " "})
#: Power as Pint writes it.
_POWER: Final = re.compile(r"\s*\*\*\s*")
#: Words for what is counted per volume.
_COUNTED: Final = re.compile(r"(?:molecules?|molec|particles?|#)\.?\s*(?=[/ ]|c?m|$)")


@dataclass(frozen=True)
class Heading:
    """Heading of a column.

    Attributes
    ----------
    name : str
        Name without unit and wavelength.
    unit : str
        Unit as spelled; empty if there is none.
    wavelength : float
        Wavelength of the column, otherwise not a number. [nm]
    text : str
        Whole text of the heading.
    """

    name: str
    unit: str = ""
    wavelength: float = math.nan
    text: str = field(default="", repr=False, compare=False)

    @property
    def key(self) -> str:
        """Letters and digits of the name in lower case, by which columns are found."""
        return re.sub(r"[^a-z0-9]", "", self.name.lower())


def heading(text: str) -> Heading:
    """Heading of a column from its text.

    Examples
    --------
    >>> heading("p(mb)")
    Heading(name='p', unit='mb', wavelength=nan)
    >>> heading("temperature_C").unit
    'C'
    >>> heading("radiance_550nm [W/m^2/sr/nm]")
    Heading(name='radiance', unit='W/m^2/sr/nm', wavelength=550.0)
    >>> heading("Single_Scattering_Albedo[440nm]").wavelength
    440.0
    """
    text = text.strip().strip('"')
    name, unit, wavelength = text, "", math.nan
    bracketed = _BRACKETS.fullmatch(name)
    if bracketed is not None:
        name, unit = bracketed[1], bracketed[2].strip()
        within = _IN_UNIT.fullmatch(unit)
        if within is not None:
            return Heading(name, "", float(within[1]), text)
    spectral = _IN_NAME.fullmatch(name)
    if spectral is not None:
        return Heading(spectral[1], unit, float(spectral[2]), text)
    ending = _SUFFIX.fullmatch(name) if not unit else None
    if ending is not None:
        name, unit = ending[1], ending[2]
    return Heading(name, unit, wavelength, text)


def conversion(unit: str, target: str, field: str = "unit") -> tuple[float, float]:
    """Factor and offset from a unit as a table spells it to another of the same kind.

    Raises
    ------
    ParameterError
        If the unit is unknown or one of something else.

    Examples
    --------
    >>> conversion("°C", "K"), conversion("hPa", "Pa"), conversion("ppmv", "1")
    ((1.0, 273.15), (100.0, 0.0), (1e-06, 0.0))
    >>> conversion("m ** -3", "1/m^3")
    (1.0, 0.0)
    """
    spelled = unit.strip()
    if target == "K" and spelled in _CELSIUS:
        return 1.0, 273.15
    if target == "1" and spelled in _RATIOS:
        return _RATIOS[spelled], 0.0
    spelled = _COUNTED.sub("", _POWER.sub("^", spelled)).translate(_POWERS)
    parts = re.split(r"([/ *])", spelled)
    spelled = with_powers("".join(_SPELLED.get(part, part) for part in parts))
    return quantity(f"1 {spelled}", target, field), 0.0
