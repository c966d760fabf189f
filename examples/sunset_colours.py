"""Why does the sky turn red when the sun goes down?

The lower the sun, the longer the way of its light through the air, and the air scatters blue
light out of that way first. Here are four strips of the same sky, looking to the sun, from 15°
above the horizon to 1.5° below it. Each is exposed for itself, so colours can be compared and
brightness cannot. Overhead the sky stays blue even then: that is ozone's work.
"""

import numpy as np

import airlight
from airlight.image.exposure import automatic_exposure
from airlight.image.spectral import default_wavelengths

earth = airlight.load_planet("earth")
solution = airlight.solve(earth, default_wavelengths(8), quality="preview")
camera = airlight.Camera(width=480, height=90, field_of_view=100.0, look_zenith=83.0)

strips = []
for sun_zenith in (75.0, 84.0, 89.0, 91.5):
    scene = airlight.Scene(altitude=2.0, sun_zenith=sun_zenith, camera=camera)
    rgb = airlight.render(solution, scene).rgb
    strips.append(rgb * 2.0 ** automatic_exposure(rgb))

airlight.write_picture("sunset_colours.png", np.concatenate(strips), exposure=0.0)
