"""Procedural texture of land between decimetres and fields of some hundred metres; it is not data.

Tufts, stones, ripples, fields: octaves of equal contrast, since natural scenes have no scale of
their own (Ruderman & Bialek 1994, Phys. Rev. Lett. 73, 814: power as the inverse square of the
frequency). The same noise is the height of small relief, whose slopes sunlight shades and whose
stones and tufts hide what is behind them. Means of reflectance and of sunlight remain.
"""

from __future__ import annotations

from math import sqrt
from typing import Final, NamedTuple

from airlight.geometry.gradient_noise import DEVIATION, smooth_noise
from airlight.geometry.vectors import Vec3, plus, scaled
from airlight.kernel import kernel
from airlight.scene.ground_detail import DISPLACED, STEP
from airlight.scene.ground_detail import OCTAVES as DETAIL_OCTAVES
from airlight.scene.hills import along_lattice

#: Number of octaves, and sizes of the cells of the coarsest and of the finest over the finest of
#: ``ground_detail``: 460 m to 3 cm on Earth.
OCTAVES: Final = 8
COARSEST: Final = 4096.0
#: Octave of ``ground_detail``, from the finest, below which the land has this texture instead.
FINEST_OF_MAP: Final = 6
#: Height of noise above which stones and tufts stand out of even ground, how much steeper they are
#: than it; mean and standard deviation of the noise with them, of 2 million places. [1]
STONES: Final = 0.45
STEEPER: Final = 2.5
STONY_MEAN: Final = 0.0649
STONY_DEVIATION: Final = 0.542
#: Standard deviation of the reflectance over its mean in one octave of dark land. [1]
CONTRAST: Final = 0.1
#: Standard deviation of red over green, and of green over blue, in one octave. [1]
HUE: Final = 0.012
#: Distance of the two heights of a slope. [cell]
STRIDE: Final = 0.5
#: Standard deviation of the slope of one octave. [1]
SLOPE: Final = 0.08
#: Standard deviation of the heights of one octave that displace finer ones: less than slopes
#: state, so that no far side is seen through a near one. [cell]
HEIGHT: Final = 0.014
#: Height of stones and tufts of the finest octave that is shown, and number of heights at which a
#: line of sight is compared with theirs: they hide what is behind them. [cell]
TALL: Final = 0.3
LEVELS: Final = 8
#: Largest cells with slopes over the finest of ``ground_detail``: 7 m on Earth.
HIGHEST: Final = 64.0
#: Standard deviation of the difference of that over a stride, over its own. [1]
RISE: Final = 0.886
#: Steepest slopes, about two and a half standard deviations of all octaves. [1]
STEEPEST: Final = 0.45
#: Cosine of the star's zenith angle below which slopes are lit as at it. [1]
LOWEST: Final = 0.06
#: Cosine of the zenith angle of a line of sight below which heights are displaced as at it. [1]
GRAZING: Final = 0.15
#: Least blur of a pixel seen at a grazing angle over its longer axis: relief shows more than the
#: level ground would. [1]
FORESHORTENED: Final = 0.12


class LandTexture(NamedTuple):
    """Texture at a place.

    Attributes
    ----------
    tone, hue : float
        Relative changes of the reflectance, and of its ratio of red to green. [1]
    ascent : float
        Tangent of the ascent towards the star's azimuth. [1]
    shore : float
        Displacement of a coast, by an eighth of a cell in each octave. [texel of ``ground_detail``]
    """

    tone: float
    hue: float
    ascent: float
    shore: float


@kernel
def texture_footprint(footprint, cosine):
    """Footprint that blurs the texture: mean of a pixel's axes, or an eighth of the longer. [m]

    Parameters
    ----------
    footprint : float
        Longer axis of the pixel footprint. [m]
    cosine : float
        Cosine of the zenith angle of the line of sight. [1]

    Examples
    --------
    >>> texture_footprint(2.0, 1.0), texture_footprint(2.0, 0.01)
    (2.0, 0.24)
    """
    return footprint * max(sqrt(min(max(cosine, 0.0), 1.0)), FORESHORTENED)


@kernel
def stony(noise, part):
    """Noise with stones and tufts: an even ground of which the highest eighth stands out. [1]

    Parameters
    ----------
    noise : float
        Result of ``smooth_noise``. [1]
    part : float
        How much they stand out, 0 to 1. [1]

    Examples
    --------
    >>> stony(0.25, 1.0), round(stony(0.65, 1.0), 9)
    (0.25, 1.15)
    """
    return noise + part * STEEPER * max(noise - STONES, 0.0)


