"""What would the sky be like under a red dwarf, with two bars of nitrogen and methane?

A planet is a text file. This one is made of bulk parameters only: a gas by its composition, a
star by its temperature, radius and distance. Scale height, scattering coefficients, the star's
spectrum and its size in the sky follow. Even thick air that scatters blue looks orange here:
there is hardly any blue light to scatter.
"""

from pathlib import Path

import airlight
from airlight.image.spectral import default_wavelengths

Path("own.toml").write_text(
    """
name = "A planet of a red dwarf"
[shell]
bottom_radius = "7000 km"
top_radius = "7110 km"
[ground]
albedo = 0.2
[star]
temperature = "3000 K"
radius = "140000 km"
distance = "0.05 au"
[[constituents]]
name = "air"
[constituents.gas]
composition = { N2 = 0.95, CH4 = 0.05 }
temperature = "270 K"
pressure = "2 bar"
gravity = "9 m/s^2"
""",
    encoding="utf-8",
)
planet = airlight.load_planet("own.toml")
wavelengths = default_wavelengths(8, *planet.wavelength_limits)
solution = airlight.solve(planet, wavelengths, quality="preview")
scene = airlight.Scene(
    sun_zenith=82.0,
    camera=airlight.Camera(width=480, height=240, field_of_view=80.0, look_zenith=75.0),
)
frame = airlight.render(solution, scene)
airlight.write_picture("own_planet.png", frame.rgb, frame.metadata)
