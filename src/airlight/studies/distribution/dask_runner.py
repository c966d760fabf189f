"""Tasks on Dask: processes of this machine, or a cluster by its address."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import tempfile
from collections.abc import Callable, Iterable, Iterator
from itertools import islice
from pathlib import Path
from typing import Any, Final

from airlight.child_processes import deaf_to_interrupts, folder_of_children, safe_path
from airlight.errors import WorkerError
from airlight.kernel.threads import thread_count
from airlight.studies.distribution.runner import Name, Task

#: Number of tasks queued at each worker while it runs another, so that it is never idle.
_AHEAD: Final = 1
#: Time to find a scheduler, and to end. [s]
_FINDING: Final = 10
_ENDING: Final = 5
#: Time after which a lost scheduler is abandoned, and limit for starting a process. [s]
_LOST: Final = 10
_STARTING: Final = 120


class DaskRunner:
    """Workers of a Dask cluster as a ``Runner``.

    Parameters
    ----------
    client : distributed.Client
        Connection to the scheduler.
    local : bool
        Whether the workers are processes of this machine.
    """

    def __init__(self, client: Any, *, local: bool) -> None:
        self._client, self._local = client, local

    @property
    def workers(self) -> int:
        """See ``Runner``."""
        return max(1, len(self._client.scheduler_info(n_workers=-1)["workers"]))

    @property
    def description(self) -> str:
        """See ``Runner``."""
        if self._local:
            return f"{self.workers} processes"
        return f"{self.workers} workers of {self._client.scheduler.address}"

    def run(
        self, function: Callable[..., Any], tasks: Iterable[Task[Name]]
    ) -> Iterator[tuple[Name, Any]]:
        """See ``Runner``."""
        from distributed import as_completed

        waiting = iter(tasks)
        names: dict[Any, Name] = {}

        def submitted(count: int) -> list[Any]:
            some = []
            for name, arguments in islice(waiting, count):
                future = self._client.submit(function, *arguments, pure=False)
                names[future] = name
                some.append(future)
            return some

        with _explained(self._client):
            ending = as_completed(submitted((1 + _AHEAD) * self.workers))
            for future in ending:
                result = future.result()
                name = names.pop(future)
                del future  # the worker may forget it
                yield name, result
                for one in submitted(max(0, (1 + _AHEAD) * self.workers - len(names))):
                    ending.add(one)

    def once_per_machine(self, function: Callable[..., Any], *arguments: Any) -> None:
        """See ``Runner``."""
        if self._local:
            return
        with _explained(self._client):
            first: dict[str, str] = {}
            for address, worker in self._client.scheduler_info(n_workers=-1)["workers"].items():
                first.setdefault(worker["host"], address)
            futures = [
                self._client.submit(
                    function, *arguments, pure=False, workers=[address], allow_other_workers=True
                )
                for address in first.values()
            ]
            for future in futures:
                future.result()


@contextlib.contextmanager
def _explained(client: Any) -> Iterator[None]:
    """Convert the loss of workers or of the scheduler to a one-line error."""
    from distributed import CancelledError, KilledWorker
    from distributed.comm.core import CommClosedError

    try:
        yield
    except KilledWorker as error:
        allowed = f"{error.task} ended its worker {error.allowed_failures + 1} times"
        raise WorkerError(f"{allowed}: too little memory?") from None
    except (CancelledError, CommClosedError, TimeoutError, asyncio.CancelledError) as error:
        address = getattr(client.scheduler, "address", "the scheduler")
        raise WorkerError(f"lost the scheduler at {address}: {_first_line(error)}") from None


def _first_line(error: BaseException) -> str:
    return (str(error).strip().splitlines() or [type(error).__name__])[0]


@contextlib.contextmanager
def _settings(patience: int) -> Iterator[None]:
    """Settings of Dask while a runner is open: timeouts [s], folder, no logs."""
    import dask

    own = {
        "distributed.comm.timeouts.connect": f"{patience}s",
        "distributed.worker.daemon": True,
        "distributed.admin.large-graph-warning-threshold": "200MB",
        "distributed.logging.distributed": "critical",
    }
    with (
        tempfile.TemporaryDirectory(prefix="airlight-", ignore_cleanup_errors=True) as folder,
        folder_of_children(Path(folder)),
        safe_path(),
        _quiet(),
        dask.config.set({**own, "temporary-directory": folder}),
    ):
        yield


@contextlib.contextmanager
def started(workers: int) -> Iterator[DaskRunner]:
    """Context with processes that share the cores of this machine.

    Parameters
    ----------
    workers : int
        Number of processes, each with an equal share of the threads.
    """
    from distributed import Client, LocalCluster

    threads = max(1, thread_count() // workers)
    with _settings(_STARTING):
        try:
            with deaf_to_interrupts():
                cluster = LocalCluster(
                    n_workers=workers,
                    threads_per_worker=1,
                    processes=True,
                    memory_limit=0,
                    host="127.0.0.1",
                    dashboard_address="127.0.0.1:0",
                    silence_logs=logging.CRITICAL,
                    env={"AIRLIGHT_THREADS": str(threads)},
                    preload="airlight.studies.distribution.worker_process",
                )
        except RuntimeError as error:
            raise WorkerError(f"processes cannot be started: {_first_line(error)}") from None
        client = None
        try:
            client = Client(cluster)
            yield DaskRunner(client, local=True)
        finally:
            _closed(client, cluster)


@contextlib.contextmanager
def connected(address: str) -> Iterator[DaskRunner]:
    """Context with the connection to a running cluster.

    Parameters
    ----------
    address : str
        Address of its scheduler.
    """
    from distributed import Client

    with _settings(_LOST):
        try:
            client = Client(address, timeout=_FINDING)
        except (OSError, ValueError, TimeoutError) as error:
            raise WorkerError(f"no scheduler at {address}: {_first_line(error)}") from None
        try:
            try:
                client.wait_for_workers(1, timeout=_FINDING)
            except TimeoutError:
                raise WorkerError(f"the scheduler at {address} has no worker") from None
            yield DaskRunner(client, local=False)
        finally:
            _closed(client, None)


def _closed(client: Any, cluster: Any) -> None:
    for one in (client, cluster):
        if one is not None:
            with contextlib.suppress(Exception):
                one.close(timeout=_ENDING)


@contextlib.contextmanager
def _quiet() -> Iterator[None]:
    """Silence the log of Dask: task errors are raised, lost workers replaced."""
    import distributed  # noqa: F401 - it gives loggers below its own their levels

    own = ("distributed", "asyncio", "tornado")
    known = [name for name in logging.root.manager.loggerDict if name.partition(".")[0] in own]
    loggers = [logging.getLogger(name) for name in {*own, *known}]
    levels = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for logger, level in zip(loggers, levels, strict=True):
            logger.setLevel(level)
