"""Why is Titan a ring when the sun is behind it?

Its haze reaches 500 km up and scatters forwards: from the night side, with the sun hidden behind
the disc, all of the limb shines, orange below and blue-grey in the thin haze above. An airless
moon would be a thin crescent, or nothing. The camera is eight radii away, the sun 165° from its
zenith.
"""

import airlight
from airlight.image.spectral import default_wavelengths

titan = airlight.load_planet("titan")
solution = airlight.solve(titan, default_wavelengths(8), quality="preview")
camera = airlight.Camera(width=480, height=240, field_of_view=36.0, look_zenith=180.0)
scene = airlight.Scene(altitude=8.0 * titan.bottom_radius, sun_zenith=165.0, camera=camera)
frame = airlight.render(solution, scene)
airlight.write_picture("titan_backlight.png", frame.rgb, frame.metadata)
