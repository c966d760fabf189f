"""Progress until the first frame of a viewer: compilation and solving."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter
from typing import Final

from airlight.kernel.compiling import Compiling, progress_text
from airlight.render.background_compilation import start_render_compiler
from airlight.solver.moments.loops import LOOPS
from airlight.viewer.background.solver_thread import SolverStatus

#: Shortest time between two redraws, which compete for the CPU. [s]
_EVERY: Final = 0.2


class Preparing:
    """Compilation of the solver in this process and of the renderer in another.

    Parameters
    ----------
    wake : callable
        Called from any thread, a few times a second, while there is progress.

    Attributes
    ----------
    compiler : BackgroundCompiler
        Process that compiles the renderer.
    """

    def __init__(self, wake: Callable[[], None]) -> None:
        self._wake = wake
        self._woken = 0.0
        self._solver = Compiling(LOOPS)
        self.compiler = start_render_compiler()
        self._both = (self._solver, self.compiler.compiling)
        for one in self._both:
            one.subscribe(self._progressed)

    def _progressed(self) -> None:
        now = perf_counter()
        if now - self._woken >= _EVERY:
            self._woken = now
            self._wake()

    @property
    def share(self) -> float:
        """Compiled fraction of the functions. [1]"""
        one, other = self._both
        total = len(one.names | other.names)
        return len(one.finished | other.finished) / total if total else 1.0

    def text(self, status: SolverStatus) -> str:
        """Current task, progress and time left."""
        words = progress_text(self._both)
        if words:
            return words
        if status.busy and status.total:
            return f"{status.doing}: {status.done} of at most {status.total} steps"
        return status.doing or "rendering"

    def close(self) -> None:
        """Stop counting and end the other process."""
        self._solver.close()
        self.compiler.close()

    def finish(self) -> None:
        """Stop counting; the other process continues."""
        self._solver.close()
