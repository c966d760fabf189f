"""Procedural texture of land between decimetres and fields of some hundred metres; it is not data.

Octaves of noise in a plane, since natural scenes have no scale of their own (Ruderman & Bialek
1994, Phys. Rev. Lett. 73, 814: power as the inverse square of the frequency). Each kind of ground
has a structure of its own: plants are patches; every other octave of bare ground is waves of sand
with sharp crests, which wander, fork and fade out, on stony ground only where coarser noise makes
drifts; snow is drawn out along the wind, as sastrugi. The same noise is the height of small relief,
whose slopes sunlight shades; stony ground has mounds or pits, too. At a grazing angle plants and
crests are seen in rows that hide what is behind them. Means of reflectance and of sunlight remain.
"""

from __future__ import annotations

from math import cos, exp, floor, log, log2, pi, sin, sqrt
from typing import Final, NamedTuple

from airlight.geometry.gradient_noise import PLANE_DEVIATION, SLOPE_DEVIATION, plane_noise
from airlight.geometry.vectors import Vec3, dot, plus, scaled
from airlight.kernel import kernel
from airlight.scene.ground_detail import DISPLACED, STEP, along_lattice
from airlight.scene.ground_detail import OCTAVES as DETAIL_OCTAVES

#: Number of octaves, and sizes of the cells of the coarsest and of the finest over the finest of
#: ``ground_detail``: 460 m to 7 mm on Earth.
OCTAVES: Final = 9
COARSEST: Final = 4096.0
#: Octave of ``ground_detail``, from the finest, below which the land has this texture instead.
FINEST_OF_MAP: Final = 6
#: Shares of green plants and of snow at which the structure of the ground changes. [1]
GREEN: Final = 0.35
SNOWY: Final = 0.5
#: Contrast and slopes of bare ground between waves, and of snow, over the mean of those of plants;
#: of plants, that of the coarsest octave and its increase to each finer one. [1]
SANDY: Final = 0.5
ICY: Final = 1.0
COARSE: Final = 0.5
FINER: Final = 0.14
#: Length of the noise of waves along crests and across, and of sastrugi [cell]; how far crests
#: wander [rad], and the second harmonic that sharpens them [1].
CREST: Final = 8.0
BETWEEN: Final = 4.0
DRAWN: Final = 3.0
WANDER: Final = 5.0
SHARP: Final = 0.3
#: Waves of a second train per one of the first, and how far it turns along a cell of crests [rad],
#: by eye. [1]
CLOSER: Final = 1.3
ASLANT: Final = 0.5
#: What a coarser octave's noise counts less for drifts of sand on stony ground than the next finer,
#: and the sum at which drifts begin, and over which waves become high on them. [1]
OLDER: Final = 0.4
DRIFT: Final = -0.05
HIGHER: Final = 0.4
#: Contrast of stony ground in an octave over that in the next coarser one, by eye. [1]
FADING: Final = 0.8
#: Standard deviation of the reflectance over its mean in one octave of dark land. [1]
CONTRAST: Final = 0.1
#: Standard deviation of red over green, and of green over blue, in one octave. [1]
HUE: Final = 0.012
#: Standard deviation of the slope of one octave. [1]
SLOPE: Final = 0.08
#: Angle of the least row over that of a pixel, ratio of distances of the nearest rows, size of
#: ragged edges over the height of a row, how far they rise over it, and width over height of blades
#: and of stones. All chosen by looking at pictures. [1]
ROW: Final = 3.0
SPACING: Final = 0.04
RAGGED: Final = 3.0
RAISED: Final = 1.0
UPRIGHT: Final = 0.5
FLAT: Final = 2.5
#: Least blur of a pixel seen at a grazing angle over its longer axis: relief shows more than the
#: level ground would. [1]
FORESHORTENED: Final = 0.12
#: Largest cells with slopes, but for waves, over the finest of ``ground_detail``: 7 m on Earth.
HIGHEST: Final = 64.0
#: Slopes of mounds and pits on stony ground, between octaves, over ``SLOPE``, and the noise below 0
#: from which they rise or sink. [1]
UNEVEN: Final = 5.0
LEVEL: Final = 0.15
#: Cells of the coarsest mounds, with half of their slopes, and of the steepest over the finest of
#: ``ground_detail``; slopes of stony ground's waves over those of others. [1]
UNEVEN_FROM: Final = 256.0
STEEPER_FROM: Final = 16.0
DRIFTED: Final = 1.2
#: Slopes of mounds of an octave over those of the next coarser below ``STEEPER_FROM``, and width
#: of what is seen on stony ground in rows over the pixel: wider things fade, as they would be
#: streaks, by eye. [1]
SMOOTHER: Final = 0.85
EXTENDED: Final = 6.0
#: Steepest slopes, about two and a half standard deviations of all octaves. [1]
STEEPEST: Final = 0.45
#: Cosine of the star's zenith angle below which slopes are lit as at it. [1]
LOWEST: Final = 0.06


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
def face_of(up):
    """Axis of the face of a cube on which the texture of a place lies, 0 to 2."""
    if abs(up.z) >= max(abs(up.x), abs(up.y)):
        return 2
    return 0 if abs(up.x) >= abs(up.y) else 1


