"""Waves of the sea that a picture resolves; the others are Cox & Munk's statistics.

Phillips's equilibrium range (Phillips 1977, "The Dynamics of the Upper Ocean", section 4.5): equal
mean-square slope in equal intervals of ln k, from the peak of fully developed waves (Pierson &
Moskowitz 1964, J. Geophys. Res. 69, 5181: exp(-5/4 (k_p/k)²)) to the gravity-capillary minimum of
phase speed, 370 rad/m. Its constant is what makes the mean-square slope Cox & Munk's. A wave is
resolved by its attenuation over a pixel's footprint; the rest of its variance stays statistical, so
that the sum is the same at all distances and far waters are those of ``cox_munk``.

Three orthogonal plane waves in space have isotropic slopes on any plane through them. Each octave
has two such triads of 7 and 11 wavelengths per period, whose directions are Pythagorean
quadruples: phases are exact in single precision, from lattice coordinates as of ``ground_detail``.
The waves are frozen, and the same for each time and wind direction.
"""

from __future__ import annotations

from math import exp, floor, log, sqrt
from typing import Final

from airlight.geometry.vectors import Vec3, dot, plus, scaled
from airlight.kernel import kernel
from airlight.physics.optics.cox_munk import mean_square_slope

#: Octaves of periods; the longest has so many finest cells. [1]
OCTAVES: Final = 20
LONGEST: Final = 65536.0
#: Wavenumber of the slowest waves, √(ρ g/σ). [rad m⁻¹]
SLOWEST: Final = 370.0
#: Share of the mean-square slope that resolvable waves have, at most; the rest are capillaries.
SHARE: Final = 0.97
#: Width of the pixel's filter over its footprint: waves of four pixels keep three quarters of their
#: amplitude, of two a tenth. [1]
_FILTER: Final = 0.6
#: Filter width times wavenumber of waves that are left out: a hundredth of their amplitude is left.
_LOST: Final = 2.34
#: Shortest waves of an octave that is left out, over the peak's wavenumber. [1]
_FIRST: Final = 0.5
#: Footprint times the peak's wavenumber beyond which nothing is resolved. [1]
COARSEST: Final = 18.0


@kernel
def peak_wavenumber(wind):
    """Wavenumber of the peak of fully developed waves, g (0.84/U)². [rad m⁻¹]

    Elfouhaily et al. (1997), J. Geophys. Res. 102, 15781, eq. 3 with the inverse wave age 0.84.

    Examples
    --------
    >>> round(6.2832 / peak_wavenumber(10.0))  # metres
    91
    """
    return 9.81 * 0.7056 / (wind * wind)


@kernel
def saturation(wind):
    """Mean-square slope per interval of ln k in the equilibrium range. [1]

    ∫ exp(-5/4 (k_p/k)²) d ln k up to k is ln(k/k_p) - (γ + ln 5/4)/2.

    Examples
    --------
    >>> round(saturation(10.0), 4)  # Phillips (1977): 0.0046, by Cox and Munk's slopes
    0.0064
    """
    from_peak = log(SLOWEST / peak_wavenumber(wind)) - 0.4001797
    return SHARE * mean_square_slope(wind) / from_peak


@kernel
def resolved(wavenumber, footprint):
    """Amplitude of a wave averaged over a footprint, (1 - q/4)₊⁴ with q = (0.6 k f)²/2. [1]

    A Gaussian filter with an end.

    Parameters
    ----------
    wavenumber, footprint : float
        Wavenumber k [rad m⁻¹], and longer axis f of a pixel's footprint [m].
    """
    reach = _FILTER * wavenumber * footprint
    left = max(1.0 - 0.125 * reach * reach, 0.0)
    return left * left * left * left


@kernel
def wave(turns):
    """Sine of a number of turns, within 0.0011. [1]

    Examples
    --------
    >>> round(wave(0.25), 9), round(abs(wave(0.5)), 9), round(wave(7.75), 9)
    (1.0, 0.0, -1.0)
    """
    x = 1.0 - 2.0 * (turns - floor(turns))
    arch = 4.0 * x * (1.0 - abs(x))
    return arch * (0.775 + 0.225 * abs(arch))


