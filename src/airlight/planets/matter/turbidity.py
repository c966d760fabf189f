"""Haze by turbidity or optical depth and an Ångström or Junge exponent."""

from __future__ import annotations

from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ConflictError, ParameterError
from airlight.physics.units import values_in
from airlight.planets.matter.matter import Matter
from airlight.planets.matter.phases import PhaseFunction
from airlight.planets.matter.state_keys import ALBEDO, DEPTH
from airlight.planets.parameters import MISSING, parameters
from airlight.planets.schema.field import Field, always, key
from airlight.planets.spectral import EVERYWHERE, Limits

FloatArray = npt.NDArray[np.float64]

#: Wavelength of turbidity and optical depth. [nm]
AT: Final = 550.0
#: K of Costa et al., Table 1, at the wavelengths of red, green and blue. [nm], [1]
_K_AT: Final = (440.0, 550.0, 680.0)
_K: Final = (0.0089, 0.0092, 0.0096)
#: Wavelengths up to which K is constant beyond its ends. [nm]
_K_LIMITS: Final[Limits] = (360.0, 830.0)


def _no_phase_function() -> ParameterError:
    return ConflictError("phase_function", "is required with turbidity")


_TURBIDITY: Final = Field(
    help="1 is clear air, 2 clean, 10 thick haze.",
    range=(1.0, 100.0),
    example="2",
    slider=(1.0, 10.0),
)


class _Haze(Matter):
    """Matter that requires a phase function."""

    @property
    def needs_phase(self) -> str:
        """Turbidity, which does not determine a phase function."""
        return "turbidity"

    def phase_function(self, wavelengths: npt.ArrayLike) -> PhaseFunction:
        """Raise an error, as the phase function belongs to the constituent."""
        raise _no_phase_function()


@parameters
class Turbidity(_Haze):
    """Haze with scattering proportional to a power of the wavelength.

    Parameters
    ----------
    turbidity : float, optional
        T, optical depth of gas and haze over that of the gas at 550 nm, 1 to 100. [1]
    rayleigh_optical_depth : float, optional
        Optical depth of the gas at 550 nm, with a turbidity. [1]
    optical_depth : float, optional
        Vertical optical depth of extinction by the haze at 550 nm, instead of a turbidity. [1]
    junge : float, optional
        v, 2 to 6: N(r) ∝ r^-(v+1) scatters like λ^-(v-2). [1]
    angstrom : float, optional
        Exponent v - 2, instead of v, 0 to 4. [1]
    single_scattering_albedo : float
        Albedo at all wavelengths. [1]

    References
    ----------
    Ångström (1929), Geografiska Annaler 11, 156; Junge (1963), Air Chemistry and Radioactivity.

    Examples
    --------
    >>> haze = Turbidity(turbidity=2.0, rayleigh_optical_depth=0.0973, junge=4.0)
    >>> (1e5 * haze.scattering_coefficients([550.0, 1100.0], 1200.0)).round(3).tolist()
    [8.108, 2.027]
    """

    keyword = "turbidity"
    label = "turbidity"
    help = "Haze by one number; it needs a `phase_function`."
    example = "{ optical_depth = 0.1, … }"

    turbidity: float | None = key(
        _TURBIDITY, note="τ(550 nm) = (T-1) τ_R of the gas.", default=None
    )
    rayleigh_optical_depth: float | None = key(
        label="optical depth of the gas",
        help="Vertical optical depth of the clear air at 550 nm.",
        range=(0.0, 1e3),
        slider=(1e-3, 10.0),
        scale="log",
        default=None,
    )
    optical_depth: float | None = key(
        DEPTH,
        help="Of the haze straight up, at 550 nm.",
        note="Instead of the turbidity.",
        default=None,
    )
    junge: float | None = key(
        label="Junge exponent",
        help="Junge exponent of the size distribution; 4 makes the haze vary as λ^-2.",
        note="Scattering and absorption vary as λ^-(v-2).",
        range=(2.0, 6.0),
        default=None,
    )
    angstrom: float | None = key(
        label="Ångström exponent",
        help="Exponent of the haze's decrease with wavelength.",
        note="Alternative to the Junge exponent.",
        range=(0.0, 4.0),
        default=None,
    )
    single_scattering_albedo: float = key(ALBEDO, offered=always, default=1.0)

    def __post_init__(self) -> None:
        if (self.turbidity is None) == (self.optical_depth is None):
            given = MISSING if self.turbidity is None else self.turbidity
            raise ParameterError("turbidity", given, "either turbidity or optical_depth")
        if (self.turbidity is None) != (self.rayleigh_optical_depth is None):
            depth = self.rayleigh_optical_depth
            phrase = "is required with turbidity" if depth is None else "requires turbidity"
            raise ConflictError("rayleigh_optical_depth", phrase)
        if (self.junge is None) == (self.angstrom is None):
            given = MISSING if self.junge is None else self.junge
            raise ParameterError("junge", given, "either junge or angstrom, which is junge - 2")

    @property
    def limits(self) -> Limits:
        """Wavelength range, unlimited. [nm]"""
        return EVERYWHERE

    def _extinction(self, wavelengths: npt.ArrayLike, vertical_column: float) -> FloatArray:
        if self.optical_depth is not None:
            depth = self.optical_depth
        else:
            assert self.turbidity is not None
            assert self.rayleigh_optical_depth is not None
            depth = (self.turbidity - 1.0) * self.rayleigh_optical_depth
        exponent = self.angstrom if self.angstrom is not None else (self.junge or 2.0) - 2.0
        ratio = values_in(wavelengths, "nm", "wavelengths") / AT
        return np.asarray(depth / vertical_column * ratio**-exponent)

    def scattering_coefficients(
        self, wavelengths: npt.ArrayLike, vertical_column: float
    ) -> FloatArray:
        """Scattering coefficient at relative density 1, shape (nl,). [m⁻¹]"""
        return self.single_scattering_albedo * self._extinction(wavelengths, vertical_column)

    def absorption_coefficients(
        self, wavelengths: npt.ArrayLike, vertical_column: float
    ) -> FloatArray:
        """Absorption coefficient at relative density 1, shape (nl,). [m⁻¹]"""
        share = 1.0 - self.single_scattering_albedo
        return share * self._extinction(wavelengths, vertical_column)


