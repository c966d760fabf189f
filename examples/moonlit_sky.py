"""Is the sky blue by moonlight?

Yes, a little paler: moonlight is sunlight, 400 000 times darker and redder, as the Moon's ground
is. Left by day, right by night with the full Moon where the sun was, each exposed for a camera. An
eye sees no colours by so little light.
"""

import numpy as np

import airlight
from airlight.image.spectral import default_wavelengths

earth = airlight.load_planet("earth", {"airglow": "none"})
solution = airlight.solve(earth, default_wavelengths(8), quality="preview")
camera = airlight.Camera(projection="fisheye", width=240, height=240)
moon = airlight.MoonLight(zenith=60.0, azimuth=0.0, phase=2.0)
day = airlight.Scene(sun_zenith=60.0, camera=camera)
night = airlight.Scene(sun_zenith=150.0, secondary_lights=(moon,), camera=camera)
domes = [airlight.render(solution, scene).rgb for scene in (day, night)]
domes = [dome / np.median(dome[dome > 0.0]) for dome in domes]
airlight.write_picture("moonlit_sky.png", np.concatenate(domes, axis=1))
