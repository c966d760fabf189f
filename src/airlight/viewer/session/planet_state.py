"""One planet as the viewer holds it: what it came with, what it became, what is switched off."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

from airlight.errors import ParameterError
from airlight.planets.reading.reader import planet_tables, planet_text
from airlight.viewer.parameters.nested_tables import Tables, differences
from airlight.viewer.parameters.parameter import Parameter
from airlight.viewer.parameters.parameter_list import group_of, parameters_of, spelled_out
from airlight.viewer.session.planet_file import planet_file


@dataclass(frozen=True)
class PlanetState:
    """A planet with its edits; never changed, only replaced.

    Attributes
    ----------
    source : str
        The name of the preset, or the path of the planet file.
    base : dict
        The tables that it came with, spelled out.
    tables : dict
        Those that it has now.
    off : tuple of int
        Places of the constituents that are switched off, ascending.
    """

    source: str
    base: Tables
    tables: Tables
    off: tuple[int, ...] = ()
    _parameters: list[tuple[Parameter, ...]] = field(default_factory=list, compare=False)

    @classmethod
    def opened(cls, name_or_path: str | Path) -> PlanetState:
        """A planet by the name of a preset, or from a planet file.

        Raises
        ------
        FileError, ParameterError
            If there is none, or it has a key that the declared list does not know.
        """
        text, file, folder = planet_text(name_or_path)
        tables = planet_tables(text, file)
        try:
            base = spelled_out(tables, folder)
            state = cls(str(name_or_path), base, base)
            _ = state.parameters
        except ParameterError as error:
            raise error.in_file(file) from None
        except (AttributeError, TypeError, KeyError):
            raise ParameterError("planet", file, "a planet file, with tables where it has them",
                                 file) from None  # fmt: skip
        return state

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Those of the planet. The sliders' ends stay as long as the keys do."""
        if not self._parameters:
            self._parameters.append(parameters_of(self.tables))
        return self._parameters[0]

    def with_tables(self, tables: Tables, *, same_keys: bool = False) -> PlanetState:
        """The planet with other tables; ``same_keys`` keeps the list of parameters."""
        kept = self._parameters if same_keys else []
        return replace(self, tables=tables, _parameters=kept)

    def with_off(self, off: tuple[int, ...]) -> PlanetState:
        """The planet with other constituents switched off; the list of parameters stays."""
        return replace(self, off=off)

    @property
    def groups(self) -> tuple[str, ...]:
        """Groups of the constituents, in their order."""
        constituents = self.tables["constituents"]
        return tuple(group_of(constituents, index) for index in range(len(constituents)))

    @property
    def text(self) -> str:
        """The planet file of its tables."""
        return planet_file(self.tables)

    @cached_property
    def tables_key(self) -> str:
        """A fingerprint of the tables."""
        return hashlib.sha256(repr(self.tables).encode()).hexdigest()[:32]

    @property
    def changes(self) -> tuple[tuple[str, Any, Any], ...]:
        """Paths that differ from what it came with, and both values."""
        return tuple(differences(self.base, self.tables))

    @property
    def key(self) -> str:
        """A fingerprint of what has to be solved: the tables and the switches."""
        return f"{self.tables_key} {self.off}"
