"""Why is the sunset blue on Mars?

Its dust grains are a few wavelengths across. They scatter blue light into a narrower cone around
the sun than red light, and absorb it elsewhere, so that only near the sun blue wins. Nothing here
is painted: the coefficients and lobes of this preset are those of exact Mie theory for 1.6 µm
grains, and the preset `mars` computes them from size and refractive index each time.
"""

import airlight
from airlight.image.spectral import default_wavelengths

mars = airlight.load_planet("mars-standard")
solution = airlight.solve(mars, default_wavelengths(8), quality="preview")
scene = airlight.Scene(
    altitude=2.0,
    sun_zenith=87.0,
    camera=airlight.Camera(width=480, height=240, field_of_view=70.0, look_zenith=82.0),
)
frame = airlight.render(solution, scene)
airlight.write_picture("mars_sunset.png", frame.rgb, frame.metadata)
