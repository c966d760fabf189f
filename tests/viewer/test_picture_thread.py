"""Painting thread: the newest request wins, errors are reported, and it ends."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from airlight.errors import Cancelled, ParameterError
from airlight.scene import Camera, Scene
from airlight.scene.picture_size import scaled
from airlight.viewer.painting.picture_source import Picture, Request
from airlight.viewer.painting.picture_thread import PictureThread

#: Time limit of any wait here, generous for a busy machine. [s]
LONG = 60.0


class Slow:
    """PictureSource whose second, fine picture waits until it is released or superseded."""

    def __init__(self) -> None:
        self.painted: list[float] = []
        self.closed = False

    def render(self, request: Request, stale: Callable[[], bool]) -> Iterator[Picture]:
        if request.exposure > 10.0:
            raise ParameterError("exposure", request.exposure, "at most 10 EV")
        if request.exposure < -10.0:
            raise ZeroDivisionError("a fault\nof two lines")
        yield self.picture(request, finished=False)
        until = time.monotonic() + 4.0 * LONG
        while request.exposure != 3.0 and time.monotonic() < until:
            if stale():
                raise Cancelled("newer")
            time.sleep(0.002)
        yield self.picture(request, finished=True)

    def picture(self, request: Request, *, finished: bool) -> Picture:
        self.painted.append(request.exposure)
        return Picture(
            view=None,
            width=1,
            height=1,
            request=request,
            exposure=request.exposure,
            finished=finished,
            seconds=0.0,
            by="test",
        )

    def close(self) -> None:
        self.closed = True


def wish(exposure: float) -> Request:
    nothing: Any = None
    return Request(solution=nothing, scene=Scene(), exposure=exposure)


def until(condition: Callable[[], bool]) -> None:
    limit = time.monotonic() + LONG
    while not condition():
        assert time.monotonic() < limit
        time.sleep(0.002)


@pytest.fixture
def thread() -> Iterator[tuple[PictureThread, Slow, list[int]]]:
    renderer, wakes = Slow(), [0]

    def wake() -> None:
        wakes[0] += 1

    made = PictureThread(renderer, wake)
    yield made, renderer, wakes
    made.close()
    assert renderer.closed


def test_the_newest_wish_is_painted_to_the_end(
    thread: tuple[PictureThread, Slow, list[int]],
) -> None:
    # The first requests block until they are stale: only a newer one can end them.
    made, renderer, wakes = thread
    for exposure in (1.0, 2.0, 3.0):
        made.want(wish(exposure))
        until(lambda exposure=exposure: exposure in renderer.painted)
    until(lambda: not made.busy)
    assert made.picture is not None
    assert made.picture.finished
    assert made.picture.exposure == 3.0
    assert renderer.painted == [1.0, 2.0, 3.0, 3.0]  # coarse ones of all, a fine one of the last
    assert wakes[0] >= 4


def test_the_same_wish_is_painted_once(thread: tuple[PictureThread, Slow, list[int]]) -> None:
    made, renderer, _ = thread
    made.want(wish(3.0))
    until(lambda: not made.busy)
    made.want(wish(3.0))
    assert not made.busy
    assert renderer.painted == [3.0, 3.0]


def test_errors_are_one_line_and_the_thread_lives_on(
    thread: tuple[PictureThread, Slow, list[int]],
) -> None:
    made, _, _ = thread
    made.want(wish(11.0))
    until(lambda: not made.busy)
    assert made.error == "exposure is 11.0; allowed: at most 10 EV"
    made.want(wish(-11.0))
    until(lambda: not made.busy)
    assert made.error == "ZeroDivisionError: a fault of two lines"
    made.want(wish(3.0))
    until(lambda: not made.busy)
    assert made.error == ""


def test_closing_ends_a_picture_under_way() -> None:
    renderer = Slow()
    made = PictureThread(renderer, lambda: None)
    made.want(wish(1.0))
    until(lambda: renderer.painted == [1.0])
    assert made._thread.is_alive()
    made.close()
    assert not made._thread.is_alive()


@pytest.mark.parametrize(
    ("projection", "size"),
    [("perspective", (640, 360)), ("equirectangular", (640, 320)), ("cubemap", (636, 106))],
)
def test_small_pictures_keep_their_projections_shape(
    projection: str, size: tuple[int, int]
) -> None:
    # A camera rejects an aspect ratio that does not fit its projection.
    scene = Scene(camera=Camera(projection=projection, width=size[0], height=size[1]))
    for part in (1.0, 0.5, 0.1, 1e-3):
        camera = scaled(scene, part).camera
        assert camera.width <= max(size[0] * part + 1.0, 6.0)
