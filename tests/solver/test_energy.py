"""Light is neither made nor lost: fluxes through whole spheres, and through level surfaces."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import pi

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.quadrature import gauss_legendre
from airlight.planets import Constituent, Ground, Planet, Star
from airlight.planets.matter.phases import HenyeyGreenstein, Rayleigh
from airlight.planets.matter.profiles import Exponential
from airlight.solver.moments.solution import MomentsSolution

BOTTOM, TOP = 6360e3, 6460e3


def conservative(albedo: float, haze: float = 5e-5) -> Planet:
    """Gas and haze that absorb nothing, three optical depths of gas as three wavelengths."""
    from airlight.planets.spectral import PerWavelength

    gas = PerWavelength(wavelengths=(680.0, 550.0, 440.0), values=(5.8e-6, 13.5e-6, 33.1e-6))
    return Planet(
        name="furnace",
        bottom_radius=BOTTOM,
        top_radius=TOP,
        ground=Ground(albedo=albedo),
        star=Star(irradiance=1.0, angular_radius=0.0),
        constituents=(
            Constituent(
                name="gas", profile=Exponential(scale_height=8e3), scattering=gas,
                phase_function=Rayleigh(),
            ),
            Constituent(
                name="haze", profile=Exponential(scale_height=2e3), scattering=haze,
                phase_function=HenyeyGreenstein(asymmetry=0.6),
            ),
        ),
    )  # fmt: skip


def pieces(edges: list[float], count: int) -> tuple[np.ndarray, np.ndarray]:
    """Gauss-Legendre points and weights on each piece between edges."""
    rule = gauss_legendre(count)
    points = [a + (b - a) * rule.nodes for a, b in pairwise(edges)]
    weights = [(b - a) * rule.weights for a, b in pairwise(edges)]
    return np.concatenate(points), np.concatenate(weights)


def level_fluxes(
    solution: MomentsSolution, altitude: float, mu_s: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Diffuse irradiance of a level surface from above and below, (suns, wavelengths).

    By quadrature of the radiance over both half spheres: in mu by Gauss-Legendre pieces split at
    the horizon, in azimuth likewise, with short pieces next to the star.
    """
    r = min(BOTTOM + altitude, TOP)
    horizon = -np.sqrt((r - BOTTOM) * (r + BOTTOM)) / r
    edges = sorted({-1.0, horizon, 0.0, 0.05, 0.2, 1.0})
    mu, w_mu = pieces(edges, 8)
    phi, w_phi = pieces([0.0, 0.15 * pi, 0.5 * pi, pi], 6)
    sun, view, around = np.meshgrid(mu_s, mu, phi, indexing="ij")
    radiance = solution.radiance(
        altitude=altitude, sun_zenith=np.degrees(np.arccos(sun)),
        view_zenith=np.degrees(np.arccos(view)), azimuth=np.degrees(around),
    ).values  # fmt: skip
    over_phi = 2.0 * np.einsum("smpw,p->smw", radiance, w_phi)
    down = np.einsum("smw,m->sw", over_phi, w_mu * np.maximum(mu, 0.0))
    up = np.einsum("smw,m->sw", over_phi, w_mu * np.maximum(-mu, 0.0))
    return down, up


SUNS = [-1.0, -0.4, -0.2, -0.1, -0.03, 0.0, 0.03, 0.1, 0.3, 1.0]


def direct_through(solution: MomentsSolution, altitude: float, mu_s: np.ndarray) -> np.ndarray:
    """Starlight through a level surface, downwards positive, shape (suns, wavelengths)."""
    transmittance = solution.transmittance(
        altitude=altitude, view_zenith=np.degrees(np.arccos(mu_s))
    )
    return mu_s[:, None] * transmittance.values


@pytest.mark.parametrize("altitude", [0.0, 2e3, 20e3, 100e3])
def test_in_a_white_furnace_no_sphere_gains_or_loses_light(
    altitude: float, solved: Callable[..., MomentsSolution], tell: Callable[[str], None]
) -> None:
    # Nothing absorbs and the ground returns all: through every sphere about the centre as much
    # light leaves as enters. The light that enters is π r² of the star's; 0.5 % of it is the bar.
    solution = solved(conservative(1.0))
    mu_s, weight = pieces(SUNS, 6)
    down, up = level_fluxes(solution, altitude, mu_s)
    direct = direct_through(solution, altitude, mu_s)
    net = 2.0 * weight @ (up - down - direct)
    tell(f"white furnace at {altitude:6.0f} m: net/incoming " + " ".join(f"{x:+.5f}" for x in net))
    assert_allclose(net, 0.0, atol=5e-3)


