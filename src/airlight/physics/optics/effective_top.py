"""Effective top of the atmosphere in a shell much thicker than its scale heights."""

from __future__ import annotations

from typing import Final

import numpy as np

from airlight.physics.optics.density_profile import DensitySegments

#: Largest fraction of each constituent's column above the effective top.
_ABOVE: Final = 1e-7
#: Effective top, over the thickness of the shell, above which the shell is not truncated.
_HIGH: Final = 0.7
#: Margin factor of that altitude: successive orders of scattering converge slowly in a thick cloud
#: that ends at the top of the shell.
_MARGIN: Final = 1.1


def effective_top(density: DensitySegments) -> float:
    """Altitude above which every constituent has less than 1e-7 of its column, with margin. [m]

    Solver grids span the shell; in a shell of 63 000 km the lowest 100 km and the terminator would
    have few nodes. If the shell is less than 1.4 times as thick, its own thickness is returned.

    Examples
    --------
    >>> from airlight.physics.optics.density_profile import exponential
    >>> high = DensitySegments.from_rows([exponential(8e3, 63e6)])
    >>> round(effective_top(high), -4)  # 1.1 times 8 km ln 1e7 = 129 km
    140000.0
    >>> effective_top(DensitySegments.from_rows([exponential(8e3, 1e5)]))
    100000.0
    """
    thickness, altitude = density.thickness, density.node_altitudes
    profiles = density.at_nodes
    steps = 0.5 * (profiles[:, 1:] + profiles[:, :-1]) * np.diff(altitude)
    above = np.cumsum(steps[:, ::-1], axis=1)[:, ::-1]
    counts = (above > _ABOVE * above[:, :1]).any(axis=0)
    highest = int(np.flatnonzero(counts).max(initial=-1))
    top = _MARGIN * float(altitude[highest + 1]) if highest >= 0 else thickness
    return top if top < _HIGH * thickness else thickness
