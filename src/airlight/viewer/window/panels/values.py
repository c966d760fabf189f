"""Parameters, values and defaults for the rows of the panels, read once per change."""

from __future__ import annotations

from collections.abc import Mapping

from airlight.errors import AirlightError
from airlight.viewer.parameters.amounts import Amount
from airlight.viewer.parameters.cloud_kinds import is_cloud_kind, original_clouds
from airlight.viewer.parameters.parameter import Parameter, Value
from airlight.viewer.parameters.parameter_list import value_at
from airlight.viewer.session.edited_amounts import amount_value
from airlight.viewer.session.session import Session, Versions


class PanelValues:
    """Snapshot of a session's parameters at the last ``refresh``.

    If a row edits the session, the remaining rows of the frame still show the snapshot.

    Attributes
    ----------
    parameters : tuple of Parameter
        All parameters.
    of_planet : tuple of Parameter
        Amounts of the planet, and parameters of its file.
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self._versions: Versions | None = None
        self._planet = session.planet
        self._values: Mapping[str, Value] = {}
        self._defaults: dict[str, Value] = {}
        self.parameters: tuple[Parameter, ...] = ()
        self.of_planet: tuple[Parameter, ...] = ()
        self._file: tuple[Parameter, ...] = ()

    def refresh(self) -> None:
        """Read the changes since the last call; after an error, the next call tries again."""
        session = self._session
        planet = session.planet
        if self._versions == session.versions and self._planet is planet:
            return
        parameters, of_planet, values = session.parameters, planet.parameters, session.values
        if self._planet.base is not planet.base or self._file is not of_planet:
            self._defaults = {}
        self._planet, self._file = planet, of_planet
        self.parameters, self._values = parameters, values
        self.of_planet = (*planet.amounts, *of_planet)
        self._versions = session.versions

    @property
    def of_view(self) -> tuple[Parameter, ...]:
        """Parameters of camera, sun, display and light."""
        return tuple(
            one for one in self.parameters if one.path.startswith(("view.", "display.", "light."))
        )

    def value(self, parameter: Parameter) -> Value:
        """Value of a parameter. [parameter.unit]"""
        return self._values[parameter.path]

    def default(self, parameter: Parameter) -> Value:
        """Default or original value; the current value if there is none. [parameter.unit]"""
        path = parameter.path
        if path in self._session.first_view:
            return self._session.first_view[path]
        if path.startswith("light."):
            return True
        if path not in self._defaults:
            try:
                base = self._planet.base
                if path.startswith("clouds[") and not is_cloud_kind(path):
                    base = original_clouds(base, self._planet.tables)
                self._defaults[path] = (
                    amount_value(base, parameter)
                    if isinstance(parameter, Amount)
                    else value_at(base, parameter)
                )
            except (AirlightError, AttributeError, TypeError, KeyError, IndexError):
                return self.value(parameter)
        return self._defaults[path]
