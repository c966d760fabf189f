"""Ångström exponent of a constituent: evaluation and change."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.physics.spectra.power_law import power_law
from airlight.physics.units import quantities
from airlight.planets.medium import Medium
from airlight.planets.planet import Planet
from airlight.planets.reading.nested_tables import Tables
from airlight.planets.schema.measures import text_of

FloatArray = NDArray[np.float64]

#: Wavelengths that define the exponent, AERONET's. [nm]
BETWEEN: Final = (440.0, 870.0)
#: Wavelength at which a tilt has no effect. [nm]
_PIVOT: Final = 550.0
#: Keys of a constituent that are changed together, with their units; a tilt keeps the value of the
#: first at 550 nm.
COEFFICIENTS: Final = {
    "optical_depth": "1",
    "extinction": "1/m",
    "scattering": "1/m",
    "absorption": "1/m",
}
#: Range of wavelengths of a list made for a tilt, and its length. [nm]
_SPAN: Final = (380.0, 780.0)
_NODES: Final = 16


def angstrom_refused(constituent: Tables) -> str:
    """Reason why the Ångström exponent of a constituent cannot be changed; empty if it can."""
    given = [constituent[key] for key in COEFFICIENTS if key in constituent]
    phase = constituent.get("phase_function")
    if not given or any(isinstance(one, dict) for one in given):
        return "the exponent of a constituent that is given by coefficients or optical depths"
    if isinstance(phase, dict) and phase.get("kind") == "rayleigh":
        return "the exponent of particles; molecules have theirs"
    return ""


def exponent_of(planet: Planet, index: int) -> float:
    r"""Ångström exponent of a constituent's optical depth from 440 to 870 nm.

    .. math:: \alpha = -\frac{\ln(\tau_{870} / \tau_{440})}{\ln(870 / 440)}

    Over a smaller range if the constituent's is smaller.

    References
    ----------
    Eck et al. (1999), J. Geophys. Res. 104, 31333 (AERONET's wavelengths).
    """
    low, high = planet.wavelength_limits
    ends = [min(max(nm, low), high) for nm in BETWEEN]
    if ends[0] == ends[1]:
        return 0.0
    first, last = Medium.from_planet(planet, ends).vertical_optical_depth[index]
    if not (first > 0.0 and last > 0.0):
        return 0.0
    return float(-np.log(last / first) / np.log(ends[1] / ends[0]))


def tilted(
    constituent: Tables, by: float, wavelengths: FloatArray, limits: tuple[float, float]
) -> dict[str, Any]:
    """Table of a constituent with its spectrum multiplied by (λ / 550 nm)^-by.

    Parameters
    ----------
    constituent : dict
        Table of the constituent, accepted by ``angstrom_refused``.
    by : float
        Increase of the Ångström exponent.
    wavelengths : array, shape (nl,)
        Wavelengths of the data, for a new list. [nm]
    limits : (float, float)
        Wavelength range of the planet. [nm]

    Examples
    --------
    >>> haze = {"wavelengths": "440, 550 nm", "optical_depth": [0.2, 0.1]}
    >>> [round(x, 6) for x in tilted(haze, 1.0, np.array([500.0]), (300.0, 900.0))["optical_depth"]]
    [0.25, 0.1]
    """
    table = dict(constituent)
    if "wavelengths" in table:
        nm = np.array(quantities(table["wavelengths"], "nm", "wavelengths"))
    else:
        nm = _nodes(wavelengths, limits)
        table["wavelengths"] = [text_of(one, "nm") for one in nm.tolist()]
    power = (nm / _PIVOT) ** -by
    keep = 1.0
    for key, unit in COEFFICIENTS.items():
        if key not in table:
            continue
        old = np.broadcast_to(quantities(table[key], unit, key), nm.shape)
        if keep == 1.0:
            keep = _at_pivot(nm, old) / _at_pivot(nm, old * power) if old.any() else 1.0
        shown = unit.removeprefix("1") or "1"
        table[key] = [text_of(one, shown) for one in (keep * power * old).tolist()]
    return table


def _at_pivot(nm: FloatArray, values: FloatArray) -> float:
    return float(power_law(_PIVOT, nm, values))


def _nodes(wavelengths: FloatArray, limits: tuple[float, float]) -> FloatArray:
    """Wavelengths of a new list: those of the data and of vision, within the planet's range."""
    low = max(min(_SPAN[0], float(wavelengths.min())), limits[0])
    high = min(max(_SPAN[1], float(wavelengths.max())), limits[1])
    nodes = np.geomspace(low, high, _NODES) if high > low else np.array([low])
    if low < _PIVOT < high:
        nodes = np.append(nodes, _PIVOT)
    return np.unique(nodes.round(3))
