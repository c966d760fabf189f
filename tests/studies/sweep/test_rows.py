"""Long tables of observers: block by block as all at once, resumed, in little memory."""

from __future__ import annotations

import csv
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from airlight.cli import main
from airlight.errors import FileError, ParameterError
from airlight.files.output_lock import output_lock
from airlight.planets import load_planet
from airlight.studies.sweep import rows
from airlight.studies.sweep.rows import answer_rows
from airlight.studies.sweep.shared_solution import RadianceTask

PLANET, NM = "earth-atmosphere-plus", (680.0, 550.0, 440.0)
HEADER = "site,altitude_m,sun_zenith_deg,view_zenith_deg,azimuth_deg\n"


def table(path: Path, count: int) -> Path:
    random = np.random.default_rng(7)
    values = random.uniform((0, 0, 0, 0), (9e3, 95, 180, 180), (count, 4)).round(3)
    with path.open("w", encoding="utf-8") as stream:
        stream.write("# a note\n" + HEADER)
        for number, row in enumerate(values):
            # a cell of two lines is one row
            site = '"two\nlines"' if number % 5 == 0 else f"site {number}"
            stream.write(f"{site},{','.join(map(str, row))}\n")
    return path


def answered(source: Path, target: Path, **options: object) -> int:
    task = RadianceTask(planet=load_planet(PLANET), wavelengths=NM, quality="preview")
    return answer_rows(task, str(source), str(target), **options)  # type: ignore[arg-type]


def hidden(folder: Path) -> list[str]:
    return sorted(file.name for file in folder.iterdir() if file.name.startswith("."))


class Killed(Exception):
    """End of a run by the test."""


