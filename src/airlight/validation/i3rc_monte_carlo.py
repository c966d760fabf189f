"""Monte Carlo results for the cases of I3RC: means over a field, and single columns."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_layer import CloudLayer
from airlight.planets import Constituent, Ground, Medium, Planet, Star
from airlight.planets.matter.profiles import Uniform
from airlight.solver.montecarlo.cloudy_air import Areas, CloudyAir
from airlight.solver.montecarlo.settings import MonteCarloSettings
from airlight.solver.montecarlo.solution import MonteCarloSolution
from airlight.validation.i3rc import WAVELENGTH, Experiment
from airlight.validation.planets import VAST
from airlight.validation.suite import SuiteRun

FloatArray = NDArray[np.float64]

#: View zenith angles, and azimuths clockwise from north, of the radiances. [deg]
VIEWS: Final[dict[str, tuple[float, float]]] = {
    "Iu": (180.0, 0.0),
    "I601": (120.0, 270.0),
    "I602": (120.0, 90.0),
    "Id": (0.0, 0.0),
}
#: Azimuth of the sun, which shines from low x. [deg]
_SUN_AZIMUTH: Final = 270.0
#: Radius of the flat planet, and the thickness of its shell. [m]
_RADIUS: Final = 6360e3 * VAST
_THICKNESS: Final = 5e3


class FieldResult(NamedTuple):
    """Quantity of I3RC with its standard error.

    Attributes
    ----------
    value, error : array, shape (n,)
        Irradiance over that of the sun on a horizontal plane, or radiance times π over that. [1]
    histories : int
        Number of histories.
    """

    value: FloatArray
    error: FloatArray
    histories: int


def flat_planet_without_gases(ground_albedo: float) -> Planet:
    """Planet a thousand times as large as Earth, under a point star of irradiance 1."""
    return Planet(
        name="I3RC",
        bottom_radius=_RADIUS,
        top_radius=_RADIUS + _THICKNESS,
        ground=Ground(albedo=ground_albedo),
        star=Star(irradiance=1.0, angular_radius=0.0),
        constituents=(Constituent(name="nothing", profile=Uniform(), absorption=1e-30),),
    )


def cloudy_experiment(
    experiment: Experiment, relative_error: float, run: SuiteRun | None = None
) -> CloudyAir:
    """The cloud of an experiment, to be traced up to a standard error.

    Parameters
    ----------
    relative_error : float
        Standard error of each result over its value. [1]
    """
    settings = MonteCarloSettings(
        relative_error=relative_error, polarisation=False, exact_first_order=False
    )
    medium = Medium.from_planet(flat_planet_without_gases(experiment.ground_albedo), [WAVELENGTH])
    cancel = None if run is None else run.cancel
    solution = MonteCarloSolution(medium, settings, cancel=cancel)
    return CloudyAir(solution, [CloudLayer(experiment.field, experiment.optics)])


def result(cloud: CloudyAir, experiment: Experiment, quantity: str, areas: Areas) -> FieldResult:
    """Quantity of an experiment over areas.

    Parameters
    ----------
    cloud : CloudyAir
        Result of ``cloudy_experiment``.
    quantity : str
        One of ``i3rc.QUANTITIES`` but A.
    """
    zenith, azimuth = experiment.sun_zenith, _SUN_AZIMUTH
    mu_s = np.cos(np.radians(zenith))
    altitude = 0.0 if quantity in ("T", "Id") else experiment.field.top
    direct, scale = np.zeros(1), 1.0 / mu_s
    if quantity in VIEWS:
        scale *= np.pi
        view = dict(zip(("view_zenith", "azimuth"), VIEWS[quantity], strict=True))
        found = cloud.radiance_over(
            areas, altitude=altitude, sun_zenith=zenith, sun_azimuth=azimuth, **view
        )
    else:
        found = cloud.irradiance_over(
            areas, altitude=altitude, upward=quantity == "R", sun_zenith=zenith, sun_azimuth=azimuth
        )
        if quantity == "T":
            direct = cloud.direct_over(
                areas, altitude=altitude, sun_zenith=zenith, sun_azimuth=azimuth
            )[:, 0]
    return FieldResult(
        scale * (found.total[:, 0] + direct),
        scale * found.total_error[:, 0],
        int(found.histories.sum()),
    )


def every(areas: Areas, step: int) -> Areas:
    """Every step-th area."""
    return Areas(*(side[::step] for side in (areas.east, areas.north, areas.width, areas.length)))
