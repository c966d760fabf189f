"""Thread that lights clouds: what it says, and what it leaves behind."""

from __future__ import annotations

import pytest

from airlight.kernel.compiling import Compiling
from airlight.viewer.background import cloud_thread
from airlight.viewer.background.cloud_thread import CloudThread


class _Renderer:
    """Process that compiles the loops of pictures for ever."""

    def __init__(self) -> None:
        self.compiling = Compiling([], here=False)
        self.compiling.total = 1
        self.busy = True


def test_compilation_is_told_to_each_thread_and_to_none_that_has_ended(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # The process is shared by all windows: one that is closed must not be held, or woken, by it.
    renderer = _Renderer()
    monkeypatch.setattr(cloud_thread, "live_cloudy_compiler", lambda: renderer)
    woken: list[str] = []
    threads = {name: CloudThread(lambda name=name: woken.append(name)) for name in "AB"}
    for thread in threads.values():
        # idle itself, but pictures wait
        assert not thread.busy
        assert thread.doing.startswith("clouds: compiling, once: ")
    renderer.compiling._work["loop"] = 1
    renderer.compiling.finish("loop")
    assert sorted(woken) == ["A", "B"]
    threads.pop("A").close()
    renderer.compiling.finish("loop")
    assert len(renderer.compiling._observers) == 1
    renderer.busy = False
    assert threads["B"].doing == ""
    threads["B"].close()
    assert renderer.compiling._observers == []
