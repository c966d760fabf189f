"""Complex refractive index of particles, as parameter objects."""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import cache
from typing import Annotated, Any, Final

import numpy as np
import numpy.typing as npt

from airlight.physics.optics.effective_medium import maxwell_garnett
from airlight.physics.optics.index_table import read_index
from airlight.planets.parameters import instance_of, parameters
from airlight.planets.schema.field import Field, Wavelengths
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


def read_particle_index(section: TomlTable, name: str, wavelengths: Wavelengths) -> ParticleIndex:
    """Read the index of a key: a table's name, a path, numbers or a mixture."""
    allowed = "the name of a table, or a table such as { real = 1.5, … }"
    value = section.required(name, allowed)
    if isinstance(value, str):
        table = value if value in index_words() else str(section.beside(value))
        with section.prefix_errors():
            return TableIndex(table=table if table.endswith(".csv") else value)
    within = section.section(name, allowed)
    kind = MixedIndex if MixedIndex.keyword in within else GivenIndex
    return kind.read(within, wavelengths)


def index_key(label: str, text: str, **more: Any) -> Field:
    """Key of a refractive index."""
    return Field(label=label, help=text, kind="choice", table="index", choices=index_words,
               read=read_particle_index, mode="advanced", **more)  # fmt: skip


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

    real: Annotated[
        Spectral,
        Field(
            label="index, real part",
            help="Real part n of the refractive index.",
            range=(0.1, 10.0),
            spectral=True,
            example="1.52",
            slider=(1.0, 3.0),
            per="wavelengths",
            mode="advanced",
        ),
    ]
    imaginary: Annotated[
        Spectral,
        Field(
            label="index, imaginary part",
            help="Imaginary part k of the refractive index.",
            range=(0.0, 10.0),
            spectral=True,
            example="0.006",
            slider=(1e-6, 1.0),
            scale="log",
            per="wavelengths",
            mode="advanced",
            offered=lambda table: "real" in table,
        ),
    ] = 0.0

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

    matrix: Annotated[
        GivenIndex | TableIndex,
        instance_of(GivenIndex, TableIndex),
        index_key("matrix", "What the grains lie in.", prefix="matrix"),
    ]
    inclusions: Annotated[
        GivenIndex | TableIndex,
        instance_of(GivenIndex, TableIndex),
        index_key("grains", "What lies in the matrix.", prefix="grains"),
    ]
    fraction: Annotated[
        float,
        Field(
            label="share of the grains",
            help="Volume fraction of the inclusions (Maxwell Garnett).",
            range=(0.0, 1.0),
            example="0.02",
            mode="advanced",
        ),
    ]

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


#: Kinds of ``index = { … }``, distinguished by a key; the name of a table is a word.
INDICES: Final[Alternatives[ParticleIndex]] = Alternatives((GivenIndex, MixedIndex))
