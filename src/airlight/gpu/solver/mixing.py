"""Texels of the solver's passes that combine the last images of the light to the next guess.

See ``rays`` for how a texel is related to its index.
"""

from __future__ import annotations

from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, load
from airlight.pixels.shown import WAVELENGTHS
from airlight.solvers.moments.convergence import is_near
from airlight.solvers.moments.stopping import PASS_IMAGES


@inlined
def mean(index, sizes, image, guess):
    """Mean radiances and irradiances of an image and its guess, monitored by the host. [1]

    Texels (image or guess, mean radiance or irradiance, radius, sun).
    """
    nodes = sizes.radii * sizes.suns
    node = index % nodes
    at = node * sizes.terms
    if index // nodes % 2 == 1:
        at = nodes * sizes.terms + node
    if index < 2 * nodes:
        return load(image, LANES * at)
    return load(guess, LANES * at)


@inlined
def mixed(index, weights, images):
    """Number of the combination of images.

    ``weights`` and each of ``images`` are read as single numbers.
    """
    lane = index % WAVELENGTHS
    return (
        weights[lane] * images.image_0[index]
        + weights[WAVELENGTHS + lane] * images.image_1[index]
        + weights[2 * WAVELENGTHS + lane] * images.image_2[index]
        + weights[3 * WAVELENGTHS + lane] * images.image_3[index]
        + weights[4 * WAVELENGTHS + lane] * images.image_4[index]
    )


@inlined
def sound(index, sizes, weights, images):
    """Return 1 where the combination of images is trusted at one wavelength, otherwise 0.

    Numbers (mean radiance or irradiance, radius, sun, lane); ``image_0`` is the latest.
    """
    numbers = sizes.radii * sizes.suns * WAVELENGTHS
    lane = index % WAVELENGTHS
    brightest = weights[WAVELENGTHS * PASS_IMAGES + lane]
    at = index // WAVELENGTHS * sizes.terms * WAVELENGTHS + lane
    if index >= numbers:
        brightest = weights[WAVELENGTHS * (PASS_IMAGES + 1) + lane]
        at = numbers * sizes.terms + index - numbers
    near = is_near(mixed(at, weights, images), images.image_0[at], brightest)
    return 1.0 if near else 0.0


@inlined
def next_guess(index, sizes, weights, images, sounds):
    """Combination of images where it is trusted, elsewhere the last image.

    Texels as in ``gathered_moment``.
    """
    nodes = sizes.radii * sizes.suns
    node = index // sizes.terms
    if index >= nodes * sizes.terms:
        node = nodes + index - nodes * sizes.terms
    total = load(weights, 0) * load(images.image_0, LANES * index)
    total = total + load(weights, LANES) * load(images.image_1, LANES * index)
    total = total + load(weights, 2 * LANES) * load(images.image_2, LANES * index)
    total = total + load(weights, 3 * LANES) * load(images.image_3, LANES * index)
    total = total + load(weights, 4 * LANES) * load(images.image_4, LANES * index)
    last = load(images.image_0, LANES * index)
    return last + load(sounds, LANES * node) * (total - last)
