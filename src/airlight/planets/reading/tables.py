"""Kinds of tables of a planet file with their keys, for reader, editors and handbook."""

from __future__ import annotations

from typing import Final, Protocol

from airlight.planets.constituent import Constituent
from airlight.planets.ground import Ground
from airlight.planets.matter.absorbers import ABSORBERS, SmallParticleAbsorption
from airlight.planets.matter.gas_mixture import SHARE, GasMixture
from airlight.planets.matter.gases import SCATTERERS
from airlight.planets.matter.matter import Matter
from airlight.planets.matter.particle_index import INDICES
from airlight.planets.matter.particle_sizes import SIZES
from airlight.planets.matter.particles import Particles
from airlight.planets.matter.phases import PHASES
from airlight.planets.matter.profiles import PROFILES, BulkGas, Layer
from airlight.planets.matter.turbidity import LiteralTurbidity, Turbidity
from airlight.planets.planet import Planet
from airlight.planets.reading.coefficient_keys import COEFFICIENT_KEYS
from airlight.planets.schema.field import WAVELENGTHS, Field, FileTable
from airlight.planets.schema.toml_model import fields_of
from airlight.planets.star import Star

#: Kinds of matter of a constituent, by the key of its table.
MATTER: Final[tuple[type[Matter], ...]] = (
    GasMixture,
    Particles,
    Turbidity,
    LiteralTurbidity,
)


class KindOfTable(Protocol):
    """Object that declares the keys of one kind of table."""

    def declared(self, table: FileTable | None = None) -> tuple[Field, ...]:
        """Keys that this table may have, or any table of the kind."""


class _Listed:
    """Kind of table whose keys are a list."""

    def __init__(self, *keys: Field) -> None:
        self._keys = keys

    def declared(self, table: FileTable | None = None) -> tuple[Field, ...]:
        """Keys of the list."""
        return self._keys


def _planet() -> _Listed:
    """Keys of a planet file, with those of the shell in a nested table."""
    own = Planet.declared()
    first = next(i for i, key in enumerate(own) if key.kind == "table")
    shell = Field(name="shell", label="shell", help="Radii of the atmosphere.", kind="table",
                table="shell", required=True)  # fmt: skip
    return _Listed(*own[:first], shell, *own[first:])


def _constituent() -> _Listed:
    """Fields of a constituent, its coefficients in other forms, and its kinds of matter."""
    own = {key.name: key for key in Constituent.declared()}
    phase = own.pop("phase_function")
    composition_kinds = [
        Field(name=one.keyword, label=one.label, help=one.help, kind="table", table=one.keyword)
        for one in MATTER
    ]
    first = [own.pop("name"), own.pop("profile"), WAVELENGTHS]
    return _Listed(*first, *own.values(), *COEFFICIENT_KEYS, *composition_kinds, phase)


#: Kinds of table by the name that ``Field.table`` uses.
TABLES: Final[dict[str, KindOfTable]] = {
    "planet": _planet(),
    "shell": _Listed(*(key for key in fields_of(Planet).values() if key.within == "shell")),
    "ground": Ground,
    "star": Star,
    "constituent": _constituent(),
    "profile": PROFILES,
    "bulk": BulkGas,
    "layer": Layer,
    "phase_function": PHASES,
    **{one.keyword: one for one in MATTER},
    "composition": _Listed(SHARE),
    "scattering": SCATTERERS,
    "absorption": ABSORBERS,
    "small_particles": _Listed(
        *fields_of(SmallParticleAbsorption).values(), *SmallParticleAbsorption.extra_keys
    ),
    "index": INDICES,
    "sizes": SIZES,
}


def keys_of(kind: str, table: FileTable | None = None) -> tuple[Field, ...]:
    """Keys of a kind of table.

    Parameters
    ----------
    kind : str
        Name of the kind in ``TABLES``.
    table : mapping, optional
        Table of that kind, whose contents restrict its keys.

    Examples
    --------
    >>> [key.name for key in keys_of("profile", {"kind": "tent"})]
    ['kind', 'center', 'half_width']
    """
    return TABLES[kind].declared(table)
