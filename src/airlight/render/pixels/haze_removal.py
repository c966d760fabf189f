r"""Removal of haze in pictures from above the air, as in processed photographs.

A photographer darkens what should be dark, the blue air in front of sea and woods. Here the path
radiance in front of the ground is known: of it, the picture keeps

.. math:: 1 - f\,T

with the transmittance T of the line of sight, by wavelength, and a fraction f. So nothing is taken
from air that hides the ground, such as clouds of Venus or the limb. It is no radiance.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from airlight.kernel import inlined, kernel
from airlight.kernel.lanes import lane_view, splat
from airlight.physics.optics.clouds import clouds_shown
from airlight.render.pixels.ground_angles import ground_angles
from airlight.solver.moments.source import transmittance_columns

#: Cosine of the star's zenith angle at the ground from which on haze is removed in full; none in
#: twilight, whose air is the picture. By eye. [1]
DAY: Final = 0.25


@kernel
def hazy_day(mu_s, altitude):
    """Factor of the removed fraction by the height of star and observer. [1]

    Parameters
    ----------
    mu_s : float
        Cosine of the star's zenith angle at the ground. [1]
    altitude : float
        Altitude of the observer, see ``clouds_shown``. [m]

    Examples
    --------
    >>> hazy_day(0.5, 4e5), hazy_day(0.0, 4e5), hazy_day(0.5, 1e4)
    (1.0, 0.0, 0.0)
    """
    lit = min(max(mu_s / DAY, 0.0), 1.0)
    return lit * lit * (3.0 - 2.0 * lit) * clouds_shown(altitude, True, True)


@inlined
def removed_haze(ray, sine, refraction, observer, frame):
    """Fraction f of the module, on a line of sight that ends on the ground. [1]

    Parameters
    ----------
    ray, sine, refraction : Vec3, float, float
        Direction in the observer's frame, sine of its zenith angle [1], and its refraction. [rad]
    observer, frame : Observer, FrameTables
        Observer, and what the pixels read.
    """
    mu_s, _mu_r, _nu = ground_angles(ray.x, ray.z, sine, refraction, observer, frame.tables)
    return frame.camera.dehaze * hazy_day(mu_s, observer.optical_altitude)


@inlined
def kept_haze(fraction, tables, columns, at):
    """Factor of the path radiance. [1]

    Parameters
    ----------
    fraction : float
        Result of ``removed_haze``, above zero. [1]
    tables, columns, at : MarchTables, array, int
        Tables of the solution, columns from ``columns_to_ground`` [m], and index of the first lane.
    """
    extinction = lane_view(tables.scaled_extinction, at)
    clear = transmittance_columns(columns, extinction, tables.constituents)
    return splat(1.0) - clear * np.float32(fraction)
