"""Printable text from untrusted names, paths and values, without control characters."""

from __future__ import annotations

import re
from typing import Final

#: Characters that are not shown but obeyed, or that no output can encode: control characters, marks
#: that turn the direction of writing, separators of lines, halves of surrogate pairs.
_OBEYED: Final = re.compile(
    "[\x00-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ufeff\ud800-\udfff]"
)


def is_plain(text: str) -> bool:
    r"""Whether a text is printable.

    Examples
    --------
    >>> is_plain("Snow ❄ [/x] $x_{$"), is_plain("a\x1b[31mb"), is_plain("a\nb"), is_plain("\udc80")
    (True, False, False, False)
    """
    return _OBEYED.search(text) is None


def brief(text: object, most: int = 400, whole: int = 1000) -> str:
    """Abbreviated text for a message: long words, such as paths, and long lines.

    Parameters
    ----------
    text : object
        Text, or an object for ``str``.
    most, whole : int
        Largest length of a word, and of the text. [character]

    Examples
    --------
    >>> brief("no file a/very/long/path.toml here", most=15)
    'no file a/very...h.toml here'
    """
    line = re.sub(rf"\S{{{most + 1},}}", lambda match: _cut(match[0], most), str(text))
    return _cut(line, whole)


def _cut(text: str, most: int) -> str:
    half = (most - 3) // 2
    return text if len(text) <= most else f"{text[:half]}...{text[-half:]}"


def plain(text: object) -> str:
    r"""Single line of text with non-printable characters escaped.

    Parameters
    ----------
    text : object
        Text, or an object for ``str``. Line breaks and tabs become spaces.

    Returns
    -------
    str
        Line that any stream can encode.

    Examples
    --------
    >>> print(plain("a\x1b[31mred\n  \udc80"))
    a\x1b[31mred \udc80
    """
    line = re.sub(r"[ \t]*[\r\n\t]+[ \t]*", " ", str(text))
    return _OBEYED.sub(lambda match: ascii(match[0])[1:-1], line)
