"""Options of parallel execution: ``--workers``, ``--scheduler``."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Annotated

import typer

from airlight.errors import ParameterError

Scheduler = Annotated[
    str | None,
    typer.Option(metavar="ADDRESS", help="Address of a Dask scheduler, tcp://host:8786."),
]
Workers = Annotated[
    int | None,
    typer.Option(
        metavar="N",
        help="Number of local processes; 1: this process only (number of CPU cores).",
    ),
]


@contextlib.contextmanager
def named() -> Iterator[None]:
    """Put the option's name into errors about it."""
    try:
        yield
    except ParameterError as error:
        if error.field not in ("scheduler", "workers"):
            raise
        raise error.named(f"--{error.field}") from None
