"""The automatic exposure of a session: it eases, holds, and is shared by both sides."""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable, Iterator
from typing import Any, cast

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Camera, Scene, load_planet
from airlight.planets.picture_wavelengths import picture_wavelengths
from airlight.render.gpu.device.device import Device
from airlight.render.live_renderer import LiveRenderer
from airlight.solver.moments.solution import MomentsSolution
from airlight.viewer.painting.picture_source import Picture, Request
from airlight.viewer.painting.side_renderer import SideRenderer
from airlight.viewer.session.adaptation import Adaptation
from airlight.viewer.session.session import Session
from airlight.viewer.window.sides import Sides

LONG = 60.0


class Clock:
    """Clock that a test moves. [s]"""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


def test_it_reaches_the_measured_exposure_in_half_a_second() -> None:
    clock = Clock()
    adaptation = Adaptation(clock)
    assert adaptation.exposure is None
    assert adaptation.towards(-3.0, held=False) == -3.0
    seen = [-3.0]
    for _ in range(30):
        clock.now += 1.0 / 60.0
        seen.append(adaptation.towards(1.0, held=False))
    assert np.all(np.diff(seen) >= 0.0)
    assert np.diff(seen).max() < 0.6
    # e^{-0.4/0.13} of four stops are left after 0.4 s: 0.18 EV
    assert_allclose(seen[24], 1.0, atol=0.2)
    while not adaptation.reached(1.0):
        clock.now += 1.0 / 60.0
        adaptation.towards(1.0, held=False)
    assert clock.now < 101.0


def test_it_never_passes_through_white() -> None:
    # A picture that becomes brighter by ten stops at once is never more than one too bright.
    clock = Clock()
    adaptation = Adaptation(clock)
    adaptation.towards(5.0, held=False)
    clock.now += 1.0 / 60.0
    assert -5.0 < adaptation.towards(-5.0, held=False) < -4.0


def test_a_rest_is_no_time_to_adapt_in() -> None:
    clock = Clock()
    adaptation = Adaptation(clock)
    adaptation.towards(0.0, held=False)
    clock.now += 1000.0
    assert adaptation.towards(4.0, held=False) < 2.5


def test_an_edited_planet_is_exposed_at_once_unless_it_is_locked() -> None:
    adaptation = Adaptation()
    adaptation.towards(0.0, held=False)
    assert adaptation.towards(-3.0, held=True, at_once=True) == 0.0
    assert adaptation.towards(-3.0, held=False, at_once=True) == -3.0
    session = Session("earth-atmosphere-plus")
    session.begin_drag("constituents[1].scattering")
    assert not session.holds_exposure
    session.set("display.locked", True)
    assert session.holds_exposure


@pytest.fixture(scope="module")
def request_(solved: Callable[..., MomentsSolution]) -> Request:
    earth = load_planet("earth-atmosphere-plus")
    nm = tuple(float(one) for one in picture_wavelengths(earth, "four"))
    camera = Camera(width=48, height=27, look_zenith=85.0, look_azimuth=60.0)
    scene = Scene(camera=camera, altitude=2e3, sun_zenith=70.0)
    return Request(solution=solved(earth, nm, "preview"), scene=scene, exposure=0.0, automatic=True)


def test_pictures_ease_until_the_exposure_is_reached(device: Device, request_: Request) -> None:
    renderer = SideRenderer(device.device, LiveRenderer())
    plain = list(renderer.render(request_, lambda: False))[-1]
    adaptation = Adaptation()
    adaptation.towards(plain.exposure - 4.0, held=False)
    held = dataclasses.replace(request_, adaptation=adaptation, held=True)
    shown = list(renderer.render(held, lambda: False))
    assert [one.exposure for one in shown] == [plain.exposure - 4.0] * len(shown)
    assert shown[-1].finished
    free = dataclasses.replace(held, held=False)
    assert not free.same(held)
    assert not free.same(dataclasses.replace(free, adaptation=None))  # as a side that does not lead
    eased = list(renderer.render(free, lambda: False))
    exposures = [one.exposure for one in eased]
    assert len(exposures) > 4
    assert exposures == sorted(exposures)
    assert exposures[-1] == plain.exposure
    assert [one.finished for one in eased] == [False] * (len(eased) - 1) + [True]


class Recorder:
    """PictureSource that measures an exposure of its own and paints nothing."""

    def __init__(self, measured: float) -> None:
        self.measured = measured

    def render(self, request: Request, stale: Callable[[], bool]) -> Iterator[Picture]:
        adaptation = request.adaptation if request.automatic else None
        exposure = request.exposure
        if request.automatic and adaptation is None:
            exposure += self.measured
        while True:
            if adaptation is not None:
                exposure = request.exposure + adaptation.towards(self.measured, held=request.held)
            yield Picture(view=None, width=1, height=1, request=request, exposure=exposure,
                          finished=True, seconds=0.0, by="nobody",
                          metered=self.measured)  # fmt: skip
            if adaptation is None or adaptation.reached(self.measured) or stale():
                return
            time.sleep(0.01)

    def close(self) -> None:
        pass


@pytest.fixture
def sides(request_: Request) -> Iterator[Callable[..., Sides]]:
    """Sides of a session whose pictures measure exposures, in the order of their first requests."""
    made: list[Sides] = []

    def solver(*_arguments: Any, **_named: Any) -> MomentsSolution:
        return request_.solution

    def make(session: Session, metered: tuple[float, float]) -> Sides:
        measured = iter(metered)
        made.append(
            Sides(
                session,
                lambda: cast(Any, Recorder(next(measured))),
                cast(Any, solver),
                lambda: None,
            )
        )
        return made[0]

    yield make
    for one in made:
        one.close()


def followed(sides: Sides, condition: Callable[[], object], *, both: bool) -> None:
    """Update the requests until a condition holds."""
    until = time.monotonic() + LONG
    while not condition():
        assert time.monotonic() < until
        sides.follow(both=both)
        time.sleep(0.02)


def test_a_side_that_is_swapped_while_it_adapts_stops(sides: Callable[..., Sides]) -> None:
    # Both would pull the exposure that they share, and none would reach its own.
    session = Session("earth-atmosphere-plus")
    session.store_b()
    one = sides(session, (-3.0, 5.0))
    session.adaptation.towards(12.0, held=False)
    followed(one, lambda: one.picture("A"), both=False)
    session.swap()
    followed(one, lambda: one.settled and one.picture("B"), both=False)
    assert session.adaptation.exposure == 5.0
    session.swap()
    followed(one, lambda: one.settled, both=False)
    assert session.adaptation.exposure == -3.0


@pytest.mark.parametrize("metered", [(-3.0, 5.0), (5.0, -3.0)])
@pytest.mark.parametrize("shared", [True, False])
def test_both_sides_share_the_exposure_of_the_brighter(
    metered: tuple[float, float], shared: bool, sides: Callable[..., Sides]
) -> None:
    session = Session("earth-atmosphere-plus")
    session.shares_exposure = shared
    session.store_b()
    wanted = (-3.0, -3.0) if shared else metered
    one = sides(session, metered)

    def exposures() -> tuple[float, ...]:
        shown = (one.picture("A"), one.picture("B"))
        return tuple(each.exposure for each in shown if each)

    followed(one, lambda: exposures() == wanted, both=True)
