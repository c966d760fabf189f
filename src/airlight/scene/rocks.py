"""Rocks on bare ground, with lit and shaded sides and cast shadows; they are not data.

The share of the ground below rocks wider than D is k exp(-q D), q = 1.79 + 0.152/k (Golombek & Rapp
1997, J. Geophys. Res. 102, 4117), with the k of the planet's file. Each cell of a square lattice
has at most one rock, of the sizes between those of the next finer and its own lattice: a polyhedron
whose edges are broken off, with fractures, pits, and dust on top. A line of sight, or towards the
star, visits the cells that it crosses below the tops of rocks. Seen from above, mean reflectance
and mean light of star and sky remain. Seen at an angle, rocks brighten the ground towards the star
and darken it away from it, as they do on ground that reflects by Lambert's law, down to 6° of
elevation; at flatter angles they are lower and do less.
"""

from __future__ import annotations

from math import exp, floor, log, log2, sqrt
from typing import Final, NamedTuple

from airlight.geometry.gradient_noise import in_period, noise_gradient, plane_noise, shuffled
from airlight.geometry.vectors import Vec3
from airlight.kernel import kernel
from airlight.scene.ground_detail import STEP, along_lattice

#: Decrease q of the share of the ground below rocks with their diameter, for a share of 0 of all
#: rocks, and its increase with the share's inverse. [m⁻¹]
DECREASE: Final = 1.79
SPARSER: Final = 0.152
#: Number of lattices, and size of the finest, to a factor of √2. [m]
LATTICES: Final = 5
FINEST: Final = 0.0207
#: Diameter of the widest rock of a lattice, and mean area of a cell's rock, whose logarithm of the
#: diameter is uniform. [cell], [cell²]
WIDEST: Final = 0.6
AREA: Final = 0.0509
#: Height of a rock over its radius: of the flattest, and what the highest has more. [1]
FLAT: Final = 0.35
STEEPER: Final = 0.85
#: Height of the highest rock [cell], and farthest distance from which rocks are looked for [cell],
#: with the number of cells that are visited.
HIGHEST: Final = 0.36
SPAN: Final = 3.0
VISITS: Final = 5
#: Size of the noise of fields of rocks over the finest cells. [1]
PATCH: Final = 1024.0
#: Rocks between those fields over the mean, by eye. [1]
FEWEST: Final = 0.2
#: Longest shadow. [cell]
SHADOW: Final = 2.5
#: How much less red over green rocks are, over what they reflect less than the ground between
#: them, which is dust: by eye. [1]
GREY: Final = 0.2
#: Logarithm of the ratio of diameters on a lattice. [1]
FOURFOLD: Final = log(4.0)
#: Number of faces of a rock but for its top, and of them of those at its foot; cosine and sine of
#: the angle between them, 64°. [1]
FACES: Final = 10
SIDES: Final = 6
TURN_X: Final = 0.43837
TURN_Y: Final = 0.89879
#: Nearest and farthest side from the middle, over the radius; what a side leans inwards at least
#: and more, over the height; the same of the upper faces, and the height at which they are as far
#: from the middle as sides; tilt of the top. [1]
NEAREST: Final = 0.54
FARTHER: Final = 0.37
LEAN: Final = 0.14
LEANING: Final = 0.5
UPPER: Final = 0.5
UPPER_LEAN: Final = 1.2
SHOULDER: Final = 0.45
TILT: Final = 0.6
#: Share of a ball in the direction of faces, whose edges are worn; cells of fractures and of pits
#: per radius, how much they tilt faces, and finer pits per coarser; pixel beyond which pits are not
#: seen [cell]; thickness that fractures break off at edges, at most [radius]; all by eye. [1]
WORN: Final = 0.3
FRACTURES: Final = 2.3
FRACTURED: Final = 0.45
PITS: Final = 7.3
PITTED: Final = 0.22
FINER: Final = 3.3
UNSEEN: Final = 1.8
BROKEN: Final = 0.3
#: Cosine of the angle of faces from the zenith above which dust lies on them, and where it covers
#: them, by eye; share of rocks below dust, seen from above, of 300 000 places; least reflectance
#: of a rock over the mean of rocks, by eye. [1]
DUSTY_FROM: Final = 0.55
DUSTY_TO: Final = 0.95
DUSTED: Final = 0.53
DARKEST: Final = 0.75
#: Reflectance of the ground, whose light reaches the sides of rocks; square of twice the light of
#: the sky on a face that looks away from the sky's side of the star. [1]
GROUND: Final = 0.15
DIM: Final = 0.1
#: Direct light that the ground and rocks lose per share of rocks, seen from above: under a star in
#: the zenith, and ``SHADED`` t²/(t + ``FROM``) more, with the tangent t of the zenith angle; light
#: of the sky that they lose; of 300 000 places each. [1]
LOST: Final = 0.198
SHADED: Final = 0.312
FROM: Final = 0.85
HIDDEN: Final = 0.062
#: Cosine of the star's zenith angle below which faces are lit as at it. [1]
LOWEST: Final = 0.1


