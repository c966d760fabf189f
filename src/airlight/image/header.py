"""Metadata in a picture's file, the same for every format."""

from __future__ import annotations

from collections.abc import Mapping

from airlight.files.provenance import version
from airlight.plain_text import plain

#: Prefix of our names, because formats have an ``altitude`` of their own.
PREFIX = "airlight."


def header(metadata: Mapping[str, str]) -> dict[str, str]:
    """Prepare metadata for a file.

    Parameters
    ----------
    metadata : mapping of str to str
        Names such as ``altitude`` with texts such as ``400000 m``.

    Returns
    -------
    dict of str to str
        Names prefixed with ``airlight.``, and ``airlight.version``; all characters
        are shown ones.

    Examples
    --------
    >>> header({"altitude": "400000 m"})["airlight.altitude"]
    '400000 m'
    """
    out = {PREFIX + "version": version()}
    for name, text in metadata.items():
        out[PREFIX + name] = " ".join(plain(text).split())
    return out
