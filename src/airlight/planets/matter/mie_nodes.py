"""Mie scattering at nodes in wavelength, computed on all cores, cached in memory and on disk.

Mie theory over a size distribution takes a fraction of a second per wavelength. Optical properties
vary slowly with wavelength and are interpolated between nodes.
"""

from __future__ import annotations

import hashlib
import itertools
import logging
import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.kernel import disk
from airlight.kernel.cache import Cache
from airlight.kernel.cost import LONG, announce, duration, expected_seconds, timed
from airlight.kernel.memory import check_memory
from airlight.kernel.threads import Cancel, Progress, run_blocks, thread_count
from airlight.physics.optics import mie, phase_table, ripples, size_distribution
from airlight.physics.optics.mie import Scattering
from airlight.physics.optics.ripples import ripple_means
from airlight.physics.optics.size_distribution import SizeNodes
from airlight.physics.units import values_in
from airlight.planets.matter.particle_index import ParticleIndex
from airlight.planets.matter.particle_sizes import ParticleSizes
from airlight.planets.spectral import Limits

FloatArray = npt.NDArray[np.float64]

#: Wavelengths from which nodes are placed, so that red, green and blue are nodes. [nm]
_ANCHORS: Final = (440.0, 550.0, 680.0)
#: Largest distance of nodes, in ln λ: 25 nm in the green.
SPACING: Final = 0.0475
#: Largest distance for nearly monodisperse particles, whose optics ripple with wavelength.
NARROW_SPACING: Final = 0.012
#: Effective variance below which particles are nearly monodisperse.
_NARROW: Final = 0.02
#: Limits of particles of a constant refractive index. [nm]
WIDEST: Final[Limits] = (200.0, 2500.0)
#: Wavelength for which the angles of the phase function are chosen. [nm]
_ANGLES_FOR: Final = 400.0
#: Smallest number of radii of a distribution, and number per unit of the size parameter.
_FEWEST_RADII: Final = 800
_RADII_PER_SIZE: Final = 1.0
#: Largest deviation from 1 of the integral of a computed phase function, which is divided by it:
#: at 3e-3 the mean cosine is right to 4e-4.
_INTEGRAL_TOLERANCE: Final = 5e-3
#: Largest number of nodes kept in memory.
_MOST_KEPT: Final = 2000

_kept: Cache[str, Scattering] = Cache(_MOST_KEPT)


@cache
def node_wavelengths(
    limits: Limits, own: tuple[float, ...], spacing: float = SPACING
) -> tuple[float, ...]:
    """Wavelengths of exact Mie computations, ascending.

    Parameters
    ----------
    limits : (float, float)
        Limits of the refractive index; both are nodes. [nm]
    own : tuple of float
        Further nodes, if within the limits. [nm]
    spacing : float
        Spacing of the regular nodes in ln λ; those within a quarter of it of other nodes are
        omitted. [1]

    Examples
    --------
    >>> [round(nm) for nm in node_wavelengths((400.0, 700.0), ())]
    [400, 420, 440, 460, 481, 503, 526, 550, 574, 599, 625, 652, 680, 700]
    """
    low, high = max(limits[0], WIDEST[0]), min(limits[1], WIDEST[1])
    fixed = {low, high, *(nm for nm in own if low < nm < high)}
    grid = set(_ANCHORS)
    for a, b in itertools.pairwise(_ANCHORS):
        count = math.ceil(math.log(b / a) / spacing)
        grid.update(a * (b / a) ** (i / count) for i in range(1, count))
    below, above = _ANCHORS[0], _ANCHORS[-1]
    while below > low:
        below *= math.exp(-spacing)
        grid.add(below)
    while above < high:
        above *= math.exp(spacing)
        grid.add(above)
    near = 0.25 * spacing
    inside = (nm for nm in grid if low < nm < high)
    apart = {nm for nm in inside if all(abs(math.log(nm / one)) > near for one in fixed)}
    return tuple(sorted(fixed | apart))


@cache
def nearly_one_size(sizes: ParticleSizes) -> bool:
    """Whether the distribution is so narrow that the ripples of single spheres persist."""
    variance = sizes.moment(2) * sizes.moment(4) / sizes.moment(3) ** 2 - 1.0
    return variance < _NARROW


def bracketing(nodes: tuple[float, ...], wavelengths: npt.ArrayLike) -> tuple[float, ...]:
    """Nodes for interpolation to some wavelengths.

    Of a wavelength that is a node, only itself.
    """
    known = np.asarray(nodes)
    nm = np.clip(np.atleast_1d(values_in(wavelengths, "nm", "wavelengths")), known[0], known[-1])
    above = np.searchsorted(known, nm, side="left")
    below = np.where(known[above] == nm, above, above - 1)
    return tuple(known[np.union1d(above, below)].tolist())


@cache
def phase_angles(sizes: ParticleSizes) -> FloatArray:
    """Scattering angles of the phase functions of a size distribution. [deg]"""
    angles = mie.scattering_angles(_finest(sizes, _ANGLES_FOR), _per_ripple(sizes))
    angles.flags.writeable = False
    return angles


def _finest(sizes: ParticleSizes, wavelength: float) -> float:
    """Size parameter with the finest resolved ripples. [1]"""
    radius = sizes.moment(8) / sizes.moment(7)
    return min(2.0 * np.pi * radius / (1e-9 * wavelength), mie.LARGEST_SIZE_PARAMETER)


def _per_ripple(sizes: ParticleSizes) -> float:
    """Angles per ripple of the phase functions, limited in number. [1]"""
    return 32.0 if nearly_one_size(sizes) else 12.0


