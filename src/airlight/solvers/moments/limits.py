"""Limits of the air that the moments solver takes on: beyond them no iteration would end."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.planets.medium import Medium
from airlight.solvers.moments.reduced_optics import Optics
from airlight.tables.columns import density_table

FloatArray = NDArray[np.float64]

#: Largest vertical optical depth through which light wanders, scatterings weighted by 1 - g. [1]
DEEPEST: Final = 500.0
#: Largest such depth times the height that holds nine tenths of the scattering, over the radius:
#: where light goes as far around the planet as up and down, the inverse along the vertical fails.
WIDEST: Final = 2.0
#: Part of light of degree 4 that a scattering may send backwards, and the scattering optical depth
#: up to which it may send more: g of -0.97.
BACKWARD: Final = 0.97**4 + 1e-9
THIN: Final = 1.0
#: Number of diffusion lengths that hold all the light that comes back.
_HOLDING: Final = 10.0


def check_limits(optics: Optics) -> None:
    """Refuse air in which light is scattered to and fro too many times.

    Light wanders through all of the air where that absorbs nothing, and otherwise as far as light
    diffuses in it (``diffusion_lengths``).

    Parameters
    ----------
    optics : Optics
        Optics of a medium, with the degree of the harmonics.

    Raises
    ------
    ParameterError
        If the air is too deep, too deep for its height, or too deep for its backward peak.
    """
    medium = optics.medium
    scattered = medium.columns[:, None] * medium.scattering
    turned = (scattered * (1.0 - optics.phases[..., 1])).sum(axis=0)
    lengths = diffusion_lengths(medium, optics.phases[..., 1])
    wandered = turned * np.minimum(1.0, _HOLDING / np.maximum(lengths, 1e-300))
    fourth = medium.phase_moments(4)[..., 4]
    backward = (optics.phases[..., 1] < 0.0) & (fourth > BACKWARD)
    peaked = np.where(backward, scattered, 0.0)
    height = 2.0 * optics.depths.reach / medium.bottom_radius
    deepest = min(DEEPEST, WIDEST / height) if height > 0.0 else DEEPEST
    for at, nm in enumerate(medium.wavelengths):
        if wandered[at] > deepest:
            raise ParameterError(
                f"vertical optical depth of scattering, times 1 - g, at {nm:g} nm",
                float(f"{wandered[at]:.4g}"),
                f"0 to {deepest:.4g}, or air that absorbs more",
            )
        which = int(peaked[:, at].argmax())
        if peaked[which, at] > THIN:
            raise ParameterError(
                f"mean cosine g of scattering by {medium.names[which]} at {nm:g} nm",
                float(f"{optics.phases[which, at, 1]:.4g}"),
                f"-0.97 or more where the vertical optical depth of scattering is above {THIN:g}",
            )


def diffusion_lengths(medium: Medium, asymmetry: FloatArray) -> FloatArray:
    """Number of diffusion lengths that the air is deep: ∫ sqrt(3(1 - ϖ)(1 - ϖg)) dτ. [1]

    The root is the exponent by which diffuse light falls off in Eddington's approximation. Air that
    absorbs in one layer alone counts only there: elsewhere light wanders all the same.

    Parameters
    ----------
    medium : Medium
        Medium with nl wavelengths and nc constituents.
    asymmetry : array, shape (nc, nl)
        Mean cosines g of scattering. [1]

    Returns
    -------
    array, shape (nl,)
        0 where nothing absorbs.
    """
    density, altitude = density_table(medium.density), medium.density.node_altitudes
    absorbed = density @ medium.absorption
    turned = density @ (medium.scattering * (1.0 - asymmetry))
    local = np.sqrt(3.0 * absorbed * (absorbed + turned))
    return np.asarray(0.5 * ((local[1:] + local[:-1]) * np.diff(altitude)[:, None]).sum(axis=0))
