"""Constants, units, spectra and the optics of gases, particles and ground."""
