"""``CloudLight``: light of a cloud field in a planet's air, and the tables of its pixels."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from dataclasses import field as field_of_class
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics
from airlight.kernel.cache import Cache
from airlight.kernel.threads import Cancel, Progress
from airlight.render.clouds.beam_depth import LONG_STEP, STEP, beam_depths
from airlight.render.clouds.box_air import box_air, with_deck
from airlight.render.clouds.clear_distance import clear_distances
from airlight.render.clouds.cloud_deck import CloudDeck, solved_wavelengths
from airlight.render.clouds.cloud_tables import SOLVED
from airlight.render.clouds.incident_light import Incident, OtherClouds, incident, sun_over
from airlight.render.clouds.inner_box import inner_field
from airlight.render.clouds.local_sun import LocalSun, local_suns, same_everywhere
from airlight.render.clouds.mean_layer import MeanLayer
from airlight.solver.boxes.directions import directions
from airlight.solver.boxes.light import BoxAir, BoxBeam, BoxLight
from airlight.solver.boxes.nest import Nest
from airlight.solver.boxes.settings import settings_for
from airlight.solver.boxes.solution import BoxSolution
from airlight.solver.boxes.solve import solve_box

if TYPE_CHECKING:
    from airlight.scene import Scene
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Largest number of cells of the boxes that are solved, and of those of large fields; number of
#: cells above which a field is large; and number of levels that are not joined.
MOST_SOLVED: Final = 640_000
MOST_OF_LARGE: Final = 1_100_000
#: Detail of light: that of still pictures, of live ones, and a first one without a finer box, with
#: longer steps of beams and few directions; and largest numbers of cells of the latter two. Wider
#: columns close gaps: with a quarter of the cells cumuli over the sea are 7 % too bright in red.
STILL, LIVE, FIRST = "still", "live", "first"
MOST_LIVE: Final = {LIVE: 160_000, FIRST: 160_000}
QUICK_BOX: Final = replace(settings_for("preview"), zenith_angles=2, tolerance=2e-2)
LARGE: Final = 4_000_000
FEWEST_LEVELS: Final = 8
#: Zenith angles and azimuths of the light of the ground.
_AROUND: Final = (4, 8)
#: Largest zenith angle of the sun of a box that is seen from far away. [deg]
LOWEST: Final = 85.0
#: Singular value over the largest below which spectra of beam and sky count as alike. [1]
_ALIKE: Final = 1e-6


@dataclass(frozen=True, eq=False, kw_only=True)
class CloudLight:
    """Light of a cloud field under one light of a planet.

    Attributes
    ----------
    field : CloudField
    optics : CloudOptics
        At the wavelengths of the solution.
    box : BoxSolution
        Multiple scattering at some of these wavelengths, per irradiance of the star.
    inner : BoxSolution or None
        The same in a finer box in the middle of the field.
    towards : tuple of three float
        Unit vector to the light of the box: east, north, up. [1]
    local : LocalSun
        Light under suns of other places.
    spectrum : array, shape (SOLVED, nl)
        Weights of the solved wavelengths. [1]
    layer : MeanLayer or None
        Mean layer, whose light the air scatters; None without cloudy columns.
    diffuse : array, shape (2, 2, nl)
        Diffuse irradiance below and above the clouds, from above and from below, over that of clear
        sky. [1]
    depth, base_depth : array
        Results of ``beam_depths``.
    clear : array
        Result of ``clear_distances``.
    arrays : Cache
        Tables of the last frame, which the next may share.
    """

    field: CloudField
    optics: CloudOptics
    box: BoxSolution
    inner: BoxSolution | None
    towards: tuple[float, float, float]
    local: LocalSun
    spectrum: FloatArray
    layer: MeanLayer | None
    diffuse: FloatArray
    depth: Float32Array
    base_depth: Float32Array
    clear: Float32Array
    arrays: Cache[tuple[Any, ...], dict[str, Any]] = field_of_class(
        default_factory=lambda: Cache(1)
    )

    @property
    def scaled(self) -> FloatArray:
        """Delta-M scaled extinction over that at 550 nm, shape (nl,). [1]"""
        optics = self.optics
        moments = optics.phase.moments(optics.wavelengths, self.box.settings.degree + 1)
        truncated = np.clip(moments[:, -1] / moments[:, 0], 0.0, 1.0)
        return np.asarray(optics.extinction * (1.0 - optics.albedo * truncated))

    def visibility(self, altitude: float) -> FloatArray:
        """Mean transmittance of the beam by the clouds above an altitude [m], shape (nl,). [1]"""
        field = self.field
        share = (field.top - max(field.base, altitude)) / (field.top - field.base)
        depth = max(share, 0.0) * self.base_depth.astype(np.float64).ravel()
        return np.array([np.exp(-depth * one).mean() for one in self.scaled])


def _raised(towards: tuple[float, float, float]) -> tuple[float, float, float]:
    """Direction with a zenith angle of at most ``LOWEST``."""
    out, up = math.sin(math.radians(LOWEST)), math.cos(math.radians(LOWEST))
    across = math.hypot(towards[0], towards[1])
    if towards[2] >= up:
        return towards
    if across < 1e-6:
        return out, 0.0, up
    return out * towards[0] / across, out * towards[1] / across, up


def solve_clouds(
    solution: MomentsSolution,
    scene: Scene,
    deck: CloudDeck,
    around: OtherClouds,
    *,
    solved_at: Sequence[tuple[float, Scene]] = (),
    wide: bool = False,
    detail: str = STILL,
    quality: str = "default",
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> CloudLight:
    """Solve the light of clouds in the air of a planet.

    Parameters
    ----------
    solution : MomentsSolution
        Solution of the planet, under the light.
    scene : Scene
        Scene of this light.
    deck : CloudDeck
        Clouds.
    around : OtherClouds
        Other clouds.
    solved_at : sequence of (float, Scene), optional
        Weights and scenes of the same place between which higher orders are interpolated, see
        ``blended``; by default they are those of ``scene``.
    wide : bool
        Whether clouds are seen so far away that other suns are above them, which are solved too;
        the box has a sun that is not lower than ``LOWEST`` then.
    detail : str
        ``STILL``, ``LIVE`` or ``FIRST``.
    quality, cache : str, bool
        As for ``solve_box``.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.
    """
    field, optics_at, nm = deck.field, deck.optics_at, solution.medium.wavelengths
    chosen = solved_wavelengths(nm.size)
    joined = coarse_field(field, MOST_LIVE.get(detail))
    finer = None if detail == FIRST else inner_field(field, joined, deck.place)

    def sun_of(one: Scene) -> tuple[float, float, float]:
        sun = sun_over(field, one)
        return _raised(sun) if wide else sun

    light = incident(solution, field, sun_of(scene), around)
    air = clear = box_air(solution, field.top, chosen)
    for other in around.decks:
        air = with_deck(air, other, nm[chosen])

    def box_of(cells: CloudField, one: Incident, nest: Nest | None = None) -> BoxSolution:
        return solve_box(
            cells,
            optics_at(nm[chosen]),
            _box_light(solution, (air, clear), one, chosen),
            nest=nest,
            quality=QUICK_BOX if detail == FIRST else quality,
            cache=cache,
            progress=progress,
            cancel=cancel,
        )

    def boxes_under(one: Incident) -> list[BoxSolution]:
        box = box_of(joined, one)
        return [box] if finer is None else [box, box_of(finer, one, Nest(box, field))]

    if solved_at:
        suns = [(weight, sun_of(one)) for weight, one in solved_at]
        others = [(weight, incident(solution, field, sun, around)) for weight, sun in suns]
        parts = [(weight, one, boxes_under(one)) for weight, one in others]
        boxes = [
            blended([(weight, one, some[n]) for weight, one, some in parts], light, chosen)
            for n in range(len(parts[0][2]))
        ]
    else:
        boxes = boxes_under(light)
    box = boxes[0]

    def under(cells: CloudField, sun: tuple[float, float, float]) -> tuple[BoxSolution, FloatArray]:
        one = incident(solution, field, sun, around)
        return box_of(cells, one), one.irradiance[chosen]

    if wide:
        local = local_suns(joined, light.towards, under)
    else:
        local = same_everywhere(joined.extinction.shape[2], chosen.size)
    nothing = clear_distances(field)
    depth, base_depth = beam_depths(
        field,
        nothing,
        light.towards,
        solution.medium.bottom_radius,
        step=LONG_STEP if detail == FIRST else STEP,
        progress=progress,
        cancel=cancel,
    )
    spectrum = box_spectrum(nm, chosen, light.beam, light.sky)
    without = incident(solution, field, light.towards, OtherClouds())
    cloudy, clear = _hemispheres(solution, box, spectrum, (light, without))
    return CloudLight(
        field=field,
        optics=optics_at(nm),
        box=box,
        inner=boxes[1] if len(boxes) > 1 else None,
        towards=light.towards,
        local=local,
        spectrum=spectrum,
        layer=around.layer,
        diffuse=np.maximum(cloudy / np.maximum(clear, 1e-30), 0.0),
        depth=depth,
        base_depth=base_depth,
        clear=nothing,
    )


def blended(
    parts: Sequence[tuple[float, Incident, BoxSolution]],
    light: Incident,
    chosen: NDArray[np.int64],
) -> BoxSolution:
    r"""Box between boxes under a light at other places.

    The light over that which falls on the horizontal top is interpolated, so that the change of the
    latter, a factor of three per degree of twilight, is exact:

    .. math:: L = E \sum_k w_k L_k / E_k

    Parameters
    ----------
    parts : sequence of (float, Incident, BoxSolution)
        Weights [1], and light and solution of each box.
    light : Incident
        Light on the box.
    chosen : array of int, shape (solved,)
        Indices of the solved wavelengths.
    """
    total: dict[str, Any] = {}
    for weight, one, box in parts:
        factor = weight * (light.irradiance / one.irradiance)[chosen]
        for name in ("moments", "down", "direct", "up"):
            part = getattr(box, name) * factor.astype(np.float32)
            total[name] = total[name] + part if name in total else part
    return replace(parts[0][2], **total)


def _box_light(
    solution: MomentsSolution,
    airs: tuple[BoxAir, BoxAir],
    light: Incident,
    chosen: NDArray[np.int64],
) -> BoxLight:
    """Light of a box at the solved wavelengths, with air and that of the clear planet."""
    air, clear = airs
    albedo = np.broadcast_to(solution.medium.ground_albedo, light.beam.shape)
    return BoxLight(
        towards=light.towards,
        albedo=albedo[chosen],
        ground=0.0,
        sky=lambda along: np.asarray(light.radiance(along)[:, chosen]),
        air=air,
        beam=BoxBeam(
            irradiance=lambda altitudes: np.asarray(light.direct(altitudes)[:, chosen]),
            radius=solution.medium.bottom_radius,
            air=None if air is clear else clear,
        ),
    )


def coarse_field(field: CloudField, most: int | None = None) -> CloudField:
    """Field of fewer cells to be solved, by means over neighbours where they are closest.

    Those are mostly levels: columns side by side would close gaps between small clouds.

    Parameters
    ----------
    field : CloudField
        Clouds.
    most : int, optional
        Largest number of cells.
    """
    found = field
    if most is None:
        most = MOST_SOLVED if field.extinction.size <= LARGE else MOST_OF_LARGE
    while found.extinction.size > most:
        shape, spacing = found.extinction.shape, found.spacing
        halved = [axis for axis in (0, 1, 2) if shape[axis] % 2 == 0]
        if 2 in halved and shape[2] > FEWEST_LEVELS and spacing[2] <= min(spacing[:2]):
            halved = [2]
        else:
            halved = [axis for axis in halved if axis < 2]
        if not halved:
            return found
        x, y, z = (2 if axis in halved else 1 for axis in range(3))
        cells = found.extinction.reshape(shape[0] // x, x, shape[1] // y, y, shape[2] // z, z)
        found = replace(
            found,
            extinction=cells.mean(axis=(1, 3, 5), dtype=np.float32),
            spacing=(spacing[0] * x, spacing[1] * y, spacing[2] * z),
        )
    return found


def box_spectrum(
    wavelengths: FloatArray, chosen: NDArray[np.int64], beam: FloatArray, sky: FloatArray
) -> FloatArray:
    r"""Weights that give the light at all wavelengths from that at the solved ones.

    Clouds scatter all colours alike, so that their light is a mixture of that of the beam and of
    the sky, each with a factor linear in wavelength:

    .. math:: L = (a + b\lambda) E_\odot + (c + d\lambda) E_s

    Parameters
    ----------
    wavelengths : array, shape (nl,)
        Wavelengths. [nm]
    chosen : array of int, shape (solved,)
        Indices of the solved wavelengths.
    beam, sky : array, shape (nl,)
        Spectra of the light that falls on the clouds. [1]

    Returns
    -------
    array, shape (SOLVED, nl)
        Weights; 0 for wavelengths that are not there. [1]

    Examples
    --------
    >>> nm, beam = np.linspace(400.0, 700.0, 7), np.linspace(1.0, 2.0, 7)
    >>> sky, chosen = (500.0 / nm) ** 4, np.array([0, 2, 4, 6])
    >>> mixed = 0.3 * beam + (0.2 + 1e-3 * nm) * sky
    >>> bool(np.allclose(mixed[chosen] @ box_spectrum(nm, chosen, beam, sky), mixed))
    True
    """
    slope = (wavelengths - wavelengths.mean()) / max(np.ptp(wavelengths), 1.0)
    spectra = [one / max(one.max(), 1e-30) for one in (beam, sky)]
    basis = np.stack([one * factor for one in spectra for factor in (1.0, slope)], axis=1)
    weights = np.zeros((SOLVED, wavelengths.size))
    weights[: chosen.size] = (basis @ np.linalg.pinv(basis[chosen], rcond=_ALIKE)).T
    return weights


def _hemispheres(
    solution: MomentsSolution,
    box: BoxSolution,
    spectrum: FloatArray,
    lights: tuple[Incident, Incident],
) -> FloatArray:
    """Irradiances below and above the clouds, from above and from below, shape (2, 2, 2, nl). [1]

    The first axis is with clouds and without, as of ``lights``.
    """
    light, without = lights
    medium = solution.medium
    ground, mu_s = np.array([medium.bottom_radius]), np.array([light.towards[2]])
    albedo = np.broadcast_to(medium.ground_albedo, medium.wavelengths.shape)
    sky = solution.relative_sky_irradiance(ground, mu_s)[0]
    sun = solution.relative_direct_irradiance(ground, mu_s)[0]
    below, direct, up = (
        one.mean((0, 1), dtype=np.float64) @ spectrum[: one.shape[-1]]
        for one in (box.down, box.direct, box.up)
    )
    rays = directions(*_AROUND)
    rising = np.einsum(
        "n,nw->w",
        (rays.weights[1] * rays.vectors[1, :, :, 2]).ravel(),
        without.radiance(rays.vectors[1].reshape(-1, 3)),
    )
    cloudy = np.array([[below, albedo * (below + direct)], [light.sky, up]])
    clear = np.array([[sky, albedo * (sky + sun)], [without.sky, rising]])
    return np.stack([cloudy, clear])
