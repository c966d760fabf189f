"""Figures of planets and their light, as matplotlib figures with a unit on every axis."""

from __future__ import annotations

from airlight.studies.plots.catalogue import KINDS, Choices, Work, draw

__all__ = ["KINDS", "Choices", "Work", "draw"]
