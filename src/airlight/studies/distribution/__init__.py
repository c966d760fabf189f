"""Independent tasks on this process, on processes of this machine, or on a cluster.

Nothing here knows what a task computes.
"""

from __future__ import annotations

from airlight.studies.distribution.opening import opened_runner
from airlight.studies.distribution.runner import Runner

__all__ = ["Runner", "opened_runner"]