@pytest.mark.parametrize(
    ("albedo", "haze"),
    [(0.0, 0.1), (0.3, 0.1), (0.8, 0.1), pytest.param(0.3, 3.0, marks=pytest.mark.slow)],
)
def test_what_leaves_and_what_the_ground_keeps_is_what_came(
    albedo: float, haze: float, solved: Callable[..., MomentsSolution], tell: Callable[[str], None]
) -> None:
    # The air absorbs nothing: incoming = leaving at the top + kept by the ground, which keeps
    # 1 - albedo of its irradiance. The two ends come from radiances and from `irradiance`.
    solution = solved(conservative(albedo, haze / 2e3))
    mu_s, weight = pieces(SUNS, 6)
    down, up = level_fluxes(solution, TOP - BOTTOM, mu_s)
    entered = 2.0 * weight @ (direct_through(solution, TOP - BOTTOM, mu_s) + down - up)
    ground = solution.irradiance(altitude=0.0, sun_zenith=np.degrees(np.arccos(mu_s)))
    received = (ground["direct"] + ground["diffuse"]).values
    kept = (1.0 - albedo) * 2.0 * weight @ received * (BOTTOM / TOP) ** 2
    tell(
        f"energy, albedo {albedo}, haze {haze}: (entered - kept)/incoming "
        + " ".join(f"{x:+.5f}" for x in entered - kept)
    )
    assert_allclose(entered, kept, rtol=0, atol=5e-3)


@pytest.mark.parametrize("altitude", [0.0, 10e3])
def test_sky_irradiance_is_the_integral_of_the_radiance(
    altitude: float, reference_earth: Callable[..., Planet],
    solved: Callable[..., MomentsSolution],
) -> None:  # fmt: skip
    # E = ∫ L mu dΩ over the upper half sphere, by quadrature of independent marches.
    solution = solved(reference_earth(albedo=0.3, aerosol=None))
    mu_s = np.cos(np.radians([5.0, 40.0, 70.0, 85.0, 90.0, 93.0]))
    down, _ = level_fluxes(solution, altitude, mu_s)
    sun = np.degrees(np.arccos(mu_s))
    diffuse = solution.irradiance(altitude=altitude, sun_zenith=sun)["diffuse"].values
    # In twilight the bar is that of single radiances.
    assert_allclose(diffuse[mu_s >= -1e-9], down[mu_s >= -1e-9], rtol=0.01)
    assert_allclose(diffuse, down, rtol=0.05)


def test_direct_irradiance_is_transmittance_times_cosine(
    reference_earth: Callable[..., Planet], solved: Callable[..., MomentsSolution]
) -> None:
    # E = mu_s T; the table of columns is good to 1e-3 of an optical depth of up to three.
    solution = solved(reference_earth(albedo=0.3, aerosol=None))
    sun = np.array([0.0, 30.0, 60.0, 80.0, 86.0])
    transmittance = solution.transmittance(altitude=0.0, view_zenith=sun).values
    direct = solution.irradiance(altitude=0.0, sun_zenith=sun)["direct"].values
    assert_allclose(direct, np.cos(np.radians(sun))[:, None] * transmittance, rtol=2e-3)
    night = solution.irradiance(altitude=0.0, sun_zenith=[90.1, 120.0, 180.0])
    assert_allclose(night["direct"].values, 0.0, atol=0)


def vast_cloud(depth: float, albedo: float = 0.0) -> Planet:
    """A uniform cloud that absorbs nothing, 1 km thick on a planet so vast that it is flat."""
    from airlight.planets.matter.profiles import Uniform

    return Planet(
        name="cloud",
        bottom_radius=6.36e9,
        top_radius=6.36e9 + 1e3,
        ground=Ground(albedo=albedo),
        star=Star(irradiance=1.0, angular_radius=0.0),
        constituents=(
            Constituent(
                name="cloud", profile=Uniform(), scattering=depth / 1e3,
                phase_function=HenyeyGreenstein(asymmetry=0.85),
            ),
        ),
        default_wavelengths=(550.0,),
    )  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("depth", [30.0])
def test_a_thick_cloud_lets_through_what_asymptotic_theory_says(
    depth: float, solved: Callable[..., MomentsSolution], tell: Callable[[str], None]
) -> None:
    # King (1987), JAS 44, 1734: a conservative layer over a black ground transmits
    # 4 / (3 (1-g) (τ + 2 q')), (1-g) q' = 0.714 for all asymmetries to 0.5 %, of the light that
    # falls on a sphere of it; exact for τ (1-g) above 3.
    solution = solved(vast_cloud(depth))
    mu_s, weight = pieces([0.0, 0.05, 0.3, 1.0], 6)
    ground = solution.irradiance(altitude=0.0, sun_zenith=np.degrees(np.arccos(mu_s)))
    received = 2.0 * weight @ (ground["direct"] + ground["diffuse"]).values[:, 0]
    expected = 4.0 / (3.0 * (1 - 0.85) * depth + 6.0 * 0.714)
    tell(
        f"cloud of optical depth {depth:.0f}: transmits {received:.4f}, theory {expected:.4f}; "
        f"{solution.report.sweeps} sweeps, {solution.report.seconds:.1f} s"
    )
    assert_allclose(received, expected, rtol=0.02)
    assert solution.report.sweeps < 15
