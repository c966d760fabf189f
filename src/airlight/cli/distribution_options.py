"""Options of parallel execution: ``--workers``, ``--scheduler``."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Any

import typer

from airlight.errors import ParameterError


@dataclass(frozen=True, kw_only=True)
class DistributionOptions:
    """Options of parallel execution."""

    scheduler: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="Address of a Dask scheduler, tcp://host:8786."),
    ] = None
    workers: Annotated[
        int | None,
        typer.Option(
            metavar="N",
            help="Number of local processes; 1: this process only (number of CPU cores).",
        ),
    ] = None

    def keywords(self) -> dict[str, Any]:
        """Keyword arguments of work in parallel."""
        return {"scheduler": self.scheduler, "workers": self.workers}

    @contextlib.contextmanager
    def named(self) -> Iterator[None]:
        """Put the option's name into errors about it."""
        try:
            yield
        except ParameterError as error:
            if error.field not in ("scheduler", "workers"):
                raise
            raise error.named(f"--{error.field}") from None
