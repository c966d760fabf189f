"""Observer, camera and projections, direction of the sun, map of the ground."""

from __future__ import annotations

from airlight.scene.camera import Camera
from airlight.scene.observer import horizon_zenith, look_at
from airlight.scene.scene import Scene

__all__ = ["Camera", "Scene", "horizon_zenith", "look_at"]
