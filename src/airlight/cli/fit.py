"""``airlight fit``: fit of a planet's parameters to measured radiances or a photograph."""

from __future__ import annotations

import re
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final

import typer

from airlight.cli import options
from airlight.cli.console import examples, note, say, shown_progress
from airlight.cli.option_groups import OptionGroup, named_errors, option
from airlight.cli.planet_options import PlanetOptions, overrides_of
from airlight.cli.solve_options import NoCache, Quality
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from airlight.studies.fit.fit_sky import SkyFit
    from airlight.studies.fit.measurements import Measurements
    from airlight.studies.fit.parameter import Prior
    from airlight.studies.fit.photograph import Shot
    from airlight.studies.fit.settings import FitSettings

EPILOG = examples(
    "airlight fit earth --data radiances.csv -o fitted.toml",
    'airlight fit earth --data radiances.csv --free "aerosol.optical_depth, aerosol.angstrom, '
    'ozone.column, ground.albedo" -o fitted.toml --report fit.html',
    'airlight fit earth --data sky.csv --free "aerosol.optical_depth, scale" '
    '--prior "scale=1±0.05" --bounds "aerosol.optical_depth=0..1" --loss huber -o fitted.toml',
    "airlight fit earth --photo dome.png --sun-zenith 55 --free aerosol.optical_depth "
    "-o fitted.toml",
)

#: Free parameters unless stated: load, colour and phase function of the aerosol, ground, scale.
FREE: Final = (
    "aerosol.optical_depth",
    "aerosol.angstrom",
    "aerosol.phase_function",
    "ground.albedo",
    "scale",
)
_PAIR = re.compile(r"\s*([^=]+?)\s*=\s*([^=]+?)\s*")
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_PRIOR = re.compile(rf"({_NUMBER})\s*(?:±|\+-|\+/-)\s*({_NUMBER})")
_BOUNDS = re.compile(rf"({_NUMBER})\s*\.\.\s*({_NUMBER})")


@dataclass(frozen=True, kw_only=True)
class FitOptions(OptionGroup):
    """Options of the fit."""

    free: str | None = option(
        "Free parameters: NAME.optical_depth, NAME.angstrom, NAME.phase_function, NAME.column, "
        "ground.albedo, or the path of a number of the planet's file; of the instrument scale, "
        "pointing.azimuth, pointing.zenith, and white_balance.red, .blue of a photograph "
        f"({', '.join(FREE)}; photograph: {FREE[0]}).",
        "LIST",
    )
    each_scan: str = option("Instrument parameters fitted per scan.", "LIST", "")
    bounds: str = option("Bounds of parameters, e.g. ground.albedo=0..0.4.", "LIST", "")
    prior: str = option(
        "Prior values with standard deviations, e.g. ozone.column=320±20.", "LIST", ""
    )
    start: str = option("Starting values (those of the planet).", "LIST", "")
    uncertainty: str | None = option(
        "Relative standard deviation of the data, e.g. 3% (that of the file, or estimated from "
        "the residuals).",
        "FRACTION",
    )
    bandwidth: float | None = option(
        "Full width of the instrument's bands, e.g. 3nm (that of the file): the model is averaged "
        "over them, with the lines of gases.",
        "WIDTH",
        read=options.wavelength_width,
    )
    loss: str = option("Loss function of the residuals.", "{studies.fit.loss:LOSSES}", "linear")
    quality: Quality = "default"
    no_cache: NoCache = False

    def settings(self, planet: PlanetOptions, *, photograph: bool) -> FitSettings:
        """Settings of the fit."""
        from airlight.physics.units import quantity
        from airlight.studies.fit.loss import LOSSES
        from airlight.studies.fit.settings import FitSettings

        if self.loss not in LOSSES:
            raise ParameterError("--loss", self.loss, ", ".join(LOSSES))
        names = _listed(self.free or "")
        if self.free is None:
            names = list(FREE[:1] if photograph else FREE)
        if not names:
            allowed = "a list such as aerosol.optical_depth, ground.albedo"
            raise ParameterError("--free", self.free, allowed)
        share = None
        if self.uncertainty is not None:
            share = quantity(self.uncertainty, "1", "--uncertainty")
            if not 0.0 < share < 10.0:
                allowed = "a fraction such as 3% or 0.03"
                raise ParameterError("--uncertainty", self.uncertainty, allowed)
        return FitSettings(
            free=names,
            per_scan=_listed(self.each_scan),
            bounds={name: _bound(name, text) for name, text in _pairs(self.bounds, "--bounds")},
            priors={name: _prior(name, text) for name, text in _pairs(self.prior, "--prior")},
            starts={
                name: quantity(text, "1", f"--start {name}")
                for name, text in _pairs(self.start, "--start")
            },
            uncertainty=share,
            loss=self.loss,
            quality=self.quality,
            overrides=overrides_of(planet.overrides),
            keep=not self.no_cache,
        )


