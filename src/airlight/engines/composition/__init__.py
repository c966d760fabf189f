"""Composition of atmosphere and sky with another renderer's image and depth."""

from __future__ import annotations

from airlight.engines.composition.composed import Composed, compose
from airlight.engines.composition.pinhole import Pinhole
from airlight.engines.composition.placement import Placement

__all__ = ["Composed", "Pinhole", "Placement", "compose"]
