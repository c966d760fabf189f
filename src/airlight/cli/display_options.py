"""Options of the display of a picture: exposure, tone map, encoding, glare."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Annotated, Any, Literal

import typer

from airlight.cli import options
from airlight.cli.option_groups import given_options
from airlight.errors import ConflictError, ParameterError
from airlight.physics.units import quantity


@dataclass(frozen=True, kw_only=True)
class ToneOptions:
    """Options of exposure, tone map and glare."""

    exposure: Annotated[
        str | None,
        typer.Option(
            metavar="EV|auto",
            help="Exposure compensation, a power of 2; default auto, like an adapted eye.",
        ),
    ] = None
    iso: Annotated[
        float | None,
        typer.Option(
            metavar="ISO", help="Camera sensitivity, e.g. 100; requires --aperture and --shutter."
        ),
    ] = None
    aperture: Annotated[
        str | None, typer.Option(metavar="F", help="Camera aperture, e.g. f/8.")
    ] = None
    shutter: Annotated[
        str | None, typer.Option(metavar="TIME", help="Camera shutter time, e.g. 1/250s.")
    ] = None
    tone_map: Annotated[
        str, typer.Option(metavar="NAME", help="Tone map: {image.tone_maps:TONE_MAPS}.")
    ] = "natural"
    glare: Annotated[
        float,
        typer.Option(
            metavar="NUMBER",
            help="Lens glare around the sun: 1 is a typical lens, 0 none, at most 10.",
        ),
    ] = 1.0

    @property
    def ev(self) -> Any:
        """Exposure by ``--exposure`` or by camera settings; default ``auto``. [EV]

        Examples
        --------
        >>> f"{ToneOptions(iso=100.0, aperture='f/16', shutter='1/100s').ev:.2f}"
        '-5.49'
        """
        camera = ("iso", "aperture", "shutter")
        given = list(given_options(self, *camera))
        if not given:
            return self._compensation("auto" if self.exposure is None else self.exposure)
        if self.exposure is not None:
            raise ConflictError("--exposure", f"cannot be combined with {given[0]}")
        if self.iso is None or self.aperture is None or self.shutter is None:
            missing = [f"--{name}" for name in camera if f"--{name}" not in given]
            raise ConflictError(given[0], f"requires {' and '.join(missing)}")
        from airlight.image.exposure import camera_exposure

        stop = quantity(self.aperture.strip().lower().removeprefix("f/"), "1", "--aperture")
        over, _, under = self.shutter.strip().rpartition("/")
        seconds = quantity(under, "s", "--shutter", bare=True)
        open_for = quantity(over, "1", "--shutter") / seconds if over and seconds > 0 else seconds
        for name, value in (("--iso", self.iso), ("--aperture", stop), ("--shutter", open_for)):
            if not 0.0 < value < 1e9:
                raise ParameterError(name, value, "above 0, below 1e9")
        return camera_exposure(self.iso, stop, open_for)

    def _compensation(self, text: str) -> Any:
        return options.exposure(text)


@dataclass(frozen=True, kw_only=True)
class DisplayOptions(ToneOptions):
    """Options of the display of a picture."""

    encoding: Annotated[
        Literal["srgb", "gamma"], typer.Option(help="Transfer function of the picture.")
    ] = "srgb"
    primaries: Annotated[
        Literal["srgb", "display-p3"], typer.Option(help="Primaries of the picture.")
    ] = "srgb"
    bits: Annotated[int, typer.Option(metavar="8|16", help="Bits per channel of a PNG.")] = 8

    def check(self, suffix: str, shown: bool = False) -> None:
        """Refuse values out of range, and a display of linear files or maps of numbers.

        Parameters
        ----------
        suffix : str
            Suffix of the picture.
        shown : bool
            Whether the picture has false colours.
        """
        from airlight.image.glare import checked_amount
        from airlight.image.tone_maps import TONE_MAPS
        from airlight.render.picture import LINEAR

        phrase = "cannot be combined with --show, whose colours are a scale" if shown else (
            f"does not apply to {suffix} files, which hold linear radiance")  # fmt: skip
        names = [one.name for one in fields(DisplayOptions)]
        for option in given_options(self, *names) if shown or suffix in LINEAR else ():
            raise ConflictError(option, phrase)
        if self.bits not in (8, 16):
            raise ParameterError("--bits", self.bits, "8 or 16")
        _ = self.ev
        if self.tone_map not in TONE_MAPS:
            raise ParameterError("--tone-map", self.tone_map, ", ".join(TONE_MAPS))
        checked_amount(self.glare, "--glare")

    def finish(self) -> dict[str, Any]:
        """Display settings without exposure, as keyword arguments of ``write_picture``."""
        names = ("tone_map", "encoding", "primaries", "bits", "glare")
        return {name: getattr(self, name) for name in names}

    def keywords(self) -> dict[str, Any]:
        """Display settings as keyword arguments of ``write_picture``."""
        return {"exposure": self.ev, **self.finish()}
