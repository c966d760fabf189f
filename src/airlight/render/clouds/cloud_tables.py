"""``CloudTables``: clouds, their light and the air before them, as the pixels read them."""

from __future__ import annotations

from typing import Annotated, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.vectors import Vec3
from airlight.kernel.shader_fields import InTexture
from airlight.render.clouds.cloud_textures import LIGHT, LINE, PLANE, SOURCE, SPECTRUM, VOLUME
from airlight.render.clouds.higher_orders import InnerSource
from airlight.render.clouds.patches import PatchEdges
from airlight.render.pixels.sky_view_window import SkyViewWindow

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Number of wavelengths at which multiple scattering in clouds is solved.
SOLVED: Final = 4
#: Indices of ``CloudTables.air``: first order [sr⁻¹], and that of two constituents without phase
#: functions [1]; transmittance [1]; higher orders in the light of the mean layer, and those of
#: clear sky less these [sr⁻¹].
FIRST: Final = 0
PEAKS: Final = 1
THROUGH: Final = 3
HIGHER: Final = 4
LOST: Final = 5
#: With polarisation: first order of what is polarised in the scattering plane, less across it, and
#: Q and U of higher orders, as above. [sr⁻¹]
FIRST_P: Final = 6
HIGHER_Q: Final = 7
LOST_Q: Final = 8
HIGHER_U: Final = 9
LOST_U: Final = 10
LAYERS: Final = 6
POLARISED_LAYERS: Final = 11
#: Parts of radiance: intensity; first order of what is polarised in the scattering plane, less
#: across it (``star_plane`` turns it, the same along the line, into Q and U); Q and U of higher
#: orders.
WHOLE: Final = 0
ONCE: Final = 1
Q: Final = 2
U: Final = 3
PARTS: Final = 4


class LayerTables(NamedTuple):
    """Clouds of one kind and their light, as the pixels read them; w is the number of lanes.

    Attributes
    ----------
    radius : float
        Radius of the ground. [m]
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
    levels, source_levels : array of int, shape (levels, 3)
        ``CellLevel`` of each level of detail, of the field and of multiple scattering; their rows
        are stacked in the arrays that follow.
    extinction : array, shape (nz, rows, nx)
        Extinction coefficient at 550 nm in the middle of cells. [m⁻¹]
    clear : array, shape (nz, rows, nx)
        Distance from any point of a cell in which there is nothing; 0 if unknown. [m]
    edges : PatchEdges
        Edges of the patches in which the box continues.
    depth : array, shape (nz, rows, nx)
        Optical depth at 550 nm from the middle of a cell to the sun. [1]
    base_depth : array, shape (rows, nx)
        The same from the lowest face of a column. [1]
    mean_visibility : float
        Mean transmittance of the beam below the clouds. [1]
    source : array, shape (mz, rows, mx, pairs, 8)
        Multiple scattering by a cloud of extinction 1, as harmonics of the direction of light:
        pairs of terms at the solved wavelengths, per irradiance of the star. [sr⁻¹]
    inner : InnerSource
        The same of the finer box, for the first level of detail.
    down : array, shape (rows, mx, 8)
        Diffuse irradiance of the ground at the solved wavelengths, twice. [1]
    solved_extinction : array, shape (1, 8)
        Scaled extinction at the solved wavelengths, twice, over that at 550 nm. [1]
    spectrum : array, shape (4, w)
        Weights of the solved wavelengths. [1]
    scaled, whole, single : array, shape (1, w)
        Scaled and unscaled extinction, and scattering, over extinction at 550 nm. [1]
    phase, phase_f12 : array, shape (nodes, 1, w)
        Phase function on even steps of sin(θ/2), and element F₁₂ of the phase matrix; the latter
        is empty without polarisation. [sr⁻¹]
    norms : array
        Result of ``harmonic_norms``.
    beam : array, shape (altitudes, angles, w)
        Direct normal irradiance between base and top, over the sine of the sun's height. [1]
    beam_low, beam_high : float
        Sines of the sun's height of the first and of the last angle. [1]
    slant : array, shape (angles,)
        Optical depth towards the sun over that towards the sun of the box. [1]
    local : array, shape (angles, levels, 8)
        Higher orders over those under the sun of the box, at the solved wavelengths, twice. [1]
    """

    radius: float
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
    levels: Annotated[NDArray[np.int64], PLANE]
    source_levels: Annotated[NDArray[np.int64], PLANE]
    extinction: Annotated[Float32Array, VOLUME]
    clear: Annotated[Float32Array, VOLUME]
    edges: PatchEdges
    depth: Annotated[Float32Array, VOLUME]
    base_depth: Annotated[Float32Array, PLANE]
    mean_visibility: float
    source: Annotated[Float32Array, SOURCE]
    inner: InnerSource
    down: Annotated[Float32Array, LIGHT]
    solved_extinction: Annotated[Float32Array, SPECTRUM]
    spectrum: Annotated[Float32Array, SPECTRUM]
    scaled: Annotated[Float32Array, SPECTRUM]
    whole: Annotated[Float32Array, SPECTRUM]
    single: Annotated[Float32Array, SPECTRUM]
    phase: Annotated[Float32Array, LIGHT]
    phase_f12: Annotated[Float32Array, LIGHT]
    norms: Annotated[FloatArray, PLANE]
    beam: Annotated[Float32Array, LIGHT]
    beam_low: float
    beam_high: float
    slant: Annotated[FloatArray, LINE]
    local: Annotated[Float32Array, LIGHT]


