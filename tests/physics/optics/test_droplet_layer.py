"""Layer of droplets: energy, reciprocity, limits, published values and a second method."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.physics.optics.droplet_layer import (
    LEAST_COSINE,
    STREAMS,
    doubled,
    droplet_layer,
    droplet_moments,
)
from airlight.physics.optics.reflection import Reflection, diffuse_reflectances, direct_reflectances

GREEN = np.array([550.0])
COSINES, WIDTHS = np.polynomial.legendre.leggauss(24)
COSINES, WIDTHS = 0.5 * (COSINES + 1.0), 0.5 * WIDTHS
AZIMUTHS = np.pi * (np.arange(48) + 0.5) / 48.0


def scattering_cosine(mu_s, mu_r, azimuth):
    """Cosine between the line of sight and the direction to the star; azimuth 0 is forward."""
    level = np.sqrt((1.0 - mu_s**2) * (1.0 - mu_r**2))
    return -mu_s * mu_r + level * np.cos(azimuth)


def reflected(optical_depth, mu_s, mu_r, azimuth, albedo=0.0, wavelengths=GREEN):
    """Reflectance factor of full cover over Lambert ground, shape of the arguments and (w,)."""
    layer = droplet_layer(optical_depth, wavelengths)
    ground = Reflection(np.full(wavelengths.size, albedo), cover=1.0, layer=layer)
    mu_s, mu_r, azimuth = np.broadcast_arrays(mu_s, mu_r, azimuth)
    nu = scattering_cosine(mu_s, mu_r, azimuth)
    out = np.empty((nu.size, wavelengths.size))
    direct_reflectances(ground, *(np.ravel(x).copy() for x in (mu_s, mu_r, nu)), out)
    return out.reshape(*nu.shape, wavelengths.size)


def plane_albedos(optical_depth, mu_s, albedo=0.0):
    """Plane albedo of full cover over Lambert ground, by reciprocity. [1]"""
    layer = droplet_layer(optical_depth, GREEN)
    ground = Reflection(np.array([albedo]), cover=1.0, layer=layer)
    out = np.empty((np.size(mu_s), 1))
    diffuse_reflectances(ground, np.array(mu_s, float), out)
    return out[:, 0]


@pytest.mark.parametrize("optical_depth", [0.3, 10.0, 300.0])
def test_what_is_not_reflected_is_let_through(optical_depth):
    # Conservation: nothing is absorbed. Doubling begins with a layer of depth 1e-9, which scatters
    # once; what it loses so grows with the number of scatterings.
    found = doubled(optical_depth, droplet_moments(), np.array([0.05, 1.0]))
    total = found.weights @ (found.reflected[0] + found.transmitted[0])
    total += np.exp(-found.depth / found.cosines)
    assert_allclose(total, 1.0, atol=2e-6)


@pytest.mark.parametrize("optical_depth", [1.0, 14.0, 200.0])
def test_the_reflectance_factor_has_the_plane_albedo(optical_depth):
    # The definition, ∫ R μ dμ dφ/π, by a rule of its own: of azimuths and cosines between the
    # nodes, with glory and cloudbow of single scattering.
    for mu_s in (0.15, 0.5, 1.0):
        factor = reflected(optical_depth, mu_s, COSINES[:, None], AZIMUTHS)[..., 0].mean(axis=1)
        assert_allclose(2.0 * (WIDTHS * COSINES) @ factor, plane_albedos(optical_depth, [mu_s])[0],
                        rtol=1.5e-2 if optical_depth < 2.0 else 4e-3)  # fmt: skip


def test_light_takes_the_same_way_back():
    # Helmholtz: the tables are symmetric, and so is the light of the ground below.
    rng = np.random.default_rng(3)
    star, view = rng.uniform(0.02, 1.0, (2, 200))
    azimuth = rng.uniform(0.0, np.pi, 200)
    for albedo in (0.0, 0.3):
        there, back = (
            reflected(8.0, *pair, azimuth, albedo) for pair in ((star, view), (view, star))
        )
        assert_allclose(there, back, rtol=1e-9)


def test_a_white_ground_below_reflects_all_light():
    # Conservation with the geometric series of light between ground and cloud.
    assert_allclose(plane_albedos(7.0, COSINES, albedo=1.0), 1.0, rtol=1e-9)
    assert_allclose(plane_albedos(7.0, [0.3], albedo=0.5) < 1.0, True)


def test_no_droplets_change_nothing():
    # The limit of optical depth 0: the ground itself, whatever its law; of thin layers linear in
    # the depth.
    ground = Reflection(np.array([0.2]), law=1, cover=1.0, layer=droplet_layer(0.0, GREEN))
    clear = ground._replace(cover=0.0)
    arrays = [np.array([x]) for x in (0.4, 0.7, 0.1)]
    found = np.empty((2, 1, 1))
    direct_reflectances(ground, *arrays, found[0])
    direct_reflectances(clear, *arrays, found[1])
    assert_allclose(found[0], found[1], rtol=1e-12)
    diffuse_reflectances(ground, arrays[1], found[0])
    diffuse_reflectances(clear, arrays[1], found[1])
    assert_allclose(found[0], found[1], rtol=1e-12)
    thin = [reflected(x, 0.5, 0.6, 2.0)[0] for x in (1e-4, 2e-4)]
    assert_allclose(thin[1] / thin[0], 2.0, rtol=1e-3)


def test_thin_layers_scatter_once():
    # Exact limit: π p(Θ) τ/(μ_s μ_r) of the unscaled depth, since what
    # delta-M leaves out is in the gain. The droplets' phase function at 90°, by Mie theory.
    depth, azimuth = 1e-3, np.radians(120.0)
    layer = droplet_layer(depth, GREEN)
    mu = np.sqrt(0.5)
    angle = np.degrees(np.arccos(scattering_cosine(mu, mu, azimuth)))
    phase = np.interp(
        angle, np.linspace(0.0, 180.0, len(layer.layer_phase)), layer.layer_phase[:, 0]
    )
    found = float(reflected(depth, mu, mu, azimuth)[0])
    assert_allclose(found, np.pi * phase * depth / mu**2, rtol=1e-2)


def test_thick_layers_reflect_as_asymptotic_theory_says():
    # van de Hulst (1980), Multiple Light Scattering, table 14; King (1987), J. Atmos. Sci. 44,
    # 1734: the spherical albedo of a conservative layer goes to 1 as 1 - 1/(0.75 (1 - g) τ + 1.07).
    g = droplet_moments()[1]
    for optical_depth in (30.0, 100.0, 1000.0):
        passes = 1.0 - droplet_layer(optical_depth, GREEN).layer_albedo
        assert_allclose(passes, 1.0 / (0.75 * (1.0 - g) * optical_depth + 1.07), rtol=2e-3)


def test_isotropic_scattering_is_chandrasekhars():
    # Chandrasekhar (1950), Radiative Transfer, table XI: H of conservative isotropic scattering;
    # R = H H/(4 (μ + μ')) of an infinitely deep layer; of depth 1e5 it is 1.3e-5 less.
    published = {0.1: 1.24735, 0.5: 2.01278, 1.0: 2.90781}
    moments = np.zeros(2 * STREAMS + 1)
    moments[0] = 1.0
    nodes = np.array(list(published))
    found = doubled(1e5, moments, nodes, modes=1).reflected[0, STREAMS:, STREAMS:]
    h = np.array(list(published.values()))
    expected = h[:, None] * h / (4.0 * (nodes[:, None] + nodes))
    assert_allclose(found, expected, rtol=2e-4)


@pytest.mark.parametrize("optical_depth", [2.0, 10.0, 50.0])
def test_discrete_ordinates_agree(optical_depth):
    # A second method, PythonicDISORT with 64 streams, whose truncated single scattering is replaced
    # by the exact one. At more than 3° above the layer; the bound is twice what was found.
    disort = pytest.importorskip("PythonicDISORT")
    streams, moments = 64, droplet_moments()
    peak = moments[streams]
    table = droplet_layer(1.0, GREEN).layer_phase[:, 0]
    azimuth = np.linspace(0.0, np.pi, 19)
    for mu_s in (0.2, 0.5, 0.9):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of albedos near 1
            mu, up, _, _, radiance = disort.pydisort(
                np.array([optical_depth]), np.array([1.0 - 1e-9]), streams, moments[None], mu_s,
                1.0, 0.0, NLeg=streams, NFourier=streams, f_arr=np.array([peak]),
            )[:5]  # fmt: skip
            total = np.pi * radiance(0.0, azimuth)[: streams // 2] / mu_s
        view = mu[: streams // 2, None]
        nu = scattering_cosine(mu_s, view, azimuth)
        scaled = (moments[:streams] - peak) / (1.0 - peak)
        series = (2.0 * np.arange(streams) + 1.0) * scaled / (4.0 * np.pi)
        cut = np.polynomial.legendre.legval(nu, series)
        exact = np.interp(np.degrees(np.arccos(nu)), np.linspace(0.0, 180.0, table.size), table)
        slant = (1.0 - peak) * optical_depth * (1.0 / view + 1.0 / mu_s)
        total += np.pi * (exact / (1.0 - peak) - cut) / (view + mu_s) * -np.expm1(-slant)
        off = (reflected(optical_depth, mu_s, view, azimuth)[..., 0] / total - 1.0)[
            view[:, 0] > 0.05
        ]
        assert np.sqrt(np.mean(off**2)) < (0.018 if optical_depth < 5.0 else 0.007)
        assert np.abs(off).max() < 0.08
        assert_allclose(plane_albedos(optical_depth, [mu_s]), up(0.0) / mu_s, rtol=4e-3)


def test_glory_and_cloudbow_are_at_their_angles_and_in_colour():
    # Geometric optics: the primary bow of water, seen by droplets as a white arc near 141°, is
    # dark inside, at 120°; rings of the glory have radii in proportion to the wavelength.
    angles = np.linspace(100.0, 180.0, 321)
    phase = droplet_layer(5.0, np.array([440.0, 660.0])).layer_phase[400:]
    bow = slice(120, 200)  # 130° to 150°
    assert 138.0 < angles[bow][phase[bow, 1].argmax()] < 145.0
    assert phase[:, 1][angles == 142.0] > 2.0 * phase[:, 1][angles == 120.0]
    glory = angles > 176.0
    rings = []
    for column in phase[glory].T:
        peaks = np.nonzero((column[1:-1] > column[:-2]) & (column[1:-1] > column[2:]))[0] + 1
        rings.append(180.0 - angles[glory][peaks].max())
    assert_allclose(rings[1] / rings[0], 660.0 / 440.0, rtol=0.2)


def test_a_level_sun_is_that_of_the_least_cosine():
    layers = [reflected(10.0, mu_s, 0.3, 1.0) for mu_s in (0.0, LEAST_COSINE)]
    assert_allclose(layers[0], layers[1], rtol=2e-2)


@pytest.mark.parametrize("optical_depth", [-1.0, np.nan, 1e4])
def test_impossible_depths_are_refused(optical_depth):
    with pytest.raises(ParameterError, match="optical_depth"):
        droplet_layer(optical_depth, GREEN)
