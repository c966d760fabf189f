"""Polarised light against published tables, SASKTRAN 2 and vector Monte Carlo."""
