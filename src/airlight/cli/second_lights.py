"""Options of secondary lights: ``--moon``, ``--second-star``, ``--stars``."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Annotated

import typer

from airlight.cli import options
from airlight.errors import ParameterError

if TYPE_CHECKING:
    from airlight.cli.time_and_place import Placed
    from airlight.scene.light_position import LightPosition

Moon = Annotated[
    str | None,
    typer.Option(
        metavar="none|Z,AZ[,PHASE]",
        help="Moon as a second light: zenith angle, azimuth from the sun and phase angle (0 full, "
        "90 half); none to exclude it. Default: by --at and --time.",
    ),
]
SecondStar = Annotated[
    str | None,
    typer.Option(
        metavar="Z,AZ,KELVIN[,RADIUS]",
        help="Second star: zenith angle, azimuth from the first, temperature, and angular radius "
        "(0.27deg), e.g. 80,12,3500K.",
    ),
]

Stars = Annotated[
    bool,
    typer.Option(
        "--stars",
        help="Stars to magnitude 6.5, by --at and --time or by the position of the sun; invisible "
        "by day.",
    ),
]

#: Default angular radius of a second star. [deg]
_RADIUS = 0.27


def given(moon: str | None, second_star: str | None, placed: Placed) -> tuple[LightPosition, ...]:
    """Secondary lights, from the texts of the options, or from place and time.

    Parameters
    ----------
    moon, second_star : str or None
        Texts of ``--moon`` and ``--second-star``.
    placed : Placed
        Observer and sun, with the Moon where a time is given.

    Raises
    ------
    ParameterError
        If a text cannot be read, or a value is out of range.

    Examples
    --------
    >>> from airlight.cli.time_and_place import by_angles
    >>> [one.phase for one in given("40,90,30", None, by_angles(*5 * (None,)))]
    [30.0]
    """
    from airlight.scene.moon_light import MoonLight
    from airlight.scene.star_light import StarLight

    lights: list[LightPosition] = []
    if moon is None and placed.moon is not None:
        lights.append(MoonLight.seen(placed.moon, placed.sun_azimuth))
    elif moon is not None and moon.strip().lower() != "none":
        parts = moon.split(",")
        if not 2 <= len(parts) <= 3:
            raise ParameterError("--moon", moon, "none, or zenith,azimuth,phase such as 60,40,30")
        angles = [options.angle(part, "--moon") for part in parts]
        with _named("--moon"):
            lights.append(MoonLight(zenith=angles[0], azimuth=angles[1], phase=sum(angles[2:])))
    if second_star is not None:
        parts = second_star.split(",")
        if not 3 <= len(parts) <= 4:
            allowed = "zenith,azimuth,temperature,radius such as 80,12,3500K,0.3deg"
            raise ParameterError("--second-star", second_star, allowed)
        zenith, azimuth = (options.angle(part, "--second-star") for part in parts[:2])
        kelvin = options.temperature(parts[2], "--second-star")
        radius = options.angle(parts[3], "--second-star") if len(parts) > 3 else _RADIUS
        with _named("--second-star"):
            star = StarLight.black_body(kelvin, radius)
            lights.append(StarLight(zenith=zenith, azimuth=azimuth, star=star))
    return tuple(lights)


@contextmanager
def _named(option: str) -> Iterator[None]:
    """Errors with the option, and the field in the allowed values."""
    try:
        yield
    except ParameterError as error:
        field = error.field.rpartition(".")[2].replace("_", " ")
        raise ParameterError(option, error.value, f"{field} {error.allowed}") from None
