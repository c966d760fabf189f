"""What is the dark band that rises opposite the setting sun?

It is the shadow of the Earth, cast on the air. Above it stands the Belt of Venus, pink: air that
the reddened sun still lights, seen against it. The camera looks away from the sun, which is 1.5°
below the horizon. No shadow was painted: each point on each line of sight asks how much of the
sun's disc it sees.
"""

import airlight
from airlight.image.spectral import default_wavelengths

earth = airlight.load_planet("earth")
solution = airlight.solve(earth, default_wavelengths(8), quality="preview")
scene = airlight.Scene(
    altitude=2.0,
    sun_zenith=91.5,
    camera=airlight.Camera(
        width=480, height=240, field_of_view=80.0, look_zenith=80.0, look_azimuth=180.0
    ),
)
frame = airlight.render(solution, scene)
airlight.write_picture("belt_of_venus.png", frame.rgb, frame.metadata)
