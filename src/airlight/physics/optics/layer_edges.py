"""Detection of elevated and of thin layers, whose boundaries end the panels of rays."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
import numpy.typing as npt

from airlight.physics.optics.density_profile import DENSE, THIN, DensitySegments, thin_runs

FloatArray = npt.NDArray[np.float64]

#: Number of altitudes at which profiles are sampled.
_SAMPLES: Final = 2001
#: Smallest ratio of the largest density to that at the ground in an elevated layer.
_ALOFT: Final = 2.0
#: Smallest scattering optical depth of a significant layer.
FAINT: Final = 1e-4
#: Width over the shell's thickness above which a layer is wide.
_WIDE: Final = 0.15
#: Distances, over the shell's thickness, below which edges of different layers, and both ends of a
#: layer, are merged.
_SPACING: Final = 0.015
_NARROW_SPACING: Final = 0.002


#: Largest width of a thin layer, over the shell's thickness, for absorption optical depths above a
#: limit; and for scattering optical depths of the atmosphere above a limit.
_WIDEST: Final = 0.25
_ABSORBING: Final = 0.3
_IN_DEEP_AIR: Final = 0.07
_DEEP: Final = 1.5


class ThinLayer(NamedTuple):
    """Geometrically thin layer.

    Attributes
    ----------
    bottom, top : float
        Altitudes at which its density is 1 % of the maximum. [m]
    """

    bottom: float
    top: float


def thin_layers(
    density: DensitySegments,
    scattering: FloatArray,
    absorption: FloatArray,
    *,
    widest: float | None = None,
) -> list[ThinLayer]:
    """Geometrically thin layers, in ascending order.

    They are thinner than 12 % of the shell (7 % in an optically thick atmosphere, whose levels
    follow its depth), 25 % with strong absorption, or 1.5 % at the ground.

    Parameters
    ----------
    density : DensitySegments
        Profiles of the constituents.
    scattering, absorption : array, shape (nc,)
        Largest coefficients of each constituent at relative density 1. [m⁻¹]
    widest : float, optional
        Largest width aloft instead, over the thickness of the shell. [1]

    Examples
    --------
    >>> from airlight.physics.optics.density_profile import exponential, tent
    >>> air = DensitySegments.from_rows([exponential(8e3, 1e5), tent(10e3, 100.0, 1e5)])
    >>> layers = thin_layers(air, np.array([1e-5, 1e-3]), np.zeros(2))
    >>> [(round(one.bottom, -1), round(one.top, -1)) for one in layers]
    [(9900.0, 10100.0)]
    """
    altitude, columns = density.node_altitudes, density.columns
    found: set[ThinLayer] = set()
    thin = THIN if scattering @ columns < _DEEP else _IN_DEEP_AIR
    for i, profile in enumerate(density.at_nodes):
        if (scattering[i] + absorption[i]) * columns[i] >= FAINT:
            absorbs = absorption[i] * columns[i] > _ABSORBING
            runs = thin_runs(profile, altitude, widest or (_WIDEST if absorbs else thin))
            found.update(ThinLayer(*ends) for ends in runs)
    return sorted(found)


def _samples(density: DensitySegments) -> FloatArray:
    """Sampling altitudes of the profiles: even, and denser where they vary fast. [m]"""
    steps = np.diff(density.first_nodes).astype(int)
    refined = np.repeat(steps > 1, steps)
    even = np.linspace(0.0, density.thickness, _SAMPLES)
    return np.union1d(even, density.node_altitudes[:-1][refined])


def layer_edges(
    density: DensitySegments,
    scattering: FloatArray,
    *,
    faint: float = FAINT,
    faint_and_wide: float = 0.0,
) -> FloatArray:
    """Altitudes of bottom, peak and top of each elevated scattering layer.

    Nearby edges of different layers are merged, and peaks next to edges omitted.

    Parameters
    ----------
    density : DensitySegments
        Profiles of the constituents.
    scattering : array, shape (nc,)
        Largest scattering coefficient of each constituent at relative density 1. [m⁻¹]
    faint : float
        Smallest scattering optical depth of a layer. [1]
    faint_and_wide : float
        Smallest scattering optical depth of a layer wider than 15 % of the shell. [1]

    Returns
    -------
    array, shape (n,)
        Altitudes, ascending, within the shell; empty without elevated layers. [m]

    Examples
    --------
    >>> from airlight.physics.optics.density_profile import exponential, tent
    >>> air = DensitySegments.from_rows([exponential(8e3, 1e5), tent(22e3, 5e3, 1e5)])
    >>> layer_edges(air, np.array([1e-5, 1e-5])).round(-2).tolist()
    [17100.0, 22000.0, 26900.0]
    """
    thickness = density.thickness
    altitude = _samples(density)
    ends: list[tuple[float, bool]] = []
    peaks: list[float] = []
    columns = density.columns
    for i, profile in enumerate(density.at(altitude)):
        peak = int(profile.argmax())
        if scattering[i] * columns[i] < faint or profile[peak] < _ALOFT * profile[0]:
            continue
        within = np.flatnonzero(profile > DENSE * profile[peak])
        bottom, top = float(altitude[within[0]]), float(altitude[within[-1]])
        if top - bottom > _WIDE * thickness and scattering[i] * columns[i] < faint_and_wide:
            continue
        ends += [(bottom, False), (top, top - bottom <= _SPACING * thickness)]
        peaks.append(float(altitude[peak]))
    kept: list[float] = []
    for one, narrow in sorted(ends):
        spacing = (_NARROW_SPACING if narrow else _SPACING) * thickness
        if 0.0 < one < thickness and (not kept or one - kept[-1] > spacing):
            kept.append(one)
    for one in sorted(peaks):
        if 0.0 < one < thickness and all(abs(one - end) > _SPACING * thickness for end in kept):
            kept.append(one)
    return np.array(sorted(kept))
