"""Fits of a planet by the formulas of real-time programs, with their errors."""
