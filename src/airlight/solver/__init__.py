"""Solvers of radiative transfer: three methods with one interface."""

from airlight.solver.report import Report
from airlight.solver.solution import Solution
from airlight.solver.solve import solve

__all__ = ["Report", "Solution", "solve"]
