"""Is the blue hour blue because of scattering, or because of ozone?

Because of ozone, mostly. With the sun 5° below the horizon its light reaches us through the long
slant paths of the stratosphere, where ozone takes out the orange (its Chappuis band). Left is the
sky as it is, right the same sky without ozone: two domes, the zenith in the middle, the sun
below.
"""

import numpy as np

import airlight
from airlight.image.spectral import default_wavelengths

camera = airlight.Camera(projection="fisheye", width=240, height=240)
scene = airlight.Scene(sun_zenith=95.0, camera=camera)

domes = []
for overrides in ({}, {"ozone.absorption.ozone": "0 DU"}):
    earth = airlight.load_planet("earth", overrides)
    solution = airlight.solve(earth, default_wavelengths(12), quality="preview")
    domes.append(airlight.render(solution, scene).rgb)

airlight.write_picture("ozone.png", np.concatenate(domes, axis=1))
