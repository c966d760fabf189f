"""Cases of the Intercomparison of 3D Radiation Codes, phase I, and their consensus results.

Case 1 is a step cloud, infinite in y: columns of optical depth 2 and 18. Case 2 is a field derived
from a cloud radar (ARM, 8 February 1998). Both are periodic and without gases; the ground is black
but for experiment 5 of case 2, whose published results conserve energy with an albedo of 0.4.

Source: Cahalan et al. (2005), BAMS 86, 1275, doi:10.1175/BAMS-86-9-1275; i3rc.gsfc.nasa.gov.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics
from airlight.planets.matter.particle_index import TableIndex
from airlight.planets.matter.particle_sizes import GammaSizes
from airlight.planets.matter.particles import Particles
from airlight.planets.matter.phases.formulas import HenyeyGreenstein
from airlight.planets.matter.phases.phase_function import PhaseFunction
from airlight.validation.reference_files import packaged_table, read_table

FloatArray = NDArray[np.float64]

#: Quantities: irradiances up at the top, down at the bottom and absorbed; radiances of a view from
#: above to the nadir, at 60° (light that goes on in the sun's azimuth, and back) and from below.
QUANTITIES: Final = ("R", "T", "A", "Iu", "I601", "I602", "Id")
#: Directions of the light of radiances, in which it propagates. [1]
DIRECTIONS: Final[dict[str, tuple[float, float, float]]] = {
    "Iu": (0.0, 0.0, 1.0),
    "I601": (0.75**0.5, 0.0, 0.5),
    "I602": (-(0.75**0.5), 0.0, 0.5),
    "Id": (0.0, 0.0, -1.0),
}
#: Wavelength of Deirmendjian's C1 cloud. [nm]
WAVELENGTH: Final = 670.0
#: Layers of the step cloud. Its depth and width. [m]
_STEP_LAYERS: Final = 32
_STEP_DEPTH, _STEP_WIDTH = 250.0, 500.0
#: Column width and layer depth of case 2. [m]
_RADAR_SPACING: Final = (50.0, 45.0)


@dataclass(frozen=True)
class Experiment:
    """Experiment with consensus results.

    Attributes
    ----------
    case, number : int
        Case, 1 or 2, and number of the experiment, 1 to 7.
    """

    case: int
    number: int

    def __str__(self) -> str:
        return f"case {self.case}, experiment {self.number}"

    @property
    def sun_zenith(self) -> float:
        """Zenith angle of the sun, which shines from low x. [deg]"""
        return 0.0 if self.number in (1, 3, 6) else 60.0

    @property
    def albedo(self) -> float:
        """Single-scattering albedo. [1]"""
        return 0.99 if self.number in (3, 4) else 1.0

    @property
    def ground_albedo(self) -> float:
        """Albedo of the Lambertian ground. [1]"""
        return 0.4 if self.number == 5 else 0.0

    @property
    def towards(self) -> tuple[float, float, float]:
        """Unit vector to the sun: east, north, up. [1]"""
        angle = np.radians(self.sun_zenith)
        return -float(np.sin(angle)), 0.0, float(np.cos(angle))

    @property
    def optics(self) -> CloudOptics:
        """Henyey-Greenstein with g = 0.85; C1 cloud in experiments 6 and 7."""
        phase: PhaseFunction = HenyeyGreenstein(asymmetry=0.85)
        return CloudOptics(
            wavelengths=np.array([WAVELENGTH]),
            extinction=np.ones(1),
            albedo=np.array([self.albedo]),
            phase=phase if self.number < 6 else c1_phase(),
        )

    @property
    def field(self) -> CloudField:
        """Cloud field."""
        return step_cloud() if self.case == 1 else radar_cloud()

    @property
    def results(self) -> dict[str, FloatArray]:
        """Consensus results by quantity, shape (columns,). [1]"""
        names, table = _consensus(self.case)
        start = f"exp{self.number}_"
        return {
            name.removeprefix(start): table[:, k]
            for k, name in enumerate(names)
            if name.startswith(start)
        }


#: Experiments with consensus results.
EXPERIMENTS: Final = tuple(
    Experiment(case, number)
    for case, numbers in ((1, (1, 2, 4)), (2, (1, 2, 4, 5, 6, 7)))
    for number in numbers
)


def step_cloud(layers: int = _STEP_LAYERS) -> CloudField:
    """Field of case 1, 32 columns.

    Parameters
    ----------
    layers : int
        Number of equal layers.
    """
    depth = np.repeat([2.0, 18.0], 16)[:, None, None]
    return CloudField(
        extinction=np.repeat(depth / _STEP_DEPTH, layers, axis=2).astype(np.float32),
        spacing=(_STEP_WIDTH / 32, _STEP_WIDTH / 32, _STEP_DEPTH / layers),
        base=0.0,
        beyond="periodic",
        interpolated=False,
    )


def radar_cloud() -> CloudField:
    """Field of case 2, 640 columns of 40 layers.

    The 14 empty layers below are left out: the published transmittances vary from column to column
    as those at the cloud's base do, not as those 630 m below.
    """
    layers = packaged_table("data/i3rc-case2-depth.csv")[::-1]
    depth = layers[layers.any(axis=1)].T[:, None, :]
    width, height = _RADAR_SPACING
    return CloudField(
        extinction=np.asarray(depth / height, np.float32),
        spacing=(width, width, height),
        base=0.0,
        beyond="periodic",
        interpolated=False,
    )


@lru_cache(maxsize=1)
def c1_phase() -> PhaseFunction:
    """Phase function of Deirmendjian's C1 cloud by Mie theory: n(r) ∝ r⁶ exp(-1.5 r/µm)."""
    droplets = Particles(
        index=TableIndex(table="water"),
        # Hansen's distribution: r^((1 - 3b)/b) exp(-r/(ab)), a = 6 µm and b = 1/9.
        sizes=GammaSizes(effective_radius=6e-6, effective_variance=1.0 / 9.0),
        number_density=1.0,
    )
    return droplets.phase_function(np.array([WAVELENGTH]))


@lru_cache(maxsize=2)
def _consensus(case: int) -> tuple[list[str], FloatArray]:
    return read_table(files("airlight.validation").joinpath(f"data/i3rc-case{case}.csv"))
