"""Waiting for a page by polling, since a page may forbid the evaluation of strings."""

from __future__ import annotations

import time
from typing import Any

#: Time limit, generous for two busy cores on which the solver may have to be compiled first. [s]
PATIENCE = 300.0


def until(page: Any, expression: str, seconds: float = PATIENCE) -> Any:
    """Value of an expression once it is truthy."""
    end = time.monotonic() + seconds
    while True:
        value = page.evaluate(expression)
        if value:
            return value
        assert time.monotonic() < end, f"waited {seconds:.0f} s for {expression}"
        page.wait_for_timeout(50)
