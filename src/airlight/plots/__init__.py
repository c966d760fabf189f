"""Figures of planets and their light: ordinary matplotlib figures, every axis with its unit."""

from __future__ import annotations

from airlight.plots.catalogue import KINDS, Choices, Work, draw

__all__ = ["KINDS", "Choices", "Work", "draw"]
