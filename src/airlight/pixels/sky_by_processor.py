"""The table of the sky filled by the processor, for devices that are the processor anyway.

Software devices run the shader's march some fifteen times slower than the compiled one runs: they
get the table from here, and draw pictures from it.
"""

from __future__ import annotations

from math import cos, pi, sqrt
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.bending import bend_angle, turned
from airlight.geometry.quadrature import gauss_legendre
from airlight.geometry.shell import distance_to_bottom, distance_to_top, first_meeting
from airlight.kernel import compiled_loop
from airlight.kernel.lanes import INVERSE_PI
from airlight.kernel.threads import run_blocks
from airlight.mappings.sky_view import direction_from_row, impact_from_row
from airlight.pixels.march import MOST_POINTS
from airlight.pixels.shown import POINTS, Shown
from airlight.pixels.sky_table import (
    Observer,
    half_sine_between,
    phases_towards,
    row_coordinate,
    star_from,
)
from airlight.solvers.moments.irradiance import ground_light
from airlight.solvers.moments.march import PACKET, march, new_packet
from airlight.solvers.moments.solution import MomentsSolution

Float32Array = NDArray[np.float32]

#: Numbers of a texel: four wavelengths of each of the four layers.
LAYERS: Final = 4


@compiled_loop
def _aim(column, row, columns, rows, observer, shown, p, packet):
    """Line of sight of a texel, as line ``p`` of a packet.

    Returns
    -------
    mu_s, nu : float
        Of the star on the ground, as drawn [1], and between line and star [1].
    half_sine : float
        sin(θ/2) of the angle to where the star is seen. [1]
    """
    sky = row < rows
    at = row_coordinate(row, rows, observer.outside)
    cos_azimuth = cos(pi * column / (columns - 1))
    side = sqrt(max((1.0 - cos_azimuth) * (1.0 + cos_azimuth), 0.0))
    r, mu_s = observer.r, observer.sun_z
    if observer.outside:
        impact = impact_from_row(at, sky, shown.bottom, shown.top)
        sine = impact / observer.r
        mu = -sqrt(max((1.0 - sine) * (1.0 + sine), 0.0))
        across, up = first_meeting(min(impact, shown.top), sine, shown.top)
        mu_s = star_from(across, up, shown.top, cos_azimuth, observer.sun_x, observer.sun_z)
        start = -sqrt(max((shown.top - impact) * (shown.top + impact), 0.0)) / shown.top
        r = shown.top
    else:
        mu, sine = direction_from_row(at, sky, observer.horizon_mu, observer.horizon_sine)
        impact = observer.r * sine
        start = mu
    nu = min(max(sine * cos_azimuth * observer.sun_x + mu * observer.sun_z, -1.0), 1.0)
    packet.r[p], packet.mu[p], packet.mu_s[p], packet.nu[p] = r, start, mu_s, nu
    if sky:
        packet.length[p] = distance_to_top(r, start, shown.top)
    else:
        packet.length[p] = distance_to_bottom(r, start, shown.bottom)
        across, up = first_meeting(min(impact, shown.bottom), sine, shown.bottom)
        mu_s = star_from(across, up, shown.bottom, cos_azimuth, observer.sun_x, observer.sun_z)
    half_sine = half_sine_between(
        sine * cos_azimuth, sine * side, mu, observer.seen_x, observer.seen_z
    )
    return mu_s, nu, half_sine


@compiled_loop
def _fill(first, last, columns, rows, observer, shown, light, rules, packet, work, out):
    """Texels ``first`` to ``last`` - 1 of all layers, fourth roots, shape (layer, texel, 4)."""
    lanes = light.air.ground.albedo.size
    count = min(lanes, 4)
    ground_suns = np.empty(PACKET)
    peaks = (shown.first_peak, shown.second_peak)
    for begin in range(first, last, PACKET):
        rays = min(PACKET, last - begin)
        for p in range(rays):
            texel = begin + p
            mu_s, nu, half_sine = _aim(
                texel % columns, texel // columns, columns, rows, observer, shown, p, packet
            )
            ground_suns[p] = mu_s
            phases_towards(half_sine, False, shown, packet.phase[p])
        march(packet, rays, observer.orders, 1, rules, light, work)
        for p in range(rays):
            texel = begin + p
            for w in range(count):
                out[0, texel, w] = max(work.radiance[p, w], 0.0) ** 0.25
                out[1, texel, w] = 0.0
            if texel // columns < rows:
                continue
            mu_s = ground_suns[p]
            if light.bend > 0.0:
                r, mu, nu = packet.r[p], packet.mu[p], packet.nu[p]
                angle = bend_angle(r, mu, light.bend, work.total[p, work.total.shape[1] - 1])
                mu_s, _ = turned((r * mu + packet.length[p]) / shown.bottom, mu_s, nu, angle)
            ground_light(min(max(mu_s, -1.0), 1.0), observer.orders, light, work)
            for w in range(count):
                behind = work.received[w] * work.through[p, w] * INVERSE_PI
                out[1, texel, w] = max(behind, 0.0) ** 0.25
        for layer in range(2):
            peak = peaks[layer]
            if peak < 0:
                continue
            packet.phase[:rays] = 0.0
            packet.phase[:rays, lanes * peak : lanes * (peak + 1)] = 1.0
            march(packet, rays, 1 if observer.orders != 0 else 0, 1, rules, light, work)
            for p in range(rays):
                for w in range(count):
                    value = work.radiance[p, w] if observer.orders != 0 else 0.0
                    out[2 + layer, begin + p, w] = max(value, 0.0) ** 0.25


def filled_sky(
    solution: MomentsSolution, shown: Shown, observer: Observer, shape: tuple[int, int]
) -> Float32Array:
    """The table of the sky.

    Parameters
    ----------
    solution, shown : MomentsSolution, Shown
        The solution and its tables.
    observer : Observer
        Who looks.
    shape : (int, int)
        Azimuths, and rows of each half.

    Returns
    -------
    array, shape (4, 2·rows·columns, 4)
        As the shader fills its layers: air, ground behind, and the two peaked constituents.
    """
    columns, rows = shape
    texels = 2 * columns * rows
    out = np.zeros((LAYERS, texels, 4), np.float32)
    rules = tuple(gauss_legendre(count).as_tuple() for count in POINTS)
    light = solution.light
    block = 32 * PACKET

    def run(index: int) -> None:
        _fill(
            index * block, min((index + 1) * block, texels), columns, rows, observer, shown, light,
            rules, new_packet(light.scattering.size), solution.workspace(MOST_POINTS, 1), out,
        )  # fmt: skip

    run_blocks(run, -(-texels // block))
    return out
