"""Independent tasks in this process, in processes of this machine, or on a cluster."""

from __future__ import annotations

from airlight.studies.distribution.opening import opened_runner
from airlight.studies.distribution.runner import Runner

__all__ = ["Runner", "opened_runner"]