class Rocks(NamedTuple):
    """Rocks in a pixel.

    Attributes
    ----------
    tone : float
        Reflectance over that without rocks. [1]
    hue : float
        Relative change of its ratio of red to green. [1]
    open : float
        Share of the direct light on the ground without rocks that remains. [1]
    light, sky : float
        Direct light and light of the sky on rocks, over those of level ground. [1]
    bare : float
        Share of the pixel without rocks. [1]
    """

    tone: float
    hue: float
    open: float
    light: float
    sky: float
    bare: float


class RockMet(NamedTuple):
    """Where a line leaves a rock.

    Attributes
    ----------
    part : float
        Share of the pixel that the rock covers. [1]
    face_x, face_y, face_z : float
        Outward direction of its face, not normalised, of the rock of height 1. [1]
    tone : float
        Reflectance over that of the rock: pits are dark. [1]
    """

    part: float
    face_x: float
    face_y: float
    face_z: float
    tone: float


@kernel
def rock_area(narrow, wide, share):
    """Share of the ground below rocks between two diameters [m], of a share of all rocks. [1]

    Examples
    --------
    >>> round(rock_area(0.0, 1e9, 0.07), 9), round(rock_area(0.2, 0.8, 0.07), 4)
    (0.07, 0.0288)
    """
    decrease = DECREASE + SPARSER / share
    return share * (exp(-decrease * narrow) - exp(-decrease * wide))


@kernel
def rock_met(x, y, ray, first, second, blur):
    """``RockMet`` of a line and a convex rock with plane faces, of radius and height 1.

    Parameters
    ----------
    x, y : float
        End of the line on the ground, from the middle. [radius]
    ray : Vec3
        Direction from there; its third component over the height. [radius⁻¹]
    first, second : float
        Numbers from 0 to 1 of which the faces are made.
    blur : float
        Width of the pixel. [radius]
    """
    # the line is within the rock from ``enters`` to ``leaves``, above the ground
    enters, entering = 0.0, ray.z
    tilt_x, tilt_y = TILT * (first - 0.5), TILT * (second - 0.5)
    leaving = max(ray.z + tilt_x * ray.x + tilt_y * ray.y, 1e-6)
    leaves = (0.75 + 0.25 * second - tilt_x * x - tilt_y * y) / leaving
    face_x, face_y, face_z = tilt_x, tilt_y, 1.0
    along, aside = first, sqrt(1.0 - first * first)
    offset, steep = 5.0 * second, 11.0 * second + 3.0 * first
    offset, steep = offset - floor(offset), steep - floor(steep)
    for side in range(FACES):
        left = NEAREST + FARTHER * offset - along * x - aside * y
        lean = LEAN + LEANING * steep * steep
        if side >= SIDES:
            lean = UPPER + UPPER_LEAN * steep
            left += SHOULDER * lean
        outwards = along * ray.x + aside * ray.y + lean * ray.z
        if outwards > 0.0:
            if left < leaves * outwards:
                leaves, leaving = left / outwards, outwards
                face_x, face_y, face_z = along, aside, lean
        elif left < enters * outwards:
            outwards = min(outwards, -1e-6)
            enters, entering = left / outwards, -outwards
        if enters > leaves + blur * (1.0 / leaving + 1.0 / entering):
            break
        along, aside = TURN_X * along - TURN_Y * aside, TURN_Y * along + TURN_X * aside
        offset += 0.618034 if offset < 0.381966 else -0.381966
        steep += 0.754878 if steep < 0.245122 else -0.245122
    part, out, tone = 0.0, max(leaves, 0.0), 1.0
    if leaves > enters:
        x, y, high = x + out * ray.x, y + out * ray.y, out * ray.z
        # the noise of each rock begins elsewhere
        u, v, w = x + 100.0 * first, y + 100.0 * second, high
        broken, rise_x, rise_y, rise_z = noise_gradient(FRACTURES * u, FRACTURES * v, FRACTURES * w)
        length = sqrt(ray.x * ray.x + ray.y * ray.y + ray.z * ray.z)
        leaves -= BROKEN * max(broken, 0.0) / length
        # width of the wedge between both planes, in pixels
        wedge = (leaves - enters) * leaving * entering / ((leaving + entering) * blur)
        part = min(max(wedge + 0.5, 0.0), 1.0)
    if part > 0.0:
        # sides of fractures are plane, too
        face_x += WORN * x - FRACTURED * min(max(2.0 * rise_x, -1.0), 1.0)
        face_y += WORN * y - FRACTURED * min(max(2.0 * rise_y, -1.0), 1.0)
        face_z += WORN * high - 0.5 * FRACTURED * min(max(2.0 * rise_z, -1.0), 1.0)
        fine = PITS
        for _octave in range(2):
            pits = PITTED * (1.0 - blur * fine / UNSEEN)
            if pits > 0.0:
                pit, rise_x, rise_y, rise_z = noise_gradient(fine * u, fine * v, fine * w)
                face_x -= pits * rise_x
                face_y -= pits * rise_y
                face_z -= 0.5 * pits * rise_z
                tone += pits * pit
            fine *= FINER
    return RockMet(part, face_x, face_y, face_z, tone)


