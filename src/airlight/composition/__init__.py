"""Composition: the air over a picture that another renderer drew, by its depth."""

from __future__ import annotations

from airlight.composition.composed import Composed, compose
from airlight.composition.pinhole import Pinhole
from airlight.composition.placement import Placement

__all__ = ["Composed", "Pinhole", "Placement", "compose"]
