"""Geometry of a spherical shell: distances, horizons, paths, quadratures."""
