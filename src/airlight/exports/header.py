"""Metadata of a picture's file: names and texts that every format takes."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import metadata as distributions

#: Before every name of ours, because formats have an ``altitude`` of their own.
PREFIX = "airlight."


def header(metadata: Mapping[str, str]) -> dict[str, str]:
    """Metadata as it goes into a file.

    Parameters
    ----------
    metadata : mapping of str to str
        Names such as ``altitude`` with texts such as ``400000 m``.

    Returns
    -------
    dict of str to str
        Each name with ``airlight.`` before it, and ``airlight.version``; no control characters.

    Examples
    --------
    >>> header({"altitude": "400000 m"})["airlight.altitude"]
    '400000 m'
    """
    out = {PREFIX + "version": version()}
    for name, text in metadata.items():
        out[PREFIX + name] = " ".join(str(text).split())
    return out


def version() -> str:
    """The version of airlight that runs."""
    try:
        return distributions.version("airlight")
    except distributions.PackageNotFoundError:
        return "unknown"
