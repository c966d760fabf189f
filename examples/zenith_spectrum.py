"""Which spectrum has the light of the zenith, by day and at dusk?

By day it is the sun's spectrum, its lines included, times the air's scattering. At dusk the light
has come through the ozone layer on a slant: the dip around 600 nm is the Chappuis band. Each
curve is divided by its largest value. Any wavelengths may be asked for, here one every 5 nm. A
warning names the bands of oxygen and water that this planet leaves out, such as 10 % at 690 nm.
"""

import numpy as np
from matplotlib.figure import Figure

import airlight

earth = airlight.load_planet("earth")
solution = airlight.solve(earth, np.arange(380.0, 751.0, 5.0), quality="preview")
sun_zenith = np.array([40.0, 85.0, 93.0])
sky = solution.radiance(altitude=0.0, sun_zenith=sun_zenith, view_zenith=0.0)

figure = Figure(figsize=(6.4, 3.6), layout="constrained")
axes = figure.subplots()
for angle, spectrum in zip(sun_zenith, sky, strict=True):
    axes.plot(sky.wavelength, spectrum / spectrum.max(), label=f"sun at {angle:g}°")
axes.set(xlabel="wavelength [nm]", ylabel="radiance of the zenith, largest = 1")
axes.legend()
figure.savefig("zenith_spectrum.png", dpi=75)
