"""Films as files: bitwise equal however they are rendered, resumed, and whole after a kill -9."""

from __future__ import annotations

import hashlib
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from airlight.cli import main
from airlight.errors import FileError
from airlight.files.output_lock import hidden_file
from airlight.render.picture import read_picture_metadata
from airlight.studies.film import Finish, Quality, animate, load_film
from airlight.studies.film.frames_folder import FINGERPRINT, FramesFolder

SCENE = """
name = "Rock"
[[bodies]]
name = "rock"
radius = "1 km"
position = ["0 km", "10 km", "0 km"]
[[lights]]
star = { spectrum = "astm-g173" }
direction = [0.3, -1, 0.2]
[observer]
position = ["0 km", "0 km", "0 km"]
[camera]
direction = [0, 1, 0]
field_of_view = "20 deg"
[film]
frames = 20
[[film.keys]]
path = "rock.position"
values = [["-1 km", "10 km", "0 km"], ["1 km", "9 km", "0 km"]]
"""
AIR = {
    "film.frames": 8, "view.look_zenith": "85 deg",
    "film.keys": [{"path": "view.sun_zenith", "values": "84 deg, 96 deg"}],
}  # fmt: skip
HOW = Quality(width=48, height=27, wavelengths=(680.0, 550.0, 440.0), quality="preview")
SMALL = Quality(width=32, height=18)


@pytest.fixture
def rock(tmp_path: Path) -> Path:
    file = tmp_path / "rock.toml"
    file.write_text(SCENE, encoding="utf-8")
    return file


def contents(folder: Path) -> dict[str, str]:
    return {
        file.name: hashlib.sha256(file.read_bytes()).hexdigest()
        for file in sorted(folder.iterdir())
    }


def rendered(rock: Path, folder: Path, **options: object) -> tuple[int, int]:
    finish = Finish(**options)  # type: ignore[arg-type]
    done = animate(load_film(rock), folder, how=SMALL, workers=1, finish=finish)
    return done.rendered, done.kept


@pytest.mark.slow
def test_one_process_and_two_workers_write_the_same_bytes(tmp_path: Path) -> None:
    film = load_film("earth-atmosphere-plus", AIR)
    for workers in (1, 2):
        animate(film, tmp_path / str(workers), how=HOW, workers=workers)
    one, two = (contents(tmp_path / str(workers)) for workers in (1, 2))
    assert len(one) == 8
    assert one == two
    assert len(set(one.values())) == 8


def test_only_what_is_missing_or_changed_is_drawn(rock: Path, tmp_path: Path) -> None:
    folder = tmp_path / "frames"
    locked = {"exposure": -3.0}
    assert rendered(rock, folder, **locked) == (20, 0)
    before = contents(folder)
    assert rendered(rock, folder, **locked) == (0, 20)
    (folder / "rock_00007.png").unlink()
    cut = folder / "rock_00009.png"
    cut.write_bytes(cut.read_bytes()[:-20])
    assert rendered(rock, folder, **locked) == (2, 18)
    assert contents(folder) == before
    # the first half of the film stays as it is, the second is another
    at = 'law = "linear"\nat = [0, 0.5, 1]'
    whole = SCENE.replace('["1 km", "9 km", "0 km"]]', '["0 km", "9 km", "0 km"], LAST]\n' + at)
    rock.write_text(whole.replace("LAST", '["1 km", "8 km", "0 km"]'))
    assert rendered(rock, folder, **locked) == (19, 1)  # the first stands where it stood
    rock.write_text(whole.replace("LAST", '["1 km", "8 km", "2 km"]'))
    assert rendered(rock, folder, **locked) == (10, 10)
    assert rendered(rock, folder, exposure=-2.0) == (20, 0)


def test_the_header_holds_the_fingerprint_of_png_and_exr(rock: Path, tmp_path: Path) -> None:
    film = load_film(rock, {"film.frames": 1})
    for finish in (Finish(), Finish(bits=16), Finish(suffix=".exr")):
        folder = tmp_path / f"{finish.bits}{finish.suffix[1:]}"
        assert animate(film, folder, how=SMALL, finish=finish).rendered == 1
        assert animate(film, folder, how=SMALL, finish=finish).kept == 1
        texts = read_picture_metadata(folder / f"rock_00001{finish.suffix}")
        assert len(texts[f"airlight.{FINGERPRINT}"]) == 32


