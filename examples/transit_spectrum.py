"""How does a transit show what an exoplanet's air is made of?

In front of its star the planet is larger at colours that its air absorbs. The line is the height
to which the Earth's air blocks light in transit: at blue the molecules that scatter, in the middle
the ozone layer's Chappuis band.
"""

import numpy as np
from matplotlib.figure import Figure

import airlight

figure = Figure(figsize=(6.4, 3.2), layout="constrained")
axes = figure.subplots()
for label, overrides in (("Earth", {}), ("without ozone", {"ozone.absorption.ozone": "0 DU"})):
    earth = airlight.load_planet("earth", overrides)
    solution = airlight.solve(earth, np.arange(350.0, 681.0, 15.0), quality="preview")
    transit = airlight.observe(solution, "transmission")
    axes.plot(transit.wavelength, transit["effective_height"] / 1e3, label=label)
axes.set(xlabel="wavelength [nm]", ylabel="height that blocks the star [km]", ylim=(0.0, None))
axes.legend()
figure.savefig("transit_spectrum.png", dpi=75)