@kernel
def rocks_met(x, y, ray, span, blur, density, sun, glow, dust):
    """Share of a line that rocks hide, and their light over that of level ground. [1]

    Parameters
    ----------
    x, y : float
        End on the ground. [cell]
    ray : Vec3
        Horizontal direction from there, and ascent. [1]
    span : float
        Distance from which rocks are looked for. [cell]
    blur : float
        Width of the pixel. [cell]
    density : float
        Share of cells with a rock. [1]
    sun : Vec3
        Direction towards the star. [1]
    glow : float
        Light of the sky from the star's side, horizontal over vertical, over the sine of the
        star's zenith angle. [1]
    dust : float
        What dust on rocks reflects more, over what they do. [1]

    Returns
    -------
    hidden, light, sky : float
        Share, and direct light and that of the sky.
    """
    left, light, sky, went, visits = 1.0, 0.0, 0.0, 0.0, 0
    several, low = 289.0 * density, min(span * ray.z / HIGHEST, 1.0)
    start_x, start_y = x + span * ray.x, y + span * ray.y
    i, j = float(floor(start_x)), float(floor(start_y))
    step_x, next_x, every_x = 1.0, i + 1.0 - start_x, 1.0 / max(abs(ray.x), 1e-6)
    if ray.x > 0.0:
        step_x, next_x = -1.0, start_x - i
    step_y, next_y, every_y = 1.0, j + 1.0 - start_y, 1.0 / max(abs(ray.y), 1e-6)
    if ray.y > 0.0:
        step_y, next_y = -1.0, start_y - j
    next_x *= every_x
    next_y *= every_y
    column = shuffled(in_period(i))
    while visits < VISITS and went <= span and left > 0.02:
        number = shuffled(column + in_period(j))
        if number < several:
            radius = 0.5 * WIDEST * exp(-FOURFOLD * number / several)
            # lower than the line where it leaves the cell
            if (FLAT + STEEPER) * radius * low > (span - min(next_x, next_y)) * ray.z:
                first = shuffled(number + column)
                second = shuffled(first + in_period(j)) / 289.0
                first /= 289.0
                at_x = x - i - radius - (1.0 - 2.0 * radius) * first
                at_y = y - j - radius - (1.0 - 2.0 * radius) * second
                # heights differ from shapes
                height = 7.0 * first + 3.0 * second
                height = radius * (FLAT + STEEPER * (height - floor(height))) * low
                near, wide = -at_x * ray.x - at_y * ray.y, radius + 0.5 * blur
                over = (near - wide) * ray.z > height or near < -wide
                if not over and abs(at_x * ray.y - at_y * ray.x) < wide:
                    way = Vec3(ray.x / radius, ray.y / radius, ray.z / max(height, 1e-6))
                    one = rock_met(at_x / radius, at_y / radius, way, first, second, blur / radius)
                    if one.part > 0.0:
                        upright = one.face_z * radius / max(height, 1e-6)
                        across = one.face_x * sun.x + one.face_y * sun.y
                        size = one.face_x * one.face_x + one.face_y * one.face_y
                        size = 1.0 / sqrt(size + upright * upright)
                        facing = max(across + upright * sun.z, 0.0) * size
                        below = GROUND * (0.5 - 0.5 * upright * size)
                        seen = (upright * size - DUSTY_FROM) / (DUSTY_TO - DUSTY_FROM)
                        seen = dust * (min(max(seen, 0.0), 1.0) - DUSTED)
                        seen += one.tone * (DARKEST + (2.0 - 2.0 * DARKEST) * first)
                        seen *= left * one.part
                        light += seen * (facing / max(sun.z, LOWEST) + below)
                        open_sky = 0.5 + 0.5 * upright * size + glow * across * size
                        open_sky = 0.5 * (open_sky + sqrt(open_sky * open_sky + DIM))
                        sky += seen * (open_sky + below)
                        left *= 1.0 - one.part
        if next_x < next_y:
            went = next_x
            next_x += every_x
            i += step_x
            column = shuffled(in_period(i))
        else:
            went = next_y
            next_y += every_y
            j += step_y
        visits += 1
    return 1.0 - left, light, sky


