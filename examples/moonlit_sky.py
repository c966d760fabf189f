"""Is the sky blue by moonlight?

Yes, as by day: the full Moon's light is the sun's, 400 000 times darker and a little redder. Left by
day, right by night with the Moon where the sun was, both exposed alike for a camera; an eye sees no
colours at such light, and the picture would be grey.
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
