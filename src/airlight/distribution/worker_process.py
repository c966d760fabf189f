"""Set-up of the processes that ``dask_runner`` starts: Dask imports this module in each of them."""

from __future__ import annotations

import signal
from typing import Any


def dask_setup(worker: Any) -> None:
    """Leave Ctrl-C to the process that started them all, which ends them.

    Parameters
    ----------
    worker : distributed.Worker
        Worker of this process.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
