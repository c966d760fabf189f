"""Solvers of radiative transfer: three methods with one interface."""

from airlight.solver.solution import Report, Solution
from airlight.solver.solve import solve

__all__ = ["Report", "Solution", "solve"]
