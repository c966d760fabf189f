"""Serial tasks in this process, each with all its threads."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any

from airlight.studies.distribution.runner import Name, Task


class Here:
    """Local process as a ``Runner``.

    Examples
    --------
    >>> list(Here().run(pow, [("square", (3, 2)), ("cube", (3, 3))]))
    [('square', 9), ('cube', 27)]
    """

    workers = 1
    description = "one process"

    def run(
        self, function: Callable[..., Any], tasks: Iterable[Task[Name]]
    ) -> Iterator[tuple[Name, Any]]:
        """See ``Runner``."""
        for name, arguments in tasks:
            yield name, function(*arguments)

    def once_per_machine(self, function: Callable[..., Any], *arguments: Any) -> None:
        """See ``Runner``: there is no other machine."""
