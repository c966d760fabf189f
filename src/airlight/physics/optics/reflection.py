"""Reflectance of the ground: parameters and laws for all solvers and renderers.

A reflection law gives the reflectance factor: the radiance of the ground relative to that of a
white Lambertian surface under the same illumination, π times the BRDF (Nicodemus et al. 1977,
NBS Monograph 160). It has two forms: direct (bidirectional) for the star's beam, and diffuse
(hemispherical-directional) for sky light, which is taken as isotropic (reciprocity error 0.6 % for
Lommel-Seeliger under a Rayleigh sky). Each is ``diffuse · albedo + specular``: volume scattering
below the surface, which has the ground's colour, and Fresnel reflection by the surface.

Of ground below clouds (``clouds``) lines of sight see the mean of a fraction with the layer, the
mean cover, and of one without; a renderer looks up the local covers. The sweeps of the moments'
solver have the layer's plane albedo, without azimuth (``mean_direct_reflectance``).

A law is a module with two kernels, ``brdf_direct`` and ``brdf_diffuse``, a function
``largest_albedo``, and an entry in ``LAWS``; its parameters other than the albedo are numeric
fields of ``Reflection``, or of a NamedTuple there, with a default, passed to every solver, table
and shader.
"""

from __future__ import annotations

from math import sqrt
from typing import Annotated, Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.choice import chosen_kernel
from airlight.kernel.lanes import load
from airlight.kernel.shader_fields import CHOICE, spectra
from airlight.physics.optics import hapke, lambert, lommel_seeliger, water
from airlight.physics.optics.clouds import (
    DIFFUSE_COSINE,
    layer_passage,
    layer_reflectance,
    mean_reflected,
    reflected_at,
    reflected_lanes,
    under_sky,
    under_star,
)
from airlight.physics.optics.droplet_layer import DropletLayer, no_layer

FloatArray = NDArray[np.float64]

#: Laws of reflection by name: modules with their kernels and ``largest_albedo``.
LAWS: Final[dict[str, Any]] = {
    "lambert": lambert,
    "lommel-seeliger": lommel_seeliger,
    "water": water,
    "hapke": hapke,
}


def law_number(name: str) -> int:
    """Index of a law in ``LAWS``.

    Parameters
    ----------
    name : str
        Name from ``LAWS``.
    """
    return list(LAWS).index(name)


#: Number of the law of water, which a pixel mixes with another.
WATER: Final = law_number("water")


class Reflection(NamedTuple):
    """Reflectance of the ground, as an argument of kernels.

    Attributes
    ----------
    albedo : array, shape (w,), or float
        Spherical albedo; wavelengths in the lanes, or a single one. [1]
    law : int
        Index of the law in ``LAWS``.
    wet : bool
        Whether some of the ground is water, by the law or by a map.
    wind : float
        Wind speed over water. [m s⁻¹]
    cover, cloud_optical_depth : float
        Mean cloud cover, and optical depth of the clouds. [1]
    regolith : Regolith
        Grains and roughness of Hapke's law.
    layer : DropletLayer
        Layer of that optical depth, at the wavelengths of the albedo, or of clouds that are only
        seen.
    """

    albedo: Annotated[Any, spectra(0)]
    law: Annotated[int, CHOICE] = 0
    wet: bool = False
    wind: float = 5.0
    cover: float = 0.0
    cloud_optical_depth: float = 0.0
    regolith: hapke.Regolith = hapke.MOON
    layer: DropletLayer = no_layer()

    def at(self, block: slice) -> Reflection:
        """The ground at some of its wavelengths."""
        return self._replace(albedo=self.albedo[block], layer=self.layer.at(block))


def largest_albedo(ground: Reflection) -> float:
    """Largest albedo with which a ground conserves energy, by its law and parameters. [1]

    Examples
    --------
    >>> round(largest_albedo(Reflection(1.0, law_number("lommel-seeliger"))), 3)
    0.409
    """
    return list(LAWS.values())[ground.law].largest_albedo(ground)  # type: ignore[no-any-return]


def mean_albedo(ground: Reflection) -> FloatArray:
    """Albedo under a uniform sky of a ground and its mean cover of clouds, shape (w,). [1]

    Parameters
    ----------
    ground : Reflection
        Ground at wavelengths.
    """
    albedo, back = np.asarray(ground.albedo, float), ground.layer.layer_albedo
    cloudy = back + (1.0 - back) ** 2 * albedo / (1.0 - back * albedo)
    return np.asarray(albedo + (cloudy - albedo) * ground.cover)


#: White ground by Lambert's law.
WHITE: Final = Reflection(1.0)
#: ``brdf_direct(law, ground, mu_s, mu_r, nu)``: diffuse (factor of the albedo) and specular parts
#: of π times the BRDF, by the law of that number in ``LAWS``.
brdf_direct = chosen_kernel("brdf_direct", [law.brdf_direct for law in LAWS.values()], __name__)
#: ``brdf_diffuse(law, ground, mu_r)``: the same under isotropic illumination.
brdf_diffuse = chosen_kernel("brdf_diffuse", [law.brdf_diffuse for law in LAWS.values()], __name__)


@inlined
def _spread(ground, albedo):
    """Reflectance factor for diffuse light that goes on diffusely. [1]"""
    diffuse, specular = brdf_diffuse(ground.law, ground, DIFFUSE_COSINE)
    return albedo * diffuse + specular


@inlined
def _sky_factor(ground, albedo, mu_r):
    """Reflectance factor of clear ground under a uniform sky. [1]"""
    diffuse, specular = brdf_diffuse(ground.law, ground, mu_r)
    return albedo * diffuse + specular


