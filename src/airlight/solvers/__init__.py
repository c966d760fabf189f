"""From a medium to its light: three solvers behind one interface."""

from airlight.solvers.solution import Report, Solution
from airlight.solvers.solve import solve

__all__ = ["Report", "Solution", "solve"]
