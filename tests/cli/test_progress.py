"""Progress bar: drawn on a terminal, and nowhere else."""

from __future__ import annotations

import io

import pytest

from airlight.cli.console import shown_progress


class Terminal(io.StringIO):
    """Stream that claims to be a terminal."""

    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize(("stream", "drawn"), [(io.StringIO(), False), (Terminal(), True)])
def test_a_bar_is_drawn_on_a_terminal_only(
    stream: io.StringIO, drawn: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sys.stderr", stream)
    monkeypatch.setenv("TERM", "xterm")
    with shown_progress() as report:
        report(0, 0, "solving")  # what there is to do may not be known yet
        report(3, 4, "solving")
    assert ("solving" in stream.getvalue()) == drawn


def test_the_bar_goes_when_the_work_is_interrupted(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = Terminal()
    monkeypatch.setattr("sys.stderr", stream)
    monkeypatch.setenv("TERM", "xterm")
    with pytest.raises(KeyboardInterrupt), shown_progress() as report:
        report(1, 4, "solving")
        raise KeyboardInterrupt
    # the cursor is shown again: ECMA-48 private mode 25
    assert "\x1b[?25h" in stream.getvalue()
