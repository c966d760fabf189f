"""The command line."""

from __future__ import annotations

from airlight.cli.app import main

__all__ = ["main"]
