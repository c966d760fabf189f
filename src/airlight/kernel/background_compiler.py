"""Compilation in a background process, to the cache on disk.

Numba compiles one function at a time in a process; a second process compiles what is needed next.
"""

from __future__ import annotations

import subprocess
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any, Final

from airlight.child_processes import start_python
from airlight.kernel.compiling import CompileListener, Compiling, is_kept, on_disk

#: Polling interval for compiled functions. [s]
_POLL: Final = 0.05


class BackgroundCompiler:
    """Background process that compiles loops in their order, unless they are on disk.

    Parameters
    ----------
    compiler : str
        ``module:function``, which compiles the loops in the background process.
    loops : sequence of compiled functions
        Loops in the order of compilation.
    later : sequence of compiled functions
        Further loops, which are not counted.
    arguments : tuple
        Arguments of the function.

    Attributes
    ----------
    compiling : Compiling
        Count of the functions of ``loops``.

    Notes
    -----
    The process starts at once, for those who only ask whether a loop is ``ready``. If it fails or
    cannot start, or without a cache on disk, ``ready`` is True and the loops are compiled in this
    process; after ``close``, which may precede the end of threads that wait, they are not.
    """

    def __init__(
        self,
        compiler: str,
        loops: Sequence[Any],
        later: Sequence[Any] = (),
        *,
        arguments: tuple[int, ...] = (),
    ) -> None:
        self._waits = tuple(one for one in (*loops, *later) if is_kept(one) and not on_disk(one))
        self.compiling = Compiling(loops, here=not self._waits)
        self._ended = threading.Event()
        self._closed = False
        self._process: subprocess.Popen[str] | None = None
        self._thread: threading.Thread | None = None
        if not self._waits:
            self._ended.set()
            return
        module, _, function = compiler.partition(":")
        text = f"from {__name__} import report; report({module!r}, {function!r}, *{arguments!r})"
        try:
            self._process = start_python(
                text, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
            )
        except OSError:
            self._ended.set()
            return
        self._thread = threading.Thread(target=self._listen, name="airlight-compiler", daemon=True)
        self._thread.start()

    def _listen(self) -> None:
        assert self._process is not None
        assert self._process.stdout is not None
        with self._process as process, self._process.stdout as lines:
            for line in lines:
                self.compiling.finish(line.strip())
            process.wait()
        self._ended.set()

    @property
    def busy(self) -> bool:
        """Whether the process is running."""
        return not self._ended.is_set()

    def ready(self, loop: Any) -> bool:
        """Whether a loop can be used without waiting for the process."""
        ended = self._ended.is_set() and not self._closed
        return ended or loop not in self._waits or on_disk(loop)

    def wait(self, loop: Any, stale: Callable[[], bool]) -> bool:
        """Wait for a loop; False if ``stale()`` was True first, or if the compiler is closed."""
        while not self.ready(loop):
            if self._closed or stale():
                return False
            self._ended.wait(_POLL)
        return True

    def close(self) -> None:
        """End the process."""
        if self._process is None or self._thread is None:
            return
        self._closed = True
        with suppress(OSError):
            self._process.kill()
        self._thread.join()


def report(module: str, function: str, *arguments: int) -> None:
    """Call a function with arguments, and print the name of each function that it compiles."""
    from importlib import import_module

    from numba.core import event

    def print_name(name: str) -> None:
        print(name, flush=True)

    event.register("numba:compile", CompileListener(print_name))
    getattr(import_module(module), function)(*arguments)