def test_a_folder_takes_one_film_at_a_time_and_what_a_killed_one_left_goes(tmp_path: Path) -> None:
    # a temporary file of one of its frames goes, and those of anybody else stay
    frames = FramesFolder(tmp_path / "frames", "Film", ".png", 2)
    with frames.claimed():
        hidden_file(frames.path(1), "part").touch()
        (frames.folder / ".0123.part").touch()
        other = FramesFolder(tmp_path / "frames", "Film", ".png", 2)
        with pytest.raises(FileError, match="is being written by another process"), other.claimed():
            pass
    with frames.claimed():
        assert [file.name for file in frames.folder.glob(".*.part")] == [".0123.part"]
    assert [file.name for file in frames.folder.iterdir()] == [".0123.part"]


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no kill -9")
def test_a_killed_film_is_finished_by_a_second_start(rock: Path, tmp_path: Path) -> None:
    # first a worker is killed, whose frames others draw; then the scheduler with its process
    folder = tmp_path / "frames"
    words = ["animate", str(rock), "--size", "32x18", "--exposure", "0", "--workers", "2",
             "--set", "film.frames=120", "-o", str(folder)]  # fmt: skip
    code = "import sys; from airlight.cli import main; sys.exit(main(sys.argv[1:]))"
    process = subprocess.Popen([sys.executable, "-c", code, *words], stderr=subprocess.PIPE)
    try:
        wait_for(process, folder, 10)
        workers = [pid for pid, line in children(process.pid) if "spawn_main" in line]
        assert len(workers) == 2
        os.kill(workers[0], signal.SIGKILL)
        wait_for(process, folder, frames_in(folder) + 10)
    finally:
        process.kill()
        process.communicate()
    assert process.returncode == -signal.SIGKILL
    there = contents(folder)
    done = sum(name.endswith(".png") for name in there)
    assert 20 <= done < 120
    deadline = time.monotonic() + 60.0
    while any(Path(f"/proc/{pid}").exists() for pid in workers) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert not any(Path(f"/proc/{pid}").exists() for pid in workers)
    assert main(["1" if word == "2" else word for word in words]) == 0
    names = [f"rock_{n:05d}.png" for n in range(1, 121)]
    after = contents(folder)
    assert sorted(after) == names
    assert {name: after[name] for name in there if name in names} == {
        name: there[name] for name in there if name in names
    }


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="Windows sends no SIGINT to a group")
def test_ctrl_c_ends_all_processes_in_two_lines(rock: Path, tmp_path: Path) -> None:
    # a terminal sends the signal to the whole group, workers too
    folder = tmp_path / "frames"
    words = ["animate", str(rock), "--size", "32x18", "--exposure", "0", "--workers", "2",
             "--set", "film.frames=3000", "-o", str(folder)]  # fmt: skip
    code = "import sys; from airlight.cli import main; sys.exit(main(sys.argv[1:]))"
    process = subprocess.Popen(
        [sys.executable, "-c", code, *words], stderr=subprocess.PIPE, start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )  # fmt: skip
    try:
        wait_for(process, folder, 10)
        os.killpg(process.pid, signal.SIGINT)
        _, said = process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == 130
    # a machine that has measured slow pictures also announces 3000 of them
    lines = [line for line in said.decode().splitlines() if "3000 frames of" not in line]
    assert lines[0].endswith("2 processes")
    assert lines[1].endswith("the same command renders the others")
    assert lines[2:] == ["airlight: cancelled"]
    assert all(name.endswith(".png") for name in contents(folder))


def frames_in(folder: Path) -> int:
    return len(list(folder.glob("*.png"))) if folder.is_dir() else 0


def wait_for(process: subprocess.Popen[bytes], folder: Path, count: int) -> None:
    deadline = time.monotonic() + 300.0
    while frames_in(folder) < count:
        assert process.poll() is None, process.stderr.read().decode()  # type: ignore[union-attr]
        assert time.monotonic() < deadline
        time.sleep(0.02)


def children(parent: int) -> Iterator[tuple[int, str]]:
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            status = (folder / "stat").read_text().rpartition(")")[2].split()
            line = (folder / "cmdline").read_text().replace("\0", " ")
        except OSError:
            continue
        if int(status[1]) == parent:
            yield int(folder.name), line
