"""What does an engine need to dim the sun, and how far off is a table of it?

A table of the air's transmittance over altitude and direction, 64 × 256 texels in Bruneton's
layout: `bake` fills it and measures its error at random places that are no texels (printed into
the title). The three channels are 680, 550 and 440 nm. The sun that sets at the ground loses its
blue first: the lower right corner.
"""

from matplotlib.figure import Figure

import airlight
from airlight.engines.baking.bake import bake

earth = airlight.load_planet("earth", {"refraction": "none"})  # tables draw straight
solution = airlight.solve(earth, [680.0, 550.0, 440.0], quality="preview")
baked = bake(solution, size=(8, 32, 8, 4), points=500)  # a small one of the scattered light
table = baked.tables["transmittance"]
error = baked.errors["transmittance"]

figure = Figure(figsize=(6.4, 3.2), layout="constrained")
axes = figure.subplots()
axes.imshow(table.values, origin="lower", aspect="auto", extent=(0.0, 1.0, 0.0, 1.0))
axes.set(
    xlabel="direction: straight up (0) to the horizon (1)",
    ylabel="altitude: ground (0) to space (1)",
    title=f"transmittance to space, off by at most {error.maximum:.4f}",
)
figure.savefig("transmittance_table.png", dpi=75)
