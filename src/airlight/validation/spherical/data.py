"""Independent spherical radiances, read from two files of reference data."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError
from airlight.planets import Planet
from airlight.validation.cases import CaseLines
from airlight.validation.reference_earth import reference_earth

FloatArray = NDArray[np.float64]

#: Radiances of a backward Monte Carlo in exact spherical shells.
MONTE_CARLO: Final = "spherical-monte-carlo.csv"
#: Radiances of Bruneton's implementation of 2017.
BRUNETON: Final = "bruneton2017-radiances.csv"
_NM: Final = (680, 550, 440)


@dataclass(frozen=True)
class ReferenceScene:
    """Lines of sight of one planet with their reference radiances.

    Attributes
    ----------
    name : str
        Name of the atmosphere, as in the file.
    albedo : float
        Albedo of the ground. [1]
    geometry : CaseLines
        Lines of sight, arrays of shape (n,). [m], [deg]
    radiance, standard_error : array, shape (n, 3)
        Values at 680, 550 and 440 nm, per irradiance of the sun. [sr⁻¹]
    """

    name: str
    albedo: float
    geometry: CaseLines
    radiance: FloatArray
    standard_error: FloatArray

    @property
    def planet(self) -> Planet:
        """Planet of the radiances."""
        match self.name:
            case "full-cornette-shanks":
                return reference_earth(albedo=self.albedo, aerosol="cornette-shanks")
            case "full-henyey-greenstein":
                return reference_earth(albedo=self.albedo, aerosol="henyey-greenstein")
            case "rayleigh-only":
                return reference_earth(albedo=self.albedo, aerosol=None, ozone=False)
            case "rayleigh-ozone":
                return reference_earth(albedo=self.albedo, aerosol=None)
        raise FileError(MONTE_CARLO, f"scene {self.name!r} is unknown")

    @property
    def title(self) -> str:
        """Title for tables."""
        return f"{self.name}, albedo {self.albedo:g}"


def read_scenes(folder: Path) -> list[ReferenceScene]:
    """Read the scenes of the Monte Carlo file, in its order.

    Parameters
    ----------
    folder : Path
        Folder of reference data.
    """
    file = folder / MONTE_CARLO
    rows: dict[tuple[str, float], list[dict[str, str]]] = {}
    try:
        with file.open(encoding="utf-8", newline="") as stream:
            for row in csv.DictReader(stream):
                rows.setdefault((row["scene"], float(row["ground_albedo"])), []).append(row)
        scenes = [_scene(name, albedo, part) for (name, albedo), part in rows.items()]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise FileError(file, f"cannot be read: {error}") from error
    except KeyError as error:
        raise FileError(file, f"has no column {error}") from error
    except (TypeError, ValueError) as error:
        raise FileError(file, f"contains a value that is not a number: {error}") from error
    if not scenes:
        raise FileError(file, "contains no rows")
    return scenes


def _scene(name: str, albedo: float, rows: list[dict[str, str]]) -> ReferenceScene:
    def column(title: str) -> FloatArray:
        return np.array([float(row[title]) for row in rows])

    def rgb(quantity: str) -> FloatArray:
        return np.stack([column(f"{quantity}_{nm}nm") for nm in _NM], axis=1)

    geometry = CaseLines(
        altitude=column("altitude_m"),
        sun_zenith=column("sun_zenith_deg"),
        view_zenith=column("view_zenith_deg"),
        azimuth=column("azimuth_deg"),
    )
    return ReferenceScene(name, albedo, geometry, rgb("radiance"), rgb("standard_error"))


def read_bruneton(folder: Path) -> tuple[FloatArray, FloatArray]:
    """Read the radiances of Bruneton's implementation, for lines of sight from the ground.

    Returns
    -------
    geometry : array, shape (n, 3)
        Sun zenith, view zenith, azimuth. [deg]
    radiance : array, shape (n, 3)
        Radiance at 680, 550 and 440 nm. [W m⁻² sr⁻¹ nm⁻¹]
    """
    file = folder / BRUNETON
    try:
        lines = [x for x in file.read_text(encoding="utf-8").splitlines() if x[:1] not in ("#", "")]
        table = np.array([[float(x) for x in line.split(",")] for line in lines[1:]])
    except (OSError, UnicodeDecodeError) as error:
        raise FileError(file, f"cannot be read: {error}") from error
    except ValueError as error:
        raise FileError(file, f"contains a value that is not a number: {error}") from error
    if table.ndim != 2 or table.shape[1] != 6:
        raise FileError(file, "is not a table of six columns")
    return table[:, :3], table[:, 3:]
