"""Tables of the optical depth and brightness of rings by radius: CSV with a cited header."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.errors import FileError, ParameterError
from airlight.files.input_files import read_text
from airlight.physics.data_tables.data_table import Quantity
from airlight.physics.data_tables.text_tables import read_text_table
from airlight.physics.optics.data_files import data_names, data_text

FloatArray = npt.NDArray[np.float64]

#: Prefix of the file names of the tables that ship with the package.
_PREFIX: Final = "rings-"
#: Columns of a table.
_RADIUS: Final = Quantity(name="radius", unit="m", low=0.0, above=True, units="m, km")
_DEPTH: Final = Quantity(name="optical_depth", unit="1", low=0.0)
_BRIGHTNESS: Final = Quantity(name="brightness", unit="1", low=0.0)


@dataclass(frozen=True, eq=False)
class RingProfile:
    """Normal optical depth over radius.

    Attributes
    ----------
    radii, depths : array, shape (n,)
        Radii, ascending [m], and optical depths [1].
    brightness : array, shape (n,)
        Relative single-scattering albedo. [1]
    """

    radii: FloatArray
    depths: FloatArray
    brightness: FloatArray


@cache
def ring_profiles() -> tuple[str, ...]:
    """Names of the tables that ship with the package.

    Examples
    --------
    >>> ring_profiles()
    ('saturn',)
    """
    return data_names(_PREFIX)


@cache
def read_ring_profile(name: str) -> RingProfile:
    """Profile of the package, or of a CSV file of the same format.

    Parameters
    ----------
    name : str
        One of ``ring_profiles()``, or the path to a CSV file with the columns ``radius_km`` (or
        ``radius [m]``), ascending, ``optical_depth``, and optionally ``brightness``.

    Raises
    ------
    ParameterError
        If there is no such table.
    FileError
        If the file cannot be read or is not of this format.

    Examples
    --------
    >>> profile = read_ring_profile("saturn")
    >>> float(np.interp(133.6e6, profile.radii, profile.depths)) < 0.1  # gap of Encke
    True
    """
    if name in ring_profiles():
        text = data_text(_PREFIX, name)
    elif Path(name).suffix == ".csv":
        text = read_text(Path(name))
    else:
        known = ", ".join(ring_profiles())
        raise ParameterError("profile", name, f"{known}; or the path to a CSV file")
    table = read_text_table(text, name)
    radii, depths = table.numbers(_RADIUS), table.numbers(_DEPTH)
    if radii.size < 2 or not (np.diff(radii) > 0.0).all():
        raise FileError(name, "is not a profile of rings: two or more radii, ascending")
    brightness = np.ones_like(radii)
    if table.find(_BRIGHTNESS) is not None:
        brightness = table.numbers(_BRIGHTNESS)
    for array in (radii, depths, brightness):
        array.flags.writeable = False
    return RingProfile(radii, depths, brightness)
