"""Exceptions and warnings of airlight, each with a message of one clear line."""

from __future__ import annotations

import sys
import warnings
from pathlib import Path

from airlight.plain_text import plain


class AirlightError(Exception):
    """Base of every error that airlight raises on purpose, with a message of one line."""

    def __str__(self) -> str:
        return plain(super().__str__())


class ParameterError(AirlightError, ValueError):
    """Unusable value, with its field and what is allowed.

    Parameters
    ----------
    field : str
        Path of the value, with dots and indices: ``constituents[1].scattering``.
    value : object
        Value as it was given.
    allowed : str
        Allowed range or forms, in words.
    file : str or Path, optional
        File that holds the field.

    Examples
    --------
    >>> raise ParameterError("ground.albedo", 1.5, "0 to 1")
    Traceback (most recent call last):
    ...
    airlight.errors.ParameterError: ground.albedo is 1.5; allowed: 0 to 1
    """

    def __init__(
        self, field: str, value: object, allowed: str, file: str | Path | None = None
    ) -> None:
        self.field = field
        self.value = value
        self.allowed = allowed
        self.file = file
        super().__init__(field, value, allowed, file)

    def __str__(self) -> str:
        shown = " ".join(repr(self.value).split())
        if len(shown) > 120:
            shown = shown[:117] + "..."
        where = "" if self.file is None else f"{self.file}: "
        return plain(f"{where}{self.field} is {shown}; allowed: {self.allowed}")

    def in_file(self, file: str | Path) -> ParameterError:
        """Same error with the name of the file that holds the field."""
        return ParameterError(self.field, self.value, self.allowed, file)


class FileError(AirlightError):
    """File that cannot be read or written, with the reason."""

    def __init__(self, file: str | Path, reason: str) -> None:
        self.file = file
        self.reason = " ".join(reason.split())
        super().__init__(file, reason)

    def __str__(self) -> str:
        return plain(f"{self.file}: {self.reason}")


class ConvergenceError(AirlightError):
    """Iteration that did not reach its tolerance within the allowed number of sweeps."""


class CostError(AirlightError):
    """Work that needs more memory than this machine has, refused before it begins."""


class WorkerError(AirlightError):
    """Process or machine that took part in a computation and was lost."""


class Cancelled(AirlightError):
    """Long computation stopped at the caller's request."""


class AirlightWarning(UserWarning):
    """Base of every warning that airlight gives, with a message of one line."""


def warn(line: str) -> None:
    """Warn of a result that is not what it seems; shown once for each line of the caller's code.

    Parameters
    ----------
    line : str
        Message: what is off, and by how much.
    """
    frame, level = sys._getframe(1), 2
    while frame.f_back is not None and frame.f_globals.get("__name__", "").startswith("airlight."):
        frame, level = frame.f_back, level + 1
    warnings.warn(plain(line), AirlightWarning, stacklevel=level)