@kernel
def faced(vector, face):
    """Vector whose first two components lie in a face of a cube.

    Examples
    --------
    >>> faced(Vec3(1.0, 2.0, 3.0), 0)
    Vec3(x=2.0, y=3.0, z=1.0)
    """
    if face == 0:
        return Vec3(vector.y, vector.z, vector.x)
    if face == 1:
        return Vec3(vector.z, vector.x, vector.y)
    return vector


@kernel
def row_before(dip, width):
    """Dip of the row of plants, stones or crests before a place. [1]

    Rows are wider than pixels, and near a low observer as far apart as they are tall.

    Parameters
    ----------
    dip : float
        Height of the observer over the distance of the place. [1]
    width : float
        Angle of a row. [rad]

    Examples
    --------
    >>> row_before(0.01, 0.004), round(row_before(0.4, 0.004), 3)
    (0.012, 0.406)
    """
    near = width / SPACING
    if dip <= near:
        return width * (1.0 + floor(dip / width))
    return near * exp(SPACING * (1.0 + floor(log(dip / near) / SPACING)))


@kernel
def seen_row(place, altitude, width, cell, leaf, whole, part):
    """Place of what stands up before a place on level ground, and hides it. [finest cell]

    Whatever is as tall as it is wide is seen at a grazing angle as a row before the next one, whose
    edge is ragged.

    Parameters
    ----------
    place, cell, whole, part :
        Arguments of ``land_texture``.
    altitude, width : float
        Height of the observer [m]; angle of a row [rad].
    leaf : float
        Share of green plants: blades are taller than wide, stones wider than tall. [1]
    """
    distance = max(sqrt(dot(place, place)), 1e-3 * cell)
    dip = altitude / distance
    row = row_before(dip, width)
    scale = 2.0 ** floor(log2(max(RAGGED * width * distance / cell, 0.25)))
    share = dip / (row * cell)
    at = plus(part, scaled(place, share))
    ragged, _x, _y = plane_noise(
        along_lattice(whole.x, at.x, 1.0 / scale), along_lattice(whole.y, at.y, 1.0 / scale)
    )
    moved = dip + RAISED * max(width, SPACING * dip) * ragged
    row = max(row_before(moved, width), dip)
    share = dip / row
    upright = UPRIGHT + (FLAT - UPRIGHT) * (1.0 - leaf)
    beyond = share / cell + upright * altitude * (1.0 - share) / (cell * distance)
    return plus(part, scaled(place, beyond))


@kernel
def octave_change(place, scale, whole, way, along, wander):
    """Noise of an octave, and its growth along a direction. [1]

    Parameters
    ----------
    place : Vec3
        Place. [finest cell]
    scale : float
        Size of the cells. [finest cell]
    whole, way : Vec3
        Arguments of ``land_texture``.
    along : float
        How much the noise is drawn out. [1]
    wander : float
        How far crests of waves of sand, of two cells, wander; 0 without waves. [rad]
    """
    inverse = 1.0 / scale
    across = BETWEEN if wander > 0.0 else 1.0
    value, slope_x, slope_y = plane_noise(
        along_lattice(whole.x, place.x, inverse / along),
        along_lattice(whole.y, place.y, inverse / across),
    )
    growth = way.x * slope_x / along + way.y * slope_y / across
    if wander > 0.0:
        phase = pi * along_lattice(whole.y, place.y, inverse) + wander * value
        size = min(max(0.4 + 1.5 * value, 0.0), 1.0)
        growth = pi * way.y + wander * growth
        # two trains of waves, of which one or the other is higher: crests end or fork between them
        second = CLOSER * phase + ASLANT * along_lattice(whole.x, place.x, inverse)
        part = min(max(0.5 + 1.2 * (value - 0.1), 0.0), 1.0)
        wave = (1.0 - part) * sin(phase) + part * sin(second)
        turn = CLOSER * growth + ASLANT * way.x
        growth = (1.0 - part) * growth * cos(phase) + part * turn * cos(second)
        growth *= size * (1.0 - 2.0 * SHARP * wave)
        value = size * (wave + SHARP * (0.5 - part + part * part - wave * wave))
    return value, growth


