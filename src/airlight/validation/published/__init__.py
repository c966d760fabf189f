"""Published radiances, fluxes and albedos against ours, with their sources."""
