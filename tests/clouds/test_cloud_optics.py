"""Optical properties of cloud droplets."""

import numpy as np

from airlight.clouds.cloud_optics import CloudOptics
from airlight.planets.matter.particle_index import TableIndex
from airlight.planets.matter.particle_sizes import GammaSizes
from airlight.planets.matter.particles import Particles


def test_droplets_extinguish_two_cross_sections_and_absorb_little():
    droplets = Particles(
        index=TableIndex(table="water"),
        sizes=GammaSizes(effective_radius=10e-6, effective_variance=0.1),
        number_density=1.0,
    )
    optics = CloudOptics.of_particles(droplets, [440.0, 550.0, 680.0])
    np.testing.assert_allclose(optics.extinction, 1.0, atol=0.02)
    assert np.all(optics.albedo > 0.9999)
    np.testing.assert_allclose(optics.phase.moments(optics.wavelengths, 1)[:, 1], 0.86, atol=0.01)