def test_blocks_give_what_one_block_gives(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source = table(tmp_path / "in.csv", 60)
    answered(source, tmp_path / "one.csv")
    monkeypatch.setattr(rows, "BLOCK", 7)
    answered(source, tmp_path / "many.csv")
    assert (tmp_path / "many.csv").read_bytes() == (tmp_path / "one.csv").read_bytes()
    with (tmp_path / "one.csv").open(newline="") as stream:
        found = list(csv.reader(line for line in stream if not line.startswith("#")))
    assert len(found) == 61
    assert found[0][-3:] == ["radiance_680nm", "radiance_550nm", "radiance_440nm"]
    assert hidden(tmp_path) == []


def test_a_stopped_table_is_gone_on_with(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source, target = table(tmp_path / "in.csv", 60), tmp_path / "out.csv"
    answered(source, tmp_path / "whole.csv")
    monkeypatch.setattr(rows, "BLOCK", 7)

    def stop(done: int, total: int, message: str) -> None:
        if message == "radiance" and done >= 21:
            raise Killed

    with pytest.raises(Killed):
        answered(source, target, progress=stop)
    assert not target.exists()
    (part,) = tmp_path.glob("*.rows")
    with part.open("a") as stream:  # what a kill may leave behind the last whole block
        stream.write('site,1,2,"3')
    assert answered(source, target) == 21
    assert target.read_bytes() == (tmp_path / "whole.csv").read_bytes()
    assert hidden(tmp_path) == []


@pytest.mark.parametrize("damage", ["flipped", "truncated", "index", "index emptied"])
def test_a_table_is_gone_on_with_from_the_first_damaged_block(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, damage: str
) -> None:
    # the second of three blocks is not as it was written
    source, target = table(tmp_path / "in.csv", 60), tmp_path / "out.csv"
    answered(source, tmp_path / "whole.csv")
    monkeypatch.setattr(rows, "BLOCK", 7)

    def stop(done: int, total: int, message: str) -> None:
        if message == "radiance" and done >= 21:
            raise Killed

    with pytest.raises(Killed):
        answered(source, target, progress=stop)
    (part,), (index,) = tmp_path.glob("*.rows"), tmp_path.glob("*.index")
    lines = index.read_text().splitlines()
    ends = [int(line.split()[1]) for line in lines]
    content = bytearray(part.read_bytes())
    if damage == "flipped":
        content[ends[0] + 10] ^= 1
        part.write_bytes(content)
    elif damage == "truncated":
        part.write_bytes(content[: ends[1] - 1])
    elif damage == "index":
        index.write_text("\n".join([lines[0], "1 2 3", lines[2]]) + "\n")
    else:
        index.write_text("")
    with pytest.raises(Killed):  # once more in between: what is kept is noted anew
        answered(source, target, progress=stop)
    assert answered(source, target) == 21
    assert target.read_bytes() == (tmp_path / "whole.csv").read_bytes()
    assert hidden(tmp_path) == []


def test_a_table_has_one_writer_and_hidden_files_of_others_stay(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # also names that begin as its own do
    source, target = table(tmp_path / "in.csv", 20), tmp_path / "out.csv"
    others = [".out.csv.mine.rows", ".out.csv.index", ".out.csv.part"]
    for name in others:
        (tmp_path / name).touch()
    with output_lock(target), pytest.raises(FileError, match="is being written by another"):
        answered(source, target)
    assert answered(source, target) == 0
    assert hidden(tmp_path) == sorted(others)


def test_what_is_kept_of_another_input_is_not_used(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    source, target = table(tmp_path / "in.csv", 30), tmp_path / "out.csv"
    monkeypatch.setattr(rows, "BLOCK", 7)

    def stop(done: int, total: int, message: str) -> None:
        if message == "radiance":
            raise Killed

    with pytest.raises(Killed):
        answered(source, target, progress=stop)
    assert len(hidden(tmp_path)) == 2
    source.write_text(source.read_text().replace("site 3", "site x"))
    assert answered(source, target) == 0
    assert hidden(tmp_path) == []
    assert "site x" in target.read_text()


def test_a_bad_cell_far_below_is_found_before_anything_is_computed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(rows, "BLOCK", 7)
    source = table(tmp_path / "in.csv", 30)
    source.write_text(source.read_text() + "last,1,2,500,4\n")
    with pytest.raises(ParameterError, match="view_zenith_deg is '500'; allowed: 0 to 180"):
        answered(source, tmp_path / "out.csv")
    assert sorted(file.name for file in tmp_path.iterdir()) == ["in.csv"]


@pytest.mark.validation
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no kill -9")
def test_a_killed_command_goes_on_and_needs_little_memory(tmp_path: Path) -> None:
    # rows as text alone would take 100 MB more than the bound; a block is 8192 of them
    source, target = table(tmp_path / "in.csv", 200_000), tmp_path / "out.csv"
    words = ["radiance", PLANET, "--input", str(source), "-o", str(target), "--quality", "preview"]
    code = ("import sys, resource; from airlight.cli import main; status = main(sys.argv[1:]); "
            "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss); "
            "sys.exit(status)")  # fmt: skip
    process = subprocess.Popen([sys.executable, "-c", code, *words])
    deadline = time.monotonic() + 200.0
    while not any(path.stat().st_size > 2_000_000 for path in tmp_path.glob("*.rows")):
        assert process.poll() is None
        assert time.monotonic() < deadline
        time.sleep(0.01)
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    assert not target.exists()
    done = subprocess.run([sys.executable, "-c", code, *words], capture_output=True, text=True,
                          check=True)  # fmt: skip
    assert "rows had been computed before" in done.stderr
    few = table(tmp_path / "few.csv", 100)
    small = subprocess.run(
        [sys.executable, "-c", code, *words[:3], str(few), "-o", str(tmp_path / "few-out.csv"),
         *words[-2:]], capture_output=True, text=True, check=True)  # fmt: skip
    assert int(done.stdout) - int(small.stdout) < 80_000  # [kB]
    with target.open(newline="") as stream:
        assert sum(1 for _ in csv.reader(stream)) == 200_002


@pytest.mark.validation
def test_a_million_rows_are_answered(tmp_path: Path) -> None:
    source, target = table(tmp_path / "in.csv", 1_000_000), tmp_path / "out.csv"
    answered(source, target)
    with target.open(newline="") as stream:
        assert sum(1 for _ in csv.reader(stream)) == 1_000_002


def test_processes_are_refused_where_there_is_no_table(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["radiance", PLANET, "--sun-zenith", "0", "--view-zenith", "0", "--workers", "2"]
    assert main(words) == 2
    assert "--workers requires --input FILE" in capsys.readouterr().err


@pytest.mark.slow
def test_workers_write_what_one_process_writes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    source = table(tmp_path / "in.csv", 60)
    monkeypatch.setattr(rows, "BLOCK", 7)
    for workers in (1, 2):
        answered(source, tmp_path / f"{workers}.csv", workers=workers)
    assert (tmp_path / "1.csv").read_bytes() == (tmp_path / "2.csv").read_bytes()
