"""``python -m airlight``: the command line."""

from airlight.cli import run_process

raise SystemExit(run_process())
