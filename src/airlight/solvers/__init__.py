"""Solvers of radiative transfer: three methods with one interface."""

from airlight.solvers.solution import Report, Solution
from airlight.solvers.solve import solve

__all__ = ["Report", "Solution", "solve"]
