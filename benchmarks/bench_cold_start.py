"""The whole command, from the shell's return key to the written picture.

Target: ``airlight render earth`` within 2 s with compiled code and solution cached.

Run with ``pytest benchmarks/bench_cold_start.py``.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

COMMAND = Path(sys.executable).with_name("airlight")


@pytest.mark.parametrize("words", [["--version"], ["render", "earth", "-o", "earth.png"]])
def test_command(benchmark: Any, words: list[str], tmp_path: Path) -> None:
    def run() -> None:
        subprocess.run([COMMAND, *words], cwd=tmp_path, check=True, capture_output=True)

    benchmark.pedantic(run, rounds=3, warmup_rounds=1)
