"""How fast does the zenith darken after sunset?

By a factor of about 140 until the end of civil twilight, with the sun 6° below the horizon. The
luminance of the zenith is drawn for air alone and for the clean continental air of the preset.
Solutions are for the whole sphere, so a fading sky is no special case; what is left out (the
moon, stars and airglow) takes over below about 12°.
"""

import numpy as np
from matplotlib.figure import Figure

import airlight
from airlight.image.spectral import default_wavelengths, rgb_weights
from airlight.image.xyz import luminance
from airlight.physics.constants import LUMINOUS_EFFICACY

depression = np.linspace(-10.0, 8.0, 37)  # of the sun below the horizon [deg]
figure = Figure(figsize=(6.4, 3.6), layout="constrained")
axes = figure.subplots()
for label, overrides in (
    ("clean continental air", {}),
    ("without aerosol", {"aerosol.optical_depth": 0.0}),
):
    earth = airlight.load_planet("earth", overrides)
    solution = airlight.solve(earth, default_wavelengths(8), quality="preview")
    zenith = solution.radiance(altitude=0.0, sun_zenith=90.0 + depression, view_zenith=0.0)
    rgb = zenith.values @ rgb_weights(solution.wavelengths, earth.star.irradiances)
    axes.semilogy(depression, LUMINOUS_EFFICACY * luminance(rgb), label=label)
axes.axvspan(0.0, 6.0, color="0.92", label="civil twilight")
axes.set(xlabel="sun below the horizon [deg]", ylabel="luminance of the zenith [cd m⁻²]")
axes.legend()
figure.savefig("twilight.png", dpi=75)
