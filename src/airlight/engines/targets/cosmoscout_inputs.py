"""Inputs of CosmoScout VR's ``bruneton-preprocessor``: optics in CSV files, settings in JSON.

Molecules, particles and absorbers are three components, each with one density profile.
"""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.engines.baking.air_light import groups
from airlight.engines.targets.fits.formula_planet import per_wavelength
from airlight.errors import FileError
from airlight.planets.constituent import Constituent
from airlight.planets.ground import Ground
from airlight.planets.matter.phases import TabulatedPhase
from airlight.planets.matter.profiles import Tabulated
from airlight.planets.planet import Planet
from airlight.planets.star import Star

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

SETTINGS: Final = "preprocessor.json"
#: Number of wavelengths, a multiple of three, and their range. [nm]
COUNT: Final = 15
RANGE: Final = (360.0, 830.0)
#: Numbers of angles of the phase functions and of altitudes of the densities, both uniform.
ANGLES: Final = 721
ALTITUDES: Final = 501
#: Solar radius from which the preprocessor computes an angle by a distance. [m]
SUN_RADIUS: Final = 696_340_000.0
#: Orders of scattering: those of CosmoScout's Mars.
_ORDERS: Final = 10
_COMPONENTS: Final = ("molecules", "aerosols", "ozone")


def wavelengths_for(planet: Planet) -> FloatArray:
    """Fifteen equidistant wavelengths in the visible range of the planet. [nm]"""
    low, high = planet.wavelength_limits
    return np.linspace(max(low, RANGE[0]), min(high, RANGE[1]), COUNT).round(2)


def write_inputs(folder: Path, medium: Medium) -> None:
    """Write the CSV files and the settings.

    Parameters
    ----------
    medium : Medium
        Medium at ``wavelengths_for`` its planet.
    """
    gas, particles = groups(medium)
    others = [index for index in range(len(medium.names)) if index not in particles]
    altitudes = np.linspace(0.0, medium.thickness, ALTITUDES)
    density = medium.density.at(altitudes)
    nothing = np.zeros_like(medium.scattering)
    parts: dict[str, tuple[Sequence[int], FloatArray, FloatArray]] = {
        "molecules": (gas, medium.scattering, nothing),
        "aerosols": (particles, medium.scattering, medium.absorption),
        "ozone": (others, nothing, medium.absorption),
    }
    settings: dict[str, Any] = {
        "sunDistance": SUN_RADIUS / math.sin(medium.star_angular_radius),
        "minAltitude": medium.bottom_radius,
        "maxAltitude": medium.top_radius,
        "groundAlbedo": float(medium.ground_albedo.mean()),
        "multiScatteringOrder": _ORDERS,
        "refraction": bool(medium.refractivity.any()),
        "ior": float(medium.refractivity @ density[:, 0]),
    }
    for name, (members, scattering, absorption) in parts.items():
        chosen = list(members)
        weights = (scattering + absorption)[chosen].mean(axis=1) if chosen else np.zeros(0)
        shape = weights @ density[chosen] if chosen and weights.any() else np.zeros(ALTITUDES)
        largest = float(shape.max())
        shape = shape / largest if largest > 0.0 else np.ones(ALTITUDES)
        column = float(np.trapezoid(shape, altitudes))
        depths = [
            (one * medium.columns[:, None])[chosen].sum(axis=0) / column
            for one in (scattering, absorption)
        ]
        files = {"betaAbs": f"{name}_absorption.csv", "density": f"{name}_density.csv"}
        _write_rows(folder / files["density"], ["density"], shape[:, None])
        _write_spectrum(folder / files["betaAbs"], "beta_abs", medium, depths[1])
        if name != "ozone":
            files |= {"betaSca": f"{name}_scattering.csv", "phase": f"{name}_phase.csv"}
            _write_spectrum(folder / files["betaSca"], "beta_sca", medium, depths[0])
            _write_phase(folder / files["phase"], medium, chosen)
        settings[name] = files
    text = json.dumps(settings, indent=2) + "\n"
    (folder / SETTINGS).write_text(text, encoding="utf-8")


