"""Conversion of option texts to numbers in SI."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from airlight.errors import ParameterError
from airlight.physics.units import UNDERSTOOD, quantities, quantity, values_in

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

Overwrite = Annotated[
    bool,
    typer.Option(
        "--overwrite",
        help="Also replace files that airlight did not write or that were modified.",
    ),
]


def output_option(metavar: str, words: str) -> Any:
    """Option ``--output`` of a command that has no group with it."""
    return typer.Option("--output", "-o", metavar=metavar, help=words)


#: Wavelengths of the three-wavelength mode. [nm]
RGB = (680.0, 550.0, 440.0)
#: Whole numbers below this are numbers of wavelengths; others are wavelengths. [nm]
SMALLEST_WAVELENGTH = 100


def length(text: str, option: str) -> float:
    """Parse a length such as ``400km`` or ``10 m``; only 0 needs no unit. [m]

    Examples
    --------
    >>> length("400km", "--altitude")
    400000.0
    """
    return quantity(text, "m", option)


def values(text: str, unit: str, option: str) -> list[float]:
    """Parse a list of numbers, or a range ``FROM:TO:STEP`` with its end.

    Parameters
    ----------
    text : str
        Comma-separated numbers, or a range; the last unit applies to all.
    unit : str
        Unit of the result; if in ``UNDERSTOOD``, also of numbers without a unit.
    option : str
        Name of the option, for errors.

    Raises
    ------
    ParameterError
        If the text is neither, or the range has more than 100 000 values.

    Examples
    --------
    >>> values("0:60:20deg", "deg", "--sun-zenith"), values("0m, 2km", "m", "--altitude")
    ([0.0, 20.0, 40.0, 60.0], [0.0, 2000.0])
    """
    if ":" not in text:
        return quantities(text, unit, option, bare=unit in UNDERSTOOD)
    return values_in(text, unit, option).tolist()  # type: ignore[no-any-return]


def lengths(text: str, option: str) -> tuple[float, ...]:
    """Parse a list or range of lengths, see ``values``. [m]"""
    return tuple(values(text, "m", option))


def wavelength_width(text: str, option: str) -> float:
    """Parse the width of a band such as ``10nm``; nm without a unit. [nm]"""
    return quantity(text, "nm", option, bare=True)


def angles(text: str, option: str) -> tuple[float, ...]:
    """Parse a list or range of angles, see ``values``. [deg]"""
    return tuple(values(text, "deg", option))


def unread(text: str, option: str) -> str:
    """Return the text of an option whose meaning depends on others."""
    return text


def angle(text: str, option: str) -> float:
    """Parse an angle such as ``85deg`` or ``85``; degrees without a unit. [deg]

    Examples
    --------
    >>> angle("85deg", "--sun-zenith")
    85.0
    """
    return quantity(text, "deg", option, bare=True)


def bearing(text: str, option: str) -> float:
    """Parse a compass bearing such as ``SW`` or ``225deg``; degrees without a unit. [deg]

    Examples
    --------
    >>> bearing("SW", "--sun-azimuth"), bearing("-20", "--heading")
    (225.0, -20.0)
    """
    from airlight.scene.compass import bearing as bearing_of

    return bearing_of(text, option)


def temperature(text: str, option: str) -> float:
    """Parse a temperature such as ``3500K``; kelvin without a unit. [K]

    Examples
    --------
    >>> temperature("3500K", "--second-star")
    3500.0
    """
    return quantity(text, "K", option, bare=True)


def direction(text: str, option: str) -> tuple[float, float]:
    """Parse a zenith angle and an azimuth. [deg]

    Examples
    --------
    >>> direction("85,-30", "--look")
    (85.0, -30.0)
    """
    parts = quantities(text, "deg", option, bare=True)
    if len(parts) != 2:
        raise ParameterError(option, text, "zenith,azimuth in degrees, such as 85,0")
    return parts[0], parts[1]


def picture_size(text: str | None, projection: str) -> tuple[int, int]:
    """Parse the width and height of a picture. [pixel]

    Parameters
    ----------
    text : str or None
        Size such as ``1280x720``, or one number: side of a square, width of a panorama, side of a
        cube face. None: the projection's default.

    Examples
    --------
    >>> picture_size("1280x720", "perspective")
    (1280, 720)
    >>> picture_size("512", "cubemap")
    (3072, 512)
    """
    from airlight.scene.projections import PROJECTIONS

    form = PROJECTIONS[projection]
    if text is None:
        return form.size
    match = re.fullmatch(r"\s*(\d{1,6})\s*(?:[xX×]\s*(\d{1,6})\s*)?", text)
    if match is None:
        raise ParameterError("--size", text, "WIDTHxHEIGHT such as 1280x720, or one number")
    width = int(match[1])
    if match[2] is not None:
        return width, int(match[2])
    return form.sized(width)


def crop(text: str | None, columns: int, rows: int) -> tuple[int, int, int, int] | None:
    """Parse a window of a picture: its left and top edge, its width and height. [pixel]

    Examples
    --------
    >>> crop("64,32,16,16", 128, 128), crop(None, 128, 128)
    ((64, 32, 16, 16), None)
    """
    if text is None:
        return None
    numbers = [int(one) for one in text.split(",") if re.fullmatch(r"\s*\d{1,6}\s*", one)]
    if len(numbers) == 4 == text.count(",") + 1:
        left, top, width, height = numbers
        if width > 0 and height > 0 and left + width <= columns and top + height <= rows:
            return left, top, width, height
    allowed = f"X,Y,WIDTH,HEIGHT in pixels, of a window inside {columns}x{rows}"
    raise ParameterError("--crop", text, allowed)


def projection(text: str) -> str:
    """Validated name of a projection.

    Examples
    --------
    >>> projection("fisheye")
    'fisheye'
    """
    from airlight.scene.projections import PROJECTIONS

    if text not in PROJECTIONS:
        raise ParameterError("--projection", text, ", ".join(PROJECTIONS))
    return text


def exposure(text: str, option: str = "--exposure") -> float | Literal["auto"]:
    """Parse an exposure: ``auto`` or a power of two. [EV]

    Examples
    --------
    >>> exposure("-2.5")
    -2.5
    """
    if text.strip().lower() == "auto":
        return "auto"
    value = quantity(text.strip().removesuffix("EV"), "1", option)
    if not -100.0 <= value <= 100.0:
        raise ParameterError(option, text, "auto, or -100 to 100 EV")
    return value


def film_exposure(text: str, option: str) -> float | Literal["auto", "locked"]:
    """Parse an exposure of a film: ``locked``, ``auto`` or a power of two. [EV]"""
    if text.strip().lower() == "locked":
        return "locked"
    try:
        return exposure(text, option)
    except ParameterError as error:
        raise ParameterError(option, text, "auto, locked, or -100 to 100 EV") from error


def f_number(text: str, option: str) -> float:
    """Parse the f-number of an aperture, such as ``f/8``. [1]"""
    return quantity(text.strip().lower().removeprefix("f/"), "1", option)


def shutter_time(text: str, option: str) -> float:
    """Parse a shutter time such as ``1/250s``; seconds without a unit. [s]"""
    over, _, under = text.strip().rpartition("/")
    seconds = quantity(under, "s", option, bare=True)
    return quantity(over, "1", option) / seconds if over and seconds > 0 else seconds


def wavelengths(text: str, planet: Planet) -> tuple[float, ...]:
    """Parse a list of wavelengths. [nm]

    Parameters
    ----------
    text : str
        ``rgb``: 680, 550 and 440 nm. An integer below 100: number of wavelengths over the visible
        range of the planet. Otherwise wavelengths, such as ``680,550,440``, ``"0.55 um"`` or
        ``400:900:10``.
    planet : Planet
        Planet with the limits.
    """
    option = "--wavelengths"
    stripped = text.strip().lower()
    if stripped == "rgb":
        return RGB
    if stripped.isdecimal() and int(stripped) < SMALLEST_WAVELENGTH:
        from airlight.planets.picture_wavelengths import picture_wavelengths

        count = int(stripped)
        if count < 1:
            raise ParameterError(option, text, "rgb, 1 to 99, or wavelengths in nm")
        return tuple(float(w) for w in picture_wavelengths(planet, count))
    nm = values(text, "nm", option)
    if len(set(nm)) < len(nm):
        raise ParameterError(option, text, "each wavelength once")
    if min(nm) <= 0.0:
        raise ParameterError(option, text, "wavelengths above 0 nm")
    return tuple(nm)
