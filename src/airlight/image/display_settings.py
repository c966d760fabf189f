"""Settings of a display, from names and numbers to the uniforms of ``displayed``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, Final

from airlight.errors import ParameterError
from airlight.image.displayed import Display
from airlight.image.encoding import ENCODINGS, encoding_named
from airlight.image.exposure import exposure_factor
from airlight.image.gamut import primaries_number
from airlight.image.glare import checked_amount
from airlight.image.tone_maps import TONE_MAPS, style_number, tone_map_named
from airlight.image.white_balance import (
    DAYLIGHT,
    WHITE_BALANCES,
    White,
    check_temperature,
    white_gains,
    white_temperature,
)

#: Default tone map of pictures.
DEFAULT_TONE_MAP: Final = "natural"
#: Bits per channel of a picture.
BITS: Final = (8, 16)
#: Chromaticity of a light that is not known.
UNKNOWN: Final = (0.0, 0.0)
#: Name of no encoding in metadata.
LINEAR: Final = "linear"
#: Texts of ``eye`` in metadata.
_EYE: Final = {True: "adapted", False: "by day"}


@dataclass(frozen=True, kw_only=True)
class DisplaySettings:
    """Display settings of a picture, all but its exposure; varied with ``dataclasses.replace``.

    Attributes
    ----------
    tone_map : str
        Tone map, one of ``TONE_MAPS``.
    style : str
        Contrast of the tone map ``natural``, one of ``STYLES``: ``"neutral"``, ``"punchy"`` or
        ``"soft"``.
    eye : bool, optional
        Whether to simulate mesopic vision below 4 cd m⁻², see ``mesopic``; default: with automatic
        exposure.
    encoding : str or None
        Encoding, ``"srgb"`` or ``"gamma"``; None for a target with its own encoding.
    primaries : str
        Primaries of the display, one of ``PRIMARIES``.
    bits : int
        Bits per channel, 8 or 16.
    dither : bool
        Whether to add reproducible dither of one quantisation step.
    glare : float
        Amount of glare, 0 to 10: 1 is that of a lens. [1]
    white_balance : str or float
        Light that is shown white, one of ``WHITE_BALANCES`` or its temperature, 5200 or
        ``"5200 K"``; ``auto`` is daylight of 5500 K under a star like the sun, the display's white
        in its dusk, a warm white in a night without moon, and the star's own light under others.
    white_temperature : float
        Temperature for the white balance ``"kelvin"``; a number as ``white_balance`` sets both. [K]

    Raises
    ------
    ParameterError
        If a setting is not allowed.

    Examples
    --------
    >>> replace(DisplaySettings(glare=0.0), tone_map="agx").metadata()["tone_map"]
    'agx'
    """

    tone_map: str = DEFAULT_TONE_MAP
    style: str = "neutral"
    eye: bool | None = None
    encoding: str | None = "srgb"
    primaries: str = "srgb"
    bits: int = 8
    dither: bool = True
    glare: float = 1.0
    white_balance: str | float = "auto"
    white_temperature: float = DAYLIGHT

    def __post_init__(self) -> None:
        if self.white_balance not in WHITE_BALANCES:
            kelvin = white_temperature(self.white_balance)
            object.__setattr__(self, "white_temperature", kelvin)
            object.__setattr__(self, "white_balance", "kelvin")
        check_temperature(self.white_temperature)
        tone_map_named(self.tone_map)
        style_number(self.style)
        if self.encoding is not None:
            encoding_named(self.encoding)
        primaries_number(self.primaries)
        if self.bits not in BITS:
            raise ParameterError("bits", self.bits, "8 or 16")
        checked_amount(self.glare)

    @property
    def white_level(self) -> float:
        """Pixel value of white. [1]"""
        return 2.0**self.bits - 1.0

    def adapted(self, exposure: float | str) -> DisplaySettings:
        """Settings with mesopic vision decided: by default with the exposure ``"auto"``."""
        return self if self.eye is not None else replace(self, eye=exposure == "auto")

    def display(
        self, exposure: float, star: White | None = None, scene: White | None = None
    ) -> Display:
        """Parameters of ``displayed``.

        Parameters
        ----------
        exposure : float
            Exposure. [EV]
        star : (float, float), optional
            Chromaticity of the star, see ``star_white``.
        scene : (float, float), optional
            Chromaticity of the scene's mean light, see ``scene_white``.

        Raises
        ------
        ParameterError
            If the exposure is not allowed.
        """
        which = WHITE_BALANCES.index(str(self.white_balance))
        light, mean = star or UNKNOWN, scene or UNKNOWN
        factor = exposure_factor(exposure)
        long, medium, short = white_gains(which, self.white_temperature, *light, *mean, factor)
        return Display(
            exposure=factor,
            eye=bool(self.eye),
            tone_map=list(TONE_MAPS).index(self.tone_map),
            style=style_number(self.style),
            primaries=primaries_number(self.primaries),
            encoding=-1 if self.encoding is None else list(ENCODINGS).index(self.encoding),
            dither=1.0 / self.white_level if self.dither else 0.0,
            gain_long=long,
            gain_medium=medium,
            gain_short=short,
        )

    def metadata(self) -> dict[str, str]:
        """Metadata of a picture with these settings: the inverse of ``from_metadata``."""
        kelvin = self.white_balance == "kelvin"
        return {
            "eye": _EYE[bool(self.eye)],
            "tone_map": self.tone_map,
            "style": self.style,
            "encoding": self.encoding or LINEAR,
            "primaries": self.primaries,
            "glare": f"{self.glare:g}",
            "white_balance": f"{self.white_temperature:g} K" if kelvin else str(self.white_balance),
        }

    @classmethod
    def from_metadata(cls, texts: Mapping[str, str]) -> DisplaySettings:
        """Settings that the metadata of a picture tells; defaults for what it does not tell.

        Pictures without a style are older than styles, which began with ``soft``.

        Examples
        --------
        >>> shown = DisplaySettings(eye=True, tone_map="hable", white_balance=5200.0)
        >>> DisplaySettings.from_metadata(shown.metadata()) == shown
        True
        """
        found: dict[str, Any] = {
            one.name: texts[one.name] for one in fields(cls) if one.name in texts
        }
        found.setdefault("style", "soft")
        if found.get("encoding") == LINEAR:
            found["encoding"] = None
        if "eye" in found:
            found["eye"] = found["eye"] == _EYE[True]
        for one in fields(cls):
            if one.name in found and isinstance(one.default, float):
                found[one.name] = float(found[one.name])
        return cls(**found)


def display_settings(settings: DisplaySettings | None = None, **changes: Any) -> DisplaySettings:
    """Settings with changes of single fields; None leaves a field as it is.

    Parameters
    ----------
    settings : DisplaySettings, optional
        Settings to vary; default: those of ``DisplaySettings()``.
    **changes :
        Fields of ``DisplaySettings``.
    """
    given = {name: value for name, value in changes.items() if value is not None}
    return replace(settings or DisplaySettings(), **given)
