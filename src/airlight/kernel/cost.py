"""Estimated time of long work, announced before it begins: amount over measured rate.

The default rates are those of a core of 2.1 GHz. Each machine measures its own, in CPU time, during
any work that takes long enough, and stores the fastest recent ones, as a first run includes
compilation.
"""

from __future__ import annotations

import contextlib
import json
import os
import tempfile
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from contextvars import ContextVar
from pathlib import Path
from typing import Final

from airlight.files.cache_folders import cache_folder, make_folder
from airlight.kernel.threads import thread_count

#: Kind of work of a GPU, in wall-clock time.
DEVICE: Final = "picture on a device"
#: Kind of work of pixels, or lines of sight, that are marched one by one.
LINES: Final = "exact picture"
#: Expected time from which work is reported. [s]
LONG: Final = 10.0
#: Shortest time from which a rate is measured: below, loading and compiling dominate. [s]
MEASURABLE: Final = 1.0
#: Smallest amount of work from which a rate is measured, in time at the default rates: small
#: pictures have a constant overhead, and a hundred of them made a large one appear 60 times as
#: slow. [s]
SUBSTANTIAL: Final = 0.5
#: Default rates of one core per second: points of rays times moments, terms of Mie's series times
#: angles, wavelengths of pixels; and pixels per second of a device.
RATES: Final = {
    "solve": 1.5e9,
    "particles": 6.0e9,
    "picture": 1.2e7,
    LINES: 5.0e5,
    DEVICE: 2.0e7,
}
#: Rates beyond this factor of the default rates come from a damaged file.
_BELIEVED: Final = 1e3
#: Largest decrease of a rate by one slower measurement, as a factor.
_RATE_DECAY: Final = 0.8

#: Listener of reports of one line each, or None.
announce: ContextVar[Callable[[str], None] | None] = ContextVar("announce", default=None)
_inside: ContextVar[bool] = ContextVar("inside", default=False)
_lock = threading.Lock()


@contextlib.contextmanager
def timed(kind: str, count: float, work: str) -> Iterator[None]:
    """Context that announces long work and measures its rate.

    Nested work is neither announced nor measured; failed work is not measured.

    Parameters
    ----------
    kind : str
        Key of ``RATES``.
    count : float
        Amount of work. [1]
    work : str
        Subject of the announcement: ``"a picture of 8192x4096 pixels"``.

    Examples
    --------
    >>> token = announce.set(print)
    >>> with timed("particles", 1e8 * RATES["particles"], "a long name"):  # doctest: +ELLIPSIS
    ...     pass
    a long name: about ... days
    >>> announce.reset(token)
    """
    if _inside.get():
        yield
        return
    listener = announce.get()
    if listener is not None and (expected := expected_seconds(kind, count)) > LONG:
        listener(f"{work}: about {duration(expected)}")
    inside, begun = _inside.set(True), _clock(kind)
    try:
        yield
    finally:
        _inside.reset(inside)
    _measured(kind, count, _clock(kind) - begun)


def announce_all(work: str, amounts: Iterable[tuple[str, float]]) -> None:
    """Announce long work of several kinds, distributed to processes.

    The time is for all cores of this machine: an upper limit on a cluster.

    Parameters
    ----------
    work : str
        Subject of the announcement: ``"120 frames of 1280x720 pixels"``.
    amounts : iterable of (str, float)
        Kinds among ``RATES``, and the amount of each.

    Examples
    --------
    >>> token = announce.set(print)
    >>> announce_all("frames", [("solve", 1.0), ("picture", 1e8 * RATES["picture"])])
    ... # doctest: +ELLIPSIS
    frames: about ... days
    >>> announce.reset(token)
    """
    listener = announce.get()
    expected = sum(expected_seconds(kind, count) for kind, count in amounts)
    if listener is not None and expected > LONG:
        listener(f"{work}: about {duration(expected)}")


def expected_seconds(kind: str, count: float) -> float:
    """Expected time of some work with all threads of this process. [s]"""
    together = 1 if kind == DEVICE else thread_count()
    return count / (_rates()[kind] * together)


def duration(seconds: float) -> str:
    """Time in words, to two digits.

    Examples
    --------
    >>> [duration(s) for s in (12.3, 75.0, 600.0, 5400.0, 1e6)]
    ['12 s', '1.2 min', '10 min', '1.5 h', '12 days']
    """
    for size, unit in ((86400.0, "days"), (3600.0, "h"), (60.0, "min")):
        if seconds >= (2.0 * size if unit == "days" else size):
            return f"{seconds / size:.2g} {unit}"
    return f"{seconds:.2g} s"


def _clock(kind: str) -> float:
    return time.perf_counter() if kind == DEVICE else time.process_time()


def _file() -> Path:
    return cache_folder() / "rates.json"


def _rates() -> dict[str, float]:
    """Rates of this machine; the defaults where none is measured or the file is damaged."""
    try:
        found = json.loads(_file().read_text(encoding="ascii"))
        measured = {kind: float(found[kind]) for kind in RATES if kind in found}
    except (OSError, ValueError, TypeError):
        return dict(RATES)
    return {**RATES, **{kind: rate for kind, rate in measured.items() if _believed(kind, rate)}}


def _believed(kind: str, rate: float) -> bool:
    return RATES[kind] / _BELIEVED < rate < RATES[kind] * _BELIEVED


def _measured(kind: str, count: float, seconds: float) -> None:
    """Store a measured rate, but not much less than the previous one."""
    if seconds < MEASURABLE or count < SUBSTANTIAL * RATES[kind]:
        return
    with _lock, contextlib.suppress(OSError):
        known = _rates()
        rate = max(count / seconds, _RATE_DECAY * known[kind])
        if not _believed(kind, rate):
            return
        file = _file()
        make_folder(file.parent)
        handle, name = tempfile.mkstemp(dir=file.parent, prefix=".", suffix=".part")
        try:
            with os.fdopen(handle, "w", encoding="ascii") as stream:
                json.dump({**known, kind: rate}, stream)
            Path(name).replace(file)
        finally:
            Path(name).unlink(missing_ok=True)
