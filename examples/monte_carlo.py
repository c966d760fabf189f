"""How do I know that these radiances are right?

Ask a method that has nothing in common with the first. The Monte Carlo solver follows histories
of light and knows its standard error; it shares no table and no grid with the moments solver that
draws the pictures. Lines: the sky along the sun's meridian by the moments, sun at 70°. Dots:
Monte Carlo, asked for 2 %, with bars of three standard errors.
"""

import numpy as np
from matplotlib.figure import Figure

import airlight
from airlight.solver.montecarlo.settings import MonteCarloSettings

earth = airlight.load_planet("earth-atmosphere-plus")
wavelengths = [680.0, 550.0, 440.0]
view = np.linspace(-85.0, 85.0, 69)  # negative: away from the sun
dots = np.arange(-80.0, 81.0, 40.0)


def sky(solution, angle):
    """Radiance along the meridian. [W m⁻² sr⁻¹ nm⁻¹]"""
    return solution.radiance(
        altitude=0.0,
        sun_zenith=70.0,
        view_zenith=np.abs(angle),
        azimuth=np.where(angle < 0.0, 180.0, 0.0),
    )


moments = sky(airlight.solve(earth, wavelengths), view)
histories = airlight.solve(
    earth, wavelengths, MonteCarloSettings(relative_error=0.02), solver="montecarlo"
)
traced = sky(histories, dots)
error = 3.0 * 0.02 * traced  # an upper bound: none is worse than asked for

figure = Figure(figsize=(6.4, 3.6), layout="constrained")
axes = figure.subplots()
for nm, color in zip(wavelengths, ("tab:red", "tab:green", "tab:blue"), strict=True):
    axes.semilogy(view, moments.sel(wavelength=nm), color=color, label=f"{nm:g} nm")
    at = {"color": color, "fmt": "o", "markersize": 4, "capsize": 2}
    axes.errorbar(dots, traced.sel(wavelength=nm), error.sel(wavelength=nm), **at)
axes.set(xlabel="view zenith angle, the sun at 70° [deg]", ylabel="radiance [W m⁻² sr⁻¹ nm⁻¹]")
axes.legend()
figure.savefig("monte_carlo.png", dpi=75)