class CloudTables(NamedTuple):
    """Clouds of a frame and the air before them, as the pixels read them.

    Attributes
    ----------
    radius, eye : float
        Radius of the ground, and distance of the observer from the centre. [m]
    base, top : float
        Radii of the lowest base and of the highest top. [m]
    pixel_angle : float
        Angle of a pixel. [rad]
    layers : tuple of LayerTables
        Clouds by ascending tops.
    window : SkyViewWindow
        Directions of ``air``.
    air : array, shape (directions, distances, 6 or 11, w)
        Air up to a distance, by the indices below; 11 with polarisation.
    beyond : array, shape (directions, 3, w)
        ``LOST``, ``LOST_Q`` and ``LOST_U`` of the rest of the line. [sr⁻¹]
    """

    radius: float
    eye: float
    base: float
    top: float
    pixel_angle: float
    layers: tuple[LayerTables, ...]
    window: SkyViewWindow
    air: Annotated[Float32Array, InTexture("cloud_air", 3, spectral=True)]
    beyond: Annotated[Float32Array, InTexture("cloud_air", 2, spectral=True)]


class CloudWork(NamedTuple):
    """Workspace of a thread.

    Attributes
    ----------
    before : array, shape (distances, PARTS, w)
        Path radiance of the air on a line of sight. [sr⁻¹]
    through : array, shape (distances, w)
        Transmittance of the air there. [1]
    lit : array, shape (distances,)
        Transmittance of the beam by clouds between a node and the one before. [1]
    first : array, shape (2, w)
        First order of the clouds in the part of the line that is not yet attenuated by air: the
        parts ``WHOLE`` and ``ONCE``. [sr⁻¹]
    passed : array, shape (2, w)
        Transmittance of the clouds at the start of that part and now. [1]
    solved : array, shape (layers + 1, 8)
        Higher orders of each layer in that part, and transmittance, at the solved wavelengths.
    extents : array, shape (layers, 4)
        ``SightExtent`` of each layer. [m]
    found, beams, depths : array, shape (layers,)
        Extinction of each layer at a point [m⁻¹], its optical depth to the sun, and its depth so
        far [1], at 550 nm.
    numbers : array of int, shape (layers,)
        Level of detail of each layer at a point.
    light, lost : array, shape (PARTS, w)
        Results: radiance of clouds and of the air before them, and the light of clear sky less
        that with shadows, in the light of the mean layer. [sr⁻¹]
    clear : array, shape (2, w)
        Results: scaled and unscaled transmittance of the clouds. [1]
    harmonics : array, shape (2·pairs,)
        Harmonics of the direction. [1]
    """

    before: Float32Array
    through: Float32Array
    lit: FloatArray
    first: Float32Array
    solved: Float32Array
    passed: Float32Array
    extents: FloatArray
    found: FloatArray
    beams: FloatArray
    depths: FloatArray
    numbers: NDArray[np.int64]
    light: Float32Array
    lost: Float32Array
    clear: Float32Array
    harmonics: FloatArray


def new_cloud_work(clouds: CloudTables) -> CloudWork:
    """Workspace of a thread."""
    lanes = clouds.air.shape[-1]
    nodes, count = clouds.air.shape[1], len(clouds.layers)
    return CloudWork(
        before=np.zeros((nodes, PARTS, lanes), np.float32),
        through=np.zeros((nodes, lanes), np.float32),
        lit=np.ones(nodes),
        first=np.zeros((2, lanes), np.float32),
        solved=np.zeros((count + 1, 8), np.float32),
        passed=np.zeros((2, lanes), np.float32),
        extents=np.zeros((count, 4)),
        found=np.zeros(count),
        beams=np.zeros(count),
        depths=np.zeros(count),
        numbers=np.zeros(count, np.int64),
        light=np.zeros((PARTS, lanes), np.float32),
        lost=np.zeros((PARTS, lanes), np.float32),
        clear=np.zeros((2, lanes), np.float32),
        harmonics=np.zeros(2 * max(layer.source.shape[3] for layer in clouds.layers)),
    )
