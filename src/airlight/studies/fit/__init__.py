"""Fit of a planet's parameters to measured radiances or to a photograph, with error bars."""

from __future__ import annotations

from airlight.studies.fit.fit_sky import SkyFit, fit_photograph, fit_radiances

__all__ = ["SkyFit", "fit_photograph", "fit_radiances"]
