from __future__ import annotations

from collections.abc import Callable

import pytest

from airlight import load_planet
from airlight.solver.moments.solution import MomentsSolution


@pytest.fixture(scope="session")
def earth(solved: Callable[..., MomentsSolution]) -> MomentsSolution:
    """Earth of the notes, in which light goes straight, at three wavelengths."""
    return solved(load_planet("earth-atmosphere-plus"), (680.0, 550.0, 440.0), "preview")
