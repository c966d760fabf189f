"""Successive orders of scattering, kept as spherical-harmonic moments of the radiance."""
