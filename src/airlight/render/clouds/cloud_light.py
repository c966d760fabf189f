"""``CloudLight``: light of a cloud field in a planet's air, and the tables of its pixels."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics
from airlight.geometry.vectors import Vec3
from airlight.kernel.threads import Cancel, Progress
from airlight.render.clouds.beam_depth import beam_depths
from airlight.render.clouds.box_air import box_air, with_deck
from airlight.render.clouds.clear_distance import clear_distances
from airlight.render.clouds.cloud_deck import CloudDeck, solved_wavelengths
from airlight.render.clouds.cloud_tables import SOLVED
from airlight.render.clouds.mean_layer import MeanLayer
from airlight.scene import Scene
from airlight.solver.boxes.directions import directions
from airlight.solver.boxes.light import BoxAir, BoxBeam, BoxLight
from airlight.solver.boxes.solution import BoxSolution
from airlight.solver.boxes.solve import solve_box
from airlight.solver.lines_of_sight import enter_shell
from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Largest number of cells of the boxes that are solved, and of those of large fields; number of
#: cells above which a field is large; and number of levels that are not joined.
MOST_SOLVED: Final = 640_000
MOST_OF_LARGE: Final = 1_100_000
LARGE: Final = 4_000_000
FEWEST_LEVELS: Final = 8
#: Zenith angles and azimuths of the light of the ground.
_AROUND: Final = (4, 8)
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
    towards : tuple of three float
        Unit vector to the light at the place of the field: east, north, up. [1]
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
    """

    field: CloudField
    optics: CloudOptics
    box: BoxSolution
    towards: tuple[float, float, float]
    spectrum: FloatArray
    layer: MeanLayer | None
    diffuse: FloatArray
    depth: Float32Array
    base_depth: Float32Array
    clear: Float32Array

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


def field_axes(field: CloudField, scene: Scene) -> tuple[Vec3, Vec3, Vec3]:
    """Axes of a field's place in the observer's frame: east, north, up. [1]"""
    lat, lon = math.radians(field.latitude), math.radians(field.longitude)
    up = np.array([math.cos(lat) * math.cos(lon), math.cos(lat) * math.sin(lon), math.sin(lat)])
    east = np.array([-math.sin(lon), math.cos(lon), 0.0])
    rows = np.array([east, np.cross(up, east), up]) @ scene.ground_frame
    return tuple(Vec3(*row) for row in rows.tolist())  # type: ignore[return-value]


def sun_in_frame(scene: Scene) -> Vec3:
    """Direction to the light in the observer's frame, whose first axis is below it. [1]"""
    sun = scene.sun_direction
    return Vec3(float(np.hypot(sun[0], sun[1])), 0.0, float(sun[2]))


class OtherClouds(NamedTuple):
    """Clouds around those of a kind, which act on them by their mean.

    Attributes
    ----------
    layer : MeanLayer or None
        Mean layer of all clouds.
    higher : sequence of CloudLight
        Those with higher tops, which dim the beam.
    decks : sequence of CloudDeck
        All of them; parts below the top of the box are even layers in it.
    """

    layer: MeanLayer | None = None
    higher: Sequence[CloudLight] = ()
    decks: Sequence[CloudDeck] = ()


class Incident(NamedTuple):
    """Light that falls on a field from above.

    Attributes
    ----------
    towards : tuple of three float
        Unit vector to the light at the place of the field: east, north, up. [1]
    beam, sky : array, shape (nl,)
        Direct normal irradiance at the top, and diffuse irradiance, over that of the star. [1]
    direct : callable
        Direct normal irradiance of altitudes [m], shape (n,) to (n, nl). [1]
    radiance : callable
        Diffuse radiance from directions of propagation, shape (n, 3) to (n, nl). [sr⁻¹]
    """

    towards: tuple[float, float, float]
    beam: FloatArray
    sky: FloatArray
    direct: Callable[[FloatArray], FloatArray]
    radiance: Callable[[FloatArray], FloatArray]

    @property
    def irradiance(self) -> FloatArray:
        """Irradiance of the horizontal top over that of the star, shape (nl,). [1]"""
        return np.asarray(np.maximum(self.sky + self.beam * max(self.towards[2], 0.0), 1e-30))


