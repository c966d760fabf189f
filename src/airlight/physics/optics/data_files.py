"""CSV files of optical data that ship with the package, by prefix and name."""

from __future__ import annotations

from importlib import resources


def data_names(prefix: str) -> tuple[str, ...]:
    """Names of the files ``PREFIXname.csv``, sorted.

    Examples
    --------
    >>> data_names("rings-")
    ('saturn',)
    """
    folder = resources.files("airlight.physics.optics") / "data"
    found = [entry.name for entry in folder.iterdir() if entry.name.startswith(prefix)]
    return tuple(sorted(name.removeprefix(prefix).removesuffix(".csv") for name in found))


def data_text(prefix: str, name: str) -> str:
    """Text of the file ``PREFIXname.csv``."""
    file = resources.files("airlight.physics.optics") / "data" / f"{prefix}{name}.csv"
    return file.read_text(encoding="utf-8")
