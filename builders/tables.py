"""Write a spectral table as CSV with a cited header, the form that ``spectra`` reads."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

DATA = Path(__file__).parents[1] / "src" / "airlight" / "physics" / "spectra" / "data"


def write_table(
    name: str,
    header: dict[str, str | Sequence[str]],
    columns: Sequence[str],
    wavelengths: NDArray[np.float64],
    values: NDArray[np.float64],
    digits: int,
) -> Path:
    """Write ``<name>.csv``: ``# key: text`` lines, one line of column names, one row a wavelength.

    Parameters
    ----------
    name : str
        The file's stem, by which the package calls the table.
    header : dict
        ``quantity``, ``unit``, ``source``, ``licence``; ``note`` may be several lines.
    columns : sequence of str, length k
        Names of the value columns.
    wavelengths : array, shape (n,)
        [nm]
    values : array, shape (n, k)
    digits : int
        Significant digits written.

    Returns
    -------
    Path
        The file written.
    """
    lines = []
    for key, text in header.items():
        lines += [f"# {key}: {line}" for line in ([text] if isinstance(text, str) else text)]
    lines.append(",".join(["wavelength_nm", *columns]))
    for wavelength, row in zip(wavelengths, values, strict=True):
        lines.append(",".join([f"{wavelength:g}", *(f"{value:.{digits}g}" for value in row)]))
    path = DATA / f"{name}.csv"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path
