"""Titan: spectral albedo of its full disc.

Karkoschka (1998), Methane, ammonia, and temperature measurements of the Jovian planets and Titan
from CCD-spectrophotometry, Icarus 133, 134: albedo of the full disc in July 1995 at a phase of
5.7°, table ``1995low.tab`` of NASA PDS volume GBAT_0001; calibrated to 4 %. Second-hand: means over
10 nm, over the disc of the ground (``docs/reports/atmospheres.md`` of the public repository
migujorg/claude-space-thing).
"""

from __future__ import annotations

from typing import Final

from airlight.planets import Constituent, Planet, load_planet, replace
from airlight.planets.matter.absorbers import CrossSectionAbsorption
from airlight.planets.matter.profiles import Tabulated
from airlight.validation.published.rayleigh_sphere import geometric_albedo
from airlight.validation.published.row import PublishedRow, PublishedSection, Solve

#: Albedo of the full disc by wavelength [nm]. [1]
ALBEDOS: Final = {
    800.0: 0.201, 760.0: 0.280, 720.0: 0.214, 680.0: 0.291, 640.0: 0.282, 600.0: 0.257,
    560.0: 0.226, 520.0: 0.187, 480.0: 0.148, 440.0: 0.115,
}  # fmt: skip
#: Uncertainty of the calibration. [1]
CALIBRATION: Final = 0.04

#: Column of methane on Titan: 3.5 % of the preset's gas. [m⁻²]
METHANE: Final = 8.48e28
#: Altitudes [km] and number density of methane relative to the ground [1]: 5.65 % of the gas up to
#: 6.5 km, 1.48 % from 32.5 km, with logarithmic interpolation in between (Niemann et al. 2010, JGR
#: 115, E12006), times the densities of Waite et al. (2013).
_ALTITUDES: Final = (
    0, 5, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55, 60, 65, 70, 80, 120, 150, 180, 250, 300,
)  # fmt: skip
_DENSITIES: Final = (
    1, 0.8192, 0.5492, 0.3371, 0.2041, 0.1217, 0.07142, 0.04657, 0.03379, 0.0244, 0.0175, 0.01216,
    0.00816, 0.004904, 0.003814, 0.002427, 0.000599, 0.00025, 0.000114, 2.2e-05, 8e-06,
)  # fmt: skip


def titan_with_methane() -> Planet:
    """Preset ``titan`` with the methane bands that it omits."""
    titan = load_planet("titan")
    methane = Constituent(
        name="methane",
        profile=Tabulated(
            altitudes=tuple(1e3 * h for h in _ALTITUDES), densities=tuple(map(float, _DENSITIES))
        ),
        absorption=CrossSectionAbsorption(cross_section="methane-bands", column=METHANE),
    )
    return replace(titan, constituents=(*titan.constituents, methane))


def full_disc(solve: Solve, quality: object = "preview") -> PublishedSection:
    """Full-disc albedo against telescopic measurements.

    Parameters
    ----------
    solve : callable
        See ``row.Solve``.
    """
    ours = geometric_albedo(solve(titan_with_methane(), tuple(ALBEDOS), quality))
    rows = [
        PublishedRow(
            what=f"Titan's full disc, {nm:g} nm, albedo", published=albedo, ours=float(found),
            error=CALIBRATION * albedo, source="Karkoschka (1998)",
        )
        for (nm, albedo), found in zip(ALBEDOS.items(), ours, strict=True)
    ]  # fmt: skip
    return PublishedSection(
        title="Titan's full disc",
        rows=rows,
        note="Ours with the bands of methane, at full phase; seen at 5.7°, where it is some 2 % "
        "less. The bands are about 720 and 800 nm; between them and in the blue it is the haze's "
        "albedo that differs. "
        "The stated error is that of the calibration.",
    )