@kernel
def turned(vector, octave):
    """Vector with its axes exchanged, so that octaves have different directions.

    Parameters
    ----------
    vector : Vec3
        Vector in the planet's frame.
    octave : int
        Index of the octave, positive.
    """
    way = octave - 3 * (octave // 3)
    if way == 1:
        return Vec3(vector.y, -vector.z, vector.x)
    if way == 2:
        return Vec3(-vector.z, vector.x, vector.y)
    return vector


@kernel
def turned_back(vector, octave):
    """Inverse of ``turned``.

    Examples
    --------
    >>> [tuple(turned_back(turned(Vec3(1.0, 2.0, 3.0), k), k)) for k in range(1, 3)]
    [(1.0, 2.0, 3.0), (1.0, 2.0, 3.0)]
    """
    way = octave - 3 * (octave // 3)
    if way == 1:
        return Vec3(vector.z, vector.x, -vector.y)
    if way == 2:
        return Vec3(vector.y, vector.z, -vector.x)
    return vector


@kernel
def triad_products(which, v):
    """Products of a vector and three orthogonal ones of length 7 or 11.

    Parameters
    ----------
    which : int
        0 or 1.
    v : Vec3
        Vector.

    Examples
    --------
    >>> tuple(triad_products(1, Vec3(6.0, 9.0, 2.0)))
    (121.0, 0.0, 0.0)
    """
    x, y, z = v.x, v.y, v.z
    if which == 0:
        return Vec3(
            2.0 * x + 3.0 * y + 6.0 * z, 3.0 * x - 6.0 * y + 2.0 * z, 6.0 * x + 2.0 * y - 3.0 * z
        )
    return Vec3(
        6.0 * x + 9.0 * y + 2.0 * z, 6.0 * x - 2.0 * y - 9.0 * z, 7.0 * x - 6.0 * y + 6.0 * z
    )


@kernel
def triad_sum(which, v):
    """Sum of the three vectors of ``triad_products`` times the components of another.

    Examples
    --------
    >>> tuple(triad_sum(1, Vec3(0.0, 1.0, 0.0)))
    (6.0, -2.0, -9.0)
    """
    x, y, z = v.x, v.y, v.z
    if which == 0:
        return Vec3(
            2.0 * x + 3.0 * y + 6.0 * z, 3.0 * x - 6.0 * y + 2.0 * z, 6.0 * x + 2.0 * y - 3.0 * z
        )
    return Vec3(
        6.0 * x + 6.0 * y + 7.0 * z, 9.0 * x - 2.0 * y - 6.0 * z, 2.0 * x - 9.0 * y + 6.0 * z
    )


@kernel
def lattice_turns(whole, part, scale, inverse):
    """Lattice coordinate along an axis, in periods of ``scale`` cells. [turn]"""
    return (whole - scale * floor(whole * inverse) + part) * inverse


@kernel
def sea_slopes(place, along, across, footprint, wind, cell, whole, part):
    """Slopes of the resolved waves at a place, and their share of the mean-square slope.

    Parameters
    ----------
    place : Vec3
        Position relative to the point below the observer, in the planet's frame. [m]
    along, across : Vec3
        Horizontal directions in that frame. [1]
    footprint : float
        Longer axis of the pixel's footprint. [m]
    wind : float
        Wind speed. [m s⁻¹]
    cell, whole, part : float, Vec3, Vec3
        Finest cell of the lattice [m], and results of ``ground_detail.lattice_origin``. [1]

    Returns
    -------
    slope_along, slope_across, share : float
        Rise of the sea in both directions; share of the variance, 0 to 1. [1]
    """
    peak, level = peak_wavenumber(wind), sqrt(saturation(wind))
    x, y, z = part.x + place.x / cell, part.y + place.y / cell, part.z + place.z / cell
    slope, variance, scale, inverse = Vec3(0.0, 0.0, 0.0), 0.0, LONGEST, 1.0 / LONGEST
    for octave in range(OCTAVES):
        # of waves in the plane: √(2/3) of those in space
        unit = 5.130199 * inverse / cell
        if 7.0 * unit > SLOWEST or _FILTER * 7.0 * unit * footprint > _LOST:
            break
        if 11.0 * unit > _FIRST * peak:
            spot = Vec3(
                lattice_turns(whole.x, x, scale, inverse),
                lattice_turns(whole.y, y, scale, inverse),
                lattice_turns(whole.z, z, scale, inverse),
            )
            spot, tilt = turned(spot, octave), Vec3(0.0, 0.0, 0.0)
            for which in range(2):
                length = 7.0 + 4.0 * which
                wavenumber = length * unit
                if wavenumber < SLOWEST and _FILTER * wavenumber * footprint < _LOST:
                    ratio = peak / wavenumber
                    # each of two has half of ln 2
                    amplitude = level * 0.588705 / length * resolved(wavenumber, footprint)
                    power = 0.625 * ratio * ratio
                    if power < 0.01:
                        amplitude *= 1.0 - power
                    else:
                        amplitude *= exp(-power)
                    turns = triad_products(which, spot)
                    waves = Vec3(wave(turns.x), wave(turns.y), wave(turns.z))
                    tilt = plus(tilt, scaled(triad_sum(which, waves), amplitude))
                    variance += length * length * amplitude * amplitude
            slope = plus(slope, turned_back(tilt, octave))
        scale *= 0.5
        inverse *= 2.0
    share = min(variance / mean_square_slope(wind), 1.0)
    return dot(slope, along), dot(slope, across), share