@parameters
class LiteralTurbidity(_Haze):
    r"""Eq. 17 of the OpenSpace paper as printed, for v = 4.

    .. math:: \beta = 0.434\, C(T)\, \pi \left(\frac{2\pi}{\lambda}\right)^{v-2} K, \qquad
              C = (0.65\,T - 0.65)\cdot 10^{-16}

    Parameters
    ----------
    turbidity : float
        T, 1 to 100. [1]
    junge : float
        v = 4; the units of the formula are wrong for other values. [1]

    Notes
    -----
    λ in m; the result is read in m⁻¹. K is (0.0096, 0.0092, 0.0089) at 680, 550 and 440 nm, linear
    between them. Absorption is 0; the result does not depend on the thickness of the haze.

    References
    ----------
    Costa et al., the OpenSpace paper, eq. 17 and Table 1.

    Examples
    --------
    >>> haze = LiteralTurbidity(turbidity=2.0)
    >>> f"{haze.scattering_coefficients([550.0], 1200.0)[0]:.3e}"
    '1.064e-04'
    """

    keyword = "turbidity_literal"
    label = "turbidity"
    help = "Haze as OpenSpace has it; it needs a `phase_function`."
    example = "{ turbidity = 2 }"

    turbidity: float = key(_TURBIDITY, note="Eq. 17 as printed: 1.064e-4 /m at T = 2 and 550 nm.")
    junge: float = key(
        label="Junge exponent",
        help="The published equation holds for 4 only.",
        range=(4.0, 4.0),
        default=4.0,
    )

    @property
    def limits(self) -> Limits:
        """Wavelength range of K. [nm]"""
        return _K_LIMITS

    def scattering_coefficients(
        self, wavelengths: npt.ArrayLike, vertical_column: float
    ) -> FloatArray:
        """Scattering coefficient at relative density 1, shape (nl,). [m⁻¹]"""
        nm = values_in(wavelengths, "nm", "wavelengths")
        concentration = (0.65 * self.turbidity - 0.65) * 1e-16
        k = np.interp(nm, _K_AT, _K)
        return np.asarray(0.434 * concentration * np.pi * (2.0 * np.pi / (1e-9 * nm)) ** 2 * k)

    def absorption_coefficients(
        self, wavelengths: npt.ArrayLike, vertical_column: float
    ) -> FloatArray:
        """Zeros, shape (nl,). [m⁻¹]"""
        return np.zeros(np.shape(wavelengths))
