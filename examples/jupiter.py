"""Why do Jupiter's belts fade towards the edge of its disc?

Towards the limb a line of sight ends higher, in haze and gas above the ammonia cloud that the
belts are in. Their pattern is Cassini's map; the darkening towards limb and terminator follows
from cloud, haze, methane and hydrogen. A day of ten hours flattens the real disc, which is left
out here.
"""

import airlight
from airlight.image.spectral import default_wavelengths

jupiter = airlight.load_planet("jupiter")
solution = airlight.solve(jupiter, default_wavelengths(8), quality="preview")
camera = airlight.Camera(width=480, height=240, field_of_view=36.0, look_zenith=180.0, roll=-90.0)
scene = airlight.Scene(
    altitude=6.0 * jupiter.bottom_radius,
    latitude=-10.0,
    longitude=-60.0,
    sun_zenith=45.0,
    sun_azimuth=90.0,
    camera=camera,
)
frame = airlight.render(solution, scene)
airlight.write_picture("jupiter.png", frame.rgb, frame.metadata)
