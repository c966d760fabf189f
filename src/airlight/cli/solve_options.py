"""Options of the solver and of parallel execution: wavelengths, accuracy, device, processes."""

from __future__ import annotations

from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Final, Literal

import typer

from airlight.cli import options
from airlight.cli.console import note
from airlight.cli.option_groups import OptionGroup, named_errors, option
from airlight.errors import ParameterError

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

#: Introduction of the help of ``--wavelengths``, common to all commands.
_WAVELENGTHS: Final = (
    "Wavelengths: rgb (680, 550, 440 nm), a number over the visible, a list or a range in nm."
)
Quality = Annotated[Literal["preview", "default", "fine"], typer.Option(help="Solver accuracy.")]
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
Exact = Annotated[
    bool,
    typer.Option(
        "--exact",
        help="Ray-march every pixel, instead of interpolating tables, which are accurate to a few "
        "parts in 10000.",
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


def wavelengths_option(words: str = "", default: str | None = None) -> Any:
    """Option ``--wavelengths`` whose help ends with words about the default."""
    ending = f" Default: {words}." if words else ""
    return option(_WAVELENGTHS + ending, "rgb|N|LIST|FROM:TO:STEP", default)


@dataclass(frozen=True, kw_only=True)
class AccuracyOptions(OptionGroup):
    """Options of the wavelengths and the accuracy of pictures."""

    wavelengths: str | None = wavelengths_option("16; on a GPU the four with the best colours")
    quality: Quality = "default"

    def nm(self, planet: Planet) -> tuple[float, ...] | None:
        """Wavelengths of the option; None without it. [nm]"""
        return None if self.wavelengths is None else options.wavelengths(self.wavelengths, planet)

    def picture_nm(self, planet: Planet) -> tuple[float, ...] | None:
        """Wavelengths of the option, at least three; None without it. [nm]"""
        from airlight.render.render_scene import FEWEST

        nm = self.nm(planet)
        if nm is not None and len(nm) < FEWEST:
            allowed = "rgb, 3 to 99, or three or more wavelengths: a picture has colours"
            raise ParameterError("--wavelengths", self.wavelengths, allowed)
        return nm


@dataclass(frozen=True, kw_only=True)
class SolveOptions(AccuracyOptions):
    """Options of a solution."""

    no_polarisation: NoPolarisation = False
    no_cache: NoCache = False

    def keywords(self) -> dict[str, Any]:
        """Keyword arguments of a solver."""
        return {
            "quality": self.quality,
            "polarisation": not self.no_polarisation,
            "cache": not self.no_cache,
        }


@dataclass(frozen=True, kw_only=True)
class BandOptions(SolveOptions):
    """Options of a solution at wavelengths, or of bands around them."""

    bandwidth: float | None = option(
        "Full width of bands around the wavelengths, e.g. 10nm: means, with the lines of gases.",
        "WIDTH",
        read=options.wavelength_width,
    )

    def keywords(self) -> dict[str, Any]:
        """Keyword arguments of a solver."""
        given = {} if self.bandwidth is None else {"bandwidth": self.bandwidth}
        return {**super().keywords(), **given}


@dataclass(frozen=True, kw_only=True)
class RenderOptions(SolveOptions):
    """Options of a solution and of a picture's rendering."""

    device: Device = "cpu"
    exact: Exact = False

    def keywords(self) -> dict[str, Any]:
        """Keyword arguments of a renderer."""
        return {**super().keywords(), "device": self.device, "exact": self.exact, "refused": _say}


def _say(reason: str) -> None:
    note(f"falling back to the CPU: {reason}")


@dataclass(frozen=True, kw_only=True)
class DistributionOptions(OptionGroup):
    """Options of parallel execution."""

    scheduler: str | None = option("Address of a Dask scheduler, tcp://host:8786.", "ADDRESS")
    workers: int | None = option(
        "Number of local processes; 1: this process only (number of CPU cores).", "N"
    )

    def keywords(self) -> dict[str, Any]:
        """Keyword arguments of parallel execution."""
        return {"scheduler": self.scheduler, "workers": self.workers}

    def named(self) -> AbstractContextManager[None]:
        """Context that puts names of options into errors."""
        return named_errors("scheduler", "workers")
