"""Lines of sight marched on the CPU: packets of neighbours, all wavelengths at once."""

from __future__ import annotations

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import INVERSE_PI, LANES, load, store
from airlight.pixels.sky_table import line_of_sight, star_on_ground
from airlight.solvers.moments.irradiance import ground_light


@inlined
def aim(p, mu, sine, cos_azimuth, to_ground, observer, shown, packet):
    """Set line ``p`` of a packet to a line of sight.

    Parameters
    ----------
    p : int
        Index of the line in the packet.
    mu, sine, cos_azimuth, to_ground : float, float, float, bool
        Arguments of ``look``.
    observer, shown : Observer, Shown
        Observer, and tables of the solution.
    packet : Packet
        Packet of ``march``.
    """
    r, start_mu, start_mu_s, nu, length = line_of_sight(
        mu, sine, cos_azimuth, to_ground, observer, shown
    )
    packet.r[p], packet.mu[p], packet.length[p] = r, start_mu, length
    packet.mu_s[p], packet.nu[p] = start_mu_s, nu


@compiled_loop
def ground_behind(p, sine, cos_azimuth, observer, shown, light, packet, work, ground):
    """Light of a white Lambert ground behind the air of line ``p``, which has been marched.

    Parameters
    ----------
    p, sine, cos_azimuth, observer, shown, packet :
        Arguments of ``aim``.
    light, work : Light, Workspace
        Arguments of ``march``.
    ground : array, shape (w,)
        Receives the radiance. [sr⁻¹]

    Returns
    -------
    float
        Angle of refraction along the line. [rad]
    """
    total = work.total[p]
    mu_s, angle = star_on_ground(
        sine, cos_azimuth, packet.r[p], packet.mu[p], packet.nu[p], packet.length[p],
        total[total.size - 1], observer, shown,
    )  # fmt: skip
    ground_light(min(max(mu_s, -1.0), 1.0), observer.orders, light, work)
    received, through = work.received, work.through[p]
    for at in range(0, received.size, LANES):
        store(ground, at, load(received, at) * INVERSE_PI * load(through, at))
    return angle
