"""How thick does the air look from orbit?

Very thin: from 400 km the light of the limb has fallen to a tenth 1° above the ground, which is
40 km up. The picture looks along the limb with a field of view of 8°, the sun stands 60° to the
left, 8° above the observer's horizontal. The layers are no textures: brightness follows the
columns of air and ozone.
"""

import airlight
from airlight.image.spectral import default_wavelengths

earth = airlight.load_planet("earth")
solution = airlight.solve(earth, default_wavelengths(8), quality="preview")
altitude = 400e3
horizon, _ = airlight.look_at(
    "horizon", altitude=altitude, sun_zenith=82.0, bottom_radius=earth.bottom_radius
)
scene = airlight.Scene(
    altitude=altitude,
    sun_zenith=82.0,
    camera=airlight.Camera(
        width=480, height=240, field_of_view=8.0, look_zenith=horizon - 0.8, look_azimuth=60.0
    ),
)
frame = airlight.render(solution, scene)
airlight.write_picture("limb_from_orbit.png", frame.rgb, frame.metadata)
