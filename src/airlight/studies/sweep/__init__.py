"""Sweeps: radiances on grids of planets, suns and views, computed in parallel, as Zarr."""

from __future__ import annotations

from airlight.studies.sweep.grid import Grid
from airlight.studies.sweep.sweep import Swept, sweep

__all__ = ["Grid", "Swept", "sweep"]
