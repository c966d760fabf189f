"""Measured skies by Kider et al. (2014): scans, planets, rows and pictures."""
