"""Functions that have to be compiled before a loop can run, and remaining compilation time.

They are found by the names in the source of a loop and of its callees. Progress counts functions;
the remaining time is estimated from the code that each inlines.
"""

from __future__ import annotations

import threading
import types
from collections.abc import Callable, Collection, Iterable, Iterator
from time import perf_counter
from typing import Any, Final

from numba.core import event
from numba.core.dispatcher import Dispatcher

#: CPU time of an amount of work as ``work_left`` counts it, on a core of 2.1 GHz. [s]
SECONDS: Final = 1.1e-4
#: Time by ``SECONDS`` that counts as measured: small functions first tell little. [s]
_ASSUMED: Final = 20.0
#: Shortest interval between checks of what other processes have compiled. [s]
_EVERY: Final = 0.3
#: Amount of work of any function, in bytes of bytecode.
_OVERHEAD: Final = 400


def name_of(function: Any) -> str:
    """Name of a compiled function, with its module."""
    return f"{function.py_func.__module__}.{function.py_func.__qualname__}"


def reached(loops: Iterable[Any]) -> dict[str, Any]:
    """Compiled functions that loops call, and the loops themselves, by name.

    Parameters
    ----------
    loops : iterable of compiled functions
        Functions that Python calls.

    Examples
    --------
    >>> from airlight.kernel import kernel
    >>> from airlight.kernel.cube_root import cube_root
    >>> @kernel
    ... def sixth_root(x):
    ...     return cube_root(x) ** 0.5
    >>> [name.rpartition(".")[2] for name in reached([sixth_root])]
    ['sixth_root', 'cube_root']
    """
    found: dict[str, Any] = {}
    waiting = list(loops)
    while waiting:
        one = waiting.pop()
        if name_of(one) not in found:
            found[name_of(one)] = one
            waiting += _called(one)
    return found


def _called(function: Any) -> Iterator[Any]:
    python = function.py_func
    scope = python.__globals__
    for name in _names(python.__code__):
        if isinstance(scope.get(name), Dispatcher):
            yield scope[name]


def _names(code: types.CodeType) -> set[str]:
    inner = (one for one in code.co_consts if isinstance(one, types.CodeType))
    return set(code.co_names).union(*(_names(one) for one in inner))


def on_disk(function: Any) -> bool:
    """Whether compiled code of a function is on disk for some types."""
    return bool(getattr(function, "on_disk", False))


def is_kept(function: Any) -> bool:
    """Whether compiled code of a function is cached on disk."""
    return bool(getattr(function, "is_kept", False))


def work_left(loops: Iterable[Any], finished: Collection[str]) -> int:
    """Remaining compilation work of loops.

    Parameters
    ----------
    finished : collection of str
        Names of functions that are compiled.
    """
    needed = reached(one for one in loops if name_of(one) not in finished and not on_disk(one))
    return sum(
        _work(one) for name, one in needed.items() if name not in finished and not on_disk(one)
    )


def _work(function: Any) -> int:
    return _OVERHEAD + sum(_length(inner) for inner in reached([function]).values())


class Compiling:
    """Progress of the compilation of loops.

    Parameters
    ----------
    loops : iterable of compiled functions
        Loops that will run; those with compiled code on disk are not counted.
    here : bool
        Whether this process compiles them; otherwise the caller reports each by ``finish``.

    Attributes
    ----------
    total, done : int
        Number of functions, and of compiled ones. [1]
    """

    def __init__(self, loops: Iterable[Any], *, here: bool = True) -> None:
        functions = reached(one for one in loops if not on_disk(one))
        missing = {name: one for name, one in functions.items() if not on_disk(one)}
        self._work = {name: _work(one) for name, one in missing.items()}
        self._missing = missing
        self._finished: set[str] = set()
        self._looked = 0.0
        self._lock = threading.Lock()
        self._began = perf_counter()
        self.total = len(self._work)
        self._observers: list[Callable[[], None]] = []
        self._listener = CompileListener(self.finish)
        self._listens = here and self.total > 0
        if self._listens:
            event.register("numba:compile", self._listener)

    @property
    def names(self) -> frozenset[str]:
        """Names of all functions to compile."""
        return frozenset(self._work)

    @property
    def finished(self) -> frozenset[str]:
        """Names of compiled functions."""
        now = perf_counter()
        with self._lock:
            if now - self._looked > _EVERY:
                self._looked = now
                waiting = self._work.keys() - self._finished
                self._finished |= {name for name in waiting if on_disk(self._missing[name])}
            return frozenset(self._finished)

    @property
    def done(self) -> int:
        """Number of functions that are compiled. [1]"""
        return len(self.finished)

    def finish(self, name: str) -> None:
        """Count a function that is compiled."""
        with self._lock:
            if name not in self._work:
                return
            self._finished.add(name)
        for one in tuple(self._observers):
            one()

    def subscribe(self, observer: Callable[[], None]) -> Callable[[], None]:
        """Call ``observer``, on any thread, after each function; returns the unsubscriber."""
        self._observers.append(observer)
        return lambda: self._observers.remove(observer)

    @property
    def seconds_left(self) -> float:
        """Estimated remaining time of compilation. [s]"""
        done = sum(self._work[name] for name in self.finished)
        rest = sum(self._work.values()) - done
        elapsed = perf_counter() - self._began
        return rest * (elapsed + _ASSUMED) / (done + _ASSUMED / SECONDS)

    def close(self) -> None:
        """Unsubscribe from Numba's compilation events."""
        if self._listens:
            self._listens = False
            event.unregister("numba:compile", self._listener)


def progress_text(counts: Iterable[Compiling]) -> str:
    """Number of compiled functions, each counted once, and the time left; empty at the end."""
    running = [one for one in counts if one.done < one.total]
    if not running:
        return ""
    names = frozenset[str]().union(*(one.names for one in running))
    done = frozenset[str]().union(*(one.finished for one in running))
    left = max(one.seconds_left for one in running)
    return f"compiling, once: {len(done)} of {len(names)} functions, about {left:.0f} s left"


def _length(function: Any) -> int:
    return len(function.py_func.__code__.co_code)


class CompileListener(event.Listener):
    """Listener of Numba's events that reports the name of each compiled function."""

    def __init__(self, on_compiled: Callable[[str], None]) -> None:
        self._on_compiled = on_compiled

    def on_start(self, _: Any) -> None:
        """Ignore the start of a compilation."""

    def on_end(self, ended: Any) -> None:
        """Report the compiled function."""
        self._on_compiled(name_of(ended.data["dispatcher"]))
