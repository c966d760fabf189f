"""Backward Monte Carlo in the spherical shell: the referee without geometric approximation."""
