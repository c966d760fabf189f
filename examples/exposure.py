"""Which exposure and which tone map suit a sunset?

A frame holds radiances over many decades; a screen shows two or three. Exposure says which
decades, in stops from row to row here. The tone map says how the rest is squeezed, from left to
right: natural, which is the default, Hable, ACES and AgX. Change them as often as you like: the
frame stays, only its display is made again.
"""

import numpy as np
from PIL import Image

import airlight
from airlight.image.display import to_display
from airlight.image.spectral import default_wavelengths

earth = airlight.load_planet("earth")
solution = airlight.solve(earth, default_wavelengths(8), quality="preview")
camera = airlight.Camera(width=120, height=80, field_of_view=60.0, look_zenith=84.0)
scene = airlight.Scene(altitude=2.0, sun_zenith=86.0, camera=camera)
rgb = airlight.render(solution, scene).rgb

tone_maps = ("natural", "hable", "aces", "agx")
rows = []
for exposure in (-6.0, -4.0, -2.0):
    shown = [to_display(rgb, exposure, tone_map) for tone_map in tone_maps]
    rows.append(np.concatenate(shown, axis=1))
Image.fromarray(np.concatenate(rows)).save("exposure.png")
