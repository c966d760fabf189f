"""A sphere in a shell: distances, horizons, paths, quadratures. No physics of light."""
