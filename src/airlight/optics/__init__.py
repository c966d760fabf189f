"""From matter to coefficients: cross-sections, phase functions, densities with altitude."""
