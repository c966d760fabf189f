"""Options of parallel execution: ``--workers``, ``--scheduler``."""

from __future__ import annotations

from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import Annotated, Any

import typer

from airlight.cli.option_groups import named_errors


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
        """Keyword arguments of parallel execution."""
        return {"scheduler": self.scheduler, "workers": self.workers}

    def named(self) -> AbstractContextManager[None]:
        """Context that puts names of options into errors."""
        return named_errors("scheduler", "workers")
