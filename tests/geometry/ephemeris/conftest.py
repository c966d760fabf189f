"""JPL's ephemeris for the tests of this folder."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from typing import Any

import pytest


@pytest.fixture(scope="session")
def almanac() -> Iterator[tuple[Any, Any]]:
    """DE421 and measured rotation of Earth: (ephemeris, time scale)."""
    pytest.importorskip("skyfield")
    from skyfield.api import Loader
    from skyfield_data import get_skyfield_data_path

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the package says when its last rotation data end
        load = Loader(get_skyfield_data_path(), verbose=False)
        bodies, scale = load("de421.bsp"), load.timescale(builtin=False)
    yield bodies, scale
    bodies.close()
