"""The examples at the end of each command's help."""

from __future__ import annotations


def examples(*lines: str) -> str:
    r"""Format command lines under the word "Examples" for Typer's epilogue.

    Parameters
    ----------
    *lines : str
        Commands, one each.

    Returns
    -------
    str
        Paragraph whose lines the help does not wrap, which ``\b`` says.

    Examples
    --------
    >>> examples("airlight planets")
    '\x08\nExamples:\n  $ airlight planets'
    """
    return "\n".join(["\b", "Examples:", *(f"  $ {line}" for line in lines)])
