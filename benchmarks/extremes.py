"""Extremes of what a planet may be: solved or refused, how fast, and whether light is conserved.

``python benchmarks/extremes.py [--quality preview]`` solves each planet of the list, adds up the
light that leaves the top and that the ground keeps, looks from every edge towards suns on every
edge, compares light exactly on edges with that next to them, and prints the tables that
docs/reliability.md summarises.
"""

from __future__ import annotations

import argparse
from itertools import pairwise
from time import perf_counter, process_time
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight import solve
from airlight.errors import AirlightError
from airlight.geometry.quadrature import gauss_legendre
from airlight.planets import Constituent, Ground, Planet, Star
from airlight.planets.matter.phases import HenyeyGreenstein
from airlight.planets.matter.profiles import Exponential
from airlight.solver import Solution

FloatArray = NDArray[np.float64]

EARTH, SHELL = 6360e3, 60e3

ABOUT = """\
`python benchmarks/extremes.py docs/reliability.md`, quality `{quality}`: one kind of particle
(Henyey-Greenstein), scale height an eighth of the shell, 550 nm. Seconds are CPU time of the
solve. Energy: light that came, less what left the top and what the ground kept, over what came,
where the air absorbs nothing. Verdict *solved* includes radiances, finite and not negative, from
the ground, the top and above it, under suns and towards directions in the zenith, on both
horizons, level and in the nadir.
"""
EDGE_ABOUT = """
Light exactly on an edge, less that of the nearer neighbour (1e-6 of the shell or 1e-5 degrees
away), over the brightest under that sun: shells like Earth's of depth 1 (g = 0.6) and 30
(g = 0.9, albedo 1), a shell as thick as its planet of 1 km, and g = -0.9.

| edge | depth 1 | depth 30 | 1 km | g = -0.9 |
|---|---|---|---|---|"""
COLUMNS = (
    "| g | depth | ϖ | albedo | radius, km | shell/radius | s | sweeps | energy | verdict |",
    "|---|---|---|---|---|---|---|---|---|---|",
)


class Case(NamedTuple):
    """Planet with one kind of particle, of scale height an eighth of the shell.

    ``kept`` is the albedo of one scattering, ``albedo`` that of the ground.
    """

    asymmetry: float = 0.6
    depth: float = 1.0
    albedo: float = 0.3
    kept: float = 1.0
    radius: float = EARTH
    thickness: float = SHELL

    def planet(self) -> Planet:
        """Build the planet; raises what its validation raises."""
        extinction = 8.0 * self.depth / self.thickness
        particles = Constituent(
            name="particles", profile=Exponential(scale_height=self.thickness / 8.0),
            scattering=self.kept * extinction, absorption=(1.0 - self.kept) * extinction,
            phase_function=HenyeyGreenstein(asymmetry=self.asymmetry),
        )  # fmt: skip
        return Planet(
            name="extreme", bottom_radius=self.radius, top_radius=self.radius + self.thickness,
            ground=Ground(albedo=self.albedo), star=Star(irradiance=1.0, angular_radius=0.0),
            constituents=(particles,), default_wavelengths=(550.0,),
        )  # fmt: skip


CASES = (
    *(Case(asymmetry=g, depth=t, albedo=1.0) for g in (0.9, 0.99, 0.999) for t in (0.3, 3.0, 30.0)),
    *(Case(asymmetry=g, depth=t) for g in (-0.9, -0.999) for t in (0.3, 1.0, 10.0, 100.0)),
    *(Case(asymmetry=g, depth=t) for g in (-0.95, -0.97, -0.99) for t in (0.1, 0.3, 1.0)),
    *(Case(asymmetry=g, depth=0.03) for g in (-0.97, -0.99, -0.999)),
    *(Case(asymmetry=0.0, depth=t) for t in (1e-8, 1e-4, 10.0, 100.0, 400.0, 1000.0)),
    Case(asymmetry=0.85, depth=1000.0),
    Case(asymmetry=0.999, depth=1000.0),
    Case(asymmetry=0.0, depth=1000.0, kept=0.5),
    Case(depth=10.0, kept=0.0),
    Case(depth=10.0, albedo=0.0),
    Case(depth=10.0, albedo=1.0),
    Case(radius=1e3, thickness=1e3),
    Case(radius=1e3, thickness=10.0),
    Case(radius=1e3, thickness=1.0),
    Case(radius=1e9, thickness=1e6),
    Case(radius=1e9, thickness=1e9),
    Case(radius=1e9, thickness=1e9, depth=10.0),
    Case(radius=1e9, thickness=1e9, depth=100.0),
    Case(radius=1e9, thickness=3e8, depth=100.0),
)


