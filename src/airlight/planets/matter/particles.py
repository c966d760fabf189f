"""Particles by refractive index and size: Mie theory or anomalous diffraction."""

from __future__ import annotations

from functools import lru_cache
from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ConflictError, ParameterError
from airlight.kernel.threads import Cancel, Progress
from airlight.physics.optics import anomalous_diffraction
from airlight.physics.units import values_in
from airlight.planets.matter.matter import Matter
from airlight.planets.matter.mie_nodes import (
    NARROW_SPACING,
    SPACING,
    WIDEST,
    bracketing,
    mie_nodes,
    nearly_one_size,
    node_wavelengths,
    phase_angles,
)
from airlight.planets.matter.particle_index import INDEX, ParticleIndex
from airlight.planets.matter.particle_sizes import SIZES, ParticleSizes
from airlight.planets.matter.phases import TabulatedPhase
from airlight.planets.matter.state_keys import DEPTH
from airlight.planets.parameters import MISSING, parameters
from airlight.planets.schema.field import always, key
from airlight.planets.spectral import Limits, narrowest

FloatArray = npt.NDArray[np.float64]

#: Number of radii of a distribution in anomalous diffraction.
_RADII: Final = 400


#: Exact theory, and the approximation of van de Hulst.
METHODS: Final = ("mie", "anomalous-diffraction")


