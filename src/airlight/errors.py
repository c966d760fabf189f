"""The exceptions that airlight raises: one clear line each."""

from __future__ import annotations

from pathlib import Path


class AirlightError(Exception):
    """Base of every error that airlight raises on purpose; its text is one line."""


class ParameterError(AirlightError, ValueError):
    """A value that cannot be used: names the field, the value and what is allowed.

    Parameters
    ----------
    field : str
        Where the value stands, with dots and indices: ``constituents[1].scattering``.
    value : object
        The value as it was given.
    allowed : str
        The allowed range or the allowed forms, in words.
    file : str or Path, optional
        The file that holds the field.

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
        return f"{where}{self.field} is {shown}; allowed: {self.allowed}"

    def in_file(self, file: str | Path) -> ParameterError:
        """The same error with the name of the file that holds the field."""
        return ParameterError(self.field, self.value, self.allowed, file)


class FileError(AirlightError):
    """A file that cannot be read or written: names the file and the reason."""

    def __init__(self, file: str | Path, reason: str) -> None:
        self.file = file
        self.reason = " ".join(reason.split())
        super().__init__(file, reason)

    def __str__(self) -> str:
        return f"{self.file}: {self.reason}"


class ConvergenceError(AirlightError):
    """A solver used up its allowed sweeps before it reached its tolerance."""


class Cancelled(AirlightError):
    """The caller asked a long computation to stop."""
