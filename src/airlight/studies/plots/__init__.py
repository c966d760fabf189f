"""Figures of planets and their radiation, by matplotlib."""

from __future__ import annotations

from airlight.studies.plots.catalogue import KINDS, Choices, Work, draw

__all__ = ["KINDS", "Choices", "Work", "draw"]
