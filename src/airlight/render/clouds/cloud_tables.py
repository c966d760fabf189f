"""``CloudTables``: clouds, their light and the air before them, as the pixels read them."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.vectors import Vec3
from airlight.render.clouds.patches import PatchEdges
from airlight.render.pixels.sky_view_window import SkyViewWindow

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Number of wavelengths at which multiple scattering in clouds is solved.
SOLVED: Final = 4


class CloudTables(NamedTuple):
    """Clouds as the pixels read them; w is the number of lanes of a picture.

    Attributes
    ----------
    radius, eye : float
        Radius of the ground, and distance of the observer from the centre. [m]
    base, top : float
        Radii of the lowest and of the highest faces of the box. [m]
    corner_x, corner_y : float
        Coordinates of the western and southern faces. [m]
    step_x, step_y, step_z : float
        Width of a cell to the east, to the north and upwards. [m]
    periodic : bool
        Whether the box repeats itself sideways.
    detailed : bool
        Whether extinction has detail below the cells.
    trail : float
        Displacement of trails to the west over the square of the depth below the top. [m⁻¹]
    east, north, up : Vec3
        Axes of the box's place in the observer's frame. [1]
    sun : Vec3
        Direction to the sun in the observer's frame. [1]
    pixel_angle : float
        Angle of a pixel. [rad]
    mean_visibility : float
        Mean transmittance of the beam below the clouds. [1]
    extinction : array, shape (nz, ny, nx)
        Extinction coefficient at 550 nm in the middle of cells. [m⁻¹]
    clear : array, shape (nz, ny, nx)
        Distance from any point of a cell in which there is nothing; 0 if unknown. [m]
    edges : PatchEdges
        Edges of the patches in which the box continues.
    depth : array, shape (nz, ny, nx)
        Optical depth at 550 nm from the middle of a cell to the sun. [1]
    base_depth : array, shape (ny, nx)
        The same from the lowest face of a column. [1]
    source : array, shape (mz, my, mx, pairs, 8)
        Multiple scattering by a cloud of extinction 1, as harmonics of the direction of light:
        pairs of terms at the solved wavelengths, per irradiance of the star. [sr⁻¹]
    down : array, shape (my, mx, 8)
        Diffuse irradiance of the ground at the solved wavelengths, twice. [1]
    solved_extinction : array, shape (1, 8)
        Scaled extinction at the solved wavelengths, twice, over that at 550 nm. [1]
    spectrum : array, shape (4, w)
        Weights of the solved wavelengths. [1]
    scaled, whole, single : array, shape (1, w)
        Scaled and unscaled extinction, and scattering, over extinction at 550 nm. [1]
    phase : array, shape (nodes, 1, w)
        Phase function on even steps of sin(θ/2). [sr⁻¹]
    norms : array
        Result of ``harmonic_norms``.
    beam : array, shape (altitudes, angles, w)
        Direct normal irradiance between base and top, over the sine of the sun's height. [1]
    beam_low, beam_high : float
        Sines of the sun's height of the first and of the last angle. [1]
    air_light : array, shape (2, w)
        Diffuse light below the bases, and above them, over that of clear sky: factors of the higher
        orders of scattering in the air. [1]
    window : SkyViewWindow
        Directions of ``air``.
    air : array, shape (directions, distances, 5, w)
        Path radiance of the air up to a distance: first order [sr⁻¹], that of two constituents
        without phase functions [1], higher orders [sr⁻¹]; and transmittance [1].
    """

    radius: float
    eye: float
    base: float
    top: float
    corner_x: float
    corner_y: float
    step_x: float
    step_y: float
    step_z: float
    periodic: bool
    detailed: bool
    trail: float
    east: Vec3
    north: Vec3
    up: Vec3
    sun: Vec3
    pixel_angle: float
    mean_visibility: float
    extinction: Float32Array
    clear: Float32Array
    edges: PatchEdges
    depth: Float32Array
    base_depth: Float32Array
    source: Float32Array
    down: Float32Array
    solved_extinction: Float32Array
    spectrum: Float32Array
    scaled: Float32Array
    whole: Float32Array
    single: Float32Array
    phase: Float32Array
    norms: FloatArray
    beam: Float32Array
    beam_low: float
    beam_high: float
    air_light: Float32Array
    window: SkyViewWindow
    air: Float32Array


class CloudWork(NamedTuple):
    """Workspace of a thread.

    Attributes
    ----------
    before, through : array, shape (distances, w)
        Path radiance [sr⁻¹] and transmittance [1] of the air on a line of sight.
    first, solved, passed : array, shape (2, w), (2, 8), (2, w)
        Radiance of the clouds in the first order and in higher orders, of the part of the line
        that is not yet attenuated by air and of the whole line; transmittance at its start and now.
    light : array, shape (4, w)
        Result: radiance [sr⁻¹], scaled and unscaled transmittance [1] of the clouds, and the light
        that the air loses by shadows [sr⁻¹].
    harmonics : array, shape (2·pairs,)
        Harmonics of the direction. [1]
    """

    before: Float32Array
    through: Float32Array
    first: Float32Array
    solved: Float32Array
    passed: Float32Array
    light: Float32Array
    harmonics: FloatArray


def new_cloud_work(clouds: CloudTables) -> CloudWork:
    """Workspace of a thread."""
    lanes = clouds.air.shape[-1]
    nodes = clouds.air.shape[1]
    return CloudWork(
        before=np.zeros((nodes, lanes), np.float32),
        through=np.zeros((nodes, lanes), np.float32),
        first=np.zeros((2, lanes), np.float32),
        solved=np.zeros((2, 8), np.float32),
        passed=np.zeros((2, lanes), np.float32),
        light=np.zeros((4, lanes), np.float32),
        harmonics=np.zeros(2 * clouds.source.shape[3]),
    )
