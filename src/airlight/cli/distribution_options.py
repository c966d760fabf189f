"""Options that say who runs many tasks: ``--workers``, ``--scheduler``."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Annotated

import typer

from airlight.errors import ParameterError

Scheduler = Annotated[
    str | None,
    typer.Option(
        metavar="ADDRESS", help="Of a Dask cluster, tcp://host:8786, whose workers do the work."
    ),
]
Workers = Annotated[
    int | None,
    typer.Option(
        metavar="N",
        help="Processes of this machine, which share its cores; 1 is this process alone. If "
        "left out as many as there are CPU cores.",
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
        raise ParameterError(f"--{error.field}", error.value, error.allowed) from None
