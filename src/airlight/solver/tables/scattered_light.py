"""Path radiance from tables: sum of parts, each times its phase function.

Few texels along the angle between view and sun do not resolve the peak of a phase function.
Radiance is therefore the sum of a smooth part times the phase function of the gas, and of single
scattering by particles times theirs. The latter has a separate table, or one channel, whose colours
follow the smooth part (Bruneton & Neyret 2008, section 4) or are grey (Atmosphere Plus notes, first
print, section 2.3).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.solver.tables.layout import FloatArray, Positions
from airlight.solver.tables.table import Table

#: Methods of packing scattered radiance into tables.
PACKINGS: Final = ("separate", "combined", "rgba", "phase-included")


@dataclass(frozen=True, eq=False)
class PhaseFunctions:
    """Phase functions as tables over u = sin(θ/2), evenly spaced from 0 to 1.

    Attributes
    ----------
    names : tuple of str, length np
        Name of the constituent or mixture of each.
    values : array, shape (np, nl, nodes)
        Tabulated values. [sr⁻¹]
    """

    names: tuple[str, ...]
    values: FloatArray

    def at(self, name: str, nu: FloatArray) -> FloatArray:
        """Phase function of a constituent, linear in u, from nu (...) to (..., nl). [sr⁻¹]"""
        rows = self._by_node[self.names.index(name)]
        x = np.sqrt(np.clip(0.5 * (1.0 - nu), 0.0, 1.0)) * (len(rows) - 1)
        low = np.minimum(x.astype(int), len(rows) - 2)
        share = (x - low)[..., None]
        return np.asarray((1.0 - share) * rows[low] + share * rows[low + 1])

    @cached_property
    def _by_node(self) -> FloatArray:
        """Values with the wavelength axis last, shape (np, nodes, nl). [sr⁻¹]"""
        return np.ascontiguousarray(np.swapaxes(self.values, 1, 2))


@dataclass(frozen=True, kw_only=True, eq=False)
class ScatteredLight:
    """Path radiance per irradiance of the star, reconstructed from tables.

    Parameters
    ----------
    packing : str
        One of ``PACKINGS``. ``phase-included``: the table ``scattering`` alone. ``separate``: it is
        multiplied by the first phase function, and each type of particles has a further table and
        phase function. ``combined`` and ``rgba``: the last channel of ``scattering`` is multiplied
        by the phase function ``particles``, if any.
    colours : array, shape (nl,)
        Ratio of the particles' to the smooth part, over that at the wavelength ``reference``; only
        for ``combined``. [1]
    reference : int
        Index of the wavelength of the last channel.
    """

    packing: str
    tables: Mapping[str, Table]
    phases: PhaseFunctions
    colours: NDArray[np.float64]
    reference: int = 0

    def __post_init__(self) -> None:
        if self.packing not in PACKINGS:
            raise ParameterError("packing", self.packing, ", ".join(PACKINGS))

    def relative_radiance(self, positions: Positions) -> FloatArray:
        """Path radiance, shape (n, nl). [sr⁻¹]"""
        main = self.tables["scattering"].at(positions)
        if self.packing == "phase-included":
            return main
        if self.packing == "separate":
            total = main * self.phases.at(self.phases.names[0], positions.nu)
            for name in self.phases.names[1:]:
                total += self.tables[name].at(positions) * self.phases.at(name, positions.nu)
            return total
        smooth, alpha = main[:, :-1], main[:, -1:]
        light = smooth * self.phases.at(self.phases.names[0], positions.nu)
        if "particles" not in self.phases.names:
            return light
        particles = self.phases.at("particles", positions.nu) * alpha
        if self.packing == "rgba":
            return light + particles
        return light + particles * proportional(smooth, self.colours, self.reference)


def proportional(smooth: FloatArray, colours: FloatArray, reference: int) -> FloatArray:
    """Colours of the particles' part, proportional to the smooth part, 1 at the reference. [1]

    Parameters
    ----------
    reference : int
        Index of the reference wavelength.
    """
    divisor = smooth[:, reference : reference + 1]
    ratio = np.divide(smooth, divisor, out=np.zeros_like(smooth), where=divisor > 0.0)
    ratio *= colours
    ratio[:, reference] = 1.0
    return ratio
