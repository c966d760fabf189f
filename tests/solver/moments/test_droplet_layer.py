"""The flat layer of droplets against a real one, solved in the air of a planet."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose

from airlight import load_planet, solve
from airlight.clouds.cloud_optics import REFERENCE, droplets
from airlight.physics.optics.droplet_layer import droplet_layer
from airlight.physics.optics.reflection import Reflection, direct_reflectances
from airlight.planets.constituent import Constituent
from airlight.planets.matter.profiles import Layer, Layered
from airlight.planets.parameters import replace as changed


def test_the_moments_solver_sees_the_same_layer() -> None:
    # A second method: spherical air with nothing but droplets of 10 µm, optical depth 10, in
    # 200 m above black ground. Away from the horizon it is flat; the solver's own aim is 1 %, its
    # forward peak is cut at another degree.
    depth = 10.0
    matter = replace(
        droplets(10e-6, 1.0 / 9.0), number_density=None, optical_depth=depth, at=REFERENCE
    )
    profile = Layered(layers=(Layer(width=200.0, constant_term=1.0), Layer()))
    planet = load_planet("earth-atmosphere-plus", {"ground.albedo": 0.0})
    cloud = Constituent(name="droplets", matter=matter, profile=profile)
    planet = changed(planet, constituents=(cloud,))
    solution = solve(planet, [550.0], "default", cache=False)
    star = solution.medium.solar_irradiance[0]
    layer = Reflection(np.zeros(1), cover=1.0, layer=droplet_layer(depth, np.array([550.0])))
    for sun in (20.0, 60.0):
        mu_s = np.cos(np.radians(sun))
        for azimuth in (0.0, 90.0, 150.0):
            view = np.array([5.0, 30.0, 50.0, 65.0])
            seen = solution.radiance(
                altitude=30e3, sun_zenith=sun, view_zenith=180.0 - view, azimuth=azimuth
            )
            found = np.asarray(seen).reshape(-1) * np.pi / (star * mu_s)
            mu_r = np.cos(np.radians(view))
            nu = -mu_s * mu_r + np.sin(np.radians(sun)) * np.sin(np.radians(view)) * np.cos(
                np.radians(azimuth)
            )
            out = np.empty((view.size, 1))
            direct_reflectances(layer, np.full(view.size, mu_s), mu_r, nu, out)
            assert_allclose(found, out[:, 0], rtol=0.02)
