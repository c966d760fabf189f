"""Report of a fit, as HTML or Markdown, and planet file with the fitted values."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import Any, Final

import numpy as np

from airlight.planets.reading.planet_file import planet_file
from airlight.studies.fit.fit_sky import SkyFit
from airlight.studies.fit.measurements import Measurements
from airlight.studies.fit.parameter import FitParameter
from airlight.studies.fit.pictures import pictures_of
from airlight.studies.fit.residuals import (
    SUN_EDGES,
    ZENITH_EDGES,
    Binned,
    Residuals,
    binned,
    residuals_of,
)
from airlight.studies.reports.html import page_html, part_html
from airlight.studies.reports.markdown import escaped, part_lines
from airlight.studies.reports.parts import Part, ReportPicture, ReportTable, Text, cells

#: Correlation above which two parameters are reported as poorly separable. [1]
_CLOSE: Final = 0.95
#: Sum of squares over degrees of freedom above which the model does not fit the data. [1]
_POOR: Final = 2.0
#: Deviation of a ratio of error bars, in standard deviations, above which scans differ by more than
#: noise. [1]
_WIDER: Final = 3.0


def number(value: float, error: float) -> str:
    """Value rounded to the digits allowed by its error bar.

    Examples
    --------
    >>> number(0.123456, 0.0023), number(345.6, 12.0), number(0.5, 0.0)
    ('0.1235', '346', '0.5')
    """
    if not error > 0.0:
        return f"{value:.4g}"
    digits = 1 - int(np.floor(np.log10(error)))
    return f"{value:.{min(max(digits, 0), 12)}f}"


def result_lines(sky: SkyFit) -> list[str]:
    """One line per parameter: name, value, error bar, unit, and remarks."""
    found = sky.fitted
    lines = []
    for k, one in enumerate(found.parameters):
        error = float(found.errors.standard[k])
        text = f"{one.name} = {number(float(found.values[k]), error)}"
        text += f" ± {error:.2g}{one.unit_text}" if error > 0.0 else one.unit_text
        if found.errors.by_scans is not None and found.errors.by_scans[k] > 0.0:
            text += f" (from {_groups(sky)} ± {found.errors.by_scans[k]:.2g})"
        remark = _remark(sky, k)
        lines.append(text + (f"; {remark}" if remark else ""))
    return lines


def warnings_of(sky: SkyFit) -> list[str]:
    """Caveats of the error bars, one sentence each."""
    found, errors = sky.fitted, sky.fitted.errors
    out = [
        f"{one.name} ends at its bound, {_bound_at(sky, k)}: the data ask for more than the model "
        "allows, and the other values depend on it"
        for k, one in enumerate(found.parameters)
        if errors.at_bound[k]
    ]
    if _known(sky) and errors.reduced > _POOR:
        out.append(
            f"the residuals are {np.sqrt(errors.reduced):.2g} times the uncertainties: the model "
            "does not reach the data, and error bars by noise are too small"
        )
    if errors.by_scans is not None:
        free = ~errors.at_bound
        ratio = float((errors.by_scans[free] / errors.standard[free]).max()) if free.any() else 0.0
        # The relative standard error of an error bar from n scans is 1 / √(2 (n - 1)).
        if ratio > 1.0 + _WIDER / np.sqrt(2.0 * (errors.groups - 1)):
            out.append(
                f"error bars from {_groups(sky)} are up to {ratio:.2g} times those by noise: use "
                "them, since the residuals are systematic"
            )
    names = [one.name for one in found.parameters]
    for i in range(len(names)):
        for j in range(i):
            if abs(errors.correlation[i, j]) > _CLOSE:
                out.append(
                    f"{names[j]} and {names[i]} are hard to tell apart: correlation "
                    f"{errors.correlation[i, j]:+.3f}"
                )
    return out


def _groups(sky: SkyFit) -> str:
    return "scan to scan" if isinstance(sky.data, Measurements) else "part to part"


def _known(sky: SkyFit) -> bool:
    given = isinstance(sky.data, Measurements) and sky.data.uncertainty is not None
    return given or sky.settings.uncertainty is not None


def _remark(sky: SkyFit, k: int) -> str:
    found = sky.fitted
    one, errors = found.parameters[k], found.errors
    if errors.at_bound[k]:
        return f"at its bound, {_bound_at(sky, k)}"
    if errors.from_data[k] > one.width:
        return "not constrained by the data"
    if one.prior is not None:
        return f"the data alone ± {errors.from_data[k]:.2g}"
    return ""


def _bound_at(sky: SkyFit, k: int) -> str:
    """Nearer bound of a parameter with its unit."""
    one, value = sky.fitted.parameters[k], sky.fitted.values[k]
    return f"{one.low if value - one.low < one.high - value else one.high:g}{one.unit_text}"


def residual_line(sky: SkyFit) -> str:
    """Root mean square residual, and that of each scan by the fit to the others."""
    residuals = residuals_of(sky)
    text = f"residuals {residuals.rms():.4g}"
    if sky.fitted.left_out is not None:
        rest = sky.fitted.left_out - residuals.measured
        one = "scan" if isinstance(sky.data, Measurements) else "part"
        text += f", each {one} by the fit to the others {np.sqrt(np.square(rest).mean()):.4g}"
    return f"{text} {residuals.unit} (root mean square)"


def parts_of(sky: SkyFit, *, pictures: bool = True) -> list[Part]:
    """Tables and pictures of the report.

    Parameters
    ----------
    pictures : bool
        Whether to draw pictures, which requires matplotlib.
    """
    residuals = residuals_of(sky)
    parts: list[Part] = [Text(text=summary(sky)), _parameters(sky)]
    drawn: list[ReportPicture] = pictures_of(sky, residuals) if pictures else []
    return [*parts, *drawn, *_residual_tables(residuals)]


def summary(sky: SkyFit) -> str:
    """Summary in two or three sentences: parameters, data and residuals."""
    found, residuals = sky.fitted, residuals_of(sky)
    data = sky.data
    what = (
        f"{residuals.measured.size} radiances of {len(residuals.scans)} scans at "
        f"{np.unique(residuals.wavelength).size} wavelengths"
        if isinstance(data, Measurements)
        else f"the colours of {data.view_zenith.size} directions of a photograph"
    )
    relative = float(np.sqrt(np.square(residuals.relative).mean()))
    noise = (
        f"χ² is {found.errors.chi_square:.4g} for {found.errors.freedom} degrees of freedom"
        if _known(sky)
        else f"the uncertainty, not given, is estimated from the residuals, "
        f"{100.0 * float(np.median(found.sigma / np.abs(residuals.measured))):.2g} %"
    )
    text = (
        f"{len(found.parameters)} parameters of {sky.name} fitted to {what} ({data.source}). "
        f"The residuals are {relative:.2g} % (root mean square); {noise}. "
        f"{residual_line(sky).capitalize()}. "
        f"The last step with fresh derivatives was {found.last_step.max():.2g} of an "
        f"error bar."
    )
    return "\n\n".join([text, *(one[0].upper() + one[1:] + "." for one in warnings_of(sky))])


def _parameters(sky: SkyFit) -> ReportTable:
    found = sky.fitted
    rows = []
    for k, one in enumerate(found.parameters):
        error, value = float(found.errors.standard[k]), float(found.values[k])
        scans = "" if found.errors.by_scans is None else f"{found.errors.by_scans[k]:.2g}"
        prior = "" if one.prior is None else f"{one.prior.mean:g} ± {one.prior.sigma:g}"
        rows.append(
            (
                one.name,
                *cells(f"{one.unit.removeprefix('1')} | {one.start:.4g} | {number(value, error)}"),
                *cells(f"{error:.2g} | {scans} | {prior} | {_bounds(one)} | {_remark(sky, k)}"),
            )
        )
    return ReportTable(
        title="Parameters",
        columns=cells(
            f"parameter | unit | start | fitted | ± noise | ± {_groups(sky)} | prior | bounds | "
        ),
        rows=rows,
        note="± noise: standard error if the values err independently, by their uncertainties or, "
        "if none are given, by the residuals. The other one: by how the scans, or the parts of a "
        "photograph, differ, with all that the values of one have in common; from five on. "
        "Optical depths and the ground's albedo are at 550 nm.",
    )


def _bounds(one: FitParameter) -> str:
    return f"{one.low:.4g} … {one.high:.4g}"


def _residual_tables(residuals: Residuals) -> list[Part]:
    by = (
        ("wavelength [nm]", binned(residuals, residuals.wavelength)),
        ("angle from the sun [°]", binned(residuals, residuals.from_sun, SUN_EDGES)),
        ("view zenith angle [°]", binned(residuals, residuals.view_zenith, ZENITH_EDGES)),
    )
    return [_rest_table(label, bins) for label, bins in by]


def _rest_table(label: str, bins: Binned) -> ReportTable:
    rows = [
        (f"{x:g}", int(n), f"{bias:+.2f}", f"{spread:.2f}", f"{100 * share:.1f}")
        for x, n, bias, spread, share in zip(
            bins.middle, bins.count, bins.bias, bins.spread, bins.share, strict=True
        )
    ]
    return ReportTable(
        title=f"Residuals by {label.partition(' [')[0]}",
        columns=[label, "values", "mean [%]", "root mean square [%]", "share of squares [%]"],
        rows=rows,
        folded=True,
    )


def solutions(sky: SkyFit) -> str:
    """Number of computed solutions, and wall time."""
    return f"{sky.solves} solutions and {sky.rough_solves} coarse ones, {sky.seconds:.1f} s"


def facts(sky: SkyFit) -> dict[str, str]:
    """Settings needed to repeat the fit."""
    free = ", ".join(
        [*sky.settings.free, *(f"{one} of each scan" for one in sky.settings.per_scan)]
    )
    return {
        "planet": sky.name,
        "data": sky.data.source,
        "free": free,
        "loss": sky.settings.loss,
        "quality": sky.settings.quality,
        "solutions": solutions(sky),
    }


def html(sky: SkyFit) -> str:
    """Report as a self-contained HTML page."""
    listed = "".join(f"<dt>{escape(k)}</dt><dd>{escape(v)}</dd>" for k, v in facts(sky).items())
    body = [f"<dl>{listed}</dl>", *(part_html(part) for part in parts_of(sky))]
    return page_html(f"airlight: fit of {sky.name}", body)


def markdown(sky: SkyFit, parts: Sequence[Part], pictures: str) -> str:
    """Report as Markdown, with a folder of pictures.

    Parameters
    ----------
    parts : sequence of Part
        From ``parts_of``.
    pictures : str
        Folder of the pictures relative to the page.
    """
    lines = [f"# airlight: fit of {escaped(sky.name)}", ""]
    lines += [f"- {name}: {escaped(value)}" for name, value in facts(sky).items()]
    for part in parts:
        lines += ["", *part_lines(part, pictures)]
    return "\n".join(lines) + "\n"


def fitted_file(sky: SkyFit) -> str:
    """Text of the fitted planet's file, with a header of values and error bars."""
    comments = (
        f"{sky.name}, fitted to {sky.data.source} by airlight fit.",
        *result_lines(sky),
        *(f"Note: {one}." for one in warnings_of(sky)),
    )
    return planet_file(_short(sky.tables), comments)


def _short(value: Any) -> Any:
    """Tables with numbers rounded to eight digits."""
    if isinstance(value, dict):
        return {key: _short(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_short(one) for one in value]
    if isinstance(value, float):
        return float(f"{value:.8g}")
    if isinstance(value, str) and " " in value:
        first, _, rest = value.partition(" ")
        try:
            number = float(first)
        except ValueError:
            return value
        return f"{number:.10g} {rest}" if len(first) > 12 else value
    return value
