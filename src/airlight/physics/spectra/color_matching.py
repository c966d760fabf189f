"""Colour-matching functions of the standard observer."""

from __future__ import annotations

from airlight.physics.spectra.tables import Spectrum, read_spectrum


def cie_1931() -> Spectrum:
    """CIE 1931 2° colour-matching functions, 360 to 830 nm at 1 nm.

    Returns
    -------
    Spectrum
        ``values`` has shape (471, 3): x̄, ȳ, z̄. [1]

    References
    ----------
    ISO/CIE 11664-1:2019, Colorimetry, Part 1: CIE standard colorimetric observers.

    Examples
    --------
    >>> cie_1931().at(555.0)  # ȳ is 1 where the eye is most sensitive
    array([0.5120501, 1.       , 0.00575  ])
    """
    return read_spectrum("cie-1931")
