"""Composition of atmosphere and sky with another renderer's image and depth."""

from __future__ import annotations

from airlight.composition.composed import Composed, compose
from airlight.composition.pinhole import Pinhole
from airlight.composition.placement import Placement

__all__ = ["Composed", "Pinhole", "Placement", "compose"]