@kernel
def met_height(x, y, z, lean, tallest):
    """Height at which a line of sight meets the stones and tufts of an octave. [cell]

    Parameters
    ----------
    x, y, z : float
        End of the line on level ground. [cell]
    lean : Vec3
        Argument of ``land_texture``. [1]
    tallest : float
        Largest height. [cell]
    """
    step = tallest / LEVELS
    level, above, found = tallest, 1.0, 0.0
    while level > 0.5 * step:
        place = plus(Vec3(x, y, z), scaled(lean, level))
        height = tallest * max(smooth_noise(place.x, place.y, place.z), 0.0)
        if height >= level:
            found = level + step * (height - level) / (height - level + above)
            level = 0.0
        above = max(level - height, 1e-6)
        level -= step
    return found


@kernel
def land_texture(place, footprint, cell, whole, part, way, lean, leaf, snow):
    """Result of ``LandTexture`` at a place.

    The line of sight meets a height before the place on the level ground: each octave is seen on
    the coarser ones.

    Parameters
    ----------
    place, footprint, cell, whole, part :
        Arguments of ``ground_detail``; footprint from ``texture_footprint``.
    way : Vec3
        Horizontal direction towards the star, in the planet's frame. [1]
    lean : Vec3
        Horizontal way back towards the observer per height, in the planet's frame. [1]
    """
    tone, hue, ascent, shore, scale = 0.0, 0.0, 0.0, 0.0, COARSEST
    part_stony = 1.0 - 0.8 * leaf - 0.5 * snow
    finest = Vec3(part.x + place.x / cell, part.y + place.y / cell, part.z + place.z / cell)
    for octave in range(OCTAVES):
        shown = min(0.8 * cell * scale / footprint - 1.0, 1.0)
        if shown > 0.0:
            inverse = 1.0 / scale
            x = along_lattice(whole.x, finest.x, inverse)
            y = along_lattice(whole.y, finest.y, inverse)
            z = along_lattice(whole.z, finest.z, inverse)
            if scale <= HIGHEST:
                finer = 0.0
                if octave < OCTAVES - 1:
                    finer = min(max(0.8 * cell * scale / (STEP * footprint) - 1.0, 0.0), 1.0)
                tall = (1.0 - snow) * (1.0 - leaf) * TALL + leaf * (0.1 + 0.7 / max(scale, 1.0))
                tallest = tall * shown * (1.0 - finer)
                if tallest > 0.0:
                    met = met_height(x, y, z, lean, tallest)
                    x += lean.x * met
                    y += lean.y * met
                    z += lean.z * met
                    finest = plus(finest, scaled(lean, met * scale))
            here = smooth_noise(x, y, z)
            shore += shown * here * scale
            here = stony(here, part_stony)
            change = shown * (here - part_stony * STONY_MEAN)
            tone += change
            hue = change - hue  # signs alternate: no colour of its own for bright or dark
            if scale <= HIGHEST:
                ahead = stony(
                    smooth_noise(x + STRIDE * way.x, y + STRIDE * way.y, z + STRIDE * way.z),
                    part_stony,
                )
                ascent += shown * (ahead - here)
                height = shown * here * HEIGHT * scale / STONY_DEVIATION
                finest = plus(finest, scaled(lean, height))
        scale /= STEP
    return LandTexture(
        CONTRAST * tone / STONY_DEVIATION,
        HUE * hue / STONY_DEVIATION,
        SLOPE * ascent / (RISE * STONY_DEVIATION),
        DISPLACED * shore / (float(STEP ** (DETAIL_OCTAVES - 1)) * DEVIATION),
    )


@kernel
def textured(reflectance, change):
    """Reflectance with texture, in one channel. [1]

    Light that is reflected several times fills the hollows of bright ground: the contrast is in
    proportion to what one reflection absorbs.

    Parameters
    ----------
    reflectance : float
        Mean reflectance. [1]
    change : float
        Relative change of dark land. [1]

    Examples
    --------
    >>> textured(0.5, 0.2), textured(1.0, 0.2), textured(0.5, -3.0)
    (0.55, 1.0, 0.0)
    """
    return reflectance * max(1.0 + (1.0 - reflectance) * change, 0.0)


@kernel
def texture_light(mu_s, ascent):
    """Direct irradiance of a slope of the texture over that of level ground. [1]

    To first order 1 - ascent tan θ. Under a low star slopes shade one another, but all that the
    ground receives remains: the contrast is limited to that at which the steepest slope is dark.

    Parameters
    ----------
    mu_s : float
        Cosine of the star's zenith angle. [1]
    ascent : float
        Tangent of the ascent towards the star. [1]

    Examples
    --------
    >>> texture_light(1.0, 0.3), texture_light(-0.1, 0.3)
    (1.0, 1.0)
    """
    sine = sqrt(max((1.0 - mu_s) * (1.0 + mu_s), 0.0))
    tangent = sine / max(mu_s, LOWEST) if mu_s > 0.0 else 0.0
    limit = sqrt(1.0 + STEEPEST * STEEPEST * tangent * tangent)
    return max(1.0 - ascent * tangent / limit, 0.0)
