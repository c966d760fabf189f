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
        Words for a line about it: ``4 processes``.
    """

    @property
    def workers(self) -> int:
        """Number of tasks that run at a time."""

    @property
    def description(self) -> str:
        """Words for a line about it."""

    def run(
        self, function: Callable[..., Any], tasks: Iterable[Task[Name]]
    ) -> Iterator[tuple[Name, Any]]:
        """Run tasks, and yield name and result of each as it ends.

        Tasks are taken one by one as workers become free, so that neither a long list of them nor
        their results have to fit into memory.

        Parameters
        ----------
        function : callable
            Function of a module, which other processes can import.
        tasks : iterable
            Names and arguments.

        Yields
        ------
        (name, result)
            In the order in which tasks end.

        Raises
        ------
        WorkerError
            If the workers are lost; what was yielded before stays right.
        """

    def once_per_machine(self, function: Callable[..., Any], *arguments: Any) -> None:
        """Run a function on every other machine, before tasks that use its results on disk."""
