"""Exceptions and warnings of airlight, with one-line messages."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Final

from airlight.plain_text import brief, plain

#: Length of the joined messages of several errors; in the second half, allowed values are omitted.
_LONGEST_LINE: Final = 800


class AirlightError(Exception):
    """Base of the errors raised by airlight, with a one-line message.

    Examples
    --------
    >>> import airlight
    >>> try:
    ...     airlight.load_planet("erth")
    ... except AirlightError as error:
    ...     print(str(error).partition(";")[0])
    planet is 'erth'
    """

    def __str__(self) -> str:
        return plain(brief(super().__str__()))


class ParameterError(AirlightError, ValueError):
    """Invalid value, with its field and the allowed values.

    Parameters
    ----------
    field : str
        Path of the value, with dots and indices: ``constituents[1].scattering``.
    value : object
        Given value.
    allowed : str
        Allowed range or forms, in words.
    file : str or Path, optional
        File of the field.

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
        where = "" if self.file is None else f"{brief(self.file, whole=200)}: "
        return plain(
            brief(f"{where}{brief(self.field, whole=200)} is {shown}; allowed: {self.allowed}")
        )

    def named(self, field: str) -> ParameterError:
        """Copy with another name of the field."""
        return ParameterError(field, self.value, self.allowed, self.file)

    def in_file(self, file: str | Path | None) -> ParameterError:
        """Copy with the name of the file."""
        return ParameterError(self.field, self.value, self.allowed, file)


class ConflictError(ParameterError):
    """Field that requires or excludes another one.

    Parameters
    ----------
    field : str
        Path of the value, or name of the option.
    phrase : str
        Verb phrase: ``requires a time``, ``cannot be combined with a spectrum``.
    file : str or Path, optional
        File of the field.

    Examples
    --------
    >>> print(ConflictError("star.distance", "cannot be combined with irradiance"))
    star.distance cannot be combined with irradiance
    """

    def __init__(self, field: str, phrase: str, file: str | Path | None = None) -> None:
        super().__init__(field, None, phrase, file)
        self.args = (field, phrase, file)

    def __str__(self) -> str:
        where = "" if self.file is None else f"{brief(self.file, whole=200)}: "
        return plain(brief(f"{where}{brief(self.field, whole=200)} {self.allowed}"))

    def named(self, field: str) -> ConflictError:
        """Copy with another name of the field."""
        return ConflictError(field, self.allowed, self.file)

    def in_file(self, file: str | Path | None) -> ConflictError:
        """Copy with the name of the file."""
        return ConflictError(self.field, self.allowed, file)


class ParameterErrors(ParameterError):
    """Several invalid values, in one line; field, value and range are those of the first.

    Parameters
    ----------
    errors : sequence of ParameterError
        Errors, two or more.

    Examples
    --------
    >>> first = ParameterError("ground.albedo", 2, "0 to 1")
    >>> print(ParameterErrors([first, ParameterError("star.radius", -1, "0 or more")]))
    ground.albedo is 2; allowed: 0 to 1; also: star.radius is -1; allowed: 0 or more
    """

    def __init__(self, errors: Sequence[ParameterError]) -> None:
        self.errors = tuple(errors)
        first = self.errors[0]
        super().__init__(first.field, first.value, first.allowed, first.file)
        self.args = (self.errors,)

    def __str__(self) -> str:
        first, *others = self.errors
        parts = [str(first)]
        length = len(parts[0])
        for count, one in enumerate(others):
            whole = str(one.in_file(None))
            short = whole.partition("; allowed: ")[0]
            text = whole if length + len(whole) < _LONGEST_LINE // 2 else short
            if length + len(text) > _LONGEST_LINE:
                parts.append(f"and {len(others) - count} more")
                break
            parts.append(text)
            length += len(text) + len("; also: ")
        return "; also: ".join(parts)

    def named(self, field: str) -> ParameterError:
        """First of the errors, with another name of the field."""
        return self.errors[0].named(field)

    def in_file(self, file: str | Path | None) -> ParameterErrors:
        """Copy with the name of the file."""
        return ParameterErrors([one.in_file(file) for one in self.errors])


def changed(
    error: ParameterError, change: Callable[[ParameterError], ParameterError]
) -> ParameterError:
    """Error with ``change`` applied to each of its parts."""
    if isinstance(error, ParameterErrors):
        return ParameterErrors([change(one) for one in error.errors])
    return change(error)


class Collector:
    """Collector of the errors of several steps, raised together.

    Examples
    --------
    >>> collector = Collector()
    >>> for name, number in (("a", 1), ("b", -2), ("c", -3)):
    ...     with collector:
    ...         if number < 0:
    ...             raise ParameterError(name, number, "0 or more")
    >>> collector.raise_all()
    Traceback (most recent call last):
    ...
    airlight.errors.ParameterErrors: b is -2; allowed: 0 or more; also: c is -3; allowed: 0 or more
    """

    def __init__(self) -> None:
        self.errors: list[ParameterError] = []

    def __enter__(self) -> None:
        """Begin a step."""

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> bool:
        """Collect the step's error, if it is a ``ParameterError``."""
        if isinstance(error, ParameterErrors):
            self.errors += error.errors
        elif isinstance(error, ParameterError):
            self.errors.append(error)
        return isinstance(error, ParameterError)

    def raise_all(self) -> None:
        """Raise the collected error; several are combined."""
        if len(self.errors) == 1:
            raise self.errors[0]
        if self.errors:
            raise ParameterErrors(self.errors)


class FileError(AirlightError):
    """File that cannot be read or written, with the reason.

    Examples
    --------
    >>> print(FileError("sky.csv", "is empty"))
    sky.csv: is empty
    """

    def __init__(self, file: str | Path, reason: str) -> None:
        self.file = file
        self.reason = " ".join(reason.split())
        super().__init__(file, reason)

    def __str__(self) -> str:
        return plain(brief(f"{brief(self.file, whole=200)}: {self.reason}"))


class ConvergenceError(AirlightError):
    """Iteration that did not reach its tolerance within the allowed number of sweeps.

    Examples
    --------
    >>> import airlight
    >>> from airlight.solver.moments.settings import settings_for
    >>> hasty = airlight.replace(settings_for("preview"), max_sweeps=1)
    >>> try:
    ...     airlight.solve("mars-standard", [550.0], hasty, cache=False)
    ... except ConvergenceError as error:
    ...     print(str(error)[:14])
    after 1 sweeps
    """


class CostError(AirlightError):
    """Computation that needs more memory than is free, rejected in advance."""


class WorkerError(AirlightError):
    """Loss of a process or machine of a distributed computation."""


class Cancelled(AirlightError):
    """Computation cancelled by the caller.

    Examples
    --------
    >>> import airlight
    >>> try:
    ...     airlight.solve("mars-rayleigh", quality="preview", cancel=lambda: True, cache=False)
    ... except Cancelled:
    ...     print("no result")
    no result
    """


class AirlightWarning(UserWarning):
    """Base of the warnings of airlight, with a one-line message.

    Examples
    --------
    >>> with warnings.catch_warnings(record=True) as issued:
    ...     warnings.simplefilter("error", AirlightWarning)  # stop at results of less accuracy
    """


def warn(line: str) -> None:
    """Issue a warning about a result, shown once per line of the caller's code.

    Parameters
    ----------
    line : str
        Message, with the size of the effect.
    """
    frame, level = sys._getframe(1), 2
    while frame.f_back is not None and frame.f_globals.get("__name__", "").startswith("airlight."):
        frame, level = frame.f_back, level + 1
    warnings.warn(plain(brief(line)), AirlightWarning, stacklevel=level)
