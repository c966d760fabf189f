"""Optical properties of matter: cross-sections, phase functions, density profiles."""