@kernel
def octave_seen(ground, row, footprint, longer, scale, whole, way, along, wander):
    """Result of ``octave_change``, of the ground or of rows that hide it, blurred by the pixel. [1]

    Parameters
    ----------
    ground, row, footprint, longer :
        Arguments of ``land_texture``.
    scale, whole, way, along, wander :
        Arguments of ``octave_change``.
    """
    here, growth = 0.0, 0.0
    shown = min(0.8 * scale / footprint - 1.0, 1.0)
    if shown > 0.0:
        flat = min(max(1.2 * scale / longer - 1.0, 0.0), shown)
        if flat > 0.0:
            value, change = octave_change(ground, scale, whole, way, along, wander)
            here += flat * value
            growth += flat * change
        if flat < shown:
            value, change = octave_change(row, scale, whole, way, along, wander)
            here += (shown - flat) * value
            growth += (shown - flat) * change
    return here, growth


@kernel
def land_texture(ground, row, footprint, longer, whole, way, leaf, snow, windy, rough):
    """Result of ``LandTexture`` at a place.

    Parameters
    ----------
    ground, row : Vec3
        Place, and result of ``seen_row``, ``faced``. [finest cell]
    footprint, longer : float
        Axes of the pixel. [finest cell]
    whole : Vec3
        Result of ``lattice_origin``, ``faced``.
    way : Vec3
        Horizontal direction towards the star, in the planet's frame, ``faced``. [1]
    leaf, snow : float
        Shares of green plants and of snow. [1]
    windy : bool
        Whether sand has waves.
    rough : float
        Size of mounds on stony ground over their slope ``UNEVEN``, of pits if negative. [1]
    """
    tone, hue, ascent, shore, scale, even = 0.0, 0.0, 0.0, 0.0, COARSEST, 1.0
    sandy, snowy = leaf < GREEN and snow < SNOWY, snow >= SNOWY
    loud = SANDY if sandy else (ICY if snowy else COARSE)
    louder = 0.0 if sandy or snowy else FINER
    drawn = DRAWN if snowy else 1.0
    steep, part, drift, before = DRIFTED if rough > 0.0 else 1.0, 0.5 * rough, 0.0, 0.0
    for octave in range(OCTAVES):
        if 0.8 * scale > footprint:
            here, growth, high = 0.0, 0.0, 0.0
            if windy and sandy and octave - 2 * (octave // 2) == 1:
                high = 1.0
                if rough > 0.0:
                    high = min(max((drift - DRIFT) / HIGHER, 0.0), 1.0)
            if high < 1.0:
                here, growth = octave_seen(
                    ground, row, footprint, longer, scale, whole, way, drawn, 0.0
                )
                here *= 1.0 - high
                growth *= (1.0 - high) * loud if scale <= HIGHEST else 0.0
            if high > 0.0:
                wave, change = octave_seen(
                    ground, row, footprint, longer, scale, whole, way, CREST, WANDER
                )
                here += high * wave
                growth += high * steep * change
            seen = 1.0
            if rough > 0.0:
                even *= FADING
                seen = max(1.2 * scale / longer - 1.0, EXTENDED * footprint / scale)
                seen = min(seen, 1.0)
                here *= seen
                growth *= seen
            if octave - 2 * (octave // 2) == 0:
                drift = OLDER * drift + before
                before = here
            shore += here * scale
            tone += even * loud * here
            hue = (
                even * loud * here - hue
            )  # signs alternate: no colour of its own for bright or dark
            ascent += growth
            if part != 0.0 and scale <= UNEVEN_FROM:
                here, growth = octave_seen(
                    ground, row, footprint, longer, 0.5 * scale, whole, way, 1.0, 0.0
                )
                ascent += part * UNEVEN * max(here + LEVEL, 0.0) * growth * seen
                part *= sqrt(2.0) if scale > STEEPER_FROM else SMOOTHER
        loud += louder
        scale /= STEP
    ascent *= SLOPE / SLOPE_DEVIATION
    if rough > 0.0:
        ascent /= sqrt(1.0 + ascent * ascent / (STEEPEST * STEEPEST))
    return LandTexture(
        CONTRAST * tone / PLANE_DEVIATION,
        HUE * hue / PLANE_DEVIATION,
        ascent,
        DISPLACED * shore / (float(STEP ** (DETAIL_OCTAVES - 1)) * PLANE_DEVIATION),
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
