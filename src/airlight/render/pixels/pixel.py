"""Spectral radiance of one pixel, from the sky-view LUT or marched."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import numpy as np

from airlight.geometry.vectors import Vec3, plus, scaled
from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, lane_view, load, splat, store
from airlight.kernel.shader_fields import CHOICE, SPECTRA, Always, InTexture, scalars
from airlight.physics.optics.clouds import GroundFactors
from airlight.render.pixels.airglow import airglow_color, airglow_on_ground, by_night, night_light
from airlight.render.pixels.deck import shade_deck
from airlight.render.pixels.disc_shading import DiscPlace, MoonPhase, darkened, whole_powers
from airlight.render.pixels.ground import ground_factor, ground_reflectances, lamp_light
from airlight.render.pixels.ground_angles import columns_to_ground
from airlight.render.pixels.haze_removal import kept_haze, removed_haze
from airlight.render.pixels.longer_columns import lengthen
from airlight.render.pixels.oblate import displaced_line
from airlight.render.pixels.polarising_filter import filter_shares
from airlight.render.pixels.ring_light import ring_light
from airlight.render.pixels.ring_shine import add_ring_shine
from airlight.render.pixels.sky_lookup import classify_ray, sky_lookup
from airlight.render.pixels.sky_view_lut import Observer, half_sine_between
from airlight.render.pixels.sky_view_window import SkyViewWindow
from airlight.render.pixels.skyglow import skyglow_color
from airlight.render.pixels.skyline import haze_beyond
from airlight.render.pixels.star_disc import star_disc
from airlight.solver.moments.march_tables import MarchTables
from airlight.solver.moments.source import transmittance_columns


class LampColor(NamedTuple):
    """Colour of city lights, radiance per irradiance of the star and map value. [sr⁻¹]"""

    red: float
    green: float
    blue: float


class ViewUniforms(NamedTuple):
    """Camera, ground maps, sky-view LUT and discs: uniforms and textures of a pixel."""

    width: float
    height: float
    field_of_view: float
    projection: Annotated[int, CHOICE]
    right: Vec3
    up: Vec3
    forward: Vec3
    pixel_angle: float
    disc: float
    draws_disc: bool
    draws_air: bool
    phased: bool
    phase: MoonPhase
    limb: Vec3
    faced: bool
    occulter: Vec3
    occulter_radius: float
    samples: Annotated[int, CHOICE]
    edges: bool
    mapped: bool
    map_rows: int
    map_columns: int
    map_levels: int
    decked: bool
    deck_altitude: float
    deck_radius: float
    deck_gain: Vec3
    sky_columns: int
    sky_rows: int
    separated_phases: bool
    overlaid: bool
    clouded: bool
    clouds_from_space: bool
    relieved: bool
    rocks: float
    craters: float
    weathered: bool
    water: Vec3
    grain: Vec3
    grain_fall: float
    cloud_altitude: float
    cloud_radius: float
    detailed: bool
    detail_cell: float
    whole: Vec3
    part: Vec3
    over_rows: int
    over_columns: int
    over_levels: int
    lamp: LampColor
    airglow: float
    skyglow: float
    shines: Annotated[int, Always(0)]
    filter: Annotated[int, CHOICE]
    dehaze: float
    texels: Annotated[np.ndarray, InTexture("ground", packed=True)]
    over_texels: Annotated[np.ndarray, InTexture("overlay", packed=True)]
    sky_air: Annotated[np.ndarray, InTexture("air", spectral=True, whole=True)]
    sky_ground: Annotated[np.ndarray, InTexture("behind", spectral=True, whole=True)]
    sky_first: Annotated[np.ndarray, InTexture("first", spectral=True, whole=True)]
    sky_second: Annotated[np.ndarray, InTexture("second", spectral=True, whole=True)]
    sky_q: Annotated[np.ndarray, InTexture("stokes_q", spectral=True, whole=True)]
    sky_u: Annotated[np.ndarray, InTexture("stokes_u", spectral=True, whole=True)]
    sky_mirrored: Annotated[np.ndarray, InTexture("mirrored", spectral=True, whole=True)]
    airglow_layers: Annotated[np.ndarray, scalars(2)]
    airglow_extinction: Annotated[np.ndarray, scalars(2)]
    skyglow_layers: Annotated[np.ndarray, scalars(2)]
    shine: Annotated[np.ndarray, SPECTRA]
    shine_directions: Annotated[np.ndarray, scalars(2)]


class FrameTables(NamedTuple):
    """Everything that the pixels of a frame read.

    Attributes
    ----------
    reach : float
        Largest angle between the apparent star and a visible point of its disc. [rad]
    window : SkyViewWindow
        Window of the sky-view LUT.
    observer, camera, tables : Observer, ViewUniforms, MarchTables
        Observer, camera with its maps, and tables of the solution.
    """

    reach: float
    window: SkyViewWindow
    observer: Observer
    camera: ViewUniforms
    tables: MarchTables


class SeenLine(NamedTuple):
    """What is seen along a line of sight.

    Attributes
    ----------
    through_air, to_ground, dark : bool
        Whether the air is drawn, whether the line ends on the ground, and whether the light of the
        night is drawn.
    refraction : float
        Refraction angle of a line that ends on the ground. [rad]
    factors : GroundFactors
        Reflectances of the ground.
    dehaze : float
        Fraction of haze that is removed, ``removed_haze``. [1]
    glow, lit : Vec3
        Arguments of ``night_light``.
    whole, stokes_q, stokes_u : float
        Weights of I, Q and U, ``filter_shares``. [1]
    """

    through_air: bool
    to_ground: bool
    dark: bool
    refraction: float
    factors: GroundFactors
    dehaze: float
    glow: Vec3
    lit: Vec3
    whole: float
    stokes_q: float
    stokes_u: float


@inlined
def seen_line(ray, found, exact, observer, frame, work, color):
    """``SeenLine`` of a line of sight; its light and columns are in the workspace.

    Parameters
    ----------
    found : ClassifiedRay
        Class of the line.
    ray, exact, observer, frame, work, color :
        Arguments of ``pixel_light``, and the observer.
    """
    view = frame.camera
    through_air, to_ground = found.through_air and view.draws_air, found.to_ground
    factors, refraction, dehaze = GroundFactors(1.0, 0.0, 1.0, 0.0, 0.0), 0.0, 0.0
    dark = by_night(ray, found.sine, to_ground, observer, frame)
    glow, lit = Vec3(0.0, 0.0, 0.0), Vec3(0.0, 0.0, 0.0)
    if dark and view.skyglow > 0.0 and through_air:
        glow = skyglow_color(ray, found.sine, to_ground, observer, frame)
    if through_air:
        refraction = sky_lookup(ray, found, exact, observer, frame, work)
        if to_ground:
            factors = ground_along(ray, found.sine, refraction, dark, observer, frame, work, color)
            if view.dehaze > 0.0:
                dehaze = removed_haze(ray, found.sine, refraction, observer, frame)
            if view.clouded:
                glow = scaled(glow, 1.0 - color[9])
    if dark:
        glow = plus(
            glow, airglow_color(ray, found.sine, to_ground, observer, frame, work.columns_total)
        )
        lit = airglow_on_ground(view)
    whole, stokes_q, stokes_u = 1.0, 0.0, 0.0
    if view.filter > 0:
        whole, stokes_q, stokes_u = filter_shares(ray, observer, view)
    return SeenLine(
        through_air,
        to_ground,
        dark,
        refraction,
        factors,
        dehaze,
        glow,
        lit,
        whole,
        stokes_q,
        stokes_u,
    )


@inlined
def ground_along(ray, sine, refraction, dark, observer, frame, work, color):
    """Reflectances of the ground at the end of a line of sight: ``GroundFactors``.

    Parameters
    ----------
    ray, sine, refraction : Vec3, float, float
        Direction of the line, sine of its zenith angle, and its refraction angle. [1], [rad]
    dark : bool
        Whether the light of the night is drawn; for it and lamps, ``columns_total`` of the
        workspace receives the columns to the ground.
    observer, frame, work, color :
        Arguments of ``pixel_light``, and the observer.
    """
    factors = ground_reflectances(ray, sine, refraction, observer, frame, work, color)
    if frame.camera.overlaid or frame.camera.dehaze > 0.0 or dark:
        columns_to_ground(
            ray.z, sine, observer, frame.tables, work.columns_total, work.columns_so_far
        )
    return factors


@inlined
def ground_radiance(white, factors, color, frame, work, at):
    """Spectral radiance of ground and lamps behind the air, per irradiance of the star. [sr⁻¹]

    Parameters
    ----------
    white : lanes
        Radiance of a white ground there. [sr⁻¹]
    factors : GroundFactors
        Result of ``ground_reflectances``.
    frame, work, color :
        Arguments of ``pixel_light``.
    at : int
        Index of the first lane.
    """
    view, tables = frame.camera, frame.tables
    total = white * ground_factor(color, view, factors, tables, work, at)
    if view.overlaid:
        total = total + lamp_light(color, view, tables, work.columns_total, at)
    return total


@inlined
def line_radiance(air, seen, color, frame, work, at):
    """Spectral radiance along a line of sight, without the disc and the filter. [sr⁻¹]

    Parameters
    ----------
    air : lanes
        Path radiance. [sr⁻¹]
    seen : SeenLine
        Result of ``seen_line``.
    color, frame, work, at :
        Arguments of ``ground_radiance``.
    """
    view, tables = frame.camera, frame.tables
    radiance = lane_view(work.radiance, at)
    total = splat(0.0)
    if seen.through_air:
        total = air
        if seen.dehaze > 0.0:
            kept = kept_haze(seen.dehaze, tables, work.columns_total, at)
            total = air * kept
            if view.filter > 0:
                radiance[4] = radiance[4] * kept
                radiance[5] = radiance[5] * kept
    if seen.to_ground and view.draws_air:
        total = total + ground_radiance(radiance[1], seen.factors, color, frame, work, at)
    if seen.dark:
        total = total + night_light(
            seen.glow, seen.lit, seen.to_ground, color, view, tables, work.columns_total, at
        )
    return total


@inlined
def filtered(total, seen, view, work, at):
    """Radiance behind the polarising filter. [sr⁻¹]

    Parameters
    ----------
    total : lanes
        Radiance before it; Q and U are in the workspace. [sr⁻¹]
    seen, view, work, at :
        Arguments of ``line_radiance``, and the camera.
    """
    radiance = lane_view(work.radiance, at)
    if view.filter > 0:
        total = total * np.float32(seen.whole)
        if seen.through_air:
            total = total + radiance[4] * np.float32(seen.stokes_q)
            total = total + radiance[5] * np.float32(seen.stokes_u)
    return total


@inlined
def seen_disc(px, py, ray, frame, columns):
    """Part of the star's disc in a pixel on the sky: results of ``star_disc``, zero outside.

    Parameters
    ----------
    px, py, ray, frame :
        Arguments of ``pixel_light``.
    columns : array, shape (nc,)
        Receives the columns of the line. [m]
    """
    observer = frame.observer
    apart = 2.0 * half_sine_between(ray, observer.seen_x, observer.seen_z)
    powers, place = whole_powers(0.0), DiscPlace(0.0, 0.0, 0.0)
    if apart < frame.reach:
        powers, place = star_disc(px, py, ray, frame, columns)
    return powers, place


@inlined
def disc_light(powers, place, whole, tables, columns, at):
    """Spectral radiance of the disc behind the air and the filter, per irradiance. [sr⁻¹]

    Parameters
    ----------
    powers, place, columns :
        Results of ``seen_disc``.
    whole : float
        Weight of Stokes I. [1]
    tables, at : MarchTables, int
        Tables of the solution, and index of the first lane.
    """
    transmittance = transmittance_columns(
        columns, lane_view(tables.extinction, at), tables.constituents
    )
    return transmittance * darkened(powers, place, tables, at) * np.float32(whole)


@inlined
def store_line(seen, frame, work, color, result):
    """Store the light of air and ground along a line of sight, behind the filter. [sr⁻¹]

    Parameters
    ----------
    seen : SeenLine
        Result of ``seen_line``.
    frame, work, color, result :
        Arguments of ``pixel_light``.
    """
    for at in range(0, frame.tables.lanes, LANES):
        radiance = lane_view(work.radiance, at)
        total = line_radiance(radiance[0], seen, color, frame, work, at)
        store(result, at, filtered(total, seen, frame.camera, work, at))


@inlined
def add_beyond_air(px, py, ray, found, seen, frame, work, result):
    """Add rings and the star's disc, and what they do to the light of air and ground.

    Parameters
    ----------
    px, py, ray, found, seen, frame, work, result :
        Arguments of ``ring_light``.
    """
    tables, whole = frame.tables, seen.whole
    if tables.rings.ringed:
        whole = ring_light(px, py, ray, found, seen, frame, work, result)
    if frame.camera.draws_disc and not seen.to_ground:
        powers, place = seen_disc(px, py, ray, frame, work.columns_total)
        if powers.p0 > 0.0:
            for at in range(0, tables.lanes, LANES):
                disc = disc_light(powers, place, whole, tables, work.columns_total, at)
                store(result, at, load(result, at) + disc)


@inlined
def pixel_light(px, py, ray, beyond, exact, frame, work, color, result):
    """Spectral radiance of a pixel, per irradiance of the star. [sr⁻¹]

    Parameters
    ----------
    px, py : float
        Position from the left and top edge of the frame. [pixel]
    ray, beyond : Vec3, float
        Result of ``seen_hill`` for the viewing direction there. [1]
    exact : bool
        Constant: whether the pixel is marched.
    frame : FrameTables
        What the pixels read.
    work, color : MarchWorkspace, array of shape (12,)
        Workspace.
    result : array, shape (w,)
        Receives the radiance. [sr⁻¹]
    """
    found = classify_ray(ray, frame.observer, frame.tables)
    seen = seen_line(ray, found, exact, frame.observer, frame, work, color)
    if beyond > 1.0:
        haze_beyond(ray, found.sine, beyond, frame, work)
    store_line(seen, frame, work, color, result)
    if frame.camera.shines > 0 and seen.through_air:
        add_ring_shine(ray, found, seen, frame.observer, frame, work, color, result)
    shade_deck(ray, found, frame.observer, frame, color, result)
    add_beyond_air(px, py, ray, found, seen, frame, work, result)


@inlined
def oblate_light(px, py, ray, beyond, exact, frame, work, color, result):
    """Spectral radiance of a pixel of a planet that may be oblate. [sr⁻¹]

    Parameters
    ----------
    px, py, ray, beyond, exact, frame, work, color, result :
        Arguments of ``pixel_light``; every pixel is marched.
    """
    moved = displaced_line(ray, frame.observer, frame.tables)
    found = classify_ray(moved.ray, moved.observer, frame.tables)
    seen = seen_line(moved.ray, found, exact, moved.observer, frame, work, color)
    if seen.through_air and moved.longer != 1.0:
        lengthen(moved.longer, frame.tables.scaled_extinction, frame, work)
        for c in range(frame.tables.constituents):
            work.columns_total[c] *= moved.longer
    if beyond > 1.0:
        haze_beyond(moved.ray, found.sine, beyond, frame, work)
    store_line(seen, frame, work, color, result)
    if frame.camera.shines > 0 and seen.through_air:
        add_ring_shine(moved.ray, found, seen, moved.observer, frame, work, color, result)
    shade_deck(moved.ray, found, moved.observer, frame, color, result)
    add_beyond_air(px, py, ray, found, seen, frame, work, result)
