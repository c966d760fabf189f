"""Metadata of picture files, common to all formats."""

from __future__ import annotations

from collections.abc import Mapping

from airlight.files.provenance import version
from airlight.plain_text import plain

#: Prefix of airlight's names, because formats define an ``altitude`` themselves.
PREFIX = "airlight."


def header(metadata: Mapping[str, str]) -> dict[str, str]:
    """Metadata for a file.

    Parameters
    ----------
    metadata : mapping of str to str
        Texts by name, such as ``400000 m`` for ``altitude``.

    Returns
    -------
    dict of str to str
        Printable texts with the prefix ``airlight.``, and ``airlight.version``.

    Examples
    --------
    >>> header({"altitude": "400000 m"})["airlight.altitude"]
    '400000 m'
    """
    out = {PREFIX + "version": version()}
    for name, text in metadata.items():
        out[PREFIX + name] = " ".join(plain(text).split())
    return out