@dataclass(frozen=True, kw_only=True)
class PhotographOptions(OptionGroup):
    """Options of a photograph: camera, sun and encoding."""

    photo: Path | None = option("Photograph, instead of --data: PNG, JPEG, or linear EXR.", "FILE")
    exclude_sun: float | None = option(
        "Exclude directions closer to the sun (photograph: 15deg).", "ANGLE"
    )
    sun_zenith: float | None = option("Photograph: sun zenith angle.", "ANGLE")
    altitude: float = option("Photograph: altitude of the camera.", "LENGTH", "0m")
    projection: str = option(
        "Photograph: projection: {scene.projections:PROJECTIONS}.", "NAME", "fisheye"
    )
    fov: float | None = option("Photograph: field of view.", "ANGLE")
    look: tuple[float, float] | None = option(
        "Photograph: camera direction; azimuth from the sun.", "ZENITH,AZIMUTH"
    )
    roll: float = option("Photograph: camera roll.", "ANGLE", "0deg")
    encoding: str = option(
        "Photograph: encoding, unless EXR.", "{image.encoding:ENCODINGS}|linear", "srgb"
    )
    tone_map: str | None = option("Photograph: tone map to invert.", "NAME")
    above: float = option("Photograph: lowest elevation angle used.", "ANGLE", "5")

    def shot(self) -> Shot:
        """Camera, sun and encoding of the photograph."""
        from airlight.scene.limits import within
        from airlight.studies.fit.photograph import Shot

        if self.sun_zenith is None:
            raise ConflictError("--photo", "requires --sun-zenith, such as 55deg")
        look = (None, 0.0) if self.look is None else self.look
        return Shot(
            projection=options.projection(self.projection),
            field_of_view=self.fov,
            look_zenith=look[0],
            look_azimuth=look[1],
            roll=self.roll,
            sun_zenith=within("--sun-zenith", self.sun_zenith, 0.0, 180.0, "deg"),
            altitude=self.altitude,
            encoding=self.encoding,
            tone_map=self.tone_map,
            above=self.above,
            exclude_sun=15.0 if self.exclude_sun is None else self.exclude_sun,
        )


def fit(
    planet: PlanetOptions,
    settings: FitOptions,
    photograph: PhotographOptions,
    output: Annotated[
        Path, options.output_option("FILE", "Output planet file with the fitted values.")
    ],
    data: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Measured radiances: a CSV, or scans of a day as .npz."),
    ] = None,
    report: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Report: .html, or .md with a folder of pictures."),
    ] = None,
    overwrite: options.Overwrite = False,
) -> None:
    """Fit parameters of a planet to measured radiances, or to a photograph of its sky.

    An interrupted fit resumes when it is started again.
    """
    from airlight.files.atomic_file import atomic_file, check_target

    check_target(output)
    if output.suffix.lower() != ".toml":
        raise ParameterError("--output", str(output), "a planet file that ends in .toml")
    if report is not None:
        _check_report(report, overwrite)
    if (data is None) == (photograph.photo is None):
        conflict = "or --photo is required" if data is None else "cannot be combined with --photo"
        raise ConflictError("--data", conflict)
    chosen = settings.settings(planet, photograph=data is None)
    import numpy as np

    from airlight.studies.fit.fit_sky import fit_radiances

    with shown_progress() as progress, _named_errors():
        if data is None:
            if settings.bandwidth is not None:
                raise ConflictError("--bandwidth", "requires --data")
            sky = _photograph(planet.planet, photograph, chosen, progress)
        else:
            measured = _measurements(data)
            if photograph.exclude_sun is not None:
                measured = measured.where(measured.angle_from_sun >= photograph.exclude_sun)
            if settings.bandwidth is not None:
                widths = np.full(measured.radiance.size, settings.bandwidth)
                measured = replace(measured, bandwidth=widths)
            sky = fit_radiances(planet.planet, measured, chosen, progress=progress)
    from airlight.studies.fit.report import fitted_file, residual_line, result_lines, warnings_of

    with atomic_file(output) as part:
        part.write_text(fitted_file(sky), encoding="utf-8")
    for line in result_lines(sky):
        say(line)
    say(residual_line(sky))
    say(f"{output}  {sky.solves} solutions and {sky.rough_solves} coarse ones, {sky.seconds:.1f} s")
    for line in warnings_of(sky):
        note(line)
    if report is not None:
        _write_report(sky, report, overwrite)
        say(f"{report}  {report.stat().st_size / 1e3:.0f} kB")


