"""Polarised light beside published tables, another program and vector Monte Carlo."""
