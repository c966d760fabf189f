"""What went wrong, in one line: for a status line, beside a picture that goes on."""

from __future__ import annotations

from airlight.errors import AirlightError


def one_line(error: Exception) -> str:
    r"""An error as one line: the project's own speak for themselves, others with their type.

    Parameters
    ----------
    error : Exception
        Whatever was raised.

    Returns
    -------
    str

    Examples
    --------
    >>> one_line(AirlightError("the shell is empty"))
    'the shell is empty'
    >>> one_line(ValueError("no\n  such thing"))
    'ValueError: no such thing'
    """
    if isinstance(error, AirlightError):
        return str(error)
    return f"{type(error).__name__}: {' '.join(str(error).split())}"
