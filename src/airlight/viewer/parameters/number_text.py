"""Numbers and quantities as people write them; ``web/state/number_text.js`` has the same rules."""

from __future__ import annotations

from typing import Final

#: Length from which it is written in kilometres, and in millions of them. [m]
FAR: Final = 1e4
VERY_FAR: Final = 1e9
#: Luminance from which it is written without a prefix, and prefixes below it. [cd m⁻²], [1]
BRIGHT: Final = 0.1
PREFIXES: Final = ((1e3, "m"), (1e6, "µ"), (1e9, "n"))
#: Powers of ten between which a number is written without one.
_SMALLEST, _LARGEST = -3, 6
_RAISED: Final = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")


def number_text(value: float, decimals: int = 0) -> str:
    """Format a number with three significant digits, and all its digits before the point.

    Parameters
    ----------
    value : float
        Finite number.
    decimals : int
        Smallest number of decimals, without zeros at the end.

    Examples
    --------
    >>> number_text(187.752), number_text(1995.0), number_text(0.0643), number_text(1.156e-5)
    ('188', '1995', '0.0643', '1.16·10⁻⁵')
    >>> number_text(113.84, 1), number_text(-0.0), number_text(384400.0)
    ('113.8', '0', '384400')
    """
    if value == 0.0:
        return "0"
    mantissa, power = f"{value:.2e}".split("e")
    if not _SMALLEST <= int(power) < _LARGEST:
        return f"{_short(mantissa)}·10{str(int(power)).translate(_RAISED)}"
    return _short(f"{value:.{max(decimals, 2 - int(power), 0)}f}")


def _short(digits: str) -> str:
    return digits.rstrip("0").rstrip(".") if "." in digits else digits


def quantity_text(value: float, unit: str) -> str:
    """Format a number with its unit: lengths in m or km, hours as a clock has them.

    Examples
    --------
    >>> quantity_text(4e5, "m"), quantity_text(8849.0, "m"), quantity_text(1.496e11, "m")
    ('400 km', '8849 m', '150 million km')
    >>> quantity_text(113.84, "deg"), quantity_text(817.35, "DU"), quantity_text(20.17, "h")
    ('113.8°', '817 DU', '20:10')
    """
    if unit == "m" and abs(value) >= VERY_FAR:
        return f"{number_text(1e-9 * value)} million km"
    if unit == "m" and abs(value) >= FAR:
        return f"{number_text(1e-3 * value)} km"
    if unit == "h" and 0.0 <= value <= 24.0:
        minutes = int(60.0 * value + 0.5)
        return f"{minutes // 60}:{minutes % 60:02d}"
    if unit == "cd/m^2":
        return luminance_text(value)
    return with_unit(number_text(value, 1 if unit == "deg" else 0), unit)


def luminance_text(value: float) -> str:
    """Format a luminance [cd m⁻²]; a dark one in thousandths, millionths or billionths.

    Examples
    --------
    >>> luminance_text(4321.0), luminance_text(1.7e-4), luminance_text(0.0)
    ('4321 cd/m²', '170 µcd/m²', '0 cd/m²')
    """
    if 0.0 < value < BRIGHT:
        for factor, prefix in PREFIXES:
            if value * factor >= 1.0:
                return f"{number_text(value * factor)} {prefix}cd/m²"
    return f"{number_text(value)} cd/m²"


def unit_text(unit: str) -> str:
    """Format a unit, with superscript powers; empty for pure numbers.

    Examples
    --------
    >>> unit_text("W/m^2/nm"), unit_text("/m"), unit_text("deg"), unit_text("1")
    ('W/(m² nm)', '/m', '°', '')
    """
    if unit in ("1", ""):
        return ""
    if unit in ("deg", "degree"):
        return "°"
    above, *below = unit.replace("**", "^").split("/")
    words = [_raised(one) for one in below if one]
    under = words[0] if len(words) == 1 else f"({' '.join(words)})"
    over = "" if above == "1" else _raised(above)
    return f"{over}/{under}" if words else over


def _raised(unit: str) -> str:
    name, _, power = unit.partition("^")
    name = "µm" if name == "um" else name
    return name + power.translate(_RAISED)


def with_unit(number: str, unit: str) -> str:
    """Join a number and its unit, with a space except before °.

    Examples
    --------
    >>> with_unit("8.5", "km"), with_unit("60", "deg"), with_unit("0.3", "1")
    ('8.5 km', '60°', '0.3')
    """
    text = unit_text(unit)
    return number + text if text == "°" else f"{number} {text}".rstrip()
