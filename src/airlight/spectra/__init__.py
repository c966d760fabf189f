"""Spectra: the sun and other stars, the eye's colour-matching functions, absorption by ozone."""
