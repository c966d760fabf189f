"""Film files of flights: written for ``airlight animate``, and read back as key frames."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

from airlight.errors import ParameterError
from airlight.files.atomic_file import atomic_file
from airlight.studies.film.film import Film
from airlight.studies.film.flight_path import UNITS
from airlight.studies.film.key_frames import FLIGHT
from airlight.studies.film.plan import EXPOSURE, VIEW

#: Frame rate of new films. [s⁻¹]
RATE: Final = 30


@dataclass(frozen=True, kw_only=True)
class FlightKey:
    """Key frame of a flight.

    Attributes
    ----------
    time : float
        Time since the start of the flight. [s]
    view : mapping from str to float
        Numbers of the view by the names of ``UNITS``. [deg], [m]
    exposure : float or None
        Fixed exposure; None if it is automatic. [EV]
    """

    time: float
    view: Mapping[str, float] = field(default_factory=dict)
    exposure: float | None = None


def write_flight(
    path: str | Path,
    keys: Sequence[FlightKey],
    *,
    planet: str,
    view: Mapping[str, Any],
    display: Mapping[str, Any],
) -> None:
    """Write the film file of a flight, completely or not at all.

    Parameters
    ----------
    path : str or Path
        Path of the file.
    keys : sequence of FlightKey
        Two key frames at least; the exposure is written if it is fixed in all.
    planet : str
        Name of a preset, or path of a planet file.
    view, display : mapping
        Other keys of the tables ``[view]`` and ``[display]``.
    """
    if len(keys) < 2:
        raise ParameterError("flight", f"{len(keys)} key frames", "two or more key frames")
    duration = keys[-1].time
    frames = round(duration * RATE) + 1
    at = [key.time / duration for key in keys]
    constant = {
        name: f"{keys[0].view[name]!r} deg"
        for name in ("roll", "field_of_view")
        if len({key.view[name] for key in keys}) == 1
    }
    lines = [
        f"# airlight animate {Path(path).name} -o {Path(path).stem} -o {Path(path).stem}.mp4",
        f"planet = {_text(planet)}",
        *_table("view", {**view, **constant}),
        *_table("display", display),
        *_table("film", {"frames": frames, "rate": RATE}),
    ]
    for name, unit in UNITS.items():
        if name not in constant:
            values = [f"{key.view[name]!r} {unit}" for key in keys]
            lines += _key_frames(f"{VIEW}{name}", values, at, FLIGHT)
    exposures = [key.exposure for key in keys]
    if None not in exposures:
        lines += _key_frames(EXPOSURE, exposures, at, "smooth")
    with atomic_file(path) as place:
        place.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _table(name: str, values: Mapping[str, Any]) -> list[str]:
    return ["", f"[{name}]", *(f"{key} = {_text(value)}" for key, value in values.items())]


def _key_frames(path: str, values: list[Any], at: list[float], law: str) -> list[str]:
    return _table("[film.keys]", {"path": path, "values": values, "at": at, "law": law})


def _text(value: Any) -> str:
    """Value in TOML, which is that in JSON."""
    return json.dumps(value, ensure_ascii=False)


def flight_keys(film: Film) -> tuple[FlightKey, ...]:
    """Key frames of a film of a flight.

    Raises
    ------
    ParameterError
        If the film has no key frames of the law ``flight``, or a clock.
    """
    plan = film.plan
    if plan.flight is None or film.view is None or plan.start is not None:
        raise ParameterError("film", film.name, "a film with key frames of the law 'flight'")
    times = plan.flight_keys[0].times
    duration = (plan.count - 1) / plan.rate
    # numbers of the flight, and those of its view that stay the same
    joined = {one.path.removeprefix(VIEW): one for one in plan.flight_keys}
    numbers = {name: one.numbers(UNITS[name]) for name, one in joined.items()}
    still = film.planet_view(0)
    for name in UNITS:
        if name not in numbers:
            value = getattr(still, name)
            if value is None:
                raise ParameterError("film", film.name, f"a film whose flight has view.{name}")
            numbers[name] = [float(value)] * len(times)
    return tuple(
        FlightKey(
            time=float(time) * duration,
            view={name: values[k] for name, values in numbers.items()},
            exposure=plan.exposure_at(float(time)),
        )
        for k, time in enumerate(times)
    )
