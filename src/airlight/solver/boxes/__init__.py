"""Solver of boxes of cloud: discrete ordinates in three dimensions."""
