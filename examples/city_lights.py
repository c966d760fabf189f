"""What does the Earth look like by night from orbit?

Towns along the Nile and its delta from 400 km, under the green layer of airglow at 95 km: oxygen
that shines by itself, all night, everywhere. The sun is 30° below the horizon. Airglow, lights of
towns and the air between have their measured brightness; only the exposure is long, and the camera sees colours where eyes do not.
"""

import airlight
from airlight.image.spectral import default_wavelengths

earth = airlight.load_planet("earth")
solution = airlight.solve(earth, default_wavelengths(8), quality="preview")
camera = airlight.Camera(
    width=480, height=240, field_of_view=50.0, look_zenith=112.0, look_azimuth=165.0
)
scene = airlight.Scene(
    altitude=400e3,
    latitude=22.0,
    longitude=31.0,
    sun_zenith=120.0,
    sun_azimuth=195.0,
    ground="detailed",
    camera=camera,
)
frame = airlight.render(solution, scene)
airlight.write_picture("city_lights.png", frame.rgb, frame.metadata, eye=False)
