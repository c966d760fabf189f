"""Fit of tables that are linear in nu between few texels to radiance at many angles.

Along nu, Bruneton's look-up of radiance is

    L(nu) ~ sum_j hat_j(nu) (S_j p_R(nu) + M_j p_CS(nu; g))

Aureole and glory of dust are narrower than the distance of the texels, 44 deg. S and M therefore
minimise the squared relative errors over many angles.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.targets.fits.weighted_lobe import hat_functions
from airlight.kernel import vectorized
from airlight.physics.optics.phase_functions import cornette_shanks, rayleigh

FloatArray = NDArray[np.float64]
Flags = NDArray[np.bool_]

#: Number of angles at which the radiance is known, per interval between texels.
STEP: Final = 4
#: Angles between the sun and the first of these, for forward peaks. [deg]
_AHEAD: Final = (0.3, 1.0, 2.0, 3.5, 5.5, 8.0, 11.0, 14.0, 18.0)
#: Weight of the deviation from the start, relative to the mean square of the relative errors.
_RIDGE: Final = 1e-5
#: Radiances below this fraction of the brightest have absolute errors in the fit.
_DIM: Final = 1e-9
#: Number of passes that remove negative values.
_PASSES: Final = 2
_ROWS: Final = 8192


class TexelFit:
    """Fit of two tables along nu.

    Parameters
    ----------
    g : float
        Parameter of the lobe. [1]
    angles : int
        Number of equidistant texels in nu from -1 to 1.
    phases : callable
        Phase functions of the types of particles, from nu (n,) to (kinds, n, nl). [sr⁻¹]
    """

    def __init__(self, g: float, angles: int, phases: Any) -> None:
        fine = np.linspace(-1.0, 1.0, STEP * (angles - 1) + 1)
        first = float(np.degrees(np.arccos(fine[-2])))
        ahead = np.array([one for one in _AHEAD if one < first])
        nu = np.concatenate([fine[:-1], np.cos(np.radians(ahead))])
        # radiance of the fine table at these angles: linear in the angle ahead of its last but one
        self._reading = np.zeros((nu.size, fine.size))
        self._reading[: fine.size - 1, :-1] = np.eye(fine.size - 1)
        self._reading[fine.size - 1 :, -2] = ahead / first
        self._reading[fine.size - 1 :, -1] = 1.0 - ahead / first
        even: Any = vectorized(rayleigh)
        lobe: Any = vectorized(cornette_shanks)
        hats = hat_functions(nu, angles)
        self._even = even(nu, 0.0)
        self._phases = phases(nu)
        self._functions = np.hstack([hats * self._even[:, None], hats * lobe(nu, g)[:, None]])

    def fitted(
        self, smooth: FloatArray, once: list[FloatArray], start: FloatArray, *, signed: Flags
    ) -> FloatArray:
        """S and M, shape (texels, 2·angles, nl).

        Parameters
        ----------
        smooth : array, shape (texels, fine angles, nl)
            Radiance over the Rayleigh phase function, at the fine angles.
        once : list of array, of the same shape
            Single scattering by each type of particles, over its phase function.
        start : array, shape (texels, 2·angles, nl)
            S and M where radiance does not determine them.
        signed : array of bool, shape (texels,)
            Whether S and M may be negative.
        """
        out = np.empty_like(start)
        for l in range(start.shape[-1]):
            brightest = 0.0
            for first in range(0, len(start), _ROWS):
                rows = slice(first, first + _ROWS)
                light = (smooth[rows, :, l] @ self._reading.T) * self._even
                for phase, one in zip(self._phases, once, strict=True):
                    light += (one[rows, :, l] @ self._reading.T) * phase[:, l]
                brightest = max(brightest, float(light.max()))
                light = np.maximum(light, _DIM * brightest + np.finfo(float).tiny)
                out[rows, :, l] = self._solved(light, start[rows, :, l], signed[rows])
        return out

    def _solved(self, light: FloatArray, start: FloatArray, signed: Flags) -> FloatArray:
        """Unknowns of texels, shape (n, 2·angles), for normalised columns."""
        columns = self._functions / light[..., None]
        size = np.sqrt((columns * columns).mean(axis=1)) + np.finfo(float).tiny
        columns /= size[:, None, :]
        across = columns.transpose(0, 2, 1)
        unknowns = np.eye(columns.shape[-1])
        matrix = across @ columns / light.shape[-1] + _RIDGE * unknowns
        goal = across.mean(axis=-1) + _RIDGE * start * size
        found = np.linalg.solve(matrix, goal[..., None])[..., 0]
        left_out = np.zeros(found.shape, bool)
        for _ in range(_PASSES):
            left_out |= (found < 0.0) & ~signed[:, None]
            free = ~left_out
            both = matrix * free[:, :, None] * free[:, None, :] + left_out[:, :, None] * unknowns
            found = np.linalg.solve(both, (goal * free)[..., None])[..., 0]
        held = np.where(signed[:, None], found, np.maximum(found, 0.0))
        return np.asarray(held / size)
