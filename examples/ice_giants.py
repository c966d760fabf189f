"""Why are Uranus and Neptune not of the same blue?

Both are blue since methane takes the red out of sunlight on its way through clear gas. Uranus,
left, has more haze above its methane clouds, which reflects all colours and pales the blue. Both
from six radii, each as bright as its sunlight makes it, times 2.5 for Neptune's, which is weaker.
"""

import numpy as np

import airlight
from airlight.image.spectral import default_wavelengths

halves = []
for name, gain in (("uranus", 1.0), ("neptune", 2.5)):
    planet = airlight.load_planet(name)
    solution = airlight.solve(planet, default_wavelengths(16), quality="preview")
    camera = airlight.Camera(width=240, height=240, field_of_view=20.0, look_zenith=180.0)
    scene = airlight.Scene(altitude=6.0 * planet.bottom_radius, sun_zenith=40.0, camera=camera)
    halves.append(gain * airlight.render(solution, scene).rgb)
airlight.write_picture("ice_giants.png", np.concatenate(halves, axis=1))
