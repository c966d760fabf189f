"""Radiances of an independent spherical Monte Carlo code."""
