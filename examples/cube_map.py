"""How do I light a scene with this sky?

With a cube map: six faces that share their edges, each turned as OpenGL, Vulkan and WebGPU
expect. The strip of the renderer is laid out as a cross here: up, then left, ahead, right and
behind, then down. The lower half is the planet's own ground, lit by sun and sky.
"""

import numpy as np

import airlight
from airlight.image.spectral import default_wavelengths

earth = airlight.load_planet("earth")
solution = airlight.solve(earth, default_wavelengths(8), quality="preview")
side = 112
camera = airlight.Camera(projection="cubemap", width=6 * side, height=side)
scene = airlight.Scene(altitude=1000.0, sun_zenith=75.0, camera=camera)
strip = airlight.render(solution, scene).rgb
right, left, up, down, ahead, behind = np.split(strip, 6, axis=1)

cross = np.zeros((3 * side, 4 * side, 3), np.float32)
cross[:side, side : 2 * side] = up
cross[side : 2 * side] = np.concatenate([left, ahead, right, behind], axis=1)
cross[2 * side :, side : 2 * side] = down
airlight.write_picture("cube_map.png", cross)
