"""Runners: in this process, on processes of this machine, on a cluster by its address."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from importlib import util
from pathlib import Path

import pytest

from airlight.errors import ParameterError, WorkerError
from airlight.studies.distribution import opened_runner
from airlight.studies.distribution.here import Here


def squares(count: int) -> Iterator[tuple[int, tuple[int, int]]]:
    return ((n, (n, 2)) for n in range(count))


def test_one_worker_is_this_process() -> None:
    with opened_runner(100, workers=1) as runner:
        assert isinstance(runner, Here)
        assert dict(runner.run(pow, squares(5))) == {n: n * n for n in range(5)}


def test_few_tasks_start_no_process() -> None:
    with opened_runner(3) as runner:
        assert isinstance(runner, Here)


def test_processes_take_tasks_one_by_one() -> None:
    # a list that is far ahead of the results would not fit into memory
    taken, most = 0, 0

    def counted() -> Iterator[tuple[int, tuple[int, int]]]:
        nonlocal taken
        for task in squares(60):
            taken += 1
            yield task

    found = {}
    with opened_runner(60, workers=2) as runner:
        assert runner.workers == 2
        for name, value in runner.run(pow, counted()):
            found[name] = value
            most = max(most, taken - len(found))
        with pytest.raises(ZeroDivisionError):
            list(runner.run(divmod, [("a", (1, 0))]))
    assert found == {n: n * n for n in range(60)}
    assert most <= 4


@pytest.mark.parametrize(
    ("options", "line"),
    [
        ({"workers": 0}, "workers is 0; allowed: 1 to 256"),
        ({"workers": 2, "scheduler": "tcp://a:1"}, "cannot be combined with scheduler"),
    ],
)
def test_options_that_contradict_are_refused(options: dict, line: str) -> None:
    with pytest.raises(ParameterError, match=line), opened_runner(9, **options):
        pass


def test_dask_is_asked_for_by_name_where_it_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(util, "find_spec", lambda name: None)
    for options in ({"workers": 2}, {"scheduler": "tcp://localhost:1"}):
        with (
            pytest.raises(ParameterError, match=r"pip install airlight\[dask\]"),
            opened_runner(9, **options),  # type: ignore[arg-type]
        ):
            pass
    with opened_runner(1000) as runner:
        assert isinstance(runner, Here)


def test_an_address_without_a_scheduler_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    from airlight.studies.distribution import dask_runner

    monkeypatch.setattr(dask_runner, "_FINDING", 1)
    with (
        pytest.raises(WorkerError, match=r"no scheduler at tcp://127\.0\.0\.1:9"),
        opened_runner(9, scheduler="tcp://127.0.0.1:9"),
    ):
        pass


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no kill -9")
def test_a_cluster_by_its_address_works_until_its_scheduler_is_lost(tmp_path: Path) -> None:
    file = tmp_path / "scheduler.json"
    server = "import sys; from distributed.cli.dask_{0} import main; main(sys.argv[1:])"
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    scheduler = subprocess.Popen(
        [sys.executable, "-c", server.format("scheduler"), "--port", "0", "--host", "127.0.0.1",
         "--no-dashboard", "--scheduler-file", str(file)], **quiet)  # type: ignore[call-overload]  # fmt: skip
    worker = None
    try:
        import json

        deadline = time.monotonic() + 60.0
        # Dask's file is there before its text.
        while not (file.exists() and file.read_text().endswith("}")):
            assert time.monotonic() < deadline
            time.sleep(0.1)
        address = json.loads(file.read_text())["address"]
        worker = subprocess.Popen(
            [sys.executable, "-c", server.format("worker"), address, "--nthreads", "1",
             "--no-nanny", "--no-dashboard"], **quiet)  # type: ignore[call-overload]  # fmt: skip
        with opened_runner(50, scheduler=address) as runner:
            assert address in runner.description
            runner.once_per_machine(pow, 2, 2)
            assert dict(runner.run(pow, squares(20))) == {n: n * n for n in range(20)}
            with pytest.raises(WorkerError, match="lost the scheduler"):
                for number, _ in runner.run(pow, squares(100_000)):
                    if number == 5:
                        os.kill(scheduler.pid, signal.SIGKILL)
    finally:
        for process in (scheduler, worker):
            if process is not None:
                process.kill()
                process.wait()
