"""How does the Martian sky change from clear air to a dust storm?

Three domes with the zenith in the middle, the sun 40° from it, by one exposure: dust of optical
depth 0.05, 0.5 (a clear season) and 3 (a storm). Any key of a planet's file can be changed as it
is read, with all its checks; the file stays as it is.
"""

import numpy as np

import airlight
from airlight.image.spectral import default_wavelengths

scene = airlight.Scene(
    sun_zenith=40.0, camera=airlight.Camera(projection="fisheye", width=160, height=160)
)
domes = []
for depth in (0.05, 0.5, 3.0):
    mars = airlight.load_planet("mars-standard", {"dust.optical_depth": depth})
    solution = airlight.solve(mars, default_wavelengths(8), quality="preview")
    domes.append(airlight.render(solution, scene).rgb)

airlight.write_picture("dust.png", np.concatenate(domes, axis=1))
