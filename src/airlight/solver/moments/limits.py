"""Limits of optical depth of the moments solver, beyond which it would not converge."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.solver.moments.delta_m import Optics
from airlight.solver.tables.columns import density_table

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

#: Largest vertical transport optical depth τ (1 - g) with weak absorption. [1]
DEEPEST: Final = 500.0
#: Largest transport optical depth times the altitude range with 90 % of the scattering, over the
#: radius: synthetic acceleration fails where lateral transport reaches as far as vertical. [1]
WIDEST: Final = 2.0
#: Largest fourth Legendre moment of a backward-scattering phase function (that of g = -0.97), and
#: the scattering optical depth up to which it may be larger. [1]
BACKWARD: Final = 0.97**4 + 1e-9
THIN: Final = 1.0
#: Depth in diffusion lengths beyond which a medium is effectively semi-infinite.
_DIFFUSION_LENGTHS: Final = 10.0


def check_limits(optics: Optics) -> None:
    """Raise an error if the medium is too thick for the iteration.

    The transport optical depth is that of the whole medium without absorption, else that of the
    depth reached by diffusion (``diffusion_lengths``).

    Parameters
    ----------
    optics : Optics
        Optics of a medium, with the degree of the harmonics.
    """
    medium = optics.medium
    scattered = medium.columns[:, None] * medium.scattering
    transport = (scattered * (1.0 - optics.phases[..., 1])).sum(axis=0)
    lengths = diffusion_lengths(medium, optics.phases[..., 1])
    transport = transport * np.minimum(1.0, _DIFFUSION_LENGTHS / np.maximum(lengths, 1e-300))
    fourth = medium.phase_moments(4)[..., 4]
    backward = (optics.phases[..., 1] < 0.0) & (fourth > BACKWARD)
    peaked = np.where(backward, scattered, 0.0)
    height = 2.0 * optics.depths.diffusion_length / medium.bottom_radius
    deepest = min(DEEPEST, WIDEST / height) if height > 0.0 else DEEPEST
    for at, nm in enumerate(medium.wavelengths):
        if transport[at] > deepest:
            raise ParameterError(
                f"vertical optical depth of scattering, times 1 - g, at {nm:g} nm",
                float(f"{transport[at]:.4g}"),
                f"0 to {deepest:.4g}, or stronger absorption",
            )
        which = int(peaked[:, at].argmax())
        if peaked[which, at] > THIN:
            raise ParameterError(
                f"mean cosine g of scattering by {medium.names[which]} at {nm:g} nm",
                float(f"{optics.phases[which, at, 1]:.4g}"),
                f"-0.97 or more where the vertical optical depth of scattering is above {THIN:g}",
            )


def diffusion_lengths(medium: Medium, asymmetry: FloatArray) -> FloatArray:
    """Vertical thickness in diffusion lengths: ∫ sqrt(3(1 - ϖ)(1 - ϖg)) dτ. [1]

    The root is the diffusion exponent of the Eddington approximation. If a single layer absorbs,
    only that layer contributes.

    Parameters
    ----------
    medium : Medium
        Medium with nl wavelengths and nc constituents.
    asymmetry : array, shape (nc, nl)
        Mean cosines g of scattering. [1]

    Returns
    -------
    array, shape (nl,)
        0 without absorption.
    """
    density, altitude = density_table(medium.density), medium.density.node_altitudes
    absorbed = density @ medium.absorption
    turned = density @ (medium.scattering * (1.0 - asymmetry))
    local = np.sqrt(3.0 * absorbed * (absorbed + turned))
    return np.asarray(0.5 * ((local[1:] + local[:-1]) * np.diff(altitude)[:, None]).sum(axis=0))
