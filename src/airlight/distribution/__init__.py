"""Independent tasks on one process, on the processes of this machine, or on a cluster of machines.

Nothing here knows what a task computes.
"""

from __future__ import annotations

from airlight.distribution.opening import opened_runner
from airlight.distribution.runner import Runner

__all__ = ["Runner", "opened_runner"]
