"""airlight: radiative transfer and rendering of planetary atmospheres.

A planet file becomes a ``Medium``, a medium a ``Solution``, a solution seen by a camera a
``Frame``, a frame a picture. The names below are imported lazily.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from airlight.engines.baking.bake import bake
    from airlight.engines.baking.table_files import load_tables
    from airlight.engines.composition import Pinhole, Placement, compose
    from airlight.errors import (
        AirlightError,
        AirlightWarning,
        Cancelled,
        ConvergenceError,
        FileError,
        ParameterError,
    )
    from airlight.planets import (
        Constituent,
        Ground,
        Medium,
        Planet,
        Star,
        load_planet,
        planet_names,
        replace,
    )
    from airlight.planets.importing.import_table import ImportedPlanet, import_table
    from airlight.planets.lowered_ground import lowered_ground
    from airlight.render import Frame, render
    from airlight.render.picture import write_picture
    from airlight.scene import Camera, Scene, look_at
    from airlight.scene.local_ground import local_ground
    from airlight.scene.moon_light import MoonLight
    from airlight.scene.star_light import StarLight
    from airlight.solver import Solution, solve
    from airlight.solver.stokes_frame import angle_of_polarisation, degree_of_polarisation
    from airlight.studies.observables import Plane, irradiance, observe

#: Module of each public name.
_HOMES = {
    "load_planet": "airlight.planets",
    "planet_names": "airlight.planets",
    "import_table": "airlight.planets.importing.import_table",
    "ImportedPlanet": "airlight.planets.importing.import_table",
    "Planet": "airlight.planets",
    "Constituent": "airlight.planets",
    "Ground": "airlight.planets",
    "Star": "airlight.planets",
    "Medium": "airlight.planets",
    "replace": "airlight.planets",
    "solve": "airlight.solver",
    "Solution": "airlight.solver",
    "degree_of_polarisation": "airlight.solver.stokes_frame",
    "angle_of_polarisation": "airlight.solver.stokes_frame",
    "Camera": "airlight.scene",
    "Scene": "airlight.scene",
    "look_at": "airlight.scene",
    "local_ground": "airlight.scene.local_ground",
    "lowered_ground": "airlight.planets.lowered_ground",
    "MoonLight": "airlight.scene.moon_light",
    "StarLight": "airlight.scene.star_light",
    "render": "airlight.render",
    "Frame": "airlight.render",
    "write_picture": "airlight.render.picture",
    "observe": "airlight.studies.observables",
    "irradiance": "airlight.studies.observables",
    "Plane": "airlight.studies.observables",
    "bake": "airlight.engines.baking.bake",
    "load_tables": "airlight.engines.baking.table_files",
    "compose": "airlight.engines.composition",
    "Pinhole": "airlight.engines.composition",
    "Placement": "airlight.engines.composition",
    "AirlightError": "airlight.errors",
    "AirlightWarning": "airlight.errors",
    "ParameterError": "airlight.errors",
    "FileError": "airlight.errors",
    "ConvergenceError": "airlight.errors",
    "Cancelled": "airlight.errors",
}

__all__ = [
    "load_planet",
    "planet_names",
    "import_table",
    "ImportedPlanet",
    "Planet",
    "Constituent",
    "Ground",
    "Star",
    "Medium",
    "replace",
    "solve",
    "Solution",
    "degree_of_polarisation",
    "angle_of_polarisation",
    "Camera",
    "Scene",
    "look_at",
    "local_ground",
    "lowered_ground",
    "MoonLight",
    "StarLight",
    "render",
    "Frame",
    "write_picture",
    "observe",
    "irradiance",
    "Plane",
    "bake",
    "load_tables",
    "compose",
    "Pinhole",
    "Placement",
    "AirlightError",
    "AirlightWarning",
    "ParameterError",
    "FileError",
    "ConvergenceError",
    "Cancelled",
    "__version__",
]


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        return version("airlight")
    if name not in _HOMES:
        raise AttributeError(f"module 'airlight' has no attribute {name!r}")
    value = getattr(import_module(_HOMES[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
