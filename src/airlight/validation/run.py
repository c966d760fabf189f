"""Validation run: suites by name, with their wall times."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from pkgutil import resolve_name
from time import perf_counter
from typing import Final

from airlight.errors import ConflictError, FileError, ParameterError
from airlight.kernel.threads import Progress
from airlight.validation.suite import Suite, SuiteRun


@dataclass(frozen=True)
class Entry:
    """Entry in the list of suites.

    Attributes
    ----------
    title : str
        Title of its section.
    function : str
        Module, imported only when it is needed, and name of the function that makes a ``Suite`` of
        a ``SuiteRun``.
    files : tuple of str
        Files in the folder of reference data, or patterns, at least one of which is needed.
    """

    title: str
    function: str
    files: tuple[str, ...] = ()


#: All suites, in the order of the report.
SUITES: Final[dict[str, Entry]] = {
    "golden": Entry("Golden numbers", "golden:golden"),
    "solvers": Entry("Three solvers", "solvers:solvers"),
    "spherical": Entry(
        "Independent spherical radiances",
        "spherical.radiances:spherical",
        ("spherical-monte-carlo.csv", "bruneton2017-radiances.csv"),
    ),
    "cie": Entry("CIE clear sky, type 12", "cie:cie"),
    "measured": Entry("Measured skies", "measured:measured", ("kider2013-05-27.npz",)),
    "kider": Entry("Measured days, load fitted", "measured_days:measured_days", ("kider*.npz",)),
    "energy": Entry("Energy, reversed paths and orders", "energy:energy"),
    "disort": Entry("Flat air against discrete ordinates", "plane_parallel:disort"),
    "clouds": Entry("Clouds in three dimensions", "clouds:clouds"),
    "published": Entry("Published light", "published.light:published"),
    "polarisation": Entry("Polarised light", "polarised.light:polarisation"),
}


def chosen(names: Sequence[str], data: Path | None) -> dict[str, str]:
    """Suites to run, and reasons for omitting others of "all".

    Parameters
    ----------
    names : sequence of str
        Names of suites, or "all".
    data : Path or None
        Folder of reference data.

    Returns
    -------
    dict
        Reason for omitting a suite, by name in the order of the report; empty if it runs.

    Raises
    ------
    FileError
        If ``data`` is not a folder, or lacks a file that a suite named explicitly needs.

    Examples
    --------
    >>> chosen(["golden"], None)
    {'golden': ''}
    >>> chosen(["all"], None)["spherical"]
    'requires reference data'
    """
    for name in names:
        if name not in (*SUITES, "all"):
            raise ParameterError("suite", name, ", ".join((*SUITES, "all")))
    if data is not None and not data.is_dir():
        raise FileError(data, "is not a folder")
    out = {}
    for name, entry in SUITES.items():
        if name not in names and "all" not in names:
            continue
        reason = ""
        if entry.files and data is None:
            reason = "requires reference data"
            if name in names:
                needed = " or ".join(entry.files)
                raise ConflictError("data", f"is required for {name}: a folder with {needed}")
        elif data is not None and not _has_one(data, entry.files):
            reason = f"no {' or '.join(entry.files)} in the reference data"
            if name in names:
                raise FileError(data, f"contains no {' or '.join(entry.files)}")
        out[name] = reason
    return out


def _has_one(data: Path, files: tuple[str, ...]) -> bool:
    return not files or any(one.is_file() for file in files for one in data.glob(file))


def run(names: Sequence[str], work: SuiteRun) -> Iterator[Suite]:
    """Lazy run of suites.

    Parameters
    ----------
    names : sequence of str
        See ``chosen``.
    work : SuiteRun
        Its progress names the suite.

    Yields
    ------
    Suite
        Result, with its wall time.
    """
    for name, reason in chosen(names, work.data).items():
        entry = SUITES[name]
        if reason:
            yield Suite(name=name, title=entry.title, not_run=reason)
            continue
        compute = resolve_name(f"airlight.validation.{entry.function}")
        started = perf_counter()
        suite: Suite = compute(replace(work, progress=_named(name, work.progress)))
        seconds = perf_counter() - started
        yield replace(suite, name=name, title=entry.title, seconds=seconds)


def _named(name: str, progress: Progress | None) -> Progress | None:
    if progress is None:
        return None
    return lambda done, total, message: progress(done, total, f"{name}: {message}")
