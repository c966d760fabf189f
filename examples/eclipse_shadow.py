"""What does a total eclipse look like from space?

A brown stain, 250 km dark and 6000 km dim, that crosses the Earth in three hours: the shadow of the
Moon over Spain on 12 August 2026. Every pixel of ground, cloud and air gets what the Moon leaves of
the sun's disc there.
"""

import airlight
from airlight.image.spectral import default_wavelengths

earth = airlight.load_planet("earth")
solution = airlight.solve(earth, default_wavelengths(8), quality="preview")
camera = airlight.Camera(width=480, height=240, field_of_view=70.0, look_zenith=180.0)
scene = airlight.Scene.at(
    earth, latitude=45.0, longitude=-10.0, time="2026-08-12T18:20Z", altitude=5000e3, camera=camera
)
frame = airlight.render(solution, scene)
airlight.write_picture("eclipse_shadow.png", frame.rgb, frame.metadata)