@kernel
def rocks(place, whole, ray, sun, glow, pixel, blur, cell, bare, share, stone):
    """``Rocks`` of a pixel.

    Parameters
    ----------
    place, whole : Vec3
        Place and lattice point, ``faced``. [finest cell]
    ray, sun : Vec3
        Horizontal direction towards the observer in the plane of the face, and the ascent of the
        line of sight; direction towards the star. [1]
    glow : float
        Argument of ``rocks_met``.
    pixel, blur : float
        Width of the pixel across the line of sight, and its mean on the ground. [finest cell]
    cell : float
        Size of the finest cells. [m]
    bare : float
        Share of bare ground. [1]
    share : float
        Share of bare ground below rocks. [1]
    stone : float
        Reflectance of rocks over that of the ground between them. [1]
    """
    tone, hue, open_ground, light, sky, below, left = 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0
    scale = 2.0 ** floor(log2(FINEST / cell) + 0.5)
    if bare * share > 0.0 and 0.4 * WIDEST * scale * STEP ** (LATTICES - 1) > pixel:
        inverse = 1.0 / (PATCH * scale)
        field, _rise_x, _rise_y = plane_noise(
            along_lattice(whole.x, place.x, inverse), along_lattice(whole.y, place.y, inverse)
        )
        bare *= min(max(1.0 + 2.0 * field, FEWEST), 2.0 - FEWEST)
    sine = max(sqrt(sun.x * sun.x + sun.y * sun.y), 1e-6)
    up = Vec3(sun.x / sine, sun.y / sine, max(sun.z, LOWEST) / sine)
    for _lattice in range(LATTICES):
        shown = min(0.4 * WIDEST * scale / pixel - 1.0, 1.0) if bare * share > 0.0 else 0.0
        if shown > 0.0:
            wide = WIDEST * scale * cell
            density = min(bare * rock_area(wide / STEP, wide, share) / AREA, 1.0)
            below += shown * density * AREA
            x = along_lattice(whole.x, place.x, 1.0 / scale)
            y = along_lattice(whole.y, place.y, 1.0 / scale)
            span = min(HIGHEST / max(ray.z, 1e-6), SPAN)
            cover, face, open_sky = rocks_met(
                x, y, ray, span, pixel / scale, density, sun, glow, 1.0 / stone - 1.0
            )
            dark = 0.0
            if cover < 0.98 and sun.z > 0.0:
                span = min(HIGHEST / up.z, SHADOW)
                dark, _direct, _diffuse = rocks_met(
                    x, y, up, span, blur / scale, density, sun, glow, 0.0
                )
            # the widest rocks hide what the narrow ones are
            between = 1.0 - shown * cover
            tone = tone * between + shown * cover * stone
            hue = hue * between - GREY * (1.0 - stone) * shown * cover
            light = light * between + shown * face
            sky = sky * between + shown * open_sky
            open_ground *= between * (1.0 - shown * dark)
            left *= between
        scale *= STEP
    tangent = sine / max(sun.z, 2.0 * LOWEST)
    kept = 1.0 - below * (LOST + SHADED * tangent * tangent / (tangent + FROM))
    return Rocks(
        tone / (1.0 - below * (1.0 - stone)),
        hue + GREY * (1.0 - stone) * below,
        open_ground / kept,
        light / kept,
        (sky + left) / (1.0 - HIDDEN * below),
        left,
    )
