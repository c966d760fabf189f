"""Waiting for a page: asked again and again, since a page may forbid text that becomes code."""

from __future__ import annotations

import time
from typing import Any

#: Two busy cores are slow. [s]
PATIENCE = 120.0


def until(page: Any, expression: str, seconds: float = PATIENCE) -> Any:
    """The value of an expression once it is true."""
    end = time.monotonic() + seconds
    while True:
        value = page.evaluate(expression)
        if value:
            return value
        assert time.monotonic() < end, f"waited {seconds:.0f} s for {expression}"
        page.wait_for_timeout(50)
