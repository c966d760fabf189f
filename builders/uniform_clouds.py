"""Remake ``validation/data/uniform-clouds.csv``: irradiances of uniform clouds.

Run with ``python builders/uniform_clouds.py`` where PythonicDISORT is
installed (the extra ``dev``).
"""

from __future__ import annotations

import warnings
from importlib.metadata import version
from pathlib import Path

import numpy as np
from PythonicDISORT import pydisort

from airlight.validation.uniform_cloud import ASYMMETRY, CASES, FILE, UniformCloud

STREAMS = 48
#: Largest single-scattering albedo: the method divides by what is missing to 1.
MOST = 1.0 - 1e-9
OUT = Path(__file__).parents[1] / "src" / "airlight" / "validation" / FILE
HEAD = f"""\
# Irradiance upwards at the top and downwards at the base of a uniform cloud over the incident one.
# Henyey-Greenstein, asymmetry {ASYMMETRY:g}. PythonicDISORT {version("PythonicDISORT")}, {STREAMS}
# streams, delta-M. Made by builders/uniform_clouds.py.
optical_depth,zenith,albedo,ground,up,down
"""


def irradiances(case: UniformCloud) -> tuple[float, float]:
    """Irradiances over the incident one. [1]"""
    mu = np.cos(np.radians(case.zenith))
    moments = ASYMMETRY ** np.arange(STREAMS + 1)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # albedos near 1
        _, up, down, _ = pydisort(
            np.array([case.optical_depth]), np.array([min(case.albedo, MOST)]), STREAMS,
            moments[None], mu, 1.0, 0.0, NLeg=STREAMS, f_arr=moments[-1],
            BDRF_Fourier_modes=[case.ground], only_flux=True,
        )  # fmt: skip
    return float(up(0.0)) / mu, float(sum(down(case.optical_depth))) / mu


def main() -> None:
    """Write the file."""
    rows = [
        ",".join([*(f"{value:g}" for value in case), *(f"{x:.6f}" for x in irradiances(case))])
        for case in CASES
    ]
    OUT.write_text(HEAD + "\n".join(rows) + "\n")


if __name__ == "__main__":
    main()
