"""``Runner``: interface of task runners."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator
from typing import Any, Protocol, TypeAlias, TypeVar

Name = TypeVar("Name", bound=Hashable)
#: Name of a task, and the arguments of its function.
Task: TypeAlias = tuple[Name, tuple[Any, ...]]


class Runner(Protocol):
    """Processes that run tasks.

    Attributes
    ----------
    workers : int
        Number of tasks that run at a time.
    description : str
        Description for messages: ``4 processes``.
    """

    @property
    def workers(self) -> int:
        """Number of tasks that run at a time."""

    @property
    def description(self) -> str:
        """Description for messages."""

    def run(
        self, function: Callable[..., Any], tasks: Iterable[Task[Name]]
    ) -> Iterator[tuple[Name, Any]]:
        """Run tasks, and yield name and result of each on completion.

        Tasks are taken as workers become free, so that neither tasks nor results have to fit into
        memory.

        Parameters
        ----------
        function : callable
            Module-level function, importable by other processes.
        tasks : iterable
            Names and arguments.

        Yields
        ------
        (name, result)
            In order of completion.
        """

    def once_per_machine(self, function: Callable[..., Any], *arguments: Any) -> None:
        """Run a function on every other machine, before tasks that use its results on disk."""
