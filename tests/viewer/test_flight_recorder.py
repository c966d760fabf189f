"""Flights in a session: recorded, edited, played, saved and loaded."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import pytest

from airlight.errors import AirlightError
from airlight.studies.film import load_film
from airlight.viewer.navigation.flight_recorder import INTERVAL, STEP, FlightRecorder
from airlight.viewer.session.session import Session


@pytest.fixture
def recorder() -> FlightRecorder:
    """Three key frames over the equator, 3 s apart."""
    session = Session("mars")
    made = FlightRecorder(session)
    for longitude, altitude in ((0.0, 2.0), (40.0, 1e4), (80.0, 4e5)):
        session.move({"view.latitude": 0.0, "view.longitude": longitude, "view.altitude": altitude})
        made.add()
    return made


def longitude(recorder: FlightRecorder) -> float:
    return float(recorder._session.view["view.longitude"])


def test_key_frames_by_hand_follow_each_other_and_are_shown_exactly(
    recorder: FlightRecorder,
) -> None:
    assert [one.time for one in recorder.keys] == [0.0, STEP, 2.0 * STEP]
    recorder.show(STEP)
    assert longitude(recorder) == 40.0
    recorder.show(0.5 * STEP)
    assert 0.0 < longitude(recorder) < 40.0
    # the equator is a great circle
    assert recorder._session.view["view.latitude"] == pytest.approx(0.0, abs=1e-12)
    recorder._session.move({"view.altitude": 77.0})
    recorder.add()  # at the time that is shown, between the others
    assert [one.time for one in recorder.keys] == [0.0, 0.5 * STEP, STEP, 2.0 * STEP]


def test_key_frames_are_deleted_and_moved_between_their_neighbours(
    recorder: FlightRecorder,
) -> None:
    recorder.retime(1, 100.0)
    assert recorder.keys[1].time < recorder.keys[2].time
    recorder.retime(2, 9.0)
    recorder.retime(1, 4.0)
    recorder.retime(0, 2.0)  # the first stays
    assert [one.time for one in recorder.keys] == [0.0, 4.0, 9.0]
    recorder.delete(0)  # the flight starts with the next
    assert [one.time for one in recorder.keys] == [0.0, 5.0]


def test_playing_moves_forward_stops_at_the_end_and_is_one_undo_step(
    recorder: FlightRecorder,
) -> None:
    session = recorder._session
    session.end_drag()
    session.move({"view.longitude": -20.0}, gesture="look")
    session.end_drag()
    recorder.time = 0.0
    recorder.toggle_playing()
    seen = [longitude(recorder)]
    recorder.step(1e3)  # the first frame, after a rest
    while recorder.plays:
        recorder.step(0.1)
        seen.append(longitude(recorder))
    assert seen[0] == 0.0
    assert seen[-1] == 80.0
    assert seen == sorted(seen)
    assert recorder.time == recorder.duration
    assert session.undo() == "flight"
    assert longitude(recorder) == -20.0
    recorder.toggle_playing()  # from the start again
    assert longitude(recorder) == 0.0


def test_a_recording_has_a_key_frame_a_second_and_leaves_out_those_of_a_rest() -> None:
    session = Session("mars")
    recorder = FlightRecorder(session)
    recorder.toggle_recording()
    recorder.step(1e3)  # the first frame, after a rest
    for number in range(60):
        if number < 30:
            session.move({"view.longitude": 0.5 * number})
        recorder.step(0.1)
    recorder.toggle_recording()
    times = [one.time for one in recorder.keys]
    assert times[0] == 0.0
    assert times[-1] == pytest.approx(6.0)
    assert len(times) == 5  # 0, 1, 2, 3 and the end of the rest
    assert all(b - a > 0.99 * INTERVAL for a, b in pairwise(times))
    recorder.toggle_recording()
    recorder.toggle_recording()  # stopped at once: the rest is longer
    assert [one.time for one in recorder.keys[:-1]] == times[:-1]
    assert recorder.duration == pytest.approx(6.0 + STEP)


def test_a_fixed_exposure_is_that_of_the_key_frames() -> None:
    session = Session("mars")
    recorder = FlightRecorder(session)
    for exposure in (0.0, 2.0):
        session.change_view("x", {"display.automatic": False, "display.exposure": exposure})
        recorder.add()
    recorder.show(0.5 * STEP)
    assert session.display["exposure"] == pytest.approx(1.0)


def test_a_flight_saved_is_a_film_and_is_loaded_again(
    tmp_path: Path, recorder: FlightRecorder
) -> None:
    recorder._session.set("dust.particles.optical_depth", 1.5)
    recorder.save(tmp_path / "storm.toml")
    film = load_film(tmp_path / "storm.toml")
    assert film.plan.count == 181
    assert (tmp_path / "storm-planet.toml").is_file()
    assert film.planet_view(90).longitude == pytest.approx(40.0)
    other = FlightRecorder(Session("earth"))
    other.load(tmp_path / "storm.toml")
    assert [one.time for one in other.keys] == pytest.approx([0.0, STEP, 2.0 * STEP])
    for one, key in zip(other.keys, recorder.keys, strict=True):
        assert one.view == pytest.approx(dict(key.view))
    assert other._session.value("dust.particles.optical_depth") == 1.5
    assert longitude(other) == 0.0


def test_what_is_no_flight_is_refused_in_one_line(tmp_path: Path, recorder: FlightRecorder) -> None:
    with pytest.raises(AirlightError, match=r"ends in \.toml"):
        recorder.save(tmp_path / "flight.png")
    with pytest.raises(AirlightError):
        recorder.load(tmp_path / "missing.toml")
    empty = FlightRecorder(Session("mars"))
    for act in (empty.toggle_playing, lambda: empty.save(tmp_path / "a.toml")):
        with pytest.raises(AirlightError, match="two or more key frames"):
            act()
    assert len(recorder.keys) == 3
