"""Backward Monte Carlo in the spherical shell, without geometric approximation: the referee."""
