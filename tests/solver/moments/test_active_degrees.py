"""Degrees of the light that count in thick air."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import load_planet
from airlight.planets.medium import Medium
from airlight.solver.moments import iterate
from airlight.solver.moments.active_degrees import active_degrees
from airlight.solver.moments.settings import settings_for
from airlight.solver.moments.setup import Setup, WavelengthBatch
from airlight.solver.refracted_geometry import RefractedGeometry


def batch_of(name: str, tolerance: float = 1e-2) -> WavelengthBatch:
    planet = load_planet(name)
    settings = replace(settings_for("preview"), tolerance=tolerance)
    medium = Medium.from_planet(planet, planet.wavelengths[:3])
    return Setup(geometry=RefractedGeometry.of(medium), settings=settings).batch(slice(None))


def test_light_from_all_sides_has_few_degrees_and_a_level_between_those_of_both_ends() -> None:
    # by hand: nodes with nothing but a mean radiance, one with a moment of degree 5
    batch = batch_of("venus")
    setup = batch.setup
    radii, suns = setup.gathering.radii.size, setup.grid.sun_cosines.size
    field = np.zeros((radii, suns, setup.terms, 8), np.float32)
    field[:, :, 0] = 1.0
    field[3, 7, 5 * 6 // 2 + 2, 1] = 0.1
    degrees = active_degrees(batch, field)
    assert degrees.shape == setup.grid.radii.shape
    parts = setup.refinement
    assert parts > 1
    expected = np.full(degrees.size, 2)
    expected[2 * parts + 1 : 4 * parts] = 5
    assert_allclose(degrees, expected)


@pytest.mark.parametrize("name", ["venus", "titan"])
def test_light_of_few_degrees_is_that_of_all(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    # a second method: all degrees everywhere; both stop at a change of 1e-2 of the mean radiance
    batch = batch_of(name)
    geometry, settings = batch.setup.geometry, batch.setup.settings
    few = iterate.solve_moments(geometry, settings)
    found: list[np.ndarray] = []

    def kept(batch: WavelengthBatch, field: np.ndarray) -> np.ndarray:
        found.append(active_degrees(batch, field))
        return batch.all_degrees

    monkeypatch.setattr(iterate, "active_degrees", kept)
    every = iterate.solve_moments(geometry, settings)
    assert few.sweeps == every.sweeps
    assert name != "venus" or found[0].min() < batch.setup.degree
    mean = every.field[:, :, 0]
    lit = mean > 1e-4 * mean.max()
    assert_allclose(few.field[:, :, 0][lit], mean[lit], rtol=1e-3)
