"""Solvers: three methods behind one interface, from a medium to its light."""

from airlight.solvers.solution import Report, Solution
from airlight.solvers.solve import solve

__all__ = ["Report", "Solution", "solve"]