def panels(edges: list[float], count: int) -> tuple[FloatArray, FloatArray]:
    """Gauss-Legendre points and weights between edges."""
    rule = gauss_legendre(count)
    pairs = [(a, b) for a, b in pairwise(sorted(edges)) if b > a]
    points = [a + (b - a) * rule.nodes for a, b in pairs]
    return np.concatenate(points), np.concatenate([(b - a) * rule.weights for a, b in pairs])


def lost(solution: Solution, case: Case) -> float:
    """Light that came less that left at the top and stayed in the ground, per light that came. [1]

    Where the star shines through the limb, and opposite to it where particles scatter backwards,
    the quadrature of what leaves has panels down to 0.05 degrees, so that a peak of the phase
    function is sampled and not missed.
    """
    bottom, top = solution.medium.bottom_radius, solution.medium.top_radius
    horizon = -float(np.sqrt((top - bottom) * (top + bottom))) / top
    suns, share = panels([-1.0, 1.6 * horizon, horizon, 0.4 * horizon, 0.0, 0.1, 0.4, 1.0], 4) \
        if horizon > -0.6 else panels([-1.0, horizon, 0.5 * horizon, 0.0, 0.4, 1.0], 5)  # fmt: skip
    rows = []
    for at, sun in enumerate(suns):
        edges = [-1.0, 0.5 * (horizon - 1.0), horizon, 0.0]
        around = [0.0, 0.15 * np.pi, 0.5 * np.pi, np.pi]
        if horizon < sun < 0.0:
            near = [sun + d * abs(horizon) for d in (-0.3, -0.05, -0.01, 0.0, 0.01, 0.05, 0.3)]
            edges += [x for x in near if horizon < x < 0.0]
            around = [0.0, 1e-3, 5e-3, 0.03, *around[1:]]
        if case.asymmetry < 0.0 and sun > 0.0:
            edges += [x for d in (0.0, 1e-3, 5e-3, 0.03) for x in (d - sun, -d - sun) if -1 < x < 0]
            around += [np.pi - d for d in (1e-3, 5e-3, 0.03)]
        mu, weight = panels(edges, 6)
        phi, turn = panels(around, 5)
        grid, angle = np.meshgrid(mu, phi, indexing="ij")
        factor = 2.0 * share[at] * np.outer(-mu * weight, turn)
        rows.append(
            np.stack([np.full(grid.size, sun), grid.ravel(), angle.ravel(), factor.ravel()])
        )
    sun, mu, phi, factor = np.concatenate(rows, axis=1)
    radiance = solution.radiance(
        altitude=top - bottom, sun_zenith=np.degrees(np.arccos(sun)),
        view_zenith=np.degrees(np.arccos(mu)), azimuth=np.degrees(phi),
    ).values[:, 0]  # fmt: skip
    angles = np.degrees(np.arccos(suns))
    transmittance = solution.transmittance(altitude=top - bottom, view_zenith=angles).values[:, 0]
    # A star below the level of the top that is seen through the limb leaves again.
    direct = float(share @ (np.where(suns > 0.0, suns, suns * transmittance)))
    ground = solution.irradiance(altitude=0.0, sun_zenith=angles)
    received = (ground["direct"] + ground["diffuse"]).values[:, 0]
    # The ground's own suns are those above it, at the same places around the planet.
    kept = (1.0 - case.albedo) * float(share @ received) * (bottom / top) ** 2
    return 2.0 * (direct - kept) - 2.0 * float(factor @ radiance)


def edges_are_finite(solution: Solution) -> bool:
    """Whether radiances from every edge, under suns on every edge, are finite, not negative."""
    top = solution.medium.top_radius - solution.medium.bottom_radius
    dip = np.degrees(np.arccos(solution.medium.bottom_radius / solution.medium.top_radius))
    level = [0.0, 90.0 - dip, 90.0, 90.0 + dip, 180.0]
    height, sun, view, turn = np.meshgrid([0.0, top, 3.0 * top], level, level, [0.0, 180.0])
    light = solution.radiance(
        altitude=height.ravel(), sun_zenith=sun.ravel(), view_zenith=view.ravel(),
        azimuth=turn.ravel(),
    ).values  # fmt: skip
    return bool(np.isfinite(light).all() and (light >= 0.0).all())


