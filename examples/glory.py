"""What is the coloured ring around an aeroplane's shadow on a cloud?

The glory: droplets send light back into rings, the smaller the droplets the wider. Left a fog of 5
µm, right one of 10 µm, both thin, seen straight down from 2 km with the sun overhead, 14° across.
Phase functions are by Mie theory, of droplets of nearly one size; there is no aeroplane.
"""

import numpy as np

import airlight
from airlight.image.spectral import default_wavelengths

halves = []
for radius in ("5 um", "10 um"):
    sizes = {"kind": "gamma", "effective_radius": radius, "effective_variance": 0.02}
    drops = {"index": "water", "optical_depth": 0.3, "sizes": sizes}
    profile = {"kind": "exponential", "scale_height": "300 m"}
    fog = {"constituents": [{"name": "fog", "profile": profile, "particles": drops}]}
    earth = airlight.load_planet("earth", {**fog, "ground": {"albedo": 0.0}, "refraction": "none"})
    solution = airlight.solve(earth, default_wavelengths(16), quality="preview")
    camera = airlight.Camera(width=240, height=240, field_of_view=14.0, look_zenith=180.0)
    frame = airlight.render(solution, airlight.Scene(altitude=2e3, sun_zenith=0.1, camera=camera))
    halves.append(frame.rgb / frame.rgb.mean())
airlight.write_picture("glory.png", np.concatenate(halves, axis=1))
