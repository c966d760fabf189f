"""What the rows of the panels show: values and defaults of the session, read once a change."""

from __future__ import annotations

from collections.abc import Mapping

from airlight.errors import AirlightError
from airlight.viewer.parameters.parameter import Parameter, Value
from airlight.viewer.parameters.parameter_list import value_at
from airlight.viewer.parameters.view_parameters import DEFAULTS
from airlight.viewer.session.session import Session


class PanelValues:
    """Values of a session's parameters, kept until one changes.

    Parameters
    ----------
    session : Session
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self._key: object = None
        self._base_key: object = None
        self._values: Mapping[str, Value] = {}
        self._defaults: dict[str, Value] = {}
        self.parameters: tuple[Parameter, ...] = ()

    def refresh(self) -> None:
        """Read what changed since the last call."""
        session = self._session
        key = (session.versions, session.planet)
        if self._key == key:
            return
        self._key = key
        self.parameters = session.parameters
        self._values = session.values
        base_key = (id(session.planet.base), session.planet.parameters)
        if self._base_key != base_key:
            self._base_key = base_key
            self._defaults = {}

    @property
    def of_planet(self) -> tuple[Parameter, ...]:
        """Those of the planet's file."""
        return self._session.planet.parameters

    @property
    def of_view(self) -> tuple[Parameter, ...]:
        """Those of camera, sun, display and light."""
        return tuple(
            one for one in self.parameters if one.path.startswith(("view.", "display.", "light."))
        )

    def value(self, parameter: Parameter) -> Value:
        """What a parameter is set to."""
        return self._values[parameter.path]

    def default(self, parameter: Parameter) -> Value:
        """What it came with; its own value if it came without."""
        path = parameter.path
        if path in DEFAULTS:
            return DEFAULTS[path]
        if path.startswith("light."):
            return True
        if path not in self._defaults:
            try:
                self._defaults[path] = value_at(self._session.planet.base, parameter)
            except (AirlightError, AttributeError, TypeError, KeyError, IndexError):
                return self.value(parameter)
        return self._defaults[path]
