"""Laws between key frames: limits, closed forms, and no value beyond two keys."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.studies.film.key_frames import LAWS, KeyFrames, smooth

AT = np.array([0.0, 0.3, 0.4, 1.0])
VALUES = np.array([[2.0], [5.0], [6.0], [1.0]])


@pytest.mark.parametrize("law", LAWS)
def test_a_law_passes_through_its_keys_and_stays_beyond_the_ends(law: str) -> None:
    assert_allclose(LAWS[law](AT, VALUES, AT), VALUES, rtol=1e-14)
    assert_allclose(LAWS[law](AT, VALUES, np.array([-1.0, 2.0])), [[2.0], [1.0]], rtol=1e-14)


def test_an_exponential_climb_has_equal_factors_in_equal_times() -> None:
    heights = LAWS["exponential"](np.array([0.0, 1.0]), np.array([[2.0], [512.0]]),
                                  np.linspace(0.0, 1.0, 9))  # fmt: skip
    assert_allclose(heights.ravel(), 2.0 ** np.arange(1, 10), rtol=1e-14)


def test_two_smooth_keys_are_the_cubic_that_rests_at_both_ends() -> None:
    t = np.linspace(0.0, 1.0, 11)
    found = smooth(np.array([0.0, 1.0]), np.array([[0.0], [1.0]]), t)
    assert_allclose(found.ravel(), 3.0 * t**2 - 2.0 * t**3, atol=1e-15)


@given(st.lists(st.floats(-1e3, 1e3), min_size=3, max_size=7))
def test_smooth_values_lie_between_their_keys(values: list[float]) -> None:
    # Fritsch & Butland's slopes keep each piece monotone
    at = np.linspace(0.0, 1.0, len(values))
    t = np.linspace(0.0, 1.0, 301)
    found = smooth(at, np.array(values)[:, None], t).ravel()
    piece = np.minimum((t * (len(values) - 1)).astype(int), len(values) - 2)
    low = np.minimum(np.array(values)[piece], np.array(values)[piece + 1])
    high = np.maximum(np.array(values)[piece], np.array(values)[piece + 1])
    assert np.all(found >= low - 1e-9)
    assert np.all(found <= high + 1e-9)


def test_smooth_has_no_jump_of_its_slope() -> None:
    # of a C1 curve the second difference shrinks with the square of the step; of a corner linearly
    def corner(n: int) -> float:
        t = np.linspace(0.0, 1.0, n + 1)
        return float(np.abs(np.diff(smooth(AT, VALUES, t).ravel(), 2)).max())

    assert corner(4000) < 0.3 * corner(2000)


def test_values_keep_their_units_and_lists() -> None:
    key = KeyFrames(path="a", values="2 m, 4 km", at=(0.0, 1.0))
    assert key.value(0.5) == "2001.0 m"
    assert KeyFrames(path="a", values="2, 4 km").value(0.5) == "3.0 km"
    assert KeyFrames(path="a", values="2, 4").value(0.5) == 3.0
    turned = KeyFrames(path="camera.direction", values=[[1, 0, 0], [0, 1, 0]])
    assert turned.value(0.25) == [0.75, 0.25, 0.0]
    far = KeyFrames(path="p", values=[["1 km", "0 km"], ["3 km", "500 m"]])
    assert far.value(0.5) == ["2.0 km", "0.25 km"]


@pytest.mark.parametrize(
    ("values", "more", "line"),
    [
        (["2 m"], {}, "values"),
        (["2 m", "3"], {}, "a number with a unit, such as 'm'"),
        ([2, "3 m"], {}, "a number without a unit"),
        (["2 m", "3 s"], {}, "values"),
        ([[1, 2], [1]], {}, "lists of equal length"),
        (["noon", "dusk"], {}, "values"),
        ([0, 1], {"law": "exponential"}, "numbers above 0"),
        ([0, 1], {"law": "cubic"}, "'linear' or 'smooth'"),
        ([0, 1], {"at": (0.5, 0.2)}, "ascending"),
        ([0, 1], {"at": (0.5,)}, "2 times, as many as values"),
        ([0, 1], {"at": (0.0, 1.5)}, "0 to 1"),
    ],
)
def test_unusable_keys_are_refused_in_one_line(values: object, more: dict, line: str) -> None:
    with pytest.raises(ParameterError) as caught:
        KeyFrames(path="view.altitude", values=values, **more)
    assert line in str(caught.value)
