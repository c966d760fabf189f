"""Thread that lights clouds: what it says, and what it leaves behind."""

from __future__ import annotations

import time
from types import SimpleNamespace
from typing import Any, cast

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
    renderers = {kinds: _Renderer() for kinds in (1, 2)}
    monkeypatch.setattr(cloud_thread, "live_cloudy_compiler", renderers.__getitem__)
    monkeypatch.setattr(CloudThread, "serve", lambda *_: None)
    request = cast(Any, SimpleNamespace(same=lambda _: False, planet=SimpleNamespace(clouds="c")))
    woken: list[str] = []
    threads = {name: CloudThread(lambda name=name: woken.append(name)) for name in "AB"}
    for thread in threads.values():
        thread.want(request)
        while thread.busy:
            time.sleep(0.01)
        # idle itself, but pictures wait
        assert thread.doing.startswith("clouds: compiling, once: ")
    one, two = (renderers[kinds].compiling for kinds in (1, 2))
    one._work["loop"] = 1
    time.sleep(0.1)
    woken.clear()
    one.finish("loop")
    assert sorted(woken) == ["A", "B"]
    # other clouds: another process
    threads["B"].want(SimpleNamespace(**{**vars(request), "planet": SimpleNamespace(clouds="cc")}))
    assert (len(one._observers), len(two._observers)) == (1, 1)
    threads["A"].close()
    assert one._observers == []
    renderers[2].busy = False
    while threads["B"].busy:
        time.sleep(0.01)
    assert threads["B"].doing == ""
    threads["B"].close()
    assert two._observers == []
