"""Lower hemisphere of an environment map: grey ground, ground map, or black."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.physics.spectra.color_matching import cie_1931
from airlight.planets.parameters import replace
from airlight.render.through_air import straight_lines

if TYPE_CHECKING:
    from airlight.planets.planet import Planet
    from airlight.scene import Scene
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]

#: Contents of the lower hemisphere.
GROUNDS: Final = ("neutral", "map", "black")
#: Samples per side of a texel for the coverage by the ground.
_PLACES: Final = 4
#: Number of bisections to the horizon.
_BISECTIONS: Final = 40


def grey_ground(planet: Planet) -> Planet:
    """Planet with a uniform grey ground of the same luminous albedo.

    Parameters
    ----------
    planet : Planet
        Planet, whose ground may be that around an observer (``airlight.local_ground``).

    Returns
    -------
    Planet
        Planet without map, lamps and clouds; its albedo is the mean over the star's spectrum,
        weighted by luminous efficiency.

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> ground = grey_ground(load_planet("earth")).ground
    >>> f"{ground.albedo:.2f}", ground.map
    ('0.11', None)
    """
    low, high = planet.wavelength_limits
    nm = np.arange(max(low, 400.0), min(high, 700.0) + 1.0, 5.0)
    weight = cie_1931().at(nm)[..., 1] * planet.star.irradiances(nm)
    albedo = float(weight @ planet.ground.albedos(nm) / weight.sum())
    ground = planet.ground
    law = "lambert" if ground.law == "water" else ground.law
    even = replace(ground, albedo=albedo, map=None, lights=None, clouds=None, local=None)
    even = replace(even, wind=None, law=law, brightness=1.0)
    return replace(planet, ground=even)


def blacken_ground(rgb: NDArray[np.float32], solution: MomentsSolution, scene: Scene) -> None:
    """Scale each texel by its fraction above the horizon.

    Parameters
    ----------
    rgb : array, shape (height, width, 3)
        Map, modified in place.
    scene : Scene
        Observer and camera.
    """
    camera, horizon = scene.camera, horizon_cosine(solution, scene.altitude)
    offsets = (np.arange(_PLACES) + 0.5) / _PLACES - 0.5
    for row in range(camera.height):
        block = slice(row, row + 1)
        above = camera.directions(block)[0, :, 2] - horizon
        share = np.asarray(above > 0.0, np.float32)
        if np.any(np.abs(above) < 2.0 * camera.pixel_angle):
            free = [
                camera.directions(block, offset=(across, down))[0, :, 2] > horizon
                for across in offsets
                for down in offsets
            ]
            share = np.mean(free, axis=0, dtype=np.float32)
        rgb[row] *= share[:, None]


def horizon_cosine(solution: MomentsSolution, altitude: float) -> float:
    """Cosine of the zenith angle of the apparent horizon. [1]

    Parameters
    ----------
    altitude : float
        Altitude of the observer. [m]
    """
    low, high = -1.0, 0.0
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        view = np.array([[np.sqrt(1.0 - middle * middle), 0.0, middle]])
        if bool(straight_lines(view, solution, altitude)[0].to_ground[0]):
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
