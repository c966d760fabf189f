"""Named quality levels of the solvers' settings."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

from airlight.errors import ParameterError

S = TypeVar("S")


def settings_by_name(quality: str | S, known: Mapping[str, S]) -> S:
    """Settings of a named quality level; settings are returned as they are.

    Parameters
    ----------
    known : mapping of str to Settings
        Quality levels of a solver.

    Examples
    --------
    >>> settings_by_name("fine", {"default": 1, "fine": 2}), settings_by_name(7, {"default": 1})
    (2, 7)
    """
    if isinstance(quality, type(next(iter(known.values())))):
        return quality
    if not isinstance(quality, str) or quality not in known:
        raise ParameterError("quality", quality, ", ".join(known))
    return known[quality]
