"""Sweeps: radiances on grids of planets, suns and views, as Zarr, computed by many processes."""

from __future__ import annotations

from airlight.studies.sweep.grid import Grid
from airlight.studies.sweep.sweep import Swept, sweep

__all__ = ["Grid", "Swept", "sweep"]
