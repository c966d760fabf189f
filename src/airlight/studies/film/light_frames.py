"""``LightFrames``: frames of a film for which the light of clouds is solved."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.scene import Scene
from airlight.scene.directions import direction

FloatArray = NDArray[np.float64]

#: Largest angle by which a light moves between two of these frames. [deg]
STEP: Final = 0.5


def light_directions(scene: Scene) -> FloatArray:
    """Unit vectors to the lights of a scene: towards north, west and up, shape (lights, 3). [1]"""
    return np.array(
        [direction(light.zenith, scene.sun_azimuth + light.azimuth) for light in scene.lights]
    )


@dataclass(frozen=True, eq=False)
class LightFrames:
    """Frames for which the light of clouds is solved, and by which that of others is interpolated.

    The first and the last frame, and others between which a light moves by at most ``STEP``.

    Parameters
    ----------
    directions : array, shape (frames, lights, 3)
        Directions to the lights. [1]
    solved : array of int, shape (n,)
        Numbers of the frames, ascending.
    """

    directions: FloatArray
    solved: NDArray[np.int64]

    @classmethod
    def of(cls, directions: FloatArray, keys: Sequence[object]) -> LightFrames:
        """Frames of a film.

        Parameters
        ----------
        directions : array, shape (frames, lights, 3)
            Results of ``light_directions``. [1]
        keys : sequence
            What the light depends on besides, of each frame; all frames around a change are solved.
        """
        last = len(keys) - 1
        solved = {0, last}
        latest = 0
        for number in range(1, last + 1):
            changed = keys[number] != keys[number - 1]
            moved = _angle(directions[latest], directions[number]) > math.radians(STEP)
            if changed or (moved and number - 1 > latest):
                solved.add(number - 1)
                latest = number - 1
            if changed:
                solved.add(number)
                latest = number
        return cls(directions, np.array(sorted(solved)))

    def around(self, number: int) -> tuple[tuple[float, int], ...]:
        """Weights and numbers of the solved frames by which the light of a frame is found.

        Parameters
        ----------
        number : int
            Number of the frame.
        """
        after = int(np.searchsorted(self.solved, number))
        if self.solved[after] == number:
            return ((1.0, number),)
        first, second = int(self.solved[after - 1]), int(self.solved[after])
        whole = _angle(self.directions[first], self.directions[second])
        if whole == 0.0:
            return ((1.0, first),)
        share = min(_angle(self.directions[first], self.directions[number]) / whole, 1.0)
        return ((1.0 - share, first), (share, second))


def _angle(one: FloatArray, other: FloatArray) -> float:
    """Largest angle between directions. [rad]"""
    apart = np.linalg.norm(np.cross(one, other), axis=-1)
    return float(np.arctan2(apart, (one * other).sum(axis=-1)).max())