@parameters
class Particles(Matter):
    """Spheres of one substance with a distribution of sizes.

    Parameters
    ----------
    index : GivenIndex, TableIndex or MixedIndex
        Refractive index.
    method : "mie" or "anomalous-diffraction"
        Theory. Anomalous diffraction has no phase function; its extinction error for Martian dust
        is 9 to 13 %.
    optical_depth : float, optional
        Vertical optical depth at the wavelength ``at``, 0 to 1e4. [1]
    at : float
        Wavelength of the optical depth. [nm]
    number_density : float, optional
        Number density at relative density 1, instead of the optical depth. [m⁻³]

    Notes
    -----
    Exact at 440, 550 and 680 nm and at the wavelengths of a given index. Nodes are at most 5 %
    apart (1.2 % for narrow distributions); between them cross-sections follow power laws, and the
    phase function is linear in wavelength.

    Examples
    --------
    >>> from airlight.planets.matter.particle_index import GivenIndex
    >>> from airlight.planets.matter.particle_sizes import SingleSize
    >>> dust = Particles(
    ...     index=GivenIndex(real=1.52, imaginary=0.006),
    ...     sizes=SingleSize(radius=1.6e-6),
    ...     number_density=1e6,
    ... )
    >>> sigma = dust.scattering_coefficients([550.0], 1.1e4) / 1e6
    >>> f"{sigma[0] / (np.pi * 1.6e-6**2):.3f}"  # Q_sca
    '1.863'
    """

    keyword = "particles"
    label = "particles"
    help = "Particles by what they are made of and how large they are."
    example = "{ index = 'water', … }"

    index: ParticleIndex = key(
        INDEX,
        note="The name of a table, the path to a CSV file, `{ real, imaginary }`, or"
        " `{ matrix, inclusions, fraction }`.",
    )
    sizes: ParticleSizes = key(
        help="Size distribution of the particles.",
        table=SIZES,
        example="a table such as { kind = 'gamma', … }",
    )
    optical_depth: float | None = key(
        DEPTH,
        help="Of all of them straight up, at the wavelength below.",
        note="Or a number density.",
        default=None,
    )
    number_density: float | None = key(
        help="Number density at relative density 1.",
        unit="1/m^3",
        range=(0.0, 1e25),
        example="1e6 /m^3",
        shown="/cm^3",
        slider=(1e-2, 1e6),
        scale="log",
        default=None,
    )
    at: float = key(
        label="wavelength of the optical depth",
        help="Wavelength of the optical depth.",
        unit="nm",
        range=WIDEST,
        example="550 nm",
        slider=(300.0, 1000.0),
        offered=lambda table: "optical_depth" in table,
        default=550.0,
    )
    method: str = key(
        help="Method: exact Mie theory for spheres, or van de Hulst's anomalous diffraction.",
        note="The latter needs a `phase_function` and takes 9 to 13 % off the extinction of"
        " Martian dust.",
        choices=lambda: METHODS,
        offered=always,
        default="mie",
    )

    def __post_init__(self) -> None:
        if (self.optical_depth is None) == (self.number_density is None):
            both = self.optical_depth is not None
            raise ParameterError(
                "optical_depth",
                self.optical_depth if both else MISSING,
                "either optical_depth or number_density",
            )
        low, high = self.limits
        if self.optical_depth is not None and not low <= self.at <= high:
            raise ParameterError("at", self.at, f"{low:g} to {high:g} nm, the range of the index")

    @property
    def needs_phase(self) -> str:
        """Anomalous diffraction, which requires an explicit phase function."""
        return "" if self.method == "mie" else "anomalous diffraction"

    @property
    def limits(self) -> Limits:
        """Wavelength range. [nm]"""
        return narrowest([self.index.limits, WIDEST])

    def prepare(
        self,
        wavelengths: npt.ArrayLike,
        *,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> None:
        """Compute the nodes for these wavelengths [nm]; cached in memory and on disk."""
        if self.method == "mie":
            wanted = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
            if self.optical_depth is not None:
                wanted = np.append(wanted, self.at)
            needed = bracketing(self._nodes, wanted)
            mie_nodes(self.index, self.sizes, needed, progress=progress, cancel=cancel)

    @property
    def _nodes(self) -> tuple[float, ...]:
        spacing = NARROW_SPACING if nearly_one_size(self.sizes) else SPACING
        return node_wavelengths(self.limits, self.index.tabulated_wavelengths, spacing)

    def cross_sections(self, wavelengths: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Extinction and scattering cross-section of the mean particle, each shape (nl,). [m²]"""
        nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
        if self.method == "anomalous-diffraction":
            sizes = self.sizes.sizes(_RADII)
            pairs = [
                anomalous_diffraction.cross_sections(sizes, float(one), complex(index))
                for one, index in zip(nm, self.index.at(nm), strict=True)
            ]
            extinction, scattering = np.array(pairs).T
            return extinction, scattering
        nodes = bracketing(self._nodes, nm)
        found = mie_nodes(self.index, self.sizes, nodes)
        known, wanted = np.log(nodes), np.log(nm)
        extinction, scattering = (
            np.exp(np.interp(wanted, known, np.log([getattr(one, name) for one in found])))
            for name in ("extinction", "scattering")
        )
        return extinction, scattering

    def number_of(self, vertical_column: float) -> float:
        """Number density of particles at relative density 1. [m⁻³]"""
        if self.number_density is not None:
            return self.number_density
        assert self.optical_depth is not None
        column = vertical_column * float(self.cross_sections([self.at])[0][0])
        if column <= 0.0:
            allowed = "0 of particles whose refractive index is 1, which extinguish no light"
            raise ParameterError("optical_depth", self.optical_depth, allowed)
        return self.optical_depth / column

    def scattering_coefficients(
        self, wavelengths: npt.ArrayLike, vertical_column: float
    ) -> FloatArray:
        """Scattering coefficient at relative density 1, shape (nl,). [m⁻¹]"""
        _, scattering = self.cross_sections(wavelengths)
        return scattering * self.number_of(vertical_column)

    def absorption_coefficients(
        self, wavelengths: npt.ArrayLike, vertical_column: float
    ) -> FloatArray:
        """Absorption coefficient at relative density 1, shape (nl,). [m⁻¹]"""
        extinction, scattering = self.cross_sections(wavelengths)
        return np.maximum(extinction - scattering, 0.0) * self.number_of(vertical_column)

    def phase_function(self, wavelengths: npt.ArrayLike) -> TabulatedPhase:
        """Phase function at wavelengths [nm], shape (nl,)."""
        if self.method != "mie":
            raise ConflictError("phase_function", "is required for anomalous diffraction")
        return _phase(self.index, self.sizes, bracketing(self._nodes, wavelengths))

    def asymmetries(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Mean cosine of the scattering angle, shape (nl,). [1]"""
        nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
        nodes = bracketing(self._nodes, nm)
        found = mie_nodes(self.index, self.sizes, nodes)
        return np.asarray(np.interp(nm, nodes, [one.asymmetry for one in found]))


@lru_cache(maxsize=64)
def _phase(index: ParticleIndex, sizes: ParticleSizes, nodes: tuple[float, ...]) -> TabulatedPhase:
    found = mie_nodes(index, sizes, nodes)
    return TabulatedPhase(
        angles=tuple(phase_angles(sizes).tolist()),
        rows=tuple(tuple(one.phase.tolist()) for one in found),
        f12=tuple(tuple(one.ratios[0].tolist()) for one in found),
        f33=tuple(tuple(one.ratios[1].tolist()) for one in found),
        f34=tuple(tuple(one.ratios[2].tolist()) for one in found),
        wavelengths=nodes,
    )
