"""What do Earth and Mars look like side by side?

Both from six radii above the ground with the sun 50° from the zenith, both by the same exposure:
Mars gets 43 % of the Earth's sunlight. The blue rim is the Earth's air; the Martian one is dust.
"""

import numpy as np

import airlight
from airlight.image.spectral import default_wavelengths

halves = []
for name in ("earth", "mars-standard"):
    planet = airlight.load_planet(name)
    solution = airlight.solve(planet, default_wavelengths(8), quality="preview")
    camera = airlight.Camera(width=240, height=240, field_of_view=20.0, look_zenith=180.0)
    scene = airlight.Scene(
        altitude=6.0 * planet.bottom_radius, sun_zenith=50.0, sun_azimuth=20.0, camera=camera
    )
    halves.append(airlight.render(solution, scene).rgb)

airlight.write_picture("two_planets.png", np.concatenate(halves, axis=1))