def incident(
    solution: MomentsSolution,
    field: CloudField,
    towards: tuple[float, float, float],
    around: OtherClouds,
) -> Incident:
    """Light on a field under a light in a direction, with clouds around it.

    Parameters
    ----------
    solution, field : MomentsSolution, CloudField
        Planet without clouds, and clouds.
    towards : tuple of three float
        Unit vector to the light at the place of the field: east, north, up. [1]
    around : OtherClouds
        Other clouds.
    """
    medium = solution.medium
    top, mu_s = np.array([medium.bottom_radius + field.top]), np.array([towards[2]])

    def radiance(along: FloatArray) -> FloatArray:
        looking = -np.asarray(along, float)
        count = looking.shape[0]
        lines = enter_shell(
            np.full(count, top[0]),
            looking[:, 2],
            np.hypot(looking[:, 0], looking[:, 1]),
            np.full(count, towards[2]),
            np.clip(looking @ np.array(towards), -1.0, 1.0),
            medium.bottom_radius,
            medium.top_radius,
        )
        found = np.maximum(solution.relative_radiance(lines), 0.0)
        ratio = 1.0 if around.layer is None else around.layer.radiance_ratio(lines)
        return np.asarray(found * ratio)

    sky, layer = solution.relative_sky_irradiance(top, mu_s), around.layer
    seen = np.ones(medium.wavelengths.size)
    for one in around.higher:
        seen = seen * one.visibility(field.top)

    def direct(altitudes: FloatArray) -> FloatArray:
        r = medium.bottom_radius + np.asarray(altitudes, float)
        found = solution.relative_normal_irradiance(r, np.full(r.size, towards[2]))
        return np.asarray(np.maximum(found, 0.0) * seen)

    return Incident(
        towards,
        direct(np.array([field.top]))[0],
        (sky if layer is None else sky * layer.sky_ratio(top, mu_s))[0],
        direct,
        radiance,
    )


def sun_over(field: CloudField, scene: Scene) -> tuple[float, float, float]:
    """Direction to a scene's light at the place of a field: east, north, up. [1]"""
    sun = np.array(sun_in_frame(scene))
    east, north, up = (float(sun @ np.array(axis)) for axis in field_axes(field, scene))
    return east, north, up


def solve_clouds(
    solution: MomentsSolution,
    scene: Scene,
    deck: CloudDeck,
    around: OtherClouds,
    *,
    solved_at: Sequence[tuple[float, Scene]] = (),
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
    quality, cache : str, bool
        As for ``solve_box``.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.
    """
    field, optics_at, nm = deck.field, deck.optics_at, solution.medium.wavelengths
    chosen, coarse = solved_wavelengths(nm.size), coarse_field(field)
    light = incident(solution, field, sun_over(field, scene), around)
    air = clear = box_air(solution, field.top, chosen)
    for other in around.decks:
        air = with_deck(air, other, nm[chosen])

    def box_under(one: Incident) -> BoxSolution:
        return solve_box(
            coarse,
            optics_at(nm[chosen]),
            _box_light(solution, (air, clear), one, chosen),
            quality=quality,
            cache=cache,
            progress=progress,
            cancel=cancel,
        )

    if solved_at:
        suns = [(weight, sun_over(field, one)) for weight, one in solved_at]
        others = [(weight, incident(solution, field, sun, around)) for weight, sun in suns]
        box = blended([(weight, one, box_under(one)) for weight, one in others], light, chosen)
    else:
        box = box_under(light)
    nothing = clear_distances(field)
    depth, base_depth = beam_depths(
        field,
        nothing,
        light.towards,
        solution.medium.bottom_radius,
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
        towards=light.towards,
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


def coarse_field(field: CloudField) -> CloudField:
    """Field of fewer cells to be solved, by means over neighbours where they are closest.

    Those are mostly levels: columns side by side would close gaps between small clouds.
    """
    found = field
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
