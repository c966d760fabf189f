"""Light of clouds while the sun sets."""

import numpy as np

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics, droplets
from airlight.planets import load_planet
from airlight.render.clouds.cloud_deck import CloudDeck
from airlight.render.clouds.cloud_light import solve_clouds
from airlight.render.clouds.incident_light import OtherClouds
from airlight.scene import Scene
from airlight.solver.solve import solve


def test_light_of_clouds_falls_without_a_jump_while_the_sun_sets():
    """Lights are those between suns 0.25° higher and lower, within 5 % (chosen after 3.6 %)."""
    cells = np.random.default_rng(4).random((6, 6, 8)).astype(np.float32)
    field = CloudField(
        extinction=np.where(cells > 0.6, 0.02 * cells, 0.0).astype(np.float32),
        spacing=(200.0, 200.0, 100.0),
        base=1000.0,
        beyond="periodic",
    )
    deck = CloudDeck(field, lambda nm: CloudOptics.of_particles(droplets(1e-5, 0.1), nm))
    earth = load_planet("earth-atmosphere-plus")
    nm = np.array([450.0, 550.0, 650.0])
    solution = solve(earth, nm, quality="preview", polarisation=False)
    found = []
    for zenith in np.arange(89.0, 91.01, 0.25):
        scene = Scene(sun_zenith=float(zenith))
        box = solve_clouds(solution, scene, deck, OtherClouds(), cache=False).box
        found.append([box.up.mean((0, 1)), box.moments[..., 0, :].mean((0, 1, 2))])
    light = np.log(np.array(found))
    off = light[1:-1] - 0.5 * (light[2:] + light[:-2])
    np.testing.assert_allclose(off, 0.0, atol=0.05)
    assert np.all(np.diff(light, axis=0) < 0.0)
