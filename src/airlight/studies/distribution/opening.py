"""Choice of a runner: this process, processes of this machine, or a cluster by its address."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from importlib import util
from typing import Final

from airlight.errors import ConflictError, ParameterError
from airlight.kernel.threads import thread_count
from airlight.studies.distribution.here import Here
from airlight.studies.distribution.runner import Runner

#: Largest number of processes on one machine.
MOST_WORKERS: Final = 256
#: Number of tasks per process started by default, since a start takes some seconds.
_WORTH: Final = 6


@contextlib.contextmanager
def opened_runner(
    tasks: int, *, scheduler: str | None = None, workers: int | None = None
) -> Iterator[Runner]:
    """Context with the runner of some tasks.

    Parameters
    ----------
    tasks : int
        Number of tasks.
    scheduler : str, optional
        Address of a Dask scheduler, ``tcp://host:8786``, whose workers run the tasks.
    workers : int, optional
        Number of processes, which share the cores of this machine; 1 is this process. Default: the
        number of cores, at most a sixth of the tasks, and 1 without Dask.

    Yields
    ------
    Runner

    Raises
    ------
    ParameterError
        If the number is out of range, both are given, or Dask is requested and not installed.
    WorkerError
        If there is no scheduler at that address.
    """
    if workers is not None and not 1 <= workers <= MOST_WORKERS:
        raise ParameterError("workers", workers, f"1 to {MOST_WORKERS}")
    if scheduler is not None and workers is not None:
        raise ConflictError("workers", "cannot be combined with scheduler")
    installed = util.find_spec("distributed") is not None
    if not installed and scheduler is not None:
        raise ConflictError("scheduler", "requires Dask: pip install airlight[dask]")
    if not installed and (workers or 1) > 1:
        raise ParameterError("workers", workers, "1 without Dask: pip install airlight[dask]")
    if workers is None:
        workers = min(thread_count(), tasks // _WORTH) if installed else 1
    if scheduler is None and workers <= 1:
        yield Here()
        return
    from airlight.studies.distribution.dask_runner import connected, started

    with connected(scheduler) if scheduler is not None else started(workers) as runner:
        yield runner
