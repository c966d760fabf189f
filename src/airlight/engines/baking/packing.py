"""Separation of path radiance into a smooth part and single scattering by particles.

Path radiance is reconstructed as smooth · p_gas(ν) + Σ particles · p(ν), which is exact for single
scattering. A table with an axis for ν includes multiple scattering in its smooth part and is exact
at its texels; a table without one is fitted over azimuths.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.engines.baking.air_light import AirLight, groups, lines_of_sight
from airlight.kernel import vectorized
from airlight.physics.optics.phase_functions import rayleigh
from airlight.solver.scattered_once import scattered_once
from airlight.solver.tables.atmosphere_plus import at_azimuth
from airlight.solver.tables.layout import Positions
from airlight.solver.tables.scattered_light import PhaseFunctions

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

#: Number of azimuths of the fit: midpoints of equal intervals of half a turn.
FIT_AZIMUTHS: Final = 8
#: Weight of single scattering in the fit, where azimuths do not determine it (a view
#: straight up has one angle to the sun only). [1]
_PRIOR: Final = 1e-4
#: Radiance, relative to a point's largest, below which the fit's weights are constant. [1]
_DIM: Final = 1e-3
_TINY: Final = 1e-12


@dataclass(frozen=True)
class ScatteringGroups:
    """Constituents that scatter, grouped for packing.

    Attributes
    ----------
    particles : tuple of int
        Indices of the constituents that are not molecules.
    gas : tuple of int
        Indices of the molecules.
    phases : PhaseFunctions
        Phase function ``gas``, and ``single-<name>`` of each type with a separate table, otherwise
        ``particles``.
    """

    particles: tuple[int, ...]
    gas: tuple[int, ...]
    phases: PhaseFunctions


def scattering_groups(medium: Medium, *, each: bool) -> ScatteringGroups:
    """Phase functions of the gas and of the particles, by type or as their mean.

    Means are weighted by vertical scattering optical depth. Without gas, the Rayleigh phase
    function is used.

    Parameters
    ----------
    each : bool
        Whether types of particles are separate.
    """
    gas, particles = groups(medium)
    depth = medium.scattering * medium.columns[:, None]
    nu = 1.0 - 2.0 * np.linspace(0.0, 1.0, medium.phase_table.shape[-1]) ** 2

    def mean(indices: list[int]) -> FloatArray:
        weight = depth[indices] / np.maximum(depth[indices].sum(axis=0), 1e-300)
        return np.asarray((weight[..., None] * medium.phase_table[indices]).sum(axis=0))

    smooth = np.broadcast_to(vectorized(rayleigh)(nu, 0.0), medium.phase_table.shape[1:])
    names, values = ["gas"], [mean(gas) if gas else np.array(smooth)]
    if each:
        words = slugs(medium.names[index] for index in particles)
        names += [f"single-{word}" for word in words]
        values += [mean([index]) for index in particles]
    elif particles:
        names.append("particles")
        values.append(mean(particles))
    return ScatteringGroups(
        tuple(particles), tuple(gas), PhaseFunctions(tuple(names), np.stack(values))
    )


def slugs(names: Iterable[str]) -> tuple[str, ...]:
    """Unique ASCII parts of file names from names of constituents.

    Names without ASCII letters become ``particles``; duplicates are numbered.

    Examples
    --------
    >>> slugs(["Fine mie (1.6 µm)", "haze 1", "Haze (1)", "雲"])
    ('fine-mie-1-6-um', 'haze-1', 'haze-1-2', 'particles')
    """
    made: list[str] = []
    for name in names:
        plain = unicodedata.normalize("NFKD", name).replace("\N{GREEK SMALL LETTER MU}", "u")
        known = plain.lower().encode("ascii", "ignore").decode()
        words = "".join(letter if letter.isalnum() else " " for letter in known).split()
        first = word = "-".join(words) or "particles"
        number = 1
        while word in made:
            number += 1
            word = f"{first}-{number}"
        made.append(word)
    return tuple(made)


class SeparatedLight(NamedTuple):
    """Radiance at points whose ν is known, as Rayleigh, Mie and multiple scattering.

    Attributes
    ----------
    rayleigh : array, shape (n, nl)
        Single scattering by the gas over its phase function. [1]
    remainder : array, shape (n, nl)
        Radiance of the remainder. [sr⁻¹]
    mie : array, shape (n, kinds, nl)
        Single scattering by particles over the phase function of each type, or over their mean
        (kinds = 1). [1]
    multiple : array, shape (n, nl)
        Multiple scattering, which is included in the others. [sr⁻¹]
    """

    rayleigh: FloatArray
    remainder: FloatArray
    mie: FloatArray
    multiple: FloatArray


def separate_orders(
    air: AirLight, positions: Positions, groups: ScatteringGroups, *, each: bool
) -> SeparatedLight:
    """Separate radiance into Rayleigh, Mie and multiple scattering at points whose ν is known.

    Single scattering is that of a moments solution (``AirLight.single_and_multiple``), otherwise by
    quadrature, with that of the particles scaled to the solution's first order where they
    contribute most of it.
    """
    medium = air.solution.medium
    lines = lines_of_sight(positions, medium)
    kinds = len(groups.phases.names) - 1
    if not air.has_first:
        light = air(lines)
        nothing = np.zeros((len(positions), kinds, light.shape[-1]))
        return SeparatedLight(np.zeros_like(light), light, nothing, light)
    own = medium.phase_function(positions.nu)
    gas, particles = list(groups.gas), list(groups.particles)
    if air.separates_ground:
        once, multiple = air.single_and_multiple(lines)
        from_gas = (own[:, gas] * once[:, gas]).sum(axis=1)
        mie = once[:, particles]
        if kinds and not each:
            from_particles = (own[:, particles] * mie).sum(axis=1)
            mie = (from_particles / groups.phases.at("particles", positions.nu))[:, None]
        return SeparatedLight(
            from_gas / groups.phases.at("gas", positions.nu), multiple, mie, multiple
        )
    light, first = air.with_first(lines)
    once = scattered_once(medium, lines)
    if each:  # as in the look-up
        for kind, index in zip(groups.phases.names[1:], particles, strict=True):
            own[:, index] = groups.phases.at(kind, positions.nu)
    from_gas = (own[:, gas] * once[:, gas]).sum(axis=1)
    from_particles = (own[:, particles] * once[:, particles]).sum(axis=1)
    safe = np.maximum(from_particles, 1e-300)
    ratio = np.clip((first - from_gas) / safe, 0.5, 2.0)
    share = (from_particles / np.maximum(from_gas + from_particles, 1e-300)) ** 2
    factor = 1.0 + share * (ratio - 1.0)
    # A larger part than the whole would leave a negative remainder.
    factor = np.minimum(factor, light / safe)
    left = np.maximum(light - factor * from_particles, 0.0)
    of_gas = np.minimum(from_gas, left)
    smooth = of_gas / groups.phases.at("gas", positions.nu)
    if each:
        mie = once[:, particles] * factor[:, None]
    elif kinds:
        mie = (factor * from_particles / groups.phases.at("particles", positions.nu))[:, None]
    else:
        mie = np.zeros((len(positions), 0, light.shape[-1]))
    return SeparatedLight(smooth, left - of_gas, mie, np.maximum(light - first, 0.0))


def combine(
    light: FloatArray,
    particles: FloatArray,
    p_gas: FloatArray,
    p_particles: FloatArray,
    colours: FloatArray,
    reference: int,
) -> FloatArray:
    """Channels of a combined table: smooth part, then particles at the reference wavelength.

    The smooth part is such that a look-up with ``proportional`` colours gives ``light``.

    Parameters
    ----------
    light, particles : array, shape (..., nl)
        Path radiance [sr⁻¹], and single scattering by particles [1].
    p_gas, p_particles : array, shapes that broadcast to (..., nl)
        Phase functions. [sr⁻¹]
    colours, reference
        See ``ScatteredLight``.

    Returns
    -------
    array, shape (..., nl + 1)
        Channels. [1]
    """
    alpha = particles[..., reference]
    rest = np.maximum(light[..., reference] - alpha * p_particles[..., reference], 0.0)
    smooth_reference = rest / p_gas[..., reference]
    per_smooth = np.divide(
        alpha, smooth_reference, out=np.zeros_like(alpha), where=smooth_reference > 0.0
    )
    smooth = light / (p_gas + p_particles * colours * per_smooth[..., None])
    smooth[..., reference] = smooth_reference
    return np.concatenate([smooth, alpha[..., None]], axis=-1)


def fit_azimuths(
    air: AirLight, positions: Positions, groups: ScatteringGroups, *, grey: bool
) -> tuple[FloatArray, FloatArray]:
    """Smooth part and particles' part, fitted over azimuths by relative least squares.

    Parameters
    ----------
    air, positions, parts
        Path radiance, points (at any azimuth), and the phase functions ``gas`` and ``particles``.
    grey : bool
        Whether the particles' part is equal at all wavelengths.

    Returns
    -------
    smooth : array, shape (n, nl)
        [1]
    particles : array, shape (n, nl), or (n, 1) if grey
        [1]
    """
    medium = air.solution.medium
    azimuths = 180.0 * (np.arange(FIT_AZIMUTHS) + 0.5) / FIT_AZIMUTHS
    around = [at_azimuth(positions, azimuth) for azimuth in azimuths]
    fields = ("r", "mu", "mu_s", "nu", "to_ground")
    each = (np.stack([getattr(one, name) for one in around], axis=-1).ravel() for name in fields)
    light = air.at_sun_angles(lines_of_sight(Positions(*each), medium))
    light = np.moveaxis(light.reshape(len(positions), FIT_AZIMUTHS, -1), 1, 0)
    p_gas = np.stack([groups.phases.at("gas", one.nu) for one in around])
    weight = 1.0 / np.maximum(light, _DIM * light.max(axis=0) + _TINY) ** 2
    gas_gas = (weight * p_gas * p_gas).sum(axis=0)
    gas_light = (weight * p_gas * light).sum(axis=0)
    if not groups.particles:
        nothing = np.zeros((len(positions), 1 if grey else light.shape[-1]))
        return gas_light / gas_gas, nothing
    p_mie = np.stack([groups.phases.at("particles", one.nu) for one in around])
    once = np.zeros(light.shape[1:])
    if air.has_first:
        across = at_azimuth(positions, 90.0)
        scattered = scattered_once(medium, lines_of_sight(across, medium))
        once = scattered[:, list(groups.particles)].sum(axis=1)
    gas_mie = (weight * p_gas * p_mie).sum(axis=0)
    mie_mie = (weight * p_mie * p_mie).sum(axis=0)
    mie_light = (weight * p_mie * light).sum(axis=0)
    prior = _PRIOR * mie_mie
    above = mie_light + prior * once - gas_mie * gas_light / gas_gas
    below = mie_mie + prior - gas_mie * gas_mie / gas_gas
    if grey:
        above, below = above.sum(axis=-1, keepdims=True), below.sum(axis=-1, keepdims=True)
    mie = np.maximum(above / below, 0.0)
    smooth = (gas_light - gas_mie * mie) / gas_gas
    # The smooth part would be negative: the particles' part must fit alone.
    alone = (weight * p_mie * light).sum(axis=0) / mie_mie
    if grey:
        alone = alone.min(axis=-1, keepdims=True)
    negative = (smooth < 0.0).any(axis=-1, keepdims=True) if grey else smooth < 0.0
    mie = np.where(negative, np.minimum(mie, alone), mie)
    smooth = np.maximum((gas_light - gas_mie * mie) / gas_gas, 0.0)
    return smooth, mie


def colours_of(medium: Medium, groups: ScatteringGroups, reference: int) -> FloatArray:
    """Ratio of scattering by particles and by gas, over that at a wavelength, shape (nl,). [1]

    Bruneton & Neyret (2008), section 4; 1 everywhere if there is no gas.
    """
    particles = medium.scattering[list(groups.particles)].sum(axis=0)
    gas = medium.scattering[list(groups.gas)].sum(axis=0)
    if not particles.any() or not (gas > 0.0).all():
        return np.ones(medium.wavelengths.size)
    ratio = particles / gas
    return np.asarray(ratio / ratio[reference])
