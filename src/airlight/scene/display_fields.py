"""Declarations of the parameters of a display: exposure, tone map, glare, white balance.

Options of commands, the viewer's controls and the table ``[display]`` of films take name, help,
choices, slider and default from here. Limits are those of ``DisplaySettings``, as are defaults.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from airlight.image.display_settings import DisplaySettings
from airlight.image.glare import MOST
from airlight.image.natural import STYLES
from airlight.image.tone_maps import TONE_MAPS
from airlight.image.white_balance import COLDEST, HOTTEST, WHITE_BALANCES
from airlight.planets.schema.field import Field

_PLAIN: Final = DisplaySettings()

EXPOSURE: Final = Field(
    label="exposure",
    help="Exposure compensation, a power of 2.",
    unit="EV",
    range=(-100.0, 100.0),
    slider=(-12.0, 20.0),
    synonyms=(
        "brightness",
        "brighter",
        "darker",
        "stops",
        "ev",
        "light",
        "iso",
        "aperture",
        "shutter",
    ),
)
#: Fields of ``DisplaySettings`` that views and films have, by name, in display order.
DISPLAY_FIELDS: Final[Mapping[str, Field]] = {
    "eye": Field(
        label="eye in the dark", kind="switch", initial=True,
        help="Mesopic vision: below 4 cd/m² colours fade and turn bluish.",
        synonyms=("night vision", "mesopic", "purkinje", "blue night", "colour", "color")),
    "tone_map": Field(
        label="tone map", kind="choice", choices=lambda: tuple(TONE_MAPS), initial=_PLAIN.tone_map,
        help="Tone curve that maps radiance to the display's range.",
        synonyms=("colour", "color", "contrast", "look", "film", "curve", "saturation")),
    "style": Field(
        label="style", kind="choice", choices=lambda: tuple(STYLES), initial=_PLAIN.style,
        help="Contrast of the tone map natural.",
        synonyms=("contrast", "look", "punchy", "soft", "flat", "shadows")),
    "glare": Field(
        label="glare", range=(0.0, MOST), slider=(0.0, 4.0), initial=_PLAIN.glare,
        help="Lens glare around the sun: 1 is a typical lens, 0 none.",
        synonyms=("bloom", "glow", "halo", "lens", "flare", "sun")),
    "white_balance": Field(
        label="white balance", kind="choice", choices=lambda: WHITE_BALANCES,
        help="Light shown white; auto is daylight under a star like the sun, else the star.",
        initial=_PLAIN.white_balance,
        synonyms=("colour", "color", "temperature", "kelvin", "warm", "cool", "tint", "awb")),
    "white_temperature": Field(
        label="white temperature", unit="K", range=(COLDEST, HOTTEST), slider=(2500.0, 10000.0),
        scale="log", help="Colour temperature of the white balance kelvin.",
        initial=_PLAIN.white_temperature,
        synonyms=("white balance", "kelvin", "colour", "color", "warm", "cool")),
}  # fmt: skip
EYE, TONE_MAP, STYLE, GLARE, WHITE_BALANCE, WHITE_TEMPERATURE = DISPLAY_FIELDS.values()
