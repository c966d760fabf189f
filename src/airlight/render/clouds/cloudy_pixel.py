"""Pixels of a planet with three-dimensional clouds, on the CPU.

Sky, ground, water, lamps and light of the night are as in ``pixel``: behind the clouds, in their
shadow, and with the diffuse light below them.
"""

from __future__ import annotations

import numpy as np

from airlight.geometry.vectors import Vec3, plus, scaled
from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import LANES, exponential, lane_view, load, maximum, splat, store
from airlight.kernel.without_refcount import without_refcount
from airlight.physics.optics.clouds import GroundFactors
from airlight.render.clouds.beam_depth import cell_after, cell_before
from airlight.render.clouds.cloud_march import add_clouds, beam_depth_at, box_place, line_of_air
from airlight.render.clouds.sight_extent import sight_extent
from airlight.render.pixels.airglow import airglow_color, airglow_on_ground, by_night, night_light
from airlight.render.pixels.disc_shading import DiscPlace, darkened, whole_powers
from airlight.render.pixels.ground import (
    GROUND_VALUES,
    ground_factor,
    ground_reflectances,
    lamp_light,
)
from airlight.render.pixels.ground_angles import columns_to_ground, ground_angles
from airlight.render.pixels.pixel import classify_ray, sky_lookup, sky_view_place
from airlight.render.pixels.polarising_filter import filter_shares
from airlight.render.pixels.render_cpu import as_color
from airlight.render.pixels.samples import sample_place, samples_per_side
from airlight.render.pixels.sky_view_lut import half_sine_between
from airlight.render.pixels.skyglow import skyglow_color
from airlight.render.pixels.star_disc import camera_direction, star_disc
from airlight.solver.moments.irradiance import ground_light
from airlight.solver.moments.march_tables import FACETS, MIRRORED
from airlight.solver.moments.source import transmittance_columns


@inlined
def cloudy_light(px, py, ray, exact, frame, clouds, work, cloud_work, color, result):
    """Spectral radiance of a pixel, per irradiance of the star. [sr⁻¹]

    Parameters
    ----------
    px, py, ray, exact, frame, work, color, result :
        Arguments of ``pixel_light``.
    clouds, cloud_work : CloudTables, CloudWork
        Clouds and workspace.
    """
    observer, view, tables = frame.observer, frame.camera, frame.tables
    found = classify_ray(ray, observer, tables)
    through_air, to_ground = found.through_air and view.draws_air, found.to_ground
    factors = GroundFactors(1.0, 0.0, 1.0, 0.0, 0.0)
    dark = by_night(ray, found.sine, to_ground, frame)
    glow, lit = Vec3(0.0, 0.0, 0.0), Vec3(0.0, 0.0, 0.0)
    for at in range(0, tables.lanes, LANES):
        light = lane_view(cloud_work.light, at)
        light[0], light[1], light[2], light[3] = splat(0.0), splat(1.0), splat(1.0), splat(0.0)
    extent = sight_extent(
        ray.z, found.sine, to_ground, clouds.eye, clouds.radius, clouds.base, clouds.top
    )
    if through_air and extent.last > extent.first:
        half_sine = half_sine_between(ray, observer.seen_x, observer.seen_z)
        place = sky_view_place(ray, found, clouds.window)
        line_of_air(ray, half_sine, place, extent, clouds, tables, cloud_work)
        add_clouds(ray, half_sine, extent, clouds, tables, cloud_work)
    if dark and view.skyglow > 0.0 and through_air:
        glow = skyglow_color(ray, found.sine, to_ground, frame)
    if through_air:
        refraction = sky_lookup(ray, found, exact, frame, work)
        if to_ground:
            factors = ground_reflectances(ray, found.sine, refraction, frame, work, color)
            mu_s, _, _ = ground_angles(ray.x, ray.z, found.sine, refraction, observer, tables)
            ground_light(mu_s, observer.orders, tables, work)
            shade_ground(ray, extent.last, observer.orders, clouds, tables, work)
            if view.overlaid or dark:
                columns_to_ground(
                    ray.z, found.sine, observer, tables, work.columns_total, work.columns_so_far
                )
    if dark:
        glow = plus(glow, airglow_color(ray, found.sine, to_ground, frame, work.columns_total))
        lit = airglow_on_ground(view)
    whole, stokes_q, stokes_u = 1.0, 0.0, 0.0
    if view.filter > 0:
        whole, stokes_q, stokes_u = filter_shares(ray, view)
    for at in range(0, tables.lanes, LANES):
        radiance, light = lane_view(work.radiance, at), lane_view(cloud_work.light, at)
        total = splat(0.0)
        if through_air:
            total = maximum(radiance[0] - light[3], 0.0)
        if to_ground and view.draws_air:
            factor = ground_factor(color, view, factors, tables, work, at)
            total = total + radiance[1] * factor
            if view.overlaid:
                total = total + lamp_light(color, view, tables, work.columns_total, at)
        if dark:
            total = total + night_light(
                glow, lit, to_ground, color, view, tables, work.columns_total, at
            )
        total = light[0] + light[1] * total
        if view.filter > 0:
            total = total * np.float32(whole)
            if through_air:
                total = total + light[1] * radiance[4] * np.float32(stokes_q)
                total = total + light[1] * radiance[5] * np.float32(stokes_u)
        store(result, at, total)
    if view.draws_disc and not to_ground:
        apart = 2.0 * half_sine_between(ray, observer.seen_x, observer.seen_z)
        powers, place = whole_powers(0.0), DiscPlace(0.0, 0.0, 0.0)
        if apart < frame.reach:
            powers, place = star_disc(px, py, ray, frame, work.columns_total)
        if powers.p0 > 0.0:
            for at in range(0, tables.lanes, LANES):
                transmittance = transmittance_columns(
                    work.columns_total, lane_view(tables.extinction, at), tables.constituents
                )
                disc = darkened(powers, place, tables, at) * lane_view(cloud_work.light, at)[2]
                store(result, at, load(result, at) + transmittance * disc * np.float32(whole))


