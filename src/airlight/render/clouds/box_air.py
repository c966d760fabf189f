"""Air in a box of clouds, and other clouds as even layers of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.columns import reflecting_depth
from airlight.render.clouds.cloud_deck import CloudDeck
from airlight.solver.boxes.light import BoxAir

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]

#: Levels of air in a box, and highest degree of their phase functions.
_LEVELS: Final = 6
_DEGREE: Final = 8


def box_air(solution: MomentsSolution, top: float, chosen: NDArray[np.int64]) -> BoxAir:
    """Air of a planet below an altitude [m], in layers."""
    medium = solution.medium
    edges = np.linspace(0.0, top, _LEVELS + 1)
    density = medium.density.at(0.5 * (edges[1:] + edges[:-1]))  # (nc, levels)
    extinction = density.T @ medium.extinction[:, chosen]
    scattering = density.T @ medium.scattering[:, chosen]
    moments = medium.phase_moments(_DEGREE)[:, chosen]
    moments = moments / np.maximum(moments[..., :1], 1e-30)
    mixed = np.einsum("ck,cw,cwl->kwl", density, medium.scattering[:, chosen], moments)
    mixed = mixed / np.maximum(scattering, 1e-30)[..., None]
    mixed[..., 0] = 1.0
    albedo = np.minimum(scattering / np.maximum(extinction, 1e-30), 1.0)
    return BoxAir(edges=edges, extinction=extinction, albedo=albedo, moments=mixed)


def with_deck(air: BoxAir, deck: CloudDeck, wavelengths: FloatArray) -> BoxAir:
    """Air of a box with other clouds as an even layer.

    Parameters
    ----------
    air : BoxAir
        Air.
    deck : CloudDeck
        Clouds, of which the part below the top of the air counts.
    wavelengths : array, shape (w,)
        Wavelengths. [nm]
    """
    field, optics = deck.field, deck.optics_at(wavelengths)
    top = min(field.top, float(air.edges[-1]))
    if field.base >= top:
        return air
    edges = np.union1d(air.edges, [field.base, top])
    middles = 0.5 * (edges[1:] + edges[:-1])
    inside = (middles > field.base) & (middles < top)
    old = np.searchsorted(air.edges, middles) - 1
    moments = np.asarray(optics.phase.moments(wavelengths, air.moments.shape[2] - 1))
    moments = moments / moments[:, :1]
    depth = reflecting_depth(field.column_optical_depth, float(moments[:, 1].mean()))
    added = inside[:, None] * np.asarray(optics.extinction) * (depth / (field.top - field.base))
    scattered = added * np.asarray(optics.albedo)
    before = air.extinction[old] * air.albedo[old]
    scattering, extinction = before + scattered, air.extinction[old] + added
    mixed = before[..., None] * air.moments[old] + scattered[..., None] * moments
    mixed = mixed / np.maximum(scattering, 1e-30)[..., None]
    mixed[..., 0] = 1.0
    albedo = np.minimum(scattering / np.maximum(extinction, 1e-30), 1.0)
    return BoxAir(edges=edges, extinction=extinction, albedo=albedo, moments=mixed)
