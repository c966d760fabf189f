"""Numbers of reference data: comma-separated values below comments and a line of headings."""

from __future__ import annotations

from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError

FloatArray = NDArray[np.float64]


def read_table(file: Path | Traversable) -> tuple[list[str], FloatArray]:
    """Headings, and numbers by row and column.

    Raises
    ------
    FileError
        If the file cannot be read, or contains anything but a table of numbers.
    """
    try:
        lines = [line for line in file.read_text(encoding="utf-8").splitlines() if line.strip()]
        header, *body = [line for line in lines if not line.startswith("#")]
        table = np.array([[float(cell) for cell in line.split(",")] for line in body])
    except (OSError, UnicodeDecodeError) as error:
        raise FileError(str(file), f"cannot be read: {error}") from error
    except ValueError as error:
        raise FileError(str(file), f"is not a table of numbers: {error}") from error
    return header.split(","), table


def packaged_table(name: str) -> FloatArray:
    """Numbers of a file that ships with this package."""
    return read_table(files("airlight.validation").joinpath(name))[1]
