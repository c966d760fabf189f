"""Where is the sky most polarised?

In a band 90° from the sun, as bees and photographers know: there molecules scatter at right
angles. Colours show the degree of polarisation of the whole sky, zenith in the middle, with the
sun (right) 60° from the zenith and at the horizon. The dark spots near the sun and opposite are
neutral points.
"""

import numpy as np
from matplotlib.figure import Figure

import airlight

solution = airlight.solve("earth", [680.0, 550.0, 440.0], quality="preview")
zenith, azimuth = np.linspace(0.5, 89.5, 60), np.linspace(0.0, 360.0, 121)
figure = Figure(figsize=(6.4, 3.2), layout="constrained")
for k, sun in enumerate((60.0, 90.0)):
    sky = solution.radiance(
        altitude=0.0, sun_zenith=sun, view_zenith=zenith[:, None], azimuth=azimuth, stokes=True
    )
    degree = airlight.degree_of_polarisation(sky).sel(wavelength=550.0)
    axes = figure.add_subplot(1, 2, k + 1, projection="polar")
    shown = axes.pcolormesh(np.radians(azimuth), zenith, degree, vmin=0.0, vmax=0.8)
    axes.set(title=f"sun {sun:.0f}° from the zenith", xticks=[], yticks=[])
figure.colorbar(shown, label="degree of polarisation")
figure.savefig("polarised_sky.png", dpi=75)
