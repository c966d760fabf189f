"""Exit within a second of Ctrl-C, without waiting for threads.

Python handles signals between bytecode instructions, which compilation or a threaded computation
may delay for minutes. A thread receives the signals, waits for a moment for the command to end, and
then ends the process. Partial outputs are removed.
"""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import threading
from typing import Final

from airlight.child_processes import end_all
from airlight.cli.console import note

#: Time after which an interrupted command is ended. [s]
PATIENCE: Final = 0.4
#: Exit status of an interrupted process, 128 + SIGINT.
INTERRUPTED: Final = 130
#: Set when the command itself has said that it was cancelled.
answered: Final = threading.Event()
#: Exit status by the signals that have arrived: the compiler may swallow what they raise.
received: Final[list[int]] = []
_saying: Final = threading.Lock()


def end_at_once() -> None:
    """End the process immediately at SIGINT, until ``end_when_interrupted``.

    A process that ignores the signal continues to do so.
    """
    if threading.current_thread() is not threading.main_thread():
        return
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _end_at_once)


def _end_at_once(*_: object) -> None:
    with contextlib.suppress(OSError, ValueError):
        note("cancelled")
        sys.stderr.flush()
    os._exit(INTERRUPTED)


def end_when_interrupted() -> None:
    """Watch for SIGINT and SIGTERM from now on, in the process of a command.

    No effect where signals cannot be watched (Windows, threads other than the main thread).
    """
    if threading.current_thread() is not threading.main_thread():
        return
    if signal.getsignal(signal.SIGINT) is _end_at_once:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    if sys.platform == "win32":
        return
    sys.unraisablehook = _unraisable
    read_end, write_end = os.pipe()
    os.set_blocking(write_end, False)
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _interrupted)
    signal.signal(signal.SIGTERM, _terminated)
    signal.set_wakeup_fd(write_end, warn_on_full_buffer=False)
    threading.Thread(
        target=_watch, args=(read_end,), name="airlight-interrupt", daemon=True
    ).start()


def _watch(read_end: int) -> None:
    while True:
        number = os.read(read_end, 1)
        if number and number[0] in (signal.SIGINT, signal.SIGTERM):
            threading.Event().wait(PATIENCE)
            leave(128 + number[0])


def _unraisable(what: sys.UnraisableHookArgs) -> None:
    """Suppress the report of an interruption swallowed by a callback, as of the compiler."""
    if not isinstance(what.exc_value, (KeyboardInterrupt, SystemExit)):
        sys.__unraisablehook__(what)


def _interrupted(*_: object) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # a second signal would interrupt the clean-up
    received.append(INTERRUPTED)
    raise KeyboardInterrupt


def _terminated(*_: object) -> None:
    answered.set()
    received.append(128 + signal.SIGTERM)
    raise SystemExit(received[-1])


def say_cancelled() -> None:
    """Print that the command was cancelled."""
    with _saying:
        answered.set()
        note("cancelled")


def leave(status: int) -> None:
    """End the process and its children, without waiting for threads.

    Parameters
    ----------
    status : int
        Exit status.
    """
    partial_outputs = sys.modules.get("airlight.files.partial_outputs")
    try:
        if partial_outputs is not None:
            partial_outputs.remove_all()
        if not answered.is_set():
            say_cancelled()
        _saying.acquire(timeout=PATIENCE)
        for stream in (sys.stdout, sys.stderr):
            with contextlib.suppress(OSError, ValueError):
                stream.flush()
        end_all()
    finally:
        os._exit(status)
