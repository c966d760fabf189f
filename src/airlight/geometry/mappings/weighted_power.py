"""Weighted power mapping of the view direction: three regions that follow the horizon.

Directions are divided at the geometric horizon and at the horizontal: U (upper, above the
horizontal), L (lower, from the horizon up to the horizontal) and S (surface, on the ground). Each
region has a power mapping that is finest at its lower edge (S: at its upper edge, the horizon), and
a fraction of the axis that depends on the altitude coordinate u:

    w_L = w_L1 u,    w_S = w_S1 u + w_S0,    w_U = 1 - w_L - w_S.

Source: Atmosphere Plus notes, second print, section 3.1.4. There (w_S1, w_S0) are slope and offset,
(4/32, 4/32), equivalent to linear interpolation from 4/32 to 8/32; they are not the two end values.
On the ground L is empty (w_L = 0), and with w_S0 = 0 so is S. The horizon itself belongs to the
sky.
"""

from __future__ import annotations

from airlight.kernel import kernel

#: Regions in their order on the axis.
SURFACE, LOWER, UPPER = 0, 1, 2
#: Powers and weights of the notes' comparison (section 3.1.6).
DEFAULT_POWER = 2.0
DEFAULT_LOWER_WEIGHT = 20.0 / 32.0
DEFAULT_SURFACE_SLOPE = 4.0 / 32.0
DEFAULT_SURFACE_OFFSET = 4.0 / 32.0


@kernel
def lower_weight(u, slope):
    """Fraction w_L of the axis for the region between horizon and horizontal. [1]

    Parameters
    ----------
    u : float
        Altitude coordinate. [1]
    slope : float
        w_L1, the fraction at the top of the shell. [1]

    Examples
    --------
    >>> lower_weight(0.1, 20 / 32)  # 1 km of 100 km, power 2
    0.0625
    """
    return slope * u


@kernel
def surface_weight(u, slope, offset):
    """Fraction w_S of the axis for the ground region. [1]

    Parameters
    ----------
    u : float
        Altitude coordinate. [1]
    slope, offset : float
        w_S1 and w_S0. [1]

    Examples
    --------
    >>> surface_weight(0.1, 4 / 32, 4 / 32)  # 1 km of 100 km, power 2
    0.1375
    """
    return slope * u + offset


@kernel
def view_region(mu, to_ground, horizon, upper_power, lower_power, surface_power):
    """Region of a direction, and coordinate within it.

    Parameters
    ----------
    mu : float
        Cosine of the view's zenith angle. [1]
    to_ground : bool
        Whether the line of sight ends on the ground.
    horizon : float
        Cosine of the horizon's zenith angle at this altitude, at most 0. [1]
    upper_power, lower_power, surface_power : float
        Powers p_U, p_L, p_S. [1]

    Returns
    -------
    region : int
        Index of the region: ``SURFACE``, ``LOWER`` or ``UPPER``.
    x : float
        Coordinate in the region, 0 at its lower end on the axis, 1 at its upper end. [1]
    """
    if to_ground:
        part = min(max((horizon - mu) / (1.0 + horizon), 0.0), 1.0)
        return SURFACE, 1.0 - part ** (1.0 / surface_power)
    if mu < 0.0:
        if horizon >= 0.0:
            return LOWER, 0.0
        part = min(max((mu - horizon) / -horizon, 0.0), 1.0)
        return LOWER, part ** (1.0 / lower_power)
    return UPPER, min(mu, 1.0) ** (1.0 / upper_power)


@kernel
def region_coordinate(region, x, w_lower, w_surface):
    """Coordinate within a region to the whole axis, [0, 1]. [1]

    Parameters
    ----------
    region, x : int, float
        Values from ``view_region``.
    w_lower, w_surface : float
        Weights at this altitude. [1]
    """
    if region == SURFACE:
        return w_surface * x
    if region == LOWER:
        return w_lower * x + w_surface
    base = w_lower + w_surface
    return min((1.0 - base) * x + base, 1.0)


@kernel
def view_coordinate(
    mu, to_ground, horizon, upper_power, lower_power, surface_power, w_lower, w_surface
):
    """Direction to [0, 1]: 0 straight down, w_S at the horizon, 1 straight up. [1]

    Parameters
    ----------
    mu, to_ground, horizon, upper_power, lower_power, surface_power
        Arguments of ``view_region``.
    w_lower, w_surface : float
        Weights at this altitude. [1]
    """
    region, x = view_region(mu, to_ground, horizon, upper_power, lower_power, surface_power)
    return region_coordinate(region, x, w_lower, w_surface)


@kernel
def view_from_coordinate(v, horizon, upper_power, lower_power, surface_power, w_lower, w_surface):
    """Inverse of ``view_coordinate``.

    Returns
    -------
    mu : float
        Cosine of the view's zenith angle. [1]
    to_ground : bool
        Whether the line of sight ends on the ground; False at v = w_S, the horizon.
    """
    base = w_lower + w_surface
    if v < w_surface:
        part = 1.0 - v / w_surface
        return max(horizon - (1.0 + horizon) * part**surface_power, -1.0), True
    if v < base:
        part = (v - w_surface) / w_lower
        return min(horizon - horizon * part**lower_power, 0.0), False
    w_upper = 1.0 - base
    part = (v - base) / w_upper if w_upper > 0.0 else 1.0
    return min(part, 1.0) ** upper_power, False
