"""Scene description: observer, camera, projections, lights and ground maps."""

from __future__ import annotations

from airlight.scene.camera import Camera
from airlight.scene.observer import horizon_zenith, look_at
from airlight.scene.scene import Scene

__all__ = ["Camera", "Scene", "horizon_zenith", "look_at"]
