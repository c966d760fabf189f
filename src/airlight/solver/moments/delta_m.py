"""Delta-M scaling of the optics of a medium, packed for kernels of eight wavelengths at once.

Of phase functions with a sharp forward peak, the fraction f = g_{N+1} is treated as unscattered
(δ-M: Wiscombe 1977, JAS 34, 1408), and the first order uses the exact phase function with the
scaled extinction (TMS: Nakajima & Tanaka 1988, JQSRT 40, 51). For optically thin particles single
scattering dominates the peak; δ-M then gains nothing and degrades the narrow bright band along the
horizon, so f grows with the particles' vertical optical depth (docs/decisions/04-forward-peaks.md).

Q and U are expanded to degree 2 only. Their truncated fraction is therefore larger: the element of
degree 5 of the phase matrix, which represents degrees 3 and more to 0.01 of the degree of
polarisation under haze; 0 for molecules.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import exp
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, kernel
from airlight.physics.optics.layer_edges import FAINT, ThinLayer, layer_edges
from airlight.solver.layered_columns import FAINT_AND_WIDE, layer_ends
from airlight.solver.moments.grid import MomentsGrid
from airlight.solver.moments.harmonics import ELEMENTS
from airlight.solver.moments.levels import Depths, panel_cuts
from airlight.solver.moments.packing import pack
from airlight.solver.moments.ray_optics import ScaledOptics
from airlight.solver.moments.settings import MomentsSettings
from airlight.solver.tables.columns import density_table

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

#: Vertical scattering optical depth about which forward peaks begin to be truncated. [1]
THIN: Final = 0.1
#: Smallest scattering optical depth of a layer aloft at whose boundaries panels end: at dusk, when
#: it alone is sunlit, the error of a cloud of depth 1e-4 at 55 km was up to 40 %.
_SEEN: Final = 1e-6
#: Distance from a layer boundary within which other panel ends are dropped, over the thickness.
_NEAR_EDGE: Final = 1.5e-3
#: Legendre moments below this count as zero.
NEGLIGIBLE: Final = 1e-6
#: Largest truncated fraction f. [1]
MOST_PEAK: Final = 0.999


@kernel
def is_peaked(beyond):
    """Whether a phase function has a forward peak, by its first moment above the degree. [1]"""
    return abs(beyond) > NEGLIGIBLE


@kernel
def delta_m_weight(depth):
    """Weight of delta-M scaling, from the scattering depth of peaked constituents. [1]"""
    return 1.0 - exp(-((depth / THIN) ** 2))


@kernel
def truncated_fraction(beyond, weight):
    """Truncated fraction f of delta-M scaling. [1]

    Parameters
    ----------
    beyond : float
        The phase function's first moment above the degree. [1]
    weight : float
        Weight from ``delta_m_weight``. [1]
    """
    if is_peaked(beyond):
        return min(max(beyond, 0.0), MOST_PEAK) * weight
    return 0.0


@kernel
def polarised_truncated_fraction(forward, part):
    """Truncated fraction of delta-M scaling for Q and U. [1]

    Parameters
    ----------
    forward : float
        Diagonal element of degree 5 of the phase matrix, of ``PhaseFunction``. [1]
    part : float
        Truncated fraction of I, from ``truncated_fraction``. [1]
    """
    return min(max(forward, part), MOST_PEAK)


@compiled_loop
def delta_m_scaling(
    scattering, absorption, phases, polarised_elements, columns, degree, extinction, moments,
    polarised_moments, depths,
):  # fmt: skip
    """Delta-M scaling of a medium, at each of its wavelengths.

    Parameters
    ----------
    scattering, absorption : array, shape (nc, nl)
        Coefficients of the constituents at relative density 1. [m⁻¹]
    phases : array, shape (nc, nl, degree + 2)
        Legendre moments of the phase functions. [1]
    polarised_elements : array, shape (nc, nl, 4)
        Three expansion coefficients of degree 2 and one of degree 5; 0 for scalar transfer. [1]
    columns : array, shape (nc,)
        Vertical columns. [m]
    degree : int
        Degree of the harmonics.
    extinction : array, shape (nc·nl,)
        Receives the scaled extinction coefficients. [m⁻¹]
    moments : array, shape (nc·(degree + 1)·nl,)
        Receives scattering coefficient times Legendre moment, both scaled. [m⁻¹]
    polarised_moments : array, shape (nc·4·nl,)
        Receives scattering coefficient times scaled coefficients of degree 2: β₁ couples I to even
        moments of Q and U, α₂ couples even and α₃ odd moments of Q and U; then the extinction of I
        less that of Q and U. [m⁻¹]
    depths : array, shape (3·nl,)
        Receives the weight of the scaling, from 0 (thin) to 1 (thick); the scaled vertical
        scattering optical depth; and the vertical transport optical depth, τ (1 - g). [1]
    """
    constituents, wavelengths = scattering.shape[0], scattering.shape[1]
    for w in range(wavelengths):
        peaked = 0.0
        for c in range(constituents):
            if is_peaked(phases[c, w, degree + 1]):
                peaked += scattering[c, w] * columns[c]
        weight = delta_m_weight(peaked)
        smooth = 0.0
        transport = 0.0
        for c in range(constituents):
            scattered = scattering[c, w]
            total = scattered + absorption[c, w]
            part = truncated_fraction(phases[c, w, degree + 1], weight)
            extinction[c * wavelengths + w] = total - part * scattered
            smooth += columns[c] * (scattered * (1.0 - part))
            transport += columns[c] * (total - scattered * phases[c, w, 1])
            for l in range(degree + 1):
                moment = 0.0
                if scattered > 0.0:
                    moment = scattered * (phases[c, w, l] - part)
                moments[(c * (degree + 1) + l) * wavelengths + w] = moment
            polarised_part = polarised_truncated_fraction(polarised_elements[c, w, 3], part)
            first = ELEMENTS * c * wavelengths + w
            polarised_moments[first] = scattered * polarised_elements[c, w, 0]
            polarised_moments[first + wavelengths] = scattered * (
                polarised_elements[c, w, 1] - polarised_part
            )
            polarised_moments[first + 2 * wavelengths] = scattered * (
                polarised_elements[c, w, 2] - polarised_part
            )
            polarised_moments[first + 3 * wavelengths] = scattered * (polarised_part - part)
        depths[w] = weight
        depths[wavelengths + w] = smooth
        depths[2 * wavelengths + w] = transport


@dataclass(frozen=True, eq=False)
class Optics:
    """Scaled optics of a medium for a degree of expansion, evaluated lazily.

    Parameters
    ----------
    medium : Medium
        Medium with any number of wavelengths.
    degree : int
        Degree of the harmonics.
    polarised : bool
        Whether transfer is polarised.

    Examples
    --------
    >>> from airlight.planets import Medium, load_planet
    >>> medium = Medium.from_planet(load_planet("earth-atmosphere-plus"), [550.0])
    >>> bool(Optics(medium, 2).transport_depth < medium.vertical_optical_depth.sum(axis=0))
    True
    """

    medium: Medium
    degree: int
    polarised: bool = True

    @classmethod
    def chosen(cls, medium: Medium, settings: MomentsSettings) -> Optics:
        """Optics of the lowest sufficient degree; higher for optically thick dust.

        Parameters
        ----------
        medium : Medium
            Medium with all wavelengths.
        settings : MomentsSettings
            Settings with the degrees for optically thin and thick media.
        """
        layers = bool(medium.thin_layers)
        highest = settings.layer_degree if layers else settings.thick_degree
        moments = medium.phase_moments(highest)
        polarised = settings.polarisation
        strong = np.abs(moments).max(axis=(0, 1)) > NEGLIGIBLE
        needed = int(np.flatnonzero(strong).max()) if strong.any() else 0
        thick = bool((cls(medium, settings.degree, polarised).peak_weight > 0.9).any())
        degree = max(2, min(needed, highest if thick or layers else settings.degree))
        return cls(medium, degree, polarised)

    @cached_property
    def phases(self) -> FloatArray:
        """Legendre moments of the phase functions, shape (nc, nl, degree + 2). [1]"""
        return self.medium.phase_moments(self.degree + 1)

    @cached_property
    def polarised_elements(self) -> FloatArray:
        """Expansion coefficients of the phase matrix, shape (nc, nl, 4); 0 for scalar. [1]"""
        shape = (*self.medium.scattering.shape, ELEMENTS)
        return self.medium.polarising_moments() if self.polarised else np.zeros(shape)

    @cached_property
    def _reduced(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        medium, (constituents, wavelengths) = self.medium, self.medium.scattering.shape
        extinction = np.empty((constituents, wavelengths))
        moments = np.empty((constituents, self.degree + 1, wavelengths))
        polarised_moments = np.empty((constituents, ELEMENTS, wavelengths))
        depths = np.empty((3, wavelengths))
        # Copies: the medium's arrays are read-only and may not be contiguous.
        given = (
            medium.scattering,
            medium.absorption,
            self.phases,
            self.polarised_elements,
            medium.columns,
        )
        delta_m_scaling(
            *(np.array(one, float) for one in given),
            self.degree,
            extinction.reshape(-1),
            moments.reshape(-1),
            polarised_moments.reshape(-1),
            depths.reshape(-1),
        )
        return extinction, moments, polarised_moments, depths

    @property
    def extinction(self) -> FloatArray:
        """Scaled extinction coefficients, shape (nc, nl). [m⁻¹]"""
        return self._reduced[0]

    @property
    def scattering(self) -> FloatArray:
        """Scaled scattering coefficients, shape (nc, nl). [m⁻¹]"""
        return self._reduced[1][:, 0]

    @property
    def peak_weight(self) -> FloatArray:
        """Weight of delta-M scaling, from 0 (thin) to 1 (thick), shape (nl,). [1]"""
        return np.asarray(self._reduced[3][0])

    @property
    def scattering_depth(self) -> FloatArray:
        """Scaled vertical scattering optical depth, shape (nl,). [1]"""
        return np.asarray(self._reduced[3][1])

    @property
    def transport_depth(self) -> FloatArray:
        """Vertical transport optical depth τ (1 - g), shape (nl,). [1]"""
        return np.asarray(self._reduced[3][2])

    def largest_moment_beyond(self, degree: int) -> float:
        """Largest moment above a degree, attenuated along a horizontal path. [1]

        Parameters
        ----------
        degree : int
            Degree above which moments are considered.
        """
        moments = self._reduced[1]
        depth = np.minimum(10.0 * moments[:, 0] * self.medium.columns[:, None], 1.0)
        scattered = np.maximum(moments[:, 0], 1e-300)
        kept = np.abs(moments[:, degree + 1 :]) / scattered[:, None] * depth[:, None]
        return float(kept.max(initial=0.0))

    @cached_property
    def depths(self) -> Depths:
        """Optical depths from which the radial grid follows."""
        medium = self.medium
        table, altitude = density_table(medium.density), medium.density.node_altitudes
        step = 0.5 * (table[1:] + table[:-1]) * np.diff(altitude)[:, None]
        column = np.concatenate([np.zeros((1, table.shape[1])), np.cumsum(step, axis=0)])
        smooth = self._reduced[1][:, 0]
        return Depths(altitude, column @ smooth.max(axis=1), medium.thin_layers)

    def air(self, block: slice) -> ScaledOptics:
        """Packed optics of some wavelengths, in whole groups of eight lanes."""
        medium, (extinction, moments, polarised_moments, _) = self.medium, self._reduced
        ground = medium.ground.at(block)
        return ScaledOptics(
            extinction=pack(extinction[:, block]),
            moments=pack(moments[..., block]),
            ground=ground._replace(
                albedo=pack(ground.albedo),
                layer=ground.layer._replace(layer_phase=pack(ground.layer.layer_phase)),
            ),
            star_radius=medium.lights[0].angular_radius,
            polarised_moments=pack(polarised_moments[..., block]),
        )


def panel_ends(
    medium: Medium, grid: MomentsGrid, refinement: int, *, sweeps: bool = False
) -> FloatArray:
    """Altitudes at which the panels of rays end, ascending, inside the shell. [m]

    Parameters
    ----------
    grid : MomentsGrid
        Grid of the medium.
    refinement : int
        More than 1 for optically thick media, where panels end at some levels; otherwise, and in
        sweeps, at boundaries of layers aloft.
    sweeps : bool
        Whether the rays are those of sweeps, which need no panel ends in faint wide layers; a line
        of sight with eight points made a stratosphere of depth 0.007 10 % too bright.
    """
    least, faint = (FAINT_AND_WIDE, FAINT) if sweeps else (0.0, _SEEN)
    strength = medium.scattering.max(axis=1)
    layers, thin = medium.thin_layers, layer_ends(medium)
    if refinement == 1:
        edges = layer_edges(medium.density, strength, faint=faint, faint_and_wide=least)
        return np.union1d(_outside_thin_layers(edges, layers, medium.thickness), thin)
    cuts = panel_cuts(grid.radii - grid.bottom_radius, refinement)
    if not sweeps:
        return np.union1d(cuts, thin)
    # Across a cloud boundary the error of single scattering was 9 %.
    edges = layer_edges(medium.density, strength, faint_and_wide=least)
    near = _NEAR_EDGE * medium.thickness
    kept = [cut for cut in cuts if not (np.abs(edges - cut) < near).any() or thin.size]
    return np.unique(
        np.concatenate([kept, _outside_thin_layers(edges, layers, medium.thickness), thin])
    )


def _outside_thin_layers(
    edges: FloatArray, layers: tuple[ThinLayer, ...], thickness: float
) -> FloatArray:
    """Layer boundaries away from thin layers, which have panel ends of their own. [m]"""
    near = _NEAR_EDGE * thickness
    for layer in layers:
        edges = edges[(edges < layer.bottom - near) | (edges > layer.top + near)]
    return edges
