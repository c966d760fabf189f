"""Fits of a planet by the formulas that programs for real time know, each with its error."""
