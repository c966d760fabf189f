"""Backward Monte Carlo in spherical geometry without approximation: the reference solver."""
