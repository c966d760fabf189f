"""``airlight radiance`` by place and time: the sun of the ephemeris, bearings, and a series."""

from __future__ import annotations

import csv
import io

import pytest
from numpy.testing import assert_allclose

from airlight.cli import main

EARTH = ("radiance", "earth-bruneton", "--quality", "preview", "--wavelengths", "550")
PLACE = ("--set", "body=earth", "--at", "40N,3.7W,0m")


def rows(capsys: pytest.CaptureFixture[str]) -> list[dict[str, float]]:
    table = csv.DictReader(io.StringIO(capsys.readouterr().out))
    return [{key: float(one) for key, one in row.items() if key != "time"} for row in table]


def test_a_series_is_that_of_its_angles(capsys: pytest.CaptureFixture[str]) -> None:
    # The angles of the table, asked for one by one; at noon the sun is in the south.
    day = ("--start", "2026-06-21T08:00Z", "--end", "2026-06-21T12:00Z", "--step", "2h")
    look = ("--view-zenith", "30", "--view-azimuth", "180")
    assert main([*EARTH, *PLACE, *day, *look, "--sun-distance", "file"]) == 0
    found = rows(capsys)
    assert len(found) == 3
    zeniths = [row["sun_zenith_deg"] for row in found]
    assert zeniths == sorted(zeniths, reverse=True)
    assert abs(found[2]["azimuth_deg"]) < 15.0  # 12:15 UTC is noon at 3.7° W
    for row in found:
        angles = (
            *("--altitude", "0m", "--sun-zenith", str(row["sun_zenith_deg"])),
            *("--view-zenith", "30", "--azimuth", str(row["azimuth_deg"])),
        )
        assert main([*EARTH, *angles]) == 0
        alone = float(capsys.readouterr().out.split()[2])
        assert_allclose(row["radiance_550nm"], alone, rtol=1e-6)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--sun-zenith", "60"), "--sun-zenith cannot be combined with --at"),
        (("--altitude", "0m,2km"), "--altitude is (0.0, 2000.0); allowed: a single altitude"),
        (
            ("--azimuth", "0", "--view-azimuth", "0"),
            "--view-azimuth cannot be combined",
        ),
    ],
)
def test_what_a_time_excludes_is_said(
    words: tuple[str, ...], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    time = ("--at", "40N,3.7W", "--time", "2026-06-21T08:00Z", "--view-zenith", "0")
    assert main([*EARTH, "--set", "body=earth", *time, *words]) == 2
    assert said in capsys.readouterr().err


def test_a_bearing_needs_a_place(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*EARTH, "--sun-zenith", "60", "--view-zenith", "0", "--view-azimuth", "0"]) == 2
    assert "--view-azimuth requires --at" in capsys.readouterr().err
