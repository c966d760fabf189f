"""How do I show a sky in a planetarium's dome?

As a dome master: a round picture in which the distance from the middle is the angle from the
zenith, and the camera's azimuth is at the bottom. This is the evening sky from 3000 m. As an EXR
the same frame keeps its radiances for the dome's own tone mapping.
"""

import airlight
from airlight.image.spectral import default_wavelengths

earth = airlight.load_planet("earth")
solution = airlight.solve(earth, default_wavelengths(8), quality="preview")
camera = airlight.Camera(projection="fisheye", width=320, height=320)
scene = airlight.Scene(altitude=3000.0, sun_zenith=84.0, camera=camera)
frame = airlight.render(solution, scene)

airlight.write_picture("dome_master.exr", frame.rgb, frame.metadata)
airlight.write_picture("dome_master.png", frame.rgb, frame.metadata)
