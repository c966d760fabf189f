"""Reflection by the ground: one object for every solver, sweep, march and pixel.

A law of reflection gives the radiance of the ground along a line, relative to that of a white
Lambert surface in the same light: the reflectance factor, π times the BRDF (Nicodemus et al. 1977,
NBS Monograph 160). It is evaluated twice, because the ground's light has two parts: the star's
comes from one direction, the sky's from all, which counts as uniform there (0.6 % of reciprocity by
Lommel and Seeliger's law under Rayleigh's sky). Each factor is ``matte · albedo + gloss``: light
that the matter below the surface has coloured, and light that the surface itself mirrors.

Clouds hide the same share of the ground everywhere from solvers, which know nothing of places; a
picture looks their cover up.

A new law is a file of its own with two kernels, ``star_share`` and ``sky_share``, and a function
``largest_albedo``, and a line in ``LAWS``; its parameters other than the albedo are fields of
``Reflection``, numbers with a default, which every solver, table and shader passes on.
"""

from __future__ import annotations

from math import sqrt
from typing import Annotated, Any, Final, NamedTuple, get_type_hints

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.choice import chosen_kernel
from airlight.kernel.lanes import load
from airlight.kernel.shader_fields import CHOICE, SPECTRA
from airlight.optics import lambert, lommel_seeliger, water

FloatArray = NDArray[np.float64]

#: Laws of reflection by name: modules with their kernels and ``largest_albedo``.
LAWS: Final[dict[str, Any]] = {
    "lambert": lambert,
    "lommel-seeliger": lommel_seeliger,
    "water": water,
}


def law_number(name: str) -> int:
    """Number by which kernels know a law.

    Parameters
    ----------
    name : str
        Name from ``LAWS``.
    """
    return list(LAWS).index(name)


#: Number of the law of water, which a pixel mixes with another.
WATER: Final = law_number("water")


class Reflection(NamedTuple):
    """Ground as an argument of kernels.

    Attributes
    ----------
    albedo : array, shape (w,), or float
        Fraction of diffuse light that is reflected; wavelengths in the lanes, or one of them. [1]
    law : int
        Number of the law, its position in ``LAWS``.
    wet : bool
        Whether some of the ground is water, by the law or by a map.
    wind : float
        Wind speed over water. [m s⁻¹]
    cover, cloud_albedo : float
        Mean cover of the clouds that hide the ground, and the albedo of full cover, which reflects
        by Lambert's law. [1]
    """

    albedo: Annotated[Any, SPECTRA]
    law: Annotated[int, CHOICE] = 0
    wet: bool = False
    wind: float = 5.0
    cover: float = 0.0
    cloud_albedo: float = 0.0


def largest_albedo(ground: Reflection) -> float:
    """Largest albedo with which a ground conserves energy, by its law and parameters. [1]

    Examples
    --------
    >>> round(largest_albedo(Reflection(1.0, law_number("lommel-seeliger"))), 3)
    0.409
    """
    return list(LAWS.values())[ground.law].largest_albedo(ground)  # type: ignore[no-any-return]


#: White ground by Lambert's law.
WHITE: Final = Reflection(1.0)
#: Fields that are one number for all wavelengths, with their types.
NUMBERS: Final[dict[str, type]] = {
    name: kind for name, kind in get_type_hints(Reflection).items() if name != "albedo"
}

#: ``star_share(law, ground, mu_s, leaving, nu)``: factor of the albedo, and part without it, of the
#: light of a star, by the law of that number in ``LAWS``.
star_share = chosen_kernel("star_share", [law.star_share for law in LAWS.values()], __name__)
#: ``sky_share(law, ground, leaving)``: the same, of the light of a uniform sky.
sky_share = chosen_kernel("sky_share", [law.sky_share for law in LAWS.values()], __name__)


@inlined
def _with_clouds(factor, ground):
    """Reflectance factor of ground and of the clouds above it, from that of the ground. [1]"""
    cloud = ground.cover * ground.cloud_albedo
    return factor * np.float32(1.0 - ground.cover) + np.float32(cloud)


@inlined
def star_factor(ground, at, mu_s, leaving, nu):
    """Reflectance factor of the ground in the light of a star. [1]

    Parameters
    ----------
    ground : Reflection
    at : int
        Index of the first lane.
    mu_s : float
        Cosine of the star's zenith angle at the ground. [1]
    leaving : float
        Cosine of the zenith angle of the reflected light, towards the observer. [1]
    nu : float
        Cosine between the line of sight, as it arrives at the ground, and the star. [1]

    Returns
    -------
    lanes, or a float where ``ground`` is of one wavelength
    """
    matte, gloss = star_share(ground.law, ground, mu_s, leaving, nu)
    return _with_clouds(load(ground.albedo, at) * np.float32(matte) + np.float32(gloss), ground)


@inlined
def sky_factor(ground, at, leaving):
    """Reflectance factor of the ground under a uniform sky. [1]

    By reciprocity this is also the total reflected fraction of a beam from the direction
    ``leaving``.

    Parameters
    ----------
    ground : Reflection
    at : int
        Index of the first lane.
    leaving : float
        Cosine of the zenith angle of the reflected light, towards the observer. [1]

    Returns
    -------
    lanes, or a float where ``ground`` is of one wavelength
    """
    matte, gloss = sky_share(ground.law, ground, leaving)
    return _with_clouds(load(ground.albedo, at) * np.float32(matte) + np.float32(gloss), ground)


@inlined
def leaving_cosine(r, mu, bottom):
    """Cosine of the zenith angle at which light leaves the ground along a straight line. [1]

    Parameters
    ----------
    r, mu : float
        Radius at which the line is seen [m], and its zenith cosine there, towards the ground [1].
    bottom : float
        Radius of the ground. [m]
    """
    sine = r / bottom * sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
    return sqrt(max((1.0 - sine) * (1.0 + sine), 0.0))


@inlined
def star_factor_at(ground, l, mu_s, leaving, nu):
    """``star_factor`` at one of the wavelengths, in double precision. [1]"""
    matte, gloss = star_share(ground.law, ground, mu_s, leaving, nu)
    clear = matte * ground.albedo[l] + gloss
    return clear * (1.0 - ground.cover) + ground.cover * ground.cloud_albedo


@inlined
def sky_factor_at(ground, l, leaving):
    """``sky_factor`` at one of the wavelengths, in double precision. [1]"""
    matte, gloss = sky_share(ground.law, ground, leaving)
    clear = matte * ground.albedo[l] + gloss
    return clear * (1.0 - ground.cover) + ground.cover * ground.cloud_albedo


@compiled_loop
def star_factors(ground, mu_s, leaving, nu, out):
    """Write ``star_factor`` of n lines at all wavelengths to ``out``, shape (n, nl). [1]"""
    for k in range(mu_s.size):
        for l in range(out.shape[1]):
            out[k, l] = star_factor_at(ground, l, mu_s[k], leaving[k], nu[k])


@compiled_loop
def sky_factors(ground, leaving, out):
    """Write ``sky_factor`` of n lines at all wavelengths to ``out``, shape (n, nl). [1]"""
    for k in range(leaving.size):
        for l in range(out.shape[1]):
            out[k, l] = sky_factor_at(ground, l, leaving[k])
