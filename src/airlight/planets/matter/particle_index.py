"""Complex refractive index of particles, as parameter objects."""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import cache
from typing import Annotated, Final

import numpy as np
import numpy.typing as npt

from airlight.physics.optics.effective_medium import maxwell_garnett
from airlight.physics.optics.index_table import read_index
from airlight.planets.parameters import instance_of, parameters
from airlight.planets.schema.field import Field, Wavelengths, key
from airlight.planets.schema.tagged_union import Alternatives
from airlight.planets.schema.toml_model import TomlModel
from airlight.planets.schema.toml_table import TomlTable
from airlight.planets.spectral import (
    Limits,
    PerWavelength,
    Spectral,
    narrowest,
    power_law_at,
    spectral_at,
    spectral_limits,
)

ComplexArray = npt.NDArray[np.complex128]

#: Longest list of wavelengths at each of which particles are computed exactly.
_LONGEST_OWN: Final = 40


class ParticleIndex(TomlModel, ABC):
    """Complex refractive index n + ik."""

    mode = "advanced"

    @property
    @abstractmethod
    def limits(self) -> Limits:
        """Wavelength range. [nm]"""

    @property
    @abstractmethod
    def tabulated_wavelengths(self) -> tuple[float, ...]:
        """Wavelengths of given values, each of which becomes a Mie node. [nm]"""

    @abstractmethod
    def at(self, wavelengths: npt.ArrayLike) -> ComplexArray:
        """Index n + ik at wavelengths within ``limits`` [nm], shape (nl,)."""


@cache
def index_words() -> tuple[str, ...]:
    """Names of the refractive-index tables in the package."""
    from airlight.physics.optics.index_table import index_names

    return tuple(index_names())


def read_particle_index(table: TomlTable, name: str, wavelengths: Wavelengths) -> ParticleIndex:
    """Read the index of a key: a table's name, a path, numbers or a mixture."""
    allowed = "the name of a table, or a table such as { real = 1.5, … }"
    value = table.required(name, allowed)
    if isinstance(value, str):
        named = value if value in index_words() else str(table.beside(value))
        with table.prefix_errors():
            return TableIndex(table=named if named.endswith(".csv") else value)
    within = table.table(name, allowed)
    kind = MixedIndex if MixedIndex.keyword in within else GivenIndex
    return kind.read(within, wavelengths)


#: Kinds of ``index = { … }``, distinguished by a key; the name of a table is a word.
INDICES: Final[Alternatives[ParticleIndex]] = Alternatives(ParticleIndex)
#: Key whose value is a refractive index.
INDEX: Final = Field(
    label="material",
    help="What the particles are made of: their refractive index n + ik.",
    kind="choice",
    table=INDICES,
    choices=index_words,
    read=read_particle_index,
)


@parameters
class GivenIndex(ParticleIndex):
    """Refractive index n + ik as numbers.

    Parameters
    ----------
    real : float or PerWavelength
        Real part n, 0.1 to 10. [1]
    imaginary : float or PerWavelength
        Imaginary part k, 0 to 10. [1]
    """

    keyword = "real"

    real: Spectral = key(
        label="index, real part",
        help="Real part n of the refractive index.",
        range=(0.1, 10.0),
        example="1.52",
        slider=(1.0, 3.0),
    )
    imaginary: Spectral = key(
        label="index, imaginary part",
        help="Imaginary part k of the refractive index.",
        range=(0.0, 10.0),
        example="0.006",
        slider=(1e-6, 1.0),
        scale="log",
        offered=lambda table: "real" in table,
        default=0.0,
    )

    @property
    def limits(self) -> Limits:
        """Wavelength range. [nm]"""
        return spectral_limits(self.real, self.imaginary)

    @property
    def tabulated_wavelengths(self) -> tuple[float, ...]:
        """Wavelengths of the given values. [nm]"""
        own: set[float] = set()
        for value in (self.real, self.imaginary):
            if isinstance(value, PerWavelength) and len(value.wavelengths) <= _LONGEST_OWN:
                own.update(value.wavelengths)
        return tuple(sorted(own))

    def at(self, wavelengths: npt.ArrayLike) -> ComplexArray:
        """Index n + ik at wavelengths within ``limits`` [nm], shape (nl,)."""
        k = power_law_at(self.imaginary, wavelengths)
        return np.asarray(spectral_at(self.real, wavelengths) + 1j * k)


@parameters
class TableIndex(ParticleIndex):
    """Refractive index from a table.

    Parameters
    ----------
    table : str
        Name or path that ``physics.optics.index_table.read_index`` accepts.
    """

    table: str

    def __post_init__(self) -> None:
        read_index(self.table)

    @property
    def limits(self) -> Limits:
        """Wavelength range. [nm]"""
        return read_index(self.table).limits

    @property
    def tabulated_wavelengths(self) -> tuple[float, ...]:
        """Empty, as tables have too many rows for Mie nodes."""
        return ()

    def at(self, wavelengths: npt.ArrayLike) -> ComplexArray:
        """Index n + ik at wavelengths within ``limits`` [nm], shape (nl,)."""
        return read_index(self.table).at(wavelengths)


@parameters
class MixedIndex(ParticleIndex):
    """Matrix with small inclusions of another substance, by the Maxwell Garnett rule.

    Parameters
    ----------
    matrix, inclusions : GivenIndex or TableIndex
        Indices of the two substances.
    fraction : float
        Volume fraction of the inclusions, 0 to 1. [1]
    """

    keyword = "matrix"

    matrix: Annotated[GivenIndex | TableIndex, instance_of(GivenIndex, TableIndex)] = key(
        INDEX, label="matrix", help="What the grains lie in.", prefix="matrix"
    )
    inclusions: Annotated[GivenIndex | TableIndex, instance_of(GivenIndex, TableIndex)] = key(
        INDEX, label="grains", help="What lies in the matrix.", prefix="grains"
    )
    fraction: float = key(
        label="share of the grains",
        help="Volume fraction of the inclusions (Maxwell Garnett).",
        range=(0.0, 1.0),
        example="0.02",
    )

    @property
    def limits(self) -> Limits:
        """Common wavelength range of both. [nm]"""
        return narrowest([self.matrix.limits, self.inclusions.limits])

    @property
    def tabulated_wavelengths(self) -> tuple[float, ...]:
        """Wavelengths of the given values of both. [nm]"""
        own = {*self.matrix.tabulated_wavelengths, *self.inclusions.tabulated_wavelengths}
        low, high = self.limits
        return tuple(sorted(nm for nm in own if low <= nm <= high))

    def at(self, wavelengths: npt.ArrayLike) -> ComplexArray:
        """Index n + ik at wavelengths within ``limits`` [nm], shape (nl,)."""
        parts = self.matrix.at(wavelengths), self.inclusions.at(wavelengths)
        return maxwell_garnett(*parts, self.fraction)


INDICES.classes = (GivenIndex, MixedIndex)  # the second holds indices itself
