"""Published radiances, fluxes and albedos against those of airlight, with sources."""
