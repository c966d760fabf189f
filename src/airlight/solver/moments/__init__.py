"""Successive orders of scattering by spherical-harmonic moments of the radiance."""
