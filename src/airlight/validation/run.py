"""Validation run: suites by name, with their wall times."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter
from typing import Final, Protocol

from airlight.errors import ConflictError, FileError, ParameterError
from airlight.validation.suite import Cancel, Progress, Suite


class _Compute(Protocol):
    def __call__(
        self, data: Path | None, *, progress: Progress | None, cancel: Cancel | None
    ) -> Suite: ...


@dataclass(frozen=True)
class Entry:
    """Entry in the list of suites.

    Attributes
    ----------
    title : str
        Title of its section.
    compute : callable
        Function with the signature ``compute(data, progress=, cancel=)``.
    files : tuple of str
        Files in the folder of reference data, or patterns, at least one of which is needed.
    """

    title: str
    compute: _Compute
    files: tuple[str, ...] = ()


def _golden(data: Path | None, *, progress: Progress | None, cancel: Cancel | None) -> Suite:
    from airlight.validation.golden import golden

    return golden(progress=progress, cancel=cancel)


def _solvers(data: Path | None, *, progress: Progress | None, cancel: Cancel | None) -> Suite:
    from airlight.validation.solvers import solvers

    return solvers(progress=progress, cancel=cancel)


def _spherical(data: Path | None, *, progress: Progress | None, cancel: Cancel | None) -> Suite:
    from airlight.validation.spherical.radiances import spherical

    assert data is not None
    return spherical(data, progress=progress, cancel=cancel)


def _cie(data: Path | None, *, progress: Progress | None, cancel: Cancel | None) -> Suite:
    from airlight.validation.cie import cie

    return cie(progress=progress, cancel=cancel)


def _measured(data: Path | None, *, progress: Progress | None, cancel: Cancel | None) -> Suite:
    from airlight.validation.measured import measured

    assert data is not None
    return measured(data, progress=progress, cancel=cancel)


def _kider(data: Path | None, *, progress: Progress | None, cancel: Cancel | None) -> Suite:
    from airlight.validation.measured_days import measured_days

    assert data is not None
    return measured_days(data, progress=progress, cancel=cancel)


def _energy(data: Path | None, *, progress: Progress | None, cancel: Cancel | None) -> Suite:
    from airlight.validation.energy import energy

    return energy(progress=progress, cancel=cancel)


def _disort(data: Path | None, *, progress: Progress | None, cancel: Cancel | None) -> Suite:
    from airlight.validation.plane_parallel import disort

    return disort(progress=progress, cancel=cancel)


def _published(data: Path | None, *, progress: Progress | None, cancel: Cancel | None) -> Suite:
    from airlight.validation.published.light import published

    return published(progress=progress, cancel=cancel)


def _polarisation(data: Path | None, *, progress: Progress | None, cancel: Cancel | None) -> Suite:
    from airlight.validation.polarised.light import polarisation

    return polarisation(progress=progress, cancel=cancel)


#: All suites, in the order of the report.
SUITES: Final[dict[str, Entry]] = {
    "golden": Entry("Golden numbers", _golden),
    "solvers": Entry("Three solvers", _solvers),
    "spherical": Entry(
        "Independent spherical radiances",
        _spherical,
        ("spherical-monte-carlo.csv", "bruneton2017-radiances.csv"),
    ),
    "cie": Entry("CIE clear sky, type 12", _cie),
    "measured": Entry("Measured skies", _measured, ("kider2013-05-27.npz",)),
    "kider": Entry("Measured days, load fitted", _kider, ("kider*.npz",)),
    "energy": Entry("Energy", _energy),
    "disort": Entry("Flat air against discrete ordinates", _disort),
    "published": Entry("Published light", _published),
    "polarisation": Entry("Polarised light", _polarisation),
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


def run(
    names: Sequence[str], data: Path | None = None, *, progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Iterator[Suite]:  # fmt: skip
    """Lazy run of suites.

    Parameters
    ----------
    names, data :
        See ``chosen``.

    Yields
    ------
    Suite
        Result, with its wall time.
    """
    for name, reason in chosen(names, data).items():
        entry = SUITES[name]
        if reason:
            yield Suite(name=name, title=entry.title, summary="", not_run=reason)
            continue
        started = perf_counter()
        suite = entry.compute(data, progress=_named(name, progress), cancel=cancel)
        yield replace(suite, seconds=perf_counter() - started)


def _named(name: str, progress: Progress | None) -> Progress | None:
    if progress is None:
        return None
    tell: Callable[[int, int, str], None] = progress
    return lambda done, total, message: tell(done, total, f"{name}: {message}")
