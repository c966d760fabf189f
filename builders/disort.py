"""Remake ``validation/data/plane-parallel.toml``: light on the ground below deep flat air.

Run with ``python builders/disort.py`` where PythonicDISORT is installed (the extra ``dev``). The
air is cut into even layers; peaked phase functions are scaled by delta-M with as many moments as
there are streams. ``python builders/disort.py --check`` writes nothing and prints how the light
depends on the number of layers and streams.

PythonicDISORT takes the albedo of a Lambert ground as the Fourier mode of its bidirectional
reflectance, not the albedo over pi.
"""

from __future__ import annotations

import sys
import warnings
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from PythonicDISORT import pydisort

from airlight.planets import Medium
from airlight.validation.plane_parallel import FILE, SUNS, depths, flat_cases

FloatArray = NDArray[np.float64]

LAYERS, STREAMS = 400, 32
#: Largest single-scattering albedo: the method divides by what is missing to 1.
MOST = 1.0 - 1e-9
#: Optical depth below which a layer is left out.
EMPTY = 1e-12
#: Points of the columns over altitude.
POINTS = 80_001
OUT = Path(__file__).parents[1] / "src" / "airlight" / "validation" / FILE
#: What the file says of itself.
HEAD = """\
# Light on the ground below flat air, over that of level ground outside the air, with the sun at
# zenith angles of {suns} degrees. Made by builders/disort.py: PythonicDISORT
# {version}, {streams} streams, {layers} layers; half of the layers, twice of them, or half of the
# streams change a number by at most 0.04 %. `depth` and `absorption`: optical depths straight up.
"""


class Layers(NamedTuple):
    """Layers from the top: edges of altitude [m] (n + 1), depths (n), moments (n, l + 1)."""

    edges: FloatArray
    extinction: FloatArray
    scattering: FloatArray
    moments: FloatArray


def layers(medium: Medium, count: int = LAYERS, streams: int = STREAMS, w: int = 0) -> Layers:
    """Cut a medium into layers, even in the optical depth and in altitude alike."""
    z = np.linspace(0.0, medium.thickness, POINTS)
    density = medium.density.at(z)
    local = medium.extinction[:, w] @ density
    steps = np.diff(z)
    depth = np.concatenate([[0.0], np.cumsum(0.5 * (local[1:] + local[:-1]) * steps)])
    share = 0.5 * (depth / depth[-1] + z / z[-1])
    edges = np.interp(np.linspace(0.0, 1.0, count + 1), share, z)
    edges[0], edges[-1] = 0.0, z[-1]
    means = 0.5 * (density[:, 1:] + density[:, :-1]) * steps
    columns = np.concatenate([np.zeros((len(density), 1)), np.cumsum(means, axis=1)], axis=1)
    within = np.diff([np.interp(edges, z, one) for one in columns], axis=1)[:, ::-1]
    scattering = medium.scattering[:, w][:, None] * within
    moments = scattering.T @ medium.phase_moments(streams)[:, w, :]
    total = scattering.sum(axis=0)
    extinction = medium.extinction[:, w] @ within
    return Layers(edges[::-1], extinction, total, moments / np.maximum(total, 1e-300)[:, None])


def ground(
    air: Layers, sun_zenith: float, albedo: float, absorption: FloatArray | float = 0.0
) -> float:
    """Irradiance of the ground over that of level ground outside; ``absorption`` adds depths."""
    streams = air.moments.shape[1] - 1
    extinction = air.extinction + absorption
    full = extinction > EMPTY
    extinction, scattering, moments = extinction[full], air.scattering[full], air.moments[full]
    depth = np.cumsum(extinction)
    mu = float(np.cos(np.radians(sun_zenith)))
    peak = moments[:, streams]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # albedos near 1, which MOST is for
        _, _, down, _ = pydisort(
            depth, np.minimum(scattering / extinction, MOST), streams, moments, mu, 1.0, 0.0,
            NLeg=streams, f_arr=peak if peak.max() > 1e-9 else 0, BDRF_Fourier_modes=[albedo],
            only_flux=True,
        )  # fmt: skip
    diffuse, direct = down(depth[-1])
    return float(diffuse + direct) / mu


def shares(medium: Medium, count: int = LAYERS, streams: int = STREAMS) -> list[float]:
    """Light on the ground with each of the suns."""
    air = layers(medium, count, streams)
    albedo = float(np.ravel(medium.ground_albedo)[0])
    return [ground(air, sun, albedo) for sun in SUNS]


def main() -> None:
    """Write the file, or print how firm its numbers are."""
    check = "--check" in sys.argv[1:]
    head = HEAD.format(
        suns=", ".join(f"{sun:g}" for sun in SUNS), version=version("PythonicDISORT"),
        streams=STREAMS, layers=LAYERS,
    )  # fmt: skip
    blocks = []
    for case in flat_cases():
        medium = case.medium
        known = shares(medium)
        depth, absorption = depths(medium)
        if check:
            for count, streams in (
                (LAYERS // 2, STREAMS),
                (2 * LAYERS, STREAMS),
                (LAYERS, STREAMS // 2),
            ):
                off = 100.0 * (np.array(shares(medium, count, streams)) / known - 1.0)
                print(case.name, count, streams, np.round(off, 4), flush=True)
        else:
            numbers = ", ".join(f"{share:.6e}" for share in known)
            blocks.append(
                f'\n[[case]]\nname = "{case.name}"\ndepth = {depth:.9g}\n'
                f"absorption = {absorption:.9g}\nground = [{numbers}]"
            )
    if not check:
        OUT.write_text(head + "\n".join(blocks) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
