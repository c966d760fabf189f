"""Command line."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from airlight.cli.app import main

__all__ = ["main", "run_process"]


def run_process() -> int:
    """Run the command line as the main program; returns the exit status.

    ``--version`` does not import the command parser.
    """
    if sys.argv[1:] == ["--version"]:
        from airlight.cli.version import version_line

        print(version_line())
        return 0
    from airlight.cli.interrupt import end_at_once

    end_at_once()  # while the rest is imported
    from airlight.cli import app

    return app.run_process()


def __getattr__(name: str) -> Any:
    if name != "main":
        raise AttributeError(f"module 'airlight.cli' has no attribute {name!r}")
    from airlight.cli.app import main

    return main