def edges_of(solution: Solution) -> dict[str, tuple[list[float], list[float], list[float]]]:
    """Altitudes [m], zenith angles of suns and of views [deg] of each exact edge."""
    bottom, top = solution.medium.bottom_radius, solution.medium.top_radius
    shell, dip = top - bottom, float(np.degrees(np.arccos(bottom / top)))
    suns, views = [30.0, 88.0, 95.0], [20.0, 80.0, 100.0, 160.0]
    return {
        "observer on the ground": ([0.0], suns, [20.0, 80.0]),
        "observer at the top": ([shell], suns, views),
        "sun in the zenith": ([0.0, 0.3 * shell, shell], [0.0], views),
        "sun level": ([0.0, 0.3 * shell, shell], [90.0], views),
        "sun on the horizon of the top": ([shell], [90.0 + dip], views),
        "sun in the nadir": ([0.0, 0.3 * shell, shell], [180.0], views),
        "view to the zenith": ([0.0, 0.3 * shell, shell], suns, [0.0]),
        "view level": ([0.0, 0.3 * shell, shell], suns, [90.0]),
        "view to the horizon, from the top": ([shell], suns, [90.0 + dip]),
        "view along the top, from far above": (
            [3.0 * shell], suns, [float(np.degrees(np.pi - np.arcsin(top / (top + 2 * shell))))]),
        "view to the nadir": ([0.3 * shell, shell], suns, [180.0]),
    }  # fmt: skip


def edge_jump(solution: Solution, edge: tuple[list[float], list[float], list[float]]) -> float:
    """Largest difference between light exactly on an edge and light next to it. [1]

    Neighbours are 1e-6 of the shell higher and lower, and suns and views 1e-5 degrees to either
    side; a jump is to the nearer of the two, relative to the brightest light of that sun. So an
    edge may belong to either side, as the ground's does, and not to neither.
    """
    shell = solution.medium.thickness
    height, sun, view, turn = (
        a.ravel() for a in np.meshgrid(*edge, [0.0, 180.0], indexing="ij")
    )  # fmt: skip

    def light(d_height: float, d_sun: float, d_view: float) -> FloatArray:
        return solution.radiance(
            altitude=np.maximum(height + d_height * shell, 0.0),
            sun_zenith=180.0 - np.abs(180.0 - np.abs(sun + d_sun)),
            view_zenith=180.0 - np.abs(180.0 - np.abs(view + d_view)), azimuth=turn,
        ).values[:, 0]  # fmt: skip

    here = light(0.0, 0.0, 0.0)
    bright = np.array([here[sun == one].max() for one in sun]) + 1e-30
    jumps = [
        np.minimum(*(np.abs(light(*(side * one)) - here) for side in (-1.0, 1.0))) / bright
        for one in np.diag([1e-6, 1e-5, 1e-5])
    ]
    worst = np.max(jumps)
    return float(worst) if np.isfinite(here).all() and (here >= 0.0).all() else float("nan")


def edge_lines(quality: str) -> list[str]:
    """Table of light on exact edges."""
    cases = (Case(), Case(asymmetry=0.9, depth=30.0, albedo=1.0), Case(radius=1e3, thickness=1e3),
             Case(asymmetry=-0.9, depth=1.0))  # fmt: skip
    solutions = [solve(case.planet(), quality=quality, cache=False) for case in cases]
    return [
        EDGE_ABOUT,
        *(f"| {name} | " + " | ".join(f"{edge_jump(one, edges_of(one)[name]):.0e}"
                                       for one in solutions) + " |"
          for name in edges_of(solutions[0])),
    ]  # fmt: skip


def row(case: Case, quality: str) -> str:
    """One line of the table."""
    name = (
        f"{case.asymmetry:g} | {case.depth:g} | {case.kept:g} | {case.albedo:g} | "
        f"{case.radius / 1e3:g} | {case.thickness / case.radius:.2g}"
    )
    started, used = perf_counter(), process_time()
    try:
        solution = solve(case.planet(), quality=quality, cache=False)
    except AirlightError as error:
        took = perf_counter() - started
        return f"| {name} | {took:.1f} | | | refused: {error} |"
    used = process_time() - used
    sound = "solved" if edges_are_finite(solution) else "**not finite on an edge**"
    balance = f"{100 * lost(solution, case):+.2f} %" if case.kept == 1.0 else ""
    note = f"; {solution.report.note}" if solution.report.note else ""
    return f"| {name} | {used:.1f} | {solution.report.sweeps} | {balance} | {sound}{note} |"


def main() -> None:
    """Solve all cases and print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", default="preview")
    given = parser.parse_args()
    solve(Case().planet(), quality=given.quality, cache=False)  # compiles
    print(ABOUT.format(quality=given.quality), *COLUMNS, sep="\n", flush=True)
    for case in CASES:
        print(row(case, given.quality), flush=True)
    print(*edge_lines(given.quality), sep="\n", flush=True)


if __name__ == "__main__":
    main()
