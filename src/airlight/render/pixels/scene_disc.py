"""Disc of a star in a pixel, attenuated and refracted by air, behind a body without air."""

from __future__ import annotations

from math import asin, sin, sqrt

import numpy as np

from airlight.geometry.vectors import Vec3, cross, dot, minus
from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, lane_view, load, splat, store
from airlight.render.pixels.bare_body import sphere_distance
from airlight.render.pixels.pixel import disc_light
from airlight.render.pixels.star_disc import camera_direction, leaving_air, star_disc
from airlight.solver.moments.source import transmittance_columns


@inlined
def small_disc(px, py, ray, beyond, exact, frame, work, color, result):
    """Spectral radiance of a disc smaller than two pixels, as ``pixel_light``. [sr⁻¹]"""
    view, tables = frame.camera, frame.tables
    powers, place = star_disc(px, py, ray, frame, work.columns_total)
    share = 1.0 if view.filter == 0 else 0.5
    for at in range(0, tables.lanes, LANES):
        store(result, at, disc_light(powers, place, share, tables, work.columns_total, at))


@inlined
def scene_disc(px, py, frame, columns, result):
    """Spectral radiance of the disc in a pixel, per irradiance of the star. [sr⁻¹]

    Parameters
    ----------
    px, py : float
        Position in the frame. [pixel]
    frame : BodyFrame
        What the pixels read; the body hides the disc if ``body_hides``.
    columns : array, shape (nc,)
        Workspace.
    result : array, shape (w,)
        Receives the radiance. [sr⁻¹]
    """
    observer, view, tables, body = frame.observer, frame.camera, frame.tables, frame.body
    side = body.body_samples
    step = 1.0 / side
    bright = step * step * view.disc * (1.0 if view.filter == 0 else 0.5)
    for at in range(0, tables.lanes, LANES):
        store(result, at, splat(0.0))
    for sample in range(side * side):
        down = sample // side
        across = sample - side * down
        x, y = px + (across + 0.5) * step - 0.5, py + (down + 0.5) * step - 0.5
        ray = camera_direction(x, y, view)
        left, free = leaving_air(ray, observer, tables, columns)
        apart = minus(left, Vec3(observer.sun_x, 0.0, observer.sun_z))
        angle = 2.0 * asin(min(0.5 * sqrt(dot(apart, apart)), 1.0))
        shown = free and dot(ray, ray) > 0.0 and angle < tables.star_radius
        if shown and body.body_hides:
            miss = cross(left, body.body_centre)
            along = dot(left, body.body_centre)
            shown = sphere_distance(along, sqrt(dot(miss, miss)), body.body_power) < 0.0
        if shown:
            part = sin(angle) / sin(tables.star_radius)
            mu = sqrt(max((1.0 - part) * (1.0 + part), 0.0))
            for at in range(0, tables.lanes, LANES):
                law = lane_view(tables.darkening, at)
                shape = law[5]
                for power in range(5):
                    shape = shape * np.float32(mu) + law[4 - power]
                through = transmittance_columns(
                    columns, lane_view(tables.extinction, at), tables.constituents
                )
                store(result, at, load(result, at) + through * shape * np.float32(bright))
