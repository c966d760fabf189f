"""What does the Earth look like by night from orbit?

Towns along the Nile and its delta from 400 km, under a layer of airglow at 90 to 95 km: oxygen
and sodium that shine by themselves, all night. Light of towns, airglow and the air between are as
bright as measured; the exposure is long, and an eye sees no such colours.
"""

import airlight
from airlight.image.spectral import default_wavelengths

earth = airlight.load_planet("earth")
solution = airlight.solve(earth, default_wavelengths(8), quality="preview")
camera = airlight.Camera(
    width=480, height=240, field_of_view=50.0, look_zenith=112.0, look_azimuth=180.0
)
scene = airlight.Scene(
    altitude=400e3,
    latitude=22.0,
    longitude=31.0,
    sun_zenith=120.0,
    ground="detailed",
    camera=camera,
)
frame = airlight.render(solution, scene)
airlight.write_picture("city_lights.png", frame.rgb, frame.metadata, eye=False)
