"""Where do Saturn's rings cast their shadow?

On the winter side: the sun stands 20° north of the rings' plane, so their shadow falls on the
south, with bright lines where the rings have gaps. The planet's shadow cuts the rings behind it.
Rings are of known optical depth at each radius, and each point of the air asks how much of the sun
they hide.
"""

import airlight
from airlight.image.spectral import default_wavelengths

saturn = airlight.load_planet("saturn")
solution = airlight.solve(saturn, default_wavelengths(8), quality="preview")
camera = airlight.Camera(width=480, height=240, field_of_view=62.0, look_zenith=180.0, roll=-90.0)
scene = airlight.Scene(
    altitude=6.0 * saturn.bottom_radius,
    latitude=-12.0,
    sun_zenith=50.0,
    sun_azimuth=50.0,
    camera=camera,
)
frame = airlight.render(solution, scene)
airlight.write_picture("ring_shadow.png", frame.rgb, frame.metadata)
