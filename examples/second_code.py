"""Does a second code find the same sky?

SASKTRAN 2 by successive orders in a sphere gets the coefficients and phase functions of the
Earth's air; lines are the radiance by airlight, crosses that by SASKTRAN 2, both scalar and
without refraction, for the sun 60° from the zenith and views at right angles to it.
"""

import numpy as np
import sasktran2 as sk
from matplotlib.figure import Figure
from numpy.polynomial import legendre

import airlight

earth = airlight.load_planet("earth", {"refraction": "none"})
solution = airlight.solve(earth, [680.0, 550.0, 440.0], polarisation=False)
medium, mu_s = solution.medium, np.cos(np.radians(60.0))
z = np.r_[0.0:12e3:250.0, 12e3 : medium.thickness : 1e3]
config = sk.Config()
config.num_streams, config.num_singlescatter_moments = 16, 64
config.num_successive_orders_incoming = config.num_successive_orders_outgoing = 194
config.multiple_scatter_source = sk.MultipleScatterSource.SuccessiveOrders
form = sk.InterpolationMethod.LinearInterpolation, sk.GeometryType.Spherical
geometry = sk.Geometry1D(mu_s, 0.0, medium.bottom_radius, z, *form)
viewing, zenith = sk.ViewingGeometry(), np.arange(0.0, 61.0, 10.0)
for mu in np.cos(np.radians(zenith)):
    viewing.add_ray(sk.SolarAnglesObserverLocation(mu_s, np.pi / 2, mu, 0.0))

air = sk.Atmosphere(geometry, config, numwavel=3, calculate_derivatives=False)
density = medium.density.at(z)[:, :, None]  # constituent, altitude, wavelength
scattering = density * medium.scattering[:, None]
extinction = (scattering + density * medium.absorption[:, None]).sum(axis=0)
air.storage.total_extinction[:] = extinction
air.storage.ssa[:] = scattering.sum(axis=0) / extinction
nu, weights = legendre.leggauss(400)
phases = [4 * np.pi * one.phase_values(nu, medium.wavelengths).T for one in medium.constituents]
for l in range(64):
    moments = phases @ ((l + 0.5) * weights * legendre.legval(nu, np.eye(64)[l]))
    air.leg_coeff.a1[l] = (moments[:, None] * scattering).sum(axis=0) / scattering.sum(axis=0)
air.surface.albedo[:] = medium.ground_albedo
theirs = sk.Engine(config, geometry, viewing).calculate_radiance(air)["radiance"].values[..., 0]

ours = solution.radiance(altitude=0.0, sun_zenith=60.0, view_zenith=zenith, azimuth=90.0)
ours = ours.values.T / medium.solar_irradiance[:, None]
print("largest difference:", f"{np.abs(ours / theirs - 1.0).max():.2%}")
figure = Figure(figsize=(6.4, 3.6), layout="constrained")
axes = figure.subplots()
for nm, line, marks in zip(medium.wavelengths, ours, theirs, strict=True):
    axes.plot(zenith, line, label=f"{nm:.0f} nm")
    axes.plot(zenith, marks, "kx")
axes.set(xlabel="view zenith angle [deg]", ylabel="radiance / irradiance of the sun [sr⁻¹]")
axes.legend()
figure.savefig("second_code.png", dpi=75)
