"""Rolling ground of bodies with craters, between tens of kilometres and the pixel; not data.

Decoration: octaves of noise, each half the size of the next coarser one. Slopes of an octave do not
depend on its size below 20 km, as those of the Moon fall slowly above 1 km (Rosenburg et al. 2011,
JGR 116, E02001). Finer octaves are rougher where coarser ones are high, so that no place is like
the next. Maria have wrinkle ridges instead: narrow ones along lines at which the noise is zero, 100
to 200 m high and some kilometres wide (Plescia & Golombek 1986, GSA Bulletin 97, 1289). The noise
also moves the places at which craters are read, of which none is round.
"""

from __future__ import annotations

from typing import Final, NamedTuple

from airlight.geometry.gradient_noise import sloping_noise, smooth_noise
from airlight.geometry.vectors import Vec3
from airlight.kernel import kernel
from airlight.scene.hills import lattice_place

#: Number of octaves, and cells of the coarsest over the finest of ``ground_detail``: on the Moon
#: 57 km to 110 m.
OCTAVES: Final = 10
COARSEST: Final = 1048576.0
#: Height of an octave over its cells on maria and in highlands [1], cells above which it grows no
#: more, by eye, and cells that are as large as texels of maps [m].
PLAIN: Final = 0.016
HILLY: Final = 0.05
WIDEST: Final = 20e3
LARGEST: Final = 6e4
#: Width of cells that begin to be seen is its inverse. [pixel]
SEEN: Final = 0.8
#: Roughness of the next octave where this one is 0, its increase to where it is 1, and limits. [1]
EVEN: Final = 0.95
ROUGHER: Final = 0.45
LEAST: Final = 0.6
MOST: Final = 1.25
#: Displacement of craters by an octave over its cells. [1]
MOVED: Final = 0.05
#: Noise within which there is a ridge, height of ridges over the coarsest cells, share of the next
#: octave, by which they wander, ratio of shares of successive octaves, their number, and asymmetry
#: of ridges, by eye. [1]
RIDGE: Final = 0.03
RISE: Final = 0.003
WANDER: Final = 0.2
CRISPER: Final = 0.4
BENDS: Final = 5
STEEPER: Final = 0.7
#: Height of a ridge over the largest where the next two octaves are 0, and increase by each. [1]
BROKEN: Final = 0.3
SWOLLEN: Final = 1.2


class Rolling(NamedTuple):
    """Rolling ground at a place.

    Attributes
    ----------
    height : float
        Height, of mean 0 without ridges. [finest cell]
    ascent : float
        Tangent of the ascent along a direction. [1]
    tone : float
        Sum of the octaves of noise, of mean 0. [1]
    aside, along : float
        Displacement of craters. [finest cell]
    """

    height: float
    ascent: float
    tone: float
    aside: float
    along: float


@kernel
def rolling(finest, footprint, whole, way, high, cell):
    """``Rolling`` of a place.

    Parameters
    ----------
    finest, footprint, whole, cell :
        Arguments of ``hills``.
    way : Vec3
        Horizontal direction of the ascent. [1]
    high : float
        Share of highlands. [1]
    """
    height, ascent, tone, aside, along = 0.0, 0.0, 0.0, 0.0, 0.0
    rough, scale, line, steep = PLAIN + (HILLY - PLAIN) * high, COARSEST, 0.0, 0.0
    swell, part = BROKEN, 1.0
    for octave in range(OCTAVES):
        shown = min(SEEN * scale / footprint - 1.0, 1.0)
        if shown > 0.0 and scale * cell < LARGEST:
            at = lattice_place(finest, whole, scale)
            value, slope = sloping_noise(at.x, at.y, at.z, way)
            size = shown * rough * min(WIDEST / (scale * cell), 1.0)
            height += size * value * scale
            ascent += size * slope
            tone += shown * value
            # directions of successive octaves are at right angles
            turned = aside
            aside = shown * MOVED * scale * value - along
            along = turned
            rough *= min(max(EVEN + ROUGHER * value, LEAST), MOST)
            if octave < BENDS:
                line += part * value
                steep += part * slope / scale
                if octave == 1 or octave == 2:
                    swell += SWOLLEN * value
        part *= WANDER if octave == 0 else CRISPER
        if octave == BENDS - 1 and high < 1.0 and COARSEST * cell < LARGEST:
            swell = min(max(swell, 0.0), 1.5)
            wide = RIDGE * (0.4 + swell)
            across = line / wide
            left = max(1.0 - across * across, 0.0) * RISE * swell * (1.0 - high) * COARSEST
            shown = min(max(wide * COARSEST / footprint - 1.0, 0.0), 1.0)
            lean = 1.0 + STEEPER * across
            level = 1.0 - across * across
            height += shown * left * level * lean
            ascent -= shown * left * (4.0 * across * lean - STEEPER * level) / wide * steep
        scale *= 0.5
    return Rolling(height, ascent, tone, aside, along)


@kernel
def rolling_height(finest, footprint, above, high, cell):
    """``height`` of ``Rolling`` from the centre of the body, without ridges. [finest cell]

    Octaves that cannot reach a height are left out.

    Parameters
    ----------
    finest, footprint, high, cell :
        Arguments of ``rolling``.
    above : float
        That height. [finest cell]
    """
    start, scale, height = Vec3(0.0, 0.0, 0.0), COARSEST, 0.0
    rough = PLAIN + (HILLY - PLAIN) * high
    shown, octave = 1.0, 0
    while shown > 0.0 and octave < OCTAVES:
        shown = min(SEEN * scale / footprint - 1.0, 1.0)
        if shown > 0.0 and scale * cell < LARGEST:
            at = lattice_place(finest, start, scale)
            value = smooth_noise(at.x, at.y, at.z)
            height += shown * rough * min(WIDEST / (scale * cell), 1.0) * value * scale
            rough *= min(max(EVEN + ROUGHER * value, LEAST), MOST)
            if above - height > 2.0 * rough * scale:
                height += 0.5 * rough * scale
                shown = 0.0
        scale *= 0.5
        octave += 1
    return height
