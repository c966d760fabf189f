"""Planet in the viewer: original and edited tables, constituents switched off; solve requests."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

from airlight.errors import ParameterError
from airlight.planets.parameters import MISSING
from airlight.planets.reading.declared_keys import spelled_out
from airlight.planets.reading.nested_tables import Tables, differences
from airlight.planets.reading.planet_file import planet_file
from airlight.planets.reading.reader import nested_tables, planet_text
from airlight.viewer.parameters.amounts import Amount
from airlight.viewer.parameters.parameter import Parameter
from airlight.viewer.parameters.parameter_list import group_of, parameters_of
from airlight.viewer.session.edited_amounts import amounts_in


@dataclass(frozen=True)
class PlanetState:
    """Planet with its edits; immutable.

    Attributes
    ----------
    source : str
        Name of the preset, or path of the planet file.
    base : dict
        Original tables, as returned by ``spelled_out``.
    tables : dict
        Current tables.
    off : tuple of int
        Indices of the constituents that are switched off, ascending.
    """

    source: str
    base: Tables
    tables: Tables
    off: tuple[int, ...] = ()
    _parameters: list[tuple[Parameter, ...]] = field(default_factory=list, compare=False)
    _amounts: list[tuple[Amount, ...]] = field(default_factory=list, compare=False)

    @classmethod
    def opened(cls, name_or_path: str | Path) -> PlanetState:
        """Open a preset by name, or a planet file by path."""
        text, file, folder = planet_text(name_or_path)
        tables = nested_tables(text, file)
        try:
            _check_tables(tables)
            base = spelled_out(tables, folder)
            state = cls(str(name_or_path), base, base)
            _ = state.parameters
        except ParameterError as error:
            raise error.in_file(file) from None
        except (AttributeError, TypeError, KeyError):
            allowed = "a valid planet file"
            raise ParameterError("planet", file, allowed, file) from None
        return state

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Declared parameters; slider ranges are stable while the keys are unchanged."""
        if not self._parameters:
            self._parameters.append(parameters_of(self.tables))
        return self._parameters[0]

    @property
    def amounts(self) -> tuple[Amount, ...]:
        """Amounts of the planet, see ``parameters.amounts``; ranges as in ``parameters``."""
        if not self._amounts:
            self._amounts.append(amounts_in(self.tables))
        return self._amounts[0]

    def with_tables(self, tables: Tables, *, same_keys: bool = False) -> PlanetState:
        """Copy with other tables; ``same_keys`` reuses the list of parameters."""
        parameters, amounts = (self._parameters, self._amounts) if same_keys else ([], [])
        return replace(self, tables=tables, _parameters=parameters, _amounts=amounts)

    def with_off(self, off: tuple[int, ...]) -> PlanetState:
        """Copy with other constituents disabled; the list of parameters is reused."""
        return replace(self, off=off)

    @property
    def groups(self) -> tuple[str, ...]:
        """Groups of the constituents, in the planet's order."""
        constituents = self.tables["constituents"]
        return tuple(group_of(constituents, index) for index in range(len(constituents)))

    @property
    def text(self) -> str:
        """Text of the planet file of the current tables."""
        return planet_file(self.tables)

    @cached_property
    def tables_key(self) -> str:
        """Fingerprint of the tables."""
        return hashlib.sha256(repr(self.tables).encode()).hexdigest()[:32]

    @cached_property
    def clear_key(self) -> str:
        """Fingerprint of the tables without three-dimensional clouds."""
        clear = {name: value for name, value in self.tables.items() if name != "clouds"}
        return hashlib.sha256(repr(clear).encode()).hexdigest()[:32]

    @property
    def changes(self) -> tuple[tuple[str, Any, Any], ...]:
        """Changed paths, with the original and the current value of each."""
        return tuple(differences(self.base, self.tables))

    @property
    def key(self) -> str:
        """Fingerprint of the tables and the switches that determine the solution."""
        return f"{self.clear_key} {self.off}"


def _check_tables(tables: Tables) -> None:
    """Raise if a planet lacks tables that the viewer needs."""
    for name in ("shell", "ground", "star"):
        if not isinstance(tables.get(name), dict):
            raise ParameterError(name, tables.get(name, MISSING), f"a table [{name}]")
    constituents = tables.get("constituents", MISSING)
    if not isinstance(constituents, list) or not constituents:
        raise ParameterError("constituents", constituents, "one or more tables [[constituents]]")


class Versions(NamedTuple):
    """Change counters of planet, view and display.

    Attributes
    ----------
    planet : int
        Inputs of the solution: planet, switches, wavelengths, quality.
    view : int
        Inputs of the rendering: camera, sun, orders, size.
    display : int
        Inputs of the display: exposure, tone map.
    """

    planet: int = 0
    view: int = 0
    display: int = 0


class SolveRequest(NamedTuple):
    """Request of a solution; see ``SolverThread``.

    Attributes
    ----------
    version : int
        Version of the planet.
    state : PlanetState
        Planet to solve.
    quality : str
        Quality of the solution that follows the preview.
    wavelengths : str
        Number of wavelengths, a word of ``view_parameters.WAVELENGTHS``.
    """

    version: int
    state: PlanetState
    quality: str
    wavelengths: str

    @property
    def key(self) -> tuple[str, str]:
        """Key of a request, independent of the quality."""
        return self.state.key, self.wavelengths
