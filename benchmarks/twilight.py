"""What the real air, its stratospheric aerosol and bent light change between noon and night.

``python benchmarks/twilight.py`` prints the tables of docs/planets.md, a minute: the zenith's light
by the steps that lead from one exponential to preset ``earth``, then illuminance and V of the
zenith beside published measurements.
"""

from __future__ import annotations

from airlight import Planet, load_planet, solve
from airlight.planets import replace
from airlight.solver.solution import Solution
from airlight.validation.published.twilight import (
    TWILIGHT_WAVELENGTHS,
    average_aerosol,
    ground_illuminance,
    illuminance_seidelmann1992,
    one_exponential,
    paranal_zenith_v,
    zenith_light,
    zenith_v_patat2006,
)

#: Altitudes of the sun of the first table. [deg]
ALTITUDES = (50.0, 10.0, 5.0, 0.0, -2.0, -4.0, -6.0, -8.0, -10.0, -12.0)
#: Altitudes of the sun at which published light is compared. [deg]
PUBLISHED = (20.0, 5.0, 2.0, 0.0, -1.0, -3.0, -5.0, -6.0, -8.0, -10.0, -12.0)


def steps() -> dict[str, Planet]:
    """Preset ``earth`` without its three refinements, then with one after another.

    The last has more of the lower aerosol: that of the days of the published illuminance.
    """
    earth = load_planet("earth")
    air, *others = earth.constituents
    low = [one for one in others if one.name != "stratospheric aerosol"]
    return {
        "one exponential": one_exponential(earth),
        "standard air": replace(earth, constituents=(air, *low), refraction="none"),
        "stratospheric aerosol": replace(earth, refraction="none"),
        "bent light": earth,
        "average aerosol": load_planet("earth", average_aerosol()),
    }


def changes(solved: dict[str, Solution]) -> None:
    """Print the zenith's light by steps."""
    green = TWILIGHT_WAVELENGTHS.index(560.0)
    print("zenith at 560 nm, over that of one exponential\n")
    print("| sun | " + " | ".join(solved) + " |")
    print("|---|" + "---|" * len(solved))
    first = next(iter(solved.values()))
    for altitude in ALTITUDES:
        base = zenith_light(first, altitude)[green]
        row = [f"{zenith_light(one, altitude)[green] / base:.3f}" for one in solved.values()]
        row[0] = f"{base:.3e} /sr"
        print(f"| {altitude:g}° | " + " | ".join(row) + " |")


def published(solved: dict[str, Solution]) -> None:
    """Print illuminance and V of the zenith beside published ones."""
    names = list(solved)
    print("\nilluminance [lx], and over that of the Explanatory Supplement\n")
    print("| sun | Supplement | " + " | ".join(names) + " |")
    print("|---|---|" + "---|" * len(names))
    for altitude in PUBLISHED:
        cited = illuminance_seidelmann1992(altitude)
        row = [ground_illuminance(one, altitude) / cited for one in solved.values()]
        print(f"| {altitude:g}° | {cited:.4g} | " + " | ".join(f"{x:.2f}" for x in row) + " |")
    print("\nV of the zenith 2635 m up [mag arcsec⁻²], ours less Patat et al. (2006)\n")
    print("| sun | Patat | " + " | ".join(names) + " |")
    print("|---|---|" + "---|" * len(names))
    for altitude in PUBLISHED:
        if not -15.0 <= altitude <= -5.0:
            continue
        cited = zenith_v_patat2006(altitude)
        row = [paranal_zenith_v(one, altitude) - cited for one in solved.values()]
        print(f"| {altitude:g}° | {cited:.2f} | " + " | ".join(f"{x:+.2f}" for x in row) + " |")


def main() -> None:
    """Solve and print."""
    solved = {
        name: solve(planet, TWILIGHT_WAVELENGTHS, "default") for name, planet in steps().items()
    }
    for name, one in solved.items():
        print(f"{name}: {one.report}")
    print()
    changes(solved)
    published(solved)


if __name__ == "__main__":
    main()
