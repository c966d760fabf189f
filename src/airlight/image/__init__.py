"""Colour: spectra to linear sRGB, exposure, tone maps, display encodings."""