@inlined
def _under_clouds(ground, albedo, clear, reflected, light, mu_r):
    """Mean of clear ground and ground below the layer, in the star's light. [1]"""
    cloudy = under_star(
        light, reflected, clear, _sky_factor(ground, albedo, mu_r), _spread(ground, albedo)
    )
    return clear + (cloudy - clear) * ground.cover


@inlined
def _under_cloudy_sky(ground, albedo, clear, mu_r):
    """Mean of clear ground and ground below the layer, under a uniform sky. [1]"""
    light = layer_passage(1.0, mu_r, 1.0, 1.0, ground.layer)
    cloudy = under_sky(light, clear, _spread(ground, albedo))
    return clear + (cloudy - clear) * ground.cover


@inlined
def direct_reflectance(ground, at, mu_s, mu_r, nu):
    """Bidirectional reflectance factor of the ground, π times its BRDF, as lanes. [1]

    Parameters
    ----------
    at : int
        Index of the first lane.
    mu_s : float
        Cosine of the star's zenith angle at the ground. [1]
    mu_r : float
        Cosine of the zenith angle of reflection, towards the observer. [1]
    nu : float
        Cosine between the line of sight towards the ground and the direction to the star. [1]
    """
    diffuse, specular = brdf_direct(ground.law, ground, mu_s, mu_r, nu)
    albedo = load(ground.albedo, at)
    factor = albedo * np.float32(diffuse) + np.float32(specular)
    if ground.cover > 0.0:
        light = layer_passage(mu_s, mu_r, 1.0, 1.0, ground.layer)
        reflection = layer_reflectance(mu_s, mu_r, nu, ground.layer)
        reflected = reflected_lanes(reflection, ground.layer, at)
        factor = _under_clouds(ground, albedo, factor, reflected, light, mu_r)
    return factor


@inlined
def mean_direct_reflectance(ground, at, mu_s, mu_r, nu):
    """``direct_reflectance`` with clouds that reflect evenly in azimuth, for sweeps. [1]

    Parameters
    ----------
    at, mu_s, mu_r, nu :
        Arguments of ``direct_reflectance``.

    Returns
    -------
    lanes, or a float where ``ground`` is of one wavelength
    """
    diffuse, specular = brdf_direct(ground.law, ground, mu_s, mu_r, nu)
    albedo = load(ground.albedo, at)
    factor = albedo * np.float32(diffuse) + np.float32(specular)
    if ground.cover > 0.0:
        light = layer_passage(mu_s, mu_r, 1.0, 1.0, ground.layer)
        reflected = mean_reflected(light, ground.layer)
        factor = _under_clouds(ground, albedo, factor, reflected, light, mu_r)
    return factor


@inlined
def diffuse_reflectance(ground, at, mu_r):
    """Hemispherical-directional reflectance factor of the ground, for isotropic illumination. [1]

    By reciprocity it is also the directional albedo, for a beam from the direction ``mu_r``.

    Parameters
    ----------
    at : int
        Index of the first lane.
    mu_r : float
        Cosine of the zenith angle of the reflected light, towards the observer. [1]

    Returns
    -------
    lanes, or a float where ``ground`` is of one wavelength
    """
    diffuse, specular = brdf_diffuse(ground.law, ground, mu_r)
    albedo = load(ground.albedo, at)
    factor = albedo * np.float32(diffuse) + np.float32(specular)
    if ground.cover > 0.0:
        factor = _under_cloudy_sky(ground, albedo, factor, mu_r)
    return factor


@inlined
def cos_reflected(r, mu, bottom):
    """Cosine of the zenith angle of reflection at the ground end of a straight line. [1]

    Parameters
    ----------
    r, mu : float
        Radius of the start of the line [m], and its zenith cosine there, towards the ground [1].
    bottom : float
        Radius of the ground. [m]
    """
    sine = r / bottom * sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
    return sqrt(max((1.0 - sine) * (1.0 + sine), 0.0))


@inlined
def direct_reflectance_at(ground, l, mu_s, mu_r, nu):
    """``direct_reflectance`` at wavelength l, in double precision. [1]"""
    diffuse, specular = brdf_direct(ground.law, ground, mu_s, mu_r, nu)
    albedo = ground.albedo[l]
    factor = diffuse * albedo + specular
    if ground.cover > 0.0:
        light = layer_passage(mu_s, mu_r, 1.0, 1.0, ground.layer)
        reflection = layer_reflectance(mu_s, mu_r, nu, ground.layer)
        reflected = reflected_at(reflection, ground.layer, l)
        factor = _under_clouds(ground, albedo, factor, reflected, light, mu_r)
    return factor


@inlined
def diffuse_reflectance_at(ground, l, mu_r):
    """``diffuse_reflectance`` at wavelength l, in double precision. [1]"""
    diffuse, specular = brdf_diffuse(ground.law, ground, mu_r)
    albedo = ground.albedo[l]
    factor = diffuse * albedo + specular
    if ground.cover > 0.0:
        factor = _under_cloudy_sky(ground, albedo, factor, mu_r)
    return factor


@compiled_loop
def direct_reflectances(ground, mu_s, mu_r, nu, out):
    """``direct_reflectance`` of n lines at all wavelengths, to ``out``, shape (n, nl). [1]"""
    for k in range(mu_s.size):
        for l in range(out.shape[1]):
            out[k, l] = direct_reflectance_at(ground, l, mu_s[k], mu_r[k], nu[k])


@compiled_loop
def diffuse_reflectances(ground, mu_r, out):
    """``diffuse_reflectance`` of n lines at all wavelengths, to ``out``, shape (n, nl). [1]"""
    for k in range(mu_r.size):
        for l in range(out.shape[1]):
            out[k, l] = diffuse_reflectance_at(ground, l, mu_r[k])
