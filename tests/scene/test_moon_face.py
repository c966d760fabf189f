"""Face of the Moon: known places where observers see them, and a mean of 1."""

from __future__ import annotations

from datetime import UTC, datetime

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from airlight.geometry.ephemeris.sky import Place, moon_seen
from airlight.scene.moon_face import moon_face

SIZE = 512


def reflectance(face: NDArray[np.float64], x: float, y: float) -> float:
    """Mean around a point of the finest level, in radii to the right and upwards."""
    row, column = int(0.5 * (1.0 - y) * SIZE), int(0.5 * (1.0 + x) * SIZE)
    return float(face[row - 6 : row + 7, column - 6 : column + 7].mean())


def seen_at(latitude: float, longitude: float) -> tuple[float, float]:
    """Orthographic place of selenographic coordinates, north up."""
    b, l = np.radians([latitude, longitude])
    return float(np.cos(b) * np.sin(l)), float(np.sin(b))


def test_seas_and_highlands_are_where_they_are() -> None:
    # Imbrium, Tranquillitatis, Crisium and Procellarum (IAU gazetteer) are dark, the highlands
    # around Tycho and behind Langrenus bright; near 0.54, the ratio of Apollo's soils.
    face = moon_face(0.0, 0.0, 0.0)
    seas = [(33.0, -16.0), (8.0, 31.0), (17.0, 59.0), (20.0, -55.0)]
    lands = [(-43.0, -11.0), (-30.0, 10.0), (-15.0, 40.0)]
    dark = [reflectance(face, *seen_at(*place)) for place in seas]
    bright = [reflectance(face, *seen_at(*place)) for place in lands]
    assert max(dark) < 0.75 < 1.0 < min(bright)
    assert 0.4 < np.mean(dark) / np.mean(bright) < 0.65


def test_the_face_turns_with_the_bright_limb() -> None:
    # With the bright limb at the Moon's east, Crisium is upwards; at its north it is to the right.
    up = moon_face(90.0, 0.0, 0.0)
    x, y = seen_at(17.0, 59.0)
    assert_allclose(reflectance(up, -y, x), reflectance(moon_face(0.0, 0.0, 0.0), x, y), rtol=0.02)


def test_levels_keep_the_mean() -> None:
    # Of the disc 1, by the definition; a level is the mean of four texels of the finer one.
    face = moon_face(0.0, 0.0, 0.0)
    finest, half = face[:SIZE], face[SIZE : SIZE + SIZE // 2, : SIZE // 2]
    grid = (np.arange(SIZE) + 0.5) / SIZE * 2.0 - 1.0
    inside = grid[:, None] ** 2 + grid**2 < 1.0
    assert_allclose(finest[inside].mean(axis=0), 1.0, atol=0.01)
    assert_allclose(half, finest.reshape(SIZE // 2, 2, SIZE // 2, 2, 3).mean(axis=(1, 3)))


@pytest.mark.parametrize("month", [1, 4, 8])
def test_libration_is_the_ephemeris(month: int) -> None:
    # Second method: astronomy-engine's geocentric libration; the parallax of a place is below 1°.
    from astronomy import Libration, Time

    seen = moon_seen(Place(latitude=20.0, longitude=10.0), datetime(2026, month, 9, 3, tzinfo=UTC))
    wanted = Libration(Time.Make(2026, month, 9, 3, 0, 0.0))
    assert_allclose(seen.near_latitude, wanted.elat, atol=1.05)
    assert_allclose(seen.near_longitude, wanted.elon, atol=1.05)
