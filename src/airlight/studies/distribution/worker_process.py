"""Set-up of the processes of ``dask_runner``: Dask imports this module in each."""

from __future__ import annotations

import signal
import warnings
from typing import Any

from airlight.errors import AirlightWarning


def dask_setup(worker: Any) -> None:
    """Ignore Ctrl-C and warnings, which the parent process handles."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    warnings.simplefilter("ignore", AirlightWarning)
