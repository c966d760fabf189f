"""Start and end of child processes.

``python -c`` puts the working directory on the import path, so that a ``signal.py`` there would be
imported. Children are therefore started with ``-P`` or ``PYTHONSAFEPATH``. Children that compute
leave Ctrl-C to the parent process.
"""

from __future__ import annotations

import contextlib
import os
import signal
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    import subprocess

#: Environment of Python without the working directory on its import path.
SAFE_PATH: Final = {"PYTHONSAFEPATH": "1"}
#: The resource tracker of ``multiprocessing`` does not warn of semaphores of an ended process.
_SILENT: Final = {"PYTHONWARNINGS": "ignore::UserWarning:multiprocessing.resource_tracker"}
_started: Final[set[subprocess.Popen[str]]] = set()
_folders: Final[set[Path]] = set()


def start_python(text: str, **options: Any) -> subprocess.Popen[str]:
    """Start Python with this process's import path, without the working directory.

    Parameters
    ----------
    text : str
        Source of the program.
    options
        Further arguments of ``subprocess.Popen``.

    Returns
    -------
    subprocess.Popen
        Process, ended by ``end_all``.
    """
    import subprocess

    paths = os.pathsep.join(one for one in sys.path if one)
    environment = {**os.environ, **SAFE_PATH, "PYTHONPATH": paths}
    process = subprocess.Popen(
        [sys.executable, "-P", "-c", text], text=True, env=environment, **options
    )
    _started.difference_update([one for one in _started if one.poll() is not None])
    _started.add(process)
    return process


@contextlib.contextmanager
def safe_path(**also: str) -> Iterator[None]:
    """Context in which libraries start processes with ``SAFE_PATH`` and further variables."""
    before = {name: os.environ.get(name) for name in (*SAFE_PATH, *also)}
    os.environ.update({**SAFE_PATH, **also})
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


@contextlib.contextmanager
def deaf_to_interrupts() -> Iterator[None]:
    """Context in which new threads, and their child processes, inherit a mask of Ctrl-C.

    The terminal sends Ctrl-C to all processes, and a starting child would print a traceback. No
    effect on Windows.
    """
    if sys.platform == "win32":
        yield
        return
    from multiprocessing import resource_tracker

    with safe_path(**_SILENT):
        resource_tracker.ensure_running()  # a later start would remove the signal mask
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextlib.contextmanager
def folder_of_children(folder: Path) -> Iterator[None]:
    """Register a folder of child processes, to be removed by ``end_all``."""
    _folders.add(folder)
    try:
        yield
    finally:
        _folders.discard(folder)


def end_all() -> None:
    """Kill all child processes, including those of libraries and their descendants."""
    import shutil

    for _ in range(2):  # a worker that was lost may have been replaced meanwhile
        _kill_all()
        for folder in tuple(_folders):
            shutil.rmtree(folder, ignore_errors=True)


def _kill_all() -> None:
    running: list[Any] = [one for one in _started if one.poll() is None]
    psutil = sys.modules.get("psutil")  # Dask, the library that starts processes, has loaded it
    if psutil is not None:
        tracker = sys.modules.get("multiprocessing.resource_tracker")
        spared = tracker and tracker._resource_tracker._pid  # it removes semaphores, and ends
        children = psutil.Process().children(recursive=True)
        running += [one for one in children if one.pid != spared]
    for one in running:
        with contextlib.suppress(Exception):
            one.kill()
