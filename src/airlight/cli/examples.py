"""Examples at the end of the commands' help."""

from __future__ import annotations


def examples(*lines: str) -> str:
    r"""Typer epilogue with command lines under the heading "Examples".

    Parameters
    ----------
    *lines : str
        Command lines.

    Returns
    -------
    str
        Paragraph that is not wrapped, because of ``\b``.

    Examples
    --------
    >>> examples("airlight planets")
    '\x08\nExamples:\n  $ airlight planets'
    """
    return "\n".join(["\b", "Examples:", *(f"  $ {line}" for line in lines)])
