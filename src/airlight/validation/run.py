"""Runs suites by name, one after the other, and times them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter
from typing import Final, Protocol

from airlight.errors import FileError, ParameterError
from airlight.validation.suite import Cancel, Progress, Suite


class _Compute(Protocol):
    def __call__(
        self, data: Path | None, *, progress: Progress | None, cancel: Cancel | None
    ) -> Suite: ...


@dataclass(frozen=True)
class Entry:
    """A suite as the list of suites has it.

    Attributes
    ----------
    title : str
        Of its section.
    compute : callable
        ``compute(data, progress=, cancel=)``.
    files : tuple of str
        Of the folder of reference data; one of them must be there.
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


def _energy(data: Path | None, *, progress: Progress | None, cancel: Cancel | None) -> Suite:
    from airlight.validation.energy import energy

    return energy(progress=progress, cancel=cancel)


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
    "energy": Entry("Energy", _energy),
}


def chosen(names: Sequence[str], data: Path | None) -> dict[str, str]:
    """Which suites to run, and why not the others of "all".

    Parameters
    ----------
    names : sequence of str
        Of suites, or "all".
    data : Path or None
        The folder of reference data.

    Returns
    -------
    dict
        By name, why a suite is left out; empty for those to run. In the order of the report.

    Raises
    ------
    ParameterError
        If a suite has no such name, or needs data and no folder is given.
    FileError
        If the folder is none, or lacks what a suite that was named needs.

    Examples
    --------
    >>> chosen(["golden"], None)
    {'golden': ''}
    >>> chosen(["all"], None)["spherical"]
    'needs --data'
    """
    for name in names:
        if name not in (*SUITES, "all"):
            raise ParameterError("--suite", name, ", ".join((*SUITES, "all")))
    if data is not None and not data.is_dir():
        raise FileError(data, "is no folder")
    out = {}
    for name, entry in SUITES.items():
        if name not in names and "all" not in names:
            continue
        reason = ""
        if entry.files and data is None:
            reason = "needs --data"
            if name in names:
                raise ParameterError(
                    "--data", "missing", f"the folder that holds {' or '.join(entry.files)}"
                )
        elif data is not None and not _has_one(data, entry.files):
            reason = f"--data holds no {' or '.join(entry.files)}"
            if name in names:
                raise FileError(data, f"holds no {' or '.join(entry.files)}")
        out[name] = reason
    return out


def _has_one(data: Path, files: tuple[str, ...]) -> bool:
    return not files or any((data / file).is_file() for file in files)


def run(
    names: Sequence[str], data: Path | None = None, *, progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Iterator[Suite]:  # fmt: skip
    """Run suites, each as it is asked for.

    Parameters
    ----------
    names, data :
        See ``chosen``.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``; the message names the suite.

    Yields
    ------
    Suite
        With the time that it took.

    Raises
    ------
    ParameterError, FileError
        As ``chosen`` does, before anything runs; and as a suite does whose file is damaged.
    Cancelled
        If ``cancel`` said so.
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
