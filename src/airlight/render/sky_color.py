"""Sky colour of a planet in three directions, at a solar zenith angle of 45°."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np
import numpy.typing as npt

from airlight.image.display import to_display
from airlight.image.exposure import DEFAULT_EXPOSURE
from airlight.image.spectral import rgb_weights
from airlight.image.white_balance import star_white
from airlight.image.xyz import chromaticity, rgb_to_xyz
from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.planets.picture_wavelengths import picture_wavelengths

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

FloatArray = npt.NDArray[np.float64]

#: Zenith angle of the sun. [deg]
SUN_ZENITH: Final = 45.0
#: Directions from the ground, at 90° azimuth from the sun: name and zenith angle. [deg]
LOOKS: Final = (("zenith", 0.0), ("halfway", 45.0), ("horizon", 89.0))
#: Number of wavelengths over the visible part of the planet's range.
_WAVELENGTHS: Final = 12


@dataclass(frozen=True, kw_only=True)
class SkyColor:
    """Sky colour in one direction.

    Parameters
    ----------
    look : str
        ``zenith``, ``halfway`` or ``horizon``.
    luminance : float
        Luminance. [cd m⁻²]
    chromaticity : tuple of float
        CIE 1931 x and y. [1]
    code : str
        sRGB at the default exposure and tone map, ``#rrggbb``.
    """

    look: str
    luminance: float
    chromaticity: tuple[float, float]
    code: str


def sky_colors(planet: Planet, *, cache: bool = True, progress: Any = None) -> tuple[SkyColor, ...]:
    """Sky colours from the ground in each of ``LOOKS``, at the quality ``preview``.

    Parameters
    ----------
    planet : Planet
        Planet with data in the visible.
    cache : bool
        Whether solutions are read from disk and stored there.
    progress : callable, optional
        ``progress(done, total, message)``.

    Returns
    -------
    tuple of SkyColor
        Colours in the order of ``LOOKS``.
    """
    from airlight.solver import solve

    nm = picture_wavelengths(planet, _WAVELENGTHS)
    solution = solve(planet, wavelengths=nm, quality="preview", cache=cache, progress=progress)
    radiance = solution.radiance(
        altitude=0.0,
        sun_zenith=SUN_ZENITH,
        view_zenith=np.array([zenith for _, zenith in LOOKS]),
        azimuth=90.0,
    )
    rgb = np.asarray(radiance) @ rgb_weights(nm, solution.lights[0].spectrum)
    xyz = rgb_to_xyz(rgb)
    white = star_white(solution.lights[0].spectrum)
    picture = rgb[np.newaxis, :, :]
    shown = to_display(picture, DEFAULT_EXPOSURE, star_white=white, dither=False)[0]
    return tuple(
        SkyColor(
            look=look,
            luminance=LUMINOUS_EFFICACY * float(xyz[i, 1]),
            chromaticity=(float(x), float(y)),
            code="#" + "".join(f"{int(level):02x}" for level in shown[i]),
        )
        for i, ((look, _), (x, y)) in enumerate(zip(LOOKS, chromaticity(xyz), strict=True))
    )