def planet_from_inputs(folder: str | Path, star: Star, name: str) -> Planet:
    """Planet from the preprocessor's inputs.

    Parameters
    ----------
    folder : str or Path
        Folder with ``preprocessor.json``.
    star : Star
        Light source; the inputs have only its size.
    """
    root = Path(folder)
    try:
        settings = json.loads((root / SETTINGS).read_text(encoding="utf-8"))
        thickness = settings["maxAltitude"] - settings["minAltitude"]
        constituents = []
        for component in _COMPONENTS:
            files = settings[component]
            density = _read_rows(root / files["density"])[1][:, 0]
            keys = [key for key in ("betaSca", "betaAbs") if key in files]
            spectra = {key: _read_spectrum(root / files[key]) for key in keys}
            if not any(values.any() for _, values in spectra.values()):
                continue
            nm, absorption = spectra["betaAbs"]
            scattering = spectra.get("betaSca", (nm, np.zeros_like(nm)))[1]
            altitudes = np.linspace(0.0, thickness, density.size)
            constituents.append(
                Constituent(
                    name=component,
                    profile=Tabulated(
                        altitudes=tuple(altitudes.tolist()), densities=tuple(density.tolist())
                    ),
                    scattering=per_wavelength(nm, scattering),
                    absorption=per_wavelength(nm, absorption),
                    phase_function=_read_phase(root / files["phase"]) if "phase" in files else None,
                )
            )
        return Planet(
            name=name,
            bottom_radius=float(settings["minAltitude"]),
            top_radius=float(settings["maxAltitude"]),
            ground=Ground(albedo=float(settings["groundAlbedo"])),
            star=star,
            constituents=tuple(constituents),
        )
    except (OSError, KeyError, ValueError, IndexError) as error:
        raise FileError(root, f"contains no inputs of the preprocessor: {error}") from error


def _write_rows(path: Path, header: Sequence[str], rows: ArrayLike) -> None:
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([f"{value:.9g}" for value in row] for row in np.asarray(rows))


def _write_spectrum(path: Path, name: str, medium: Medium, values: FloatArray) -> None:
    _write_rows(path, ["lambda", name], np.column_stack([1e-9 * medium.wavelengths, values]))


def _write_phase(path: Path, medium: Medium, members: Sequence[int]) -> None:
    """Write phase functions at equidistant angles, averaged over constituents by scattering."""
    angles = np.linspace(0.0, 180.0, ANGLES)
    if members:
        depth = (medium.scattering * medium.columns[:, None])[list(members)]
        share = depth / np.maximum(depth.sum(axis=0), 1e-300)
        own = medium.phase_function(np.cos(np.radians(angles)))[:, list(members)]
        values = (share * own).sum(axis=1).T
    else:
        values = np.full((medium.wavelengths.size, ANGLES), 0.25 / np.pi)
    header = ["lambda", *(f"{angle:g}" for angle in angles)]
    _write_rows(path, header, np.column_stack([1e-9 * medium.wavelengths, values]))


def _read_rows(path: Path) -> tuple[list[str], FloatArray]:
    with path.open(newline="", encoding="utf-8") as stream:
        header, *rows = csv.reader(stream)
    return header, np.array([[float(one) for one in row] for row in rows])


def _read_spectrum(path: Path) -> tuple[FloatArray, FloatArray]:
    rows = _read_rows(path)[1]
    return 1e9 * rows[:, 0], rows[:, 1]


def _read_phase(path: Path) -> TabulatedPhase:
    header, rows = _read_rows(path)
    return TabulatedPhase(
        angles=tuple(float(one) for one in header[1:]),
        rows=tuple(tuple(row) for row in rows[:, 1:].tolist()),
        wavelengths=tuple((1e9 * rows[:, 0]).tolist()),
    )