@inlined
def shade_ground(ray, distance, orders, clouds, tables, work):
    """Replace the light of clear sky on the ground by that below the clouds.

    Parameters
    ----------
    ray, distance : Vec3, float
        Direction in the observer's frame, and distance of the ground. [1], [m]
    orders : int
        Orders of scattering, see ``Observer``.
    clouds, tables, work : CloudTables, MarchTables, MarchWorkspace
        The workspace has direct and diffuse irradiance of clear sky, the light of the white ground
        behind the air, and the mirrored sky; all are changed.
    """
    point = plus(Vec3(0.0, 0.0, clouds.eye), scaled(ray, distance))
    x, y, _ = box_place(point, clouds)
    ny, nx = clouds.base_depth.shape
    inside = clouds.periodic or (-0.5 <= x < nx - 0.5 and -0.5 <= y < ny - 0.5)
    depth = beam_depth_at(point, clouds)
    wide = min(distance * clouds.pixel_angle / (0.5 * clouds.step_x * nx), 1.0)
    my, mx, _ = clouds.down.shape
    i, e = cell_before((x + 0.5) * mx / nx - 0.5, mx, clouds.periodic)
    j, f = cell_before((y + 0.5) * my / ny - 0.5, my, clouds.periodic)
    right, back = cell_after(i, mx, clouds.periodic), cell_after(j, my, clouds.periodic)
    down = lane_view(clouds.down)
    solved = (
        down[j, i] * np.float32((1.0 - e) * (1.0 - f))
        + down[j, right] * np.float32(e * (1.0 - f))
        + down[back, i] * np.float32((1.0 - e) * f)
        + down[back, right] * np.float32(e * f)
    )
    shared = lane_view(work.peaks, 0)
    shared[0] = solved
    for at in range(0, tables.lanes, LANES):
        received, behind = lane_view(work.irradiance, at), lane_view(work.radiance, at)
        spectrum = lane_view(clouds.spectrum, at)
        before = maximum(received[0] + received[1], splat(1e-30))
        sky_before = maximum(received[1], splat(1e-30))
        seen = exponential(load(clouds.scaled[0], at) * np.float32(-depth))
        seen = seen + (splat(clouds.mean_visibility) - seen) * np.float32(wide)
        received[0] = received[0] * seen
        if inside and orders != 1:
            diffuse = splat(0.0)
            for n in range(4):
                diffuse = diffuse + spectrum[n] * np.float32(work.peaks[0, n])
            received[1] = maximum(diffuse, splat(0.0))
        behind[1] = behind[1] * ((received[0] + received[1]) / before)
        if tables.ground.wet:
            ratio = received[1] / sky_before
            behind[MIRRORED] = behind[MIRRORED] * ratio
            behind[FACETS] = behind[FACETS] * ratio


@inlined
def _pixels(exact, px, py, frame, clouds, work, cloud_work, weights, out):
    """Common loop of ``render_cloudy`` and ``march_cloudy``."""
    frame, clouds, work, cloud_work, weights, out = without_refcount(
        (frame, clouds, work, cloud_work, weights, out)
    )
    lanes, view = frame.tables.lanes, frame.camera
    found, total = np.empty(lanes, np.float32), np.empty(lanes, np.float32)
    color = np.zeros(GROUND_VALUES)
    sums = np.empty((3, LANES), np.float32)
    for k in range(px.size):
        ray = camera_direction(px[k], py[k], view)
        side = samples_per_side(ray, frame.observer, view)
        share = np.float32(1.0 / (side * side))
        total[:] = 0.0
        for sample in range(side * side):
            sx, sy = px[k], py[k]
            if side > 1:
                sx, sy = sample_place(px[k], py[k], sample, side, view)
                ray = camera_direction(sx, sy, view)
            cloudy_light(sx, sy, ray, exact, frame, clouds, work, cloud_work, color, found)
            for at in range(0, lanes, LANES):
                store(total, at, load(total, at) + load(found, at) * share)
        as_color(total, weights, sums, out[k])


@compiled_loop
def render_cloudy(px, py, frame, clouds, work, cloud_work, weights, out):
    """Render pixels with the sky-view LUT.

    Parameters
    ----------
    px, py, frame, work, weights, out :
        Arguments of ``render_pixels``.
    clouds, cloud_work : CloudTables, CloudWork
        Clouds and workspace.
    """
    _pixels(False, px, py, frame, clouds, work, cloud_work, weights, out)


@compiled_loop
def march_cloudy(px, py, frame, clouds, work, cloud_work, weights, out):
    """March pixels; arguments of ``render_cloudy``."""
    _pixels(True, px, py, frame, clouds, work, cloud_work, weights, out)
