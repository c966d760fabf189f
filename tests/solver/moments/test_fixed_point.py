"""The loop of the iteration, on systems whose solution is known."""

from __future__ import annotations

from collections import deque

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.errors import Cancelled
from airlight.solver.moments.fixed_point import Backend, iterate
from airlight.solver.moments.settings import settings_for
from airlight.solver.moments.stopping import PATIENCE, Iteration, Stopping

STOPPING = Stopping.of_sweeps(settings_for("fine"))
NODES = 12


class Linear(Backend):
    """x = a + K x, as for the orders of scattering."""

    def __init__(self, matrix: np.ndarray) -> None:
        self.matrix, self.guess = matrix, np.ones(NODES)
        self.iterates: deque[np.ndarray] = deque(maxlen=STOPPING.iterates)

    def sweep(self) -> None:
        self.iterates.append(np.ones(NODES) + self.matrix @ self.guess)

    def reduce(self) -> tuple[np.ndarray, np.ndarray]:
        before, after = self.guess, self.iterates[-1]
        return before.reshape(1, -1, 1), after.reshape(1, -1, 1)

    def combine(self, weights: np.ndarray, *, best: bool) -> None:
        self.guess = sum(w * one for w, one in zip(weights[:, 0], self.iterates, strict=True))


def new_iteration() -> Iteration:
    return Iteration(STOPPING, np.zeros(1), 1)


def test_linear_system_is_solved():
    # spectral radius 0.95: plain orders would need 180 sweeps for the tolerance of 1e-4
    rng = np.random.default_rng(3)
    matrix = rng.uniform(0.0, 1.0, (NODES, NODES))
    matrix *= 0.95 / np.abs(np.linalg.eigvals(matrix)).max()
    backend, iteration, reported = Linear(matrix), new_iteration(), []
    iterate(backend, iteration, report=lambda state: reported.append(state.sweeps))
    assert_allclose(
        backend.guess, np.linalg.solve(np.eye(NODES) - matrix, np.ones(NODES)), rtol=1e-4
    )
    assert reported == list(range(1, iteration.sweeps + 1))
    assert iteration.sweeps < 20


class Diverging(Linear):
    """Changes of given sizes, until it falls back to an exact scheme from the best iterate."""

    def __init__(self, changes: list[float]) -> None:
        super().__init__(np.zeros((NODES, NODES)))
        self.changes = iter(changes)
        self.best, self.restarted = None, None

    def sweep(self) -> None:
        change = 0.0 if self.restarted is not None else next(self.changes)
        self.iterates.append(self.guess * (1.0 + change))

    def combine(self, weights: np.ndarray, *, best: bool) -> None:
        self.guess = self.iterates[-1]
        if best:
            self.best = self.guess

    def fall_back(self) -> bool | None:
        self.guess = self.restarted = self.best
        return False


def test_divergence_restarts_from_the_iterate_of_the_least_change():
    # the second change is the smallest; PATIENCE larger ones follow, then the restart
    changes = [0.1, 0.05, *[0.2] * PATIENCE]
    backend = Diverging(changes)
    iteration = new_iteration()
    iterate(backend, iteration, report=lambda _: None)
    assert_allclose(backend.restarted, np.full(NODES, 1.1 * 1.05))
    assert_array_equal(backend.guess, backend.restarted)
    assert not iteration.accelerated
    assert iteration.sweeps > len(changes)


def test_a_cancelled_iteration_ends_before_a_sweep():
    backend = Linear(np.zeros((NODES, NODES)))
    with pytest.raises(Cancelled):
        iterate(backend, new_iteration(), report=lambda _: None, cancel=lambda: True)
    assert not backend.iterates
