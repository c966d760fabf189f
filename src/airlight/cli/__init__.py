"""The command line."""

from __future__ import annotations

from airlight.cli.app import main, run_process

__all__ = ["main", "run_process"]
