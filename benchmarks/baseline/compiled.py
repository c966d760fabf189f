"""``classic.c``, compiled here and called through ctypes, on one core."""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from airlight.solver.tables.bruneton import BrunetonGrid
from airlight.solver.tables.layout import Positions
from baseline.plain import FloatArray

FLAGS = ("-O3", "-march=native")
SOURCE = Path(__file__).with_name("classic.c")

_Doubles = np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")
_Floats = np.ctypeslib.ndpointer(np.float32, flags="C_CONTIGUOUS")
_Bytes = np.ctypeslib.ndpointer(np.uint8, flags="C_CONTIGUOUS")


class _Air(ctypes.Structure):
    _fields_ = tuple(
        (name, ctypes.c_double) for name in ("bottom", "gas", "aerosol", "centre", "half_width")
    )


class _Grid(ctypes.Structure):
    _fields_ = (
        *((name, ctypes.c_double) for name in ("bottom", "top", "lowest_sun")),
        *((name, ctypes.c_long) for name in ("radii", "views", "suns", "angles")),
    )


def compiler() -> str | None:
    """The C compiler, or None."""
    return shutil.which(os.environ.get("CC", "cc"))


class Classic:
    """The functions of ``classic.c``."""

    def __init__(self, folder: Path) -> None:
        library = folder / "classic.so"
        command = [compiler(), *FLAGS, "-shared", "-fPIC", "-o", library, SOURCE, "-lm"]
        subprocess.run(command, check=True, capture_output=True, text=True)
        self._c = ctypes.CDLL(str(library))
        n, grid = ctypes.c_long, ctypes.POINTER(_Grid)
        ray = [_Doubles] * 3
        place = [_Doubles] * 4
        self._c.columns.argtypes = [n, *ray, ctypes.POINTER(_Air), ctypes.c_int, _Doubles]
        self._c.look_up.argtypes = [n, *place, _Bytes, _Floats, grid, _Doubles]
        self._c.gather.argtypes = [
            n, *place, _Floats, grid, _Doubles, ctypes.c_double, ctypes.c_int, ctypes.c_int,
            _Doubles,
        ]  # fmt: skip
        for function in (self._c.columns, self._c.look_up, self._c.gather):
            function.restype = None

    def columns(
        self, r: FloatArray, mu: FloatArray, length: FloatArray, air: tuple[float, ...], steps: int
    ) -> FloatArray:
        """See ``plain.columns``."""
        out = np.empty((r.size, 3))
        self._c.columns(r.size, r, mu, length, ctypes.byref(_Air(*air)), steps, out)
        return out

    def look_up(
        self, values: NDArray[np.float32], positions: Positions, grid: BrunetonGrid
    ) -> FloatArray:
        """See ``plain.look_up``."""
        out = np.empty((len(positions), 3))
        ground = positions.to_ground.view(np.uint8)
        where = (positions.r, positions.mu, positions.mu_s, positions.nu)
        self._c.look_up(len(positions), *where, ground, values, ctypes.byref(_Grid(*grid)), out)
        return out

    def gather(
        self,
        values: NDArray[np.float32],
        positions: Positions,
        grid: BrunetonGrid,
        scattering: FloatArray,
        scale_height: float,
        directions: tuple[int, int],
    ) -> FloatArray:
        """See ``plain.gather``."""
        out = np.empty((len(positions), 3))
        where = (positions.r, positions.mu, positions.mu_s, positions.nu)
        self._c.gather(
            len(positions), *where, values, ctypes.byref(_Grid(*grid)),
            np.ascontiguousarray(scattering), scale_height, *directions, out,
        )  # fmt: skip
        return out