def _named_errors() -> AbstractContextManager[None]:
    """Context that puts names of options into errors."""
    names = ("free", "bounds", "prior", "start", "bandwidth", "loss", "encoding", "tone_map")
    return named_errors(*names, per_scan="--each-scan", override="--set")


def _measurements(file: Path) -> Measurements:
    if file.suffix.lower() == ".npz":
        from airlight.studies.fit.scans import read_scan_file

        return read_scan_file(file).measurements(str(file))
    from airlight.studies.fit.radiance_file import read_radiance_file

    return read_radiance_file(file)


def _photograph(
    planet: str, photograph: PhotographOptions, settings: FitSettings, progress: Any
) -> SkyFit:
    from airlight.studies.fit.fit_sky import fit_photograph
    from airlight.studies.fit.photograph import read_photograph

    shot = photograph.shot()
    assert photograph.photo is not None
    return fit_photograph(
        planet, read_photograph(photograph.photo, shot), settings, progress=progress
    )


def _listed(text: str) -> list[str]:
    return [one.strip() for one in text.split(",") if one.strip()]


def _pairs(text: str, option: str) -> list[tuple[str, str]]:
    found = []
    for one in _listed(text):
        match = _PAIR.fullmatch(one)
        if match is None:
            raise ParameterError(option, one, "NAME=VALUE, several with commas between")
        found.append((match[1], match[2]))
    return found


def _bound(name: str, text: str) -> tuple[float, float]:
    match = _BOUNDS.fullmatch(text)
    if match is None:
        raise ParameterError(f"--bounds {name}", text, "LOW..HIGH, such as 0..0.4")
    return float(match[1]), float(match[2])


def _prior(name: str, text: str) -> Prior:
    from airlight.studies.fit.parameter import Prior

    match = _PRIOR.fullmatch(text)
    if match is None or not float(match[2]) > 0.0:
        raise ParameterError(f"--prior {name}", text, "MEAN±SIGMA, such as 320±20 or 320+-20")
    return Prior(mean=float(match[1]), sigma=float(match[2]))


def _check_report(report: Path, overwrite: bool) -> None:
    from airlight.files.atomic_file import check_target
    from airlight.studies.plots.figure import require_matplotlib
    from airlight.studies.reports.report_pictures import check_pictures

    check_target(report)
    if report.suffix.lower() not in (".html", ".htm", ".md"):
        raise ParameterError("--report", str(report), "a file that ends in .html or .md")
    if report.suffix.lower() == ".md":
        check_pictures(_pictures(report), overwrite=overwrite)
    require_matplotlib()


def _pictures(report: Path) -> Path:
    """Folder of the pictures of a report in Markdown."""
    return report.parent / f"{report.stem}-pictures"


def _write_report(sky: SkyFit, report: Path, overwrite: bool) -> None:
    from airlight.files.atomic_file import atomic_file
    from airlight.studies.fit.report import html, markdown, parts_of
    from airlight.studies.reports.markdown import files_of
    from airlight.studies.reports.report_pictures import write_pictures

    if report.suffix.lower() != ".md":
        with atomic_file(report) as part:
            part.write_text(html(sky), encoding="utf-8")
        return
    parts = parts_of(sky)
    folder = _pictures(report)
    write_pictures(folder, files_of(parts), overwrite=overwrite)
    with atomic_file(report) as part:
        part.write_text(markdown(sky, parts, folder.name), encoding="utf-8")
