"""Scene files: several bodies, lights and an observer in one frame."""

from __future__ import annotations

from airlight.scene.system.reading import is_scene_file, load_system, system_names
from airlight.scene.system.system import System

__all__ = ["System", "is_scene_file", "load_system", "system_names"]
