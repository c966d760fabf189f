"""Conversion of option texts to numbers in SI, with the option's name in errors."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from airlight.cli.console import note
from airlight.errors import ConflictError, ParameterError, changed
from airlight.units import UNDERSTOOD, quantities, quantity, values_in

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

Planet_ = Annotated[
    str, typer.Argument(metavar="PLANET", help="Name of a preset, or path of a TOML file.")
]
Quality = Annotated[Literal["preview", "default", "fine"], typer.Option(help="Solver accuracy.")]
Set = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="PATH=VALUE",
        help="Override a key of PLANET's file: ground.albedo=0.3, "
        "dust.profile.scale_height='8 km'; PATH= removes it. May be repeated.",
    ),
]
Glare = Annotated[
    float,
    typer.Option(
        metavar="NUMBER",
        help="Lens glare around the sun: 1 is a typical lens, 0 none, at most 10.",
    ),
]
GroundAlbedo = Annotated[
    str | None,
    typer.Option(
        metavar="ALBEDO",
        help="Surface albedo used by the solver: 0.3; 440:0.2,550:0.3,680:0.35 by wavelength in "
        "nm; or the name of a table. Default: the planet's map around the observer, or the "
        "planet's file if there is no map.",
    ),
]
Latitude = Annotated[
    str | None,
    typer.Option(
        metavar="ANGLE",
        help="Observer latitude; requires --longitude. The solver uses the surface albedo around "
        "it by the planet's map; without, the planet's mean.",
    ),
]
Longitude = Annotated[
    str | None,
    typer.Option(metavar="ANGLE", help="Observer longitude, east positive; requires --latitude."),
]
SunZenith = Annotated[
    str | None,
    typer.Option(metavar="ANGLE", help="Sun zenith angle at the observer, e.g. 72deg."),
]
SunAzimuth = Annotated[
    str | None,
    typer.Option(metavar="BEARING", help="Compass bearing of the sun: 105deg, ESE."),
]
Wavelengths = Annotated[
    str | None,
    typer.Option(
        metavar="rgb|N|LIST",
        help="Wavelengths: rgb (680, 550, 440 nm), a number over the visible, or a list in nm. "
        "Default: 16; on a GPU the four with the best colours.",
    ),
]
Device = Annotated[
    Literal["auto", "cpu", "gpu"],
    typer.Option(
        metavar="auto|cpu|gpu",
        help="Renderer: cpu; gpu, up to 4 wavelengths, falls back to cpu; auto, gpu if there is a "
        "hardware GPU.",
    ),
]
Exact = Annotated[
    bool,
    typer.Option(
        "--exact",
        help="Ray-march every pixel, instead of interpolating the sky-view LUT, which is accurate "
        "to a few parts in 10000.",
    ),
]
Exposure = Annotated[
    str | None,
    typer.Option(
        metavar="EV|auto",
        help="Exposure compensation, a power of 2; default auto, like an adapted eye.",
    ),
]
ToneMap = Annotated[
    str, typer.Option(metavar="NAME", help="Tone map: {color.tone_maps:TONE_MAPS}.")
]
Encoding = Annotated[
    Literal["srgb", "gamma"], typer.Option(help="Transfer function of the picture.")
]
Primaries = Annotated[Literal["srgb", "display-p3"], typer.Option(help="Primaries of the picture.")]
Bits = Annotated[int, typer.Option(metavar="8|16", help="Bits per channel of a PNG.")]
NoPolarisation = Annotated[
    bool,
    typer.Option(
        "--no-polarisation",
        help="Scalar radiative transfer, for comparison: radiances are off by some percent.",
    ),
]
NoCache = Annotated[
    bool, typer.Option("--no-cache", help="Disable the cache of solutions on disk.")
]
Overwrite = Annotated[
    bool,
    typer.Option(
        "--overwrite",
        help="Also replace files that airlight has not written, or that have changed since.",
    ),
]

#: Wavelengths of the three-wavelength mode. [nm]
RGB = (680.0, 550.0, 440.0)
#: A whole number below this is a number of wavelengths; from here on it is a wavelength. [nm]
SMALLEST_WAVELENGTH = 100


def planet(name: str, changes: list[str] | None = None) -> Planet:
    """Load the planet of a command.

    Parameters
    ----------
    name : str
        Name of a preset, or path of a planet file.
    changes : list of str, optional
        Arguments of ``--set``, each ``PATH=VALUE``; for a repeated path the last counts.

    Raises
    ------
    ParameterError
        If a path does not exist, or the changed file cannot be read.

    Notes
    -----
    A constituent that a low top cuts off is named on the standard error stream.
    """
    from airlight.cli.progress import shown_progress
    from airlight.planets import load_planet
    from airlight.planets.reading.overrides import FIELD, parsed
    from airlight.planets.truncated_constituents import truncated_constituents

    try:
        paths = dict(parsed(change) for change in changes or [])
        with shown_progress() as report:
            loaded = load_planet(name, paths, progress=report)
    except ParameterError as error:

        def of_the_option(one: ParameterError) -> ParameterError:
            if one.field != FIELD:
                return one
            return one.named("--set")

        raise changed(error, of_the_option) from None
    for line in truncated_constituents(loaded):
        note(line)
    return loaded


def with_ground_albedo(planet: Planet, text: str) -> Planet:
    """Planet with the ground's albedo of ``--ground-albedo``, which its map leaves as it is.

    Parameters
    ----------
    planet : Planet
        Planet of the command.
    text : str
        A number, pairs of wavelength [nm] and albedo such as ``440:0.2,680:0.3``, or the name of a
        table of reflectances.

    Raises
    ------
    ParameterError
        If it is none of these, or out of range.
    """
    from airlight.planets import replace
    from airlight.planets.spectral import PerWavelength

    option, allowed = "--ground-albedo", "0 to 1, nm:albedo pairs, or the name of a table"
    albedo: float | str | PerWavelength = text.strip()
    try:
        if ":" in text:
            pairs = [one.split(":") for one in text.split(",")]
            nm, values = zip(*((float(one), float(other)) for one, other in pairs), strict=True)
            albedo = PerWavelength(wavelengths=nm, values=values)
        elif not text.strip()[:1].isalpha():
            albedo = float(text)
        return replace(planet, ground=replace(planet.ground, albedo=albedo, local=None))
    except (ParameterError, ValueError) as error:
        words = error.allowed if isinstance(error, ParameterError) else allowed
        raise ParameterError(option, text, words) from None


def with_solved_ground(
    planet: Planet,
    ground_albedo: str | None,
    latitude: str | None,
    longitude: str | None,
    altitude: float = 0.0,
) -> Planet:
    """Planet with the surface albedo of the options; unchanged without options.

    Parameters
    ----------
    planet : Planet
        Planet of the command.
    ground_albedo, latitude, longitude : str or None
        Texts of the options of that name: the albedo, or both coordinates, or none.
    altitude : float
        Altitude of the observer. [m]

    Raises
    ------
    ParameterError
        If options contradict each other, one coordinate is missing, or a value is out of range.
    """
    given = {"--latitude": latitude, "--longitude": longitude}
    numbers = {o.strip("-"): angle(text, o) for o, text in given.items() if text is not None}
    if numbers and ground_albedo is not None:
        option = f"--{next(iter(numbers))}"
        raise ConflictError(option, "cannot be combined with --ground-albedo")
    if ground_albedo is not None:
        return with_ground_albedo(planet, ground_albedo)
    if not numbers:
        return planet
    if len(numbers) == 1:
        option, other = sorted(given, key=lambda one: given[one] is None)
        raise ConflictError(option, f"requires {other}")
    from airlight.scene.local_ground import local_ground

    try:
        return local_ground(planet, **numbers, altitude=altitude)
    except ParameterError as error:
        raise error.named(f"--{error.field}") from None


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
        Numbers with commas between them, or a range; the last one's unit is that of all.
    unit : str
        Unit of the result; of ``UNDERSTOOD`` also that of numbers without one.
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
        Size such as ``1280x720``, or one number: the side of a square, the width of a panorama, the
        side of a face of a cube map. None: a size that suits the projection.
    projection : str
        Name of the projection.

    Returns
    -------
    (int, int)
        Width and height.

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
    """Check the name of a projection.

    Examples
    --------
    >>> projection("fisheye")
    'fisheye'
    """
    from airlight.scene.projections import PROJECTIONS

    if text not in PROJECTIONS:
        raise ParameterError("--projection", text, ", ".join(PROJECTIONS))
    return text


def only_for_png(
    suffix: str,
    exposure: str | None,
    iso: float | None,
    aperture: str | None,
    shutter: str | None,
    tone_map: str,
    encoding: str,
    primaries: str,
    bits: int,
    glare: float,
    shown: bool = False,
) -> None:
    """Refuse options of the display for a linear file or a map of numbers, which have none of them.

    Parameters
    ----------
    suffix : str
        Suffix of the picture.
    exposure, iso, aperture, shutter, tone_map, encoding, primaries, bits, glare :
        Values of the options of that name.
    shown : bool
        Whether ``--show`` is given: colours stand for numbers.

    Raises
    ------
    ParameterError
        If the file is linear, or shows numbers, and an option is not as it is if left out.
    """
    from airlight.exports.picture import LINEAR

    if suffix not in LINEAR and not shown:
        return
    phrase = f"does not apply to {suffix} files, which hold linear radiance"
    phrase = "cannot be combined with --show, whose colours are a scale" if shown else phrase
    given = {
        "--exposure": (exposure, None), "--iso": (iso, None), "--aperture": (aperture, None),
        "--shutter": (shutter, None), "--tone-map": (tone_map, "natural"),
        "--encoding": (encoding, "srgb"), "--primaries": (primaries, "srgb"), "--bits": (bits, 8),
        "--glare": (glare, 1.0),
    }  # fmt: skip
    for option, (value, left_out) in given.items():
        if value != left_out:
            raise ConflictError(option, phrase)


def camera(
    exposure_text: str | None, iso: float | None, aperture: str | None, shutter: str | None
) -> float | Literal["auto"]:
    """Exposure by ``--exposure``, or by a camera's three numbers; ``auto`` without any. [EV]

    Examples
    --------
    >>> f"{camera(None, 100.0, 'f/16', '1/100s'):.2f}"
    '-5.49'
    """
    numbers = {"--iso": iso, "--aperture": aperture, "--shutter": shutter}
    given = [name for name, value in numbers.items() if value is not None]
    if not given:
        return exposure("auto" if exposure_text is None else exposure_text)
    if exposure_text is not None:
        raise ConflictError("--exposure", f"cannot be combined with {given[0]}")
    if iso is None or aperture is None or shutter is None:
        missing = " and ".join(name for name in numbers if name not in given)
        raise ConflictError(given[0], f"requires {missing}")
    from airlight.color.exposure import camera_exposure

    stop = quantity(aperture.strip().lower().removeprefix("f/"), "1", "--aperture")
    over, _, under = shutter.strip().rpartition("/")
    seconds = quantity(under, "s", "--shutter", bare=True)
    open_for = quantity(over, "1", "--shutter") / seconds if over and seconds > 0.0 else seconds
    for name, value in (("--iso", iso), ("--aperture", stop), ("--shutter", open_for)):
        if not 0.0 < value < 1e9:
            raise ParameterError(name, value, "above 0, below 1e9")
    return camera_exposure(iso, stop, open_for)


def exposure(text: str) -> float | Literal["auto"]:
    """Parse an exposure: ``auto`` or a power of two. [EV]

    Examples
    --------
    >>> exposure("-2.5")
    -2.5
    """
    if text.strip().lower() == "auto":
        return "auto"
    value = quantity(text.strip().removesuffix("EV"), "1", "--exposure")
    if not -100.0 <= value <= 100.0:
        raise ParameterError("--exposure", text, "auto, or -100 to 100 EV")
    return value


def wavelengths(text: str, planet: Planet) -> tuple[float, ...]:
    """Parse the wavelengths to compute.

    Parameters
    ----------
    text : str
        ``rgb``: 680, 550 and 440 nm. A whole number below 100: that many, over the visible part of
        the range where the planet's constituents are known. Otherwise wavelengths, such as
        ``680,550,440``, ``"0.55 um"`` or ``400:900:10``.
    planet : Planet
        Planet that gives the limits.

    Returns
    -------
    tuple of float
        Wavelengths in the order given. [nm]

    Raises
    ------
    ParameterError
        If the text is none of these, or repeats a wavelength.
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
