"""Shell: the radii of a planet's ground and of the top of its atmosphere."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final, Self

from airlight.errors import ParameterError
from airlight.planets.parameters import parameters
from airlight.planets.schema.field import Field, key
from airlight.planets.schema.toml_model import TomlModel
from airlight.planets.schema.toml_table import TomlTable

#: Smallest thickness of the shell relative to the ground radius, and largest ratio of the radii.
#: [1]
LEAST_THICKNESS: Final = 1e-7
LARGEST_RATIO: Final = 10.0


@parameters
class Shell(TomlModel):
    """Table ``[shell]`` of a planet file: the radii of the atmosphere.

    Parameters
    ----------
    bottom_radius, top_radius : float
        Radii of the ground and of the top of the air, from the centre. [m]
    """

    bottom_radius: float = key(
        label="radius of the ground",
        help="Radius of the ground; the atmosphere keeps its thickness when it is edited.",
        unit="m",
        range=(1e3, 1e12),
        example="6360 km",
        shown="km",
        slider=(10.0, 1e5),
        scale="log",
    )
    top_radius: float = key(
        label="radius of the top of the atmosphere",
        help="Radius of the top of the atmosphere, up to ten times that of the ground.",
        unit="m",
        range=(1e3, 1e13),
        example="6460 km",
        shown="km",
        slider=(10.0, 1e5),
    )

    @classmethod
    def from_values(cls, table: TomlTable, values: Mapping[str, Any]) -> Self:
        """Create the shell; its ground has to have a radius, before any range is checked."""
        bottom = values["bottom_radius"]
        if not bottom > 0.0:
            raise ParameterError(table.name_of("bottom_radius"), bottom, "more than 0 m")
        return super().from_values(table, values)

    def __post_init__(self) -> None:
        if not self.bottom_radius < self.top_radius:
            allowed = f"more than bottom_radius, {self.bottom_radius:.10g} m"
            raise ParameterError("top_radius", self.top_radius, allowed)


#: Key of the table of the radii.
SHELL: Final = Field(
    name="shell",
    label="shell",
    help="Radii of the atmosphere.",
    kind="table",
    table=Shell,
    example="a table [shell] with bottom_radius and top_radius",
    mode="standard",
    required=True,
)
