"""Set-up of the processes that ``dask_runner`` starts: Dask imports this module in each of them."""

from __future__ import annotations

import signal
import warnings
from typing import Any

from airlight.errors import AirlightWarning


def dask_setup(worker: Any) -> None:
    """Leave Ctrl-C and warnings to the process that started them all.

    Parameters
    ----------
    worker : distributed.Worker
        Worker of this process.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    warnings.simplefilter("ignore", AirlightWarning)
