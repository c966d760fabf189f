"""Planets of the reference radiances and golden numbers: AP2's Earth and variants.

AP2: J. Boody, Atmosphere Plus notes, the later print, sections 1.3 to 1.7.
"""

from __future__ import annotations

from typing import Final, Literal

from airlight.planets import Constituent, Ground, Planet, Star
from airlight.planets.matter.phases import CornetteShanks, HenyeyGreenstein, Rayleigh
from airlight.planets.matter.profiles import Exponential, Tent
from airlight.planets.spectral import PerWavelength

#: Wavelengths of all these planets. [nm]
WAVELENGTHS: Final = (680.0, 550.0, 440.0)
#: Absorption coefficient of the aerosol as printed in AP2, and as in AP2's source. [m⁻¹]
PRINTED_ABSORPTION: Final = 4.40e-6
CORRECTED_ABSORPTION: Final = 0.444e-6


def reference_earth(
    *,
    albedo: float,
    aerosol: Literal["cornette-shanks", "henyey-greenstein"] | None = "cornette-shanks",
    ozone: bool = True,
    aerosol_absorption: float = PRINTED_ABSORPTION,
) -> Planet:
    """AP2's Earth under a point star of irradiance 1.

    Parameters
    ----------
    albedo : float
        Albedo of the ground. [1]
    aerosol : str or None
        Phase function of the aerosol, g = 0.8; None for no aerosol.
    ozone : bool
        Whether to include ozone.
    aerosol_absorption : float
        Absorption coefficient of the aerosol. [m⁻¹]
    """
    parts = [
        Constituent(
            name="air",
            profile=Exponential(scale_height=8000.0),
            scattering=PerWavelength(
                wavelengths=WAVELENGTHS, values=(5.802e-6, 13.558e-6, 33.1e-6)
            ),
            phase_function=Rayleigh(),
        )
    ]
    if aerosol is not None:
        lobe = CornetteShanks if aerosol == "cornette-shanks" else HenyeyGreenstein
        parts.append(
            Constituent(
                name="aerosol",
                profile=Exponential(scale_height=1200.0),
                scattering=3.996e-6,
                absorption=aerosol_absorption,
                phase_function=lobe(asymmetry=0.8),
            )
        )
    if ozone:
        parts.append(
            Constituent(
                name="ozone",
                profile=Tent(center=25e3, half_width=15e3),
                absorption=PerWavelength(
                    wavelengths=WAVELENGTHS, values=(0.65e-6, 1.881e-6, 0.085e-6)
                ),
            )
        )
    return Planet(
        name="reference",
        bottom_radius=6360e3,
        top_radius=6460e3,
        ground=Ground(albedo=albedo),
        star=Star(irradiance=1.0, angular_radius=0.0),
        constituents=tuple(parts),
    )
