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
        Paragraphs, each printed by the help on its own line.

    Examples
    --------
    >>> examples("airlight planets")
    'Examples:\n\n$ airlight planets'
    """
    return "\n\n".join(["Examples:", *(f"$ {line}" for line in lines)])
