"""The examples at the end of each command's help."""

from __future__ import annotations


def examples(*lines: str) -> str:
    r"""Command lines under the word "Examples", as Typer's epilogue wants them.

    Parameters
    ----------
    *lines : str
        One command each.

    Returns
    -------
    str
        Paragraphs, each of which the help prints on a line of its own.

    Examples
    --------
    >>> examples("airlight planets")
    'Examples:\n\n$ airlight planets'
    """
    return "\n\n".join(["Examples:", *(f"$ {line}" for line in lines)])
