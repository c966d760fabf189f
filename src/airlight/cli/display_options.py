"""Options of the display of a picture: exposure, tone map, encoding, glare."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Final, Literal

from airlight.cli import options
from airlight.cli.option_groups import (
    OptionGroup,
    given_options,
    given_values,
    named_errors,
    option,
)
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from airlight.image.display_settings import DisplaySettings

#: Options of the exposure; the last three are a camera's.
_EXPOSURE: Final = ("exposure", "iso", "aperture", "shutter")


@dataclass(frozen=True, kw_only=True)
class ToneOptions(OptionGroup):
    """Options of exposure, tone map and glare."""

    exposure: float | str | None = option(
        "{scene.display_fields:EXPOSURE}; default auto, like an adapted eye.",
        "EV|auto",
        read=options.exposure,
    )
    iso: float | None = option(
        "Camera sensitivity, e.g. 100; requires --aperture and --shutter.", "ISO"
    )
    aperture: float | None = option("Camera aperture, e.g. f/8.", "F", read=options.f_number)
    shutter: float | None = option(
        "Camera shutter time, e.g. 1/250s.", "TIME", read=options.shutter_time
    )
    tone_map: str | None = option("{scene.display_fields:TONE_MAP}.", "NAME")
    style: str | None = option("{scene.display_fields:STYLE}.", "NAME")
    glare: float | None = option("{scene.display_fields:GLARE}; at most 10.", "NUMBER")
    white_balance: str | None = option(
        "{scene.display_fields:WHITE_BALANCE}; scene is the mean of the picture, d65 the display's "
        "white.",
        "auto|daylight|star|scene|d65|KELVIN",
    )

    @property
    def ev(self) -> Any:
        """Exposure by ``--exposure`` or by camera settings; default ``auto``. [EV]

        Examples
        --------
        >>> f"{ToneOptions(iso=100.0, aperture='f/16', shutter='1/100s').ev:.2f}"
        '-5.49'
        """
        camera = _EXPOSURE[1:]
        given = list(given_options(self, *camera))
        if not given:
            return "auto" if self.exposure is None else self.exposure
        if self.exposure is not None:
            raise ConflictError("--exposure", f"cannot be combined with {given[0]}")
        if self.iso is None or self.aperture is None or self.shutter is None:
            missing = [f"--{name}" for name in camera if f"--{name}" not in given]
            raise ConflictError(given[0], f"requires {' and '.join(missing)}")
        from airlight.image.camera_exposure import camera_exposure

        for name in camera:
            if not 0.0 < getattr(self, name) < 1e9:
                raise ParameterError(f"--{name}", getattr(self, name), "above 0, below 1e9")
        return camera_exposure(self.iso, self.aperture, self.shutter)

    def settings(self) -> DisplaySettings:
        """Display settings, of the options named as their fields."""
        from airlight.image.display_settings import DisplaySettings

        names = {one.name for one in fields(DisplaySettings)} & set(vars(self))
        with named_errors(*names):
            return DisplaySettings(**given_values(self, *names))

    def given_settings(self) -> dict[str, Any]:
        """Display settings that differ from their defaults, by name."""
        from airlight.image.display_settings import DisplaySettings

        plain = vars(DisplaySettings())
        return {name: one for name, one in vars(self.settings()).items() if one != plain[name]}


@dataclass(frozen=True, kw_only=True)
class DisplayOptions(ToneOptions):
    """Options of the display of a picture."""

    encoding: Literal["srgb", "gamma"] = option("Transfer function of the picture.", default="srgb")
    primaries: Literal["srgb", "display-p3"] = option("Primaries of the picture.", default="srgb")
    bits: int = option("Bits per channel of a PNG.", "8|16", 8)

    def check(self, suffix: str, shown: bool = False) -> None:
        """Refuse values out of range, and a display of linear files or maps of numbers.

        Parameters
        ----------
        suffix : str
            Suffix of the picture.
        shown : bool
            Whether the picture has false colours.
        """
        from airlight.render.picture import LINEAR

        phrase = f"does not apply to {suffix} files, which hold linear radiance"
        if shown:
            phrase = "cannot be combined with --show, whose colours are a scale"
        for given in given_options(self, *_NAMES) if shown or suffix in LINEAR else ():
            raise ConflictError(given, phrase)
        self.keywords()

    def keywords(self) -> dict[str, Any]:
        """Exposure and display settings as keyword arguments of ``write_picture``."""
        return {"exposure": self.ev, "settings": self.settings()}


#: Fields of the options of a display.
_NAMES: Final = tuple(one.name for one in fields(DisplayOptions))
