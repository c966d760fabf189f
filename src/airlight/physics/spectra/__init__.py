"""Spectra: sun and stars, colour-matching functions, ozone absorption."""