def mie_nodes(
    index: ParticleIndex,
    sizes: ParticleSizes,
    wavelengths: Sequence[float],
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> list[Scattering]:
    """Mean single-particle scattering at some wavelengths, computed or cached.

    Parameters
    ----------
    wavelengths : sequence of float
        Wavelengths. [nm]

    Returns
    -------
    list of Scattering
        Results per wavelength, at ``phase_angles(sizes)``, with normalised phase functions.
    """
    indices = [complex(value) for value in index.at(np.asarray(wavelengths))]
    if 1.0 in indices:
        raise ParameterError("index.real", 1.0, "other than 1, where particles scatter no light")
    keys = [_key(sizes, m, nm) for m, nm in zip(indices, wavelengths, strict=True)]
    # Local references: cached entries may be evicted during the call.
    found = {key: node for key in keys if (node := _load(key)) is not None}
    missing = [i for i, key in enumerate(keys) if key not in found]

    def one(block: int) -> None:
        i = missing[block]
        found[keys[i]] = _computed(sizes, indices[i], wavelengths[i], cancel)
        _keep(keys[i], found[keys[i]])

    if missing:
        work = _checked_work(sizes, [wavelengths[i] for i in missing])
        about = f"particles at {len(missing)} wavelengths"
        if announce.get() is None and (expected := expected_seconds("particles", work)) > LONG:
            # no progress is shown, and the process would seem to hang
            logging.getLogger("airlight").warning(f"{about}: about {duration(expected)}")
        with timed("particles", work, about):
            run_blocks(one, len(missing), cancel=cancel, progress=progress, message="particles")
    return [found[key] for key in keys]


def _checked_work(sizes: ParticleSizes, wavelengths: Sequence[float]) -> float:
    """Work of some nodes, as in ``kernel.cost``; raises an error if they need too much memory."""
    work, largest = 0.0, 0.0
    angles = len(phase_angles(sizes))
    for wavelength in wavelengths:
        spheres, _ = mie.computed_spheres(_radii(sizes, wavelength), wavelength, 1.5)
        size_parameter = _size_parameter(spheres, wavelength)
        work += mie.work(len(spheres.radii), size_parameter, angles)
        largest = max(largest, size_parameter)
    together = min(thread_count(), len(wavelengths))
    check_memory(
        together * mie.memory(largest, angles),
        f"light of particles of size parameter {largest:.0f}",
    )
    return work


def _size_parameter(sizes: SizeNodes, wavelength: float) -> float:
    """Largest size parameter of some radii. [1]"""
    return 2.0 * np.pi * float(sizes.radii[-1]) / (1e-9 * wavelength)


def _radii(sizes: ParticleSizes, wavelength: float) -> SizeNodes:
    few = sizes.sizes(_FEWEST_RADII)
    largest = min(_size_parameter(few, wavelength), mie.LARGEST_SIZE_PARAMETER)
    return few if largest <= _FEWEST_RADII else sizes.sizes(int(_RADII_PER_SIZE * largest))


def _computed(
    sizes: ParticleSizes, index: complex, wavelength: float, cancel: Cancel | None
) -> Scattering:
    nodes = _radii(sizes, wavelength)
    angles = phase_angles(sizes)
    found = mie.scattering(nodes, wavelength, index, angles, cancel=cancel)
    if _per_ripple(sizes) * _finest(sizes, _ANGLES_FOR) > mie.MOST_STEPS:
        elements = np.vstack([found.phase, found.phase * found.ratios])
        elements = ripple_means(angles, elements, 180.0 / _finest(sizes, wavelength))
        found = replace(found, phase=elements[0], ratios=elements[1:] / elements[0])
    integral = float(phase_table.moments(angles, found.phase[None], 0)[0, 0])
    if not abs(integral - 1.0) <= _INTEGRAL_TOLERANCE:
        raise ParameterError(
            f"integral of the phase function at {wavelength:g} nm",
            integral,
            f"1 within {_INTEGRAL_TOLERANCE:g}: smaller particles, or fewer of one size",
        )
    # Divided so that interpolation between the angles of the table conserves energy.
    return replace(found, phase=found.phase / integral)


@cache
def _maker() -> str:
    """Hash of the formulas that determine results."""
    digest = hashlib.sha256()
    formulas = mie.__file__, ripples.__file__, size_distribution.__file__, phase_table.__file__
    for module in (*formulas, __file__):
        digest.update(Path(module).read_bytes())
    return digest.hexdigest()


def _key(sizes: ParticleSizes, index: complex, wavelength: float) -> str:
    particle = f"{_maker()} {sizes!r} {index!r} {float(wavelength)!r}"
    return "mie" + hashlib.sha256(particle.encode()).hexdigest()


def _load(key: str) -> Scattering | None:
    known = _kept.get(key)
    if known is not None:
        return known
    arrays = disk.load(key)
    if arrays is None or not {"phase", "ratios"} <= set(arrays):
        return None
    if arrays.get("numbers", np.empty(0)).shape != (3,):
        return None
    extinction, scattering, asymmetry = arrays["numbers"].tolist()
    found = Scattering(extinction, scattering, asymmetry, arrays["phase"], arrays["ratios"])
    return _kept.put(key, found)


def _keep(key: str, found: Scattering) -> None:
    _kept.put(key, found)
    numbers = np.array([found.extinction, found.scattering, found.asymmetry])
    disk.save(key, {"numbers": numbers, "phase": found.phase, "ratios": found.ratios})
