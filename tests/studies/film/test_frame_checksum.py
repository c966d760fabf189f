"""Frames that are damaged, or somebody else's: rendered again, or one line."""

from __future__ import annotations

import errno
import hashlib
import os
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from airlight.cli import main
from airlight.errors import FileError
from airlight.files.output_lock import hidden_file, output_lock
from airlight.render.picture import write_picture
from airlight.studies.film import Animated, Finish, Quality, animate, load_film
from airlight.studies.film import frames_folder as folders
from airlight.studies.film.frame_checksum import BLANK, is_whole, with_checksum

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
frames = 4
[[film.keys]]
path = "rock.position"
values = [["-1 km", "10 km", "0 km"], ["1 km", "9 km", "0 km"]]
"""
FINISHES = tuple(Finish(exposure=-3.0, **one) for one in ({}, {"bits": 16}, {"suffix": ".exr"}))  # type: ignore[arg-type]


@pytest.fixture
def rock(tmp_path: Path) -> Path:
    file = tmp_path / "rock.toml"
    file.write_text(SCENE, encoding="utf-8")
    return file


def rendered(rock: Path, folder: Path, finish: Finish = FINISHES[0], **options: object) -> Animated:
    small = Quality(width=32, height=18)
    return animate(load_film(rock), folder, how=small, workers=1, finish=finish, **options)  # type: ignore[arg-type]


def contents(folder: Path) -> dict[str, bytes]:
    return {file.name: file.read_bytes() for file in folder.iterdir()}


@pytest.mark.parametrize("finish", FINISHES, ids=["png", "png16", "exr"])
def test_the_checksum_is_that_of_all_other_bytes(
    rock: Path, tmp_path: Path, finish: Finish
) -> None:
    # SHA-256 of the file without the 64 digits, and in PNG without the CRC behind them, which
    # Pillow verifies; a flip of any bit of these is seen
    folder = tmp_path / "frames"
    rendered(rock, folder, finish)
    content = next(iter(contents(folder).values()))
    at = content.index(b"airlight.frame_checksum")
    while not content[at : at + 64].isalnum() or b"." in content[at : at + 64]:
        at += 1
    digits = content[at : at + 64].decode()
    rest = content[:at] + content[at + (64 if finish.suffix == ".exr" else 68) :]
    assert digits == hashlib.sha256(rest).hexdigest()
    assert is_whole(content)
    if finish.suffix == ".png":
        Image.open(next(folder.iterdir())).verify()
    crc = range(at + 64, at + 68) if finish.suffix == ".png" else ()
    random = np.random.default_rng(5)
    for place in {*random.integers(len(content), size=200).tolist(), at, at + 63} - {*crc}:
        changed = bytearray(content)
        changed[place] ^= 1 << int(random.integers(8))
        assert not is_whole(bytes(changed)), place


def test_a_file_without_a_place_for_a_checksum_is_refused() -> None:
    with pytest.raises(ValueError, match="no place"):
        with_checksum(BLANK.encode())


def flip(file: Path) -> None:
    content = bytearray(file.read_bytes())
    content[-40] ^= 1
    file.write_bytes(content)


@pytest.mark.parametrize("finish", FINISHES, ids=["png", "png16", "exr"])
@pytest.mark.parametrize(
    "damage", [flip, lambda file: os.truncate(file, 1000), lambda file: os.truncate(file, 0),
               lambda file: file.write_bytes(bytes(500)), lambda file: os.truncate(file, 1 << 20),
               lambda file: os.truncate(file, 1 << 42)],
    ids=["flipped", "truncated", "emptied", "zeros", "grown", "huge"],
)  # fmt: skip
def test_damaged_frames_are_drawn_again(
    rock: Path, tmp_path: Path, finish: Finish, damage: Callable[[Path], None]
) -> None:
    # the files as they were before
    folder, lines = tmp_path / "frames", []
    rendered(rock, folder, finish)
    before = contents(folder)
    for number in (2, 4):
        damage(folder / f"rock_0000{number}{finish.suffix}")
    (folder / f"rock_00001{finish.suffix}").unlink()
    done = rendered(rock, folder, finish, on_message=lines.append)
    assert (done.rendered, done.kept, done.damaged) == (3, 1, 2)
    assert lines[0] == "2 of 4 frames were damaged and are rendered again"
    assert contents(folder) == before


@pytest.mark.parametrize("kind", ["picture", "airlight's picture", "text", "link", "pipe"])
def test_a_file_that_is_no_frame_is_left_alone(rock: Path, tmp_path: Path, kind: str) -> None:
    # a picture of one's own, of another command, a text, and what is not a file
    folder = tmp_path / "frames"
    folder.mkdir()
    file, note = folder / "rock_00002.png", tmp_path / "note.txt"
    note.write_text("mine")
    if kind == "picture":
        Image.new("RGB", (4, 4)).save(file)
    elif kind == "text":
        file.write_text("mine")
    elif kind == "link":
        file.symlink_to(note)
    elif kind == "pipe":
        os.mkfifo(file)
    else:
        write_picture(file, np.ones((4, 4, 3), np.float32))
    with pytest.raises(FileError, match=r"rock_00002\.png: is not a ") as refusal:
        rendered(rock, folder)
    assert "choose another folder" in str(refusal.value)
    assert [one.name for one in folder.iterdir()] == ["rock_00002.png"]
    assert note.read_text() == "mine"


def test_a_full_disk_is_one_line_and_frames_are_kept(
    rock: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    # a disk that is full after two frames
    write, folder, left = Path.write_bytes, tmp_path / "frames", [2]

    def full(path: Path, content: bytes) -> int:
        if path.parent == folder:
            left[0] -= 1
            if left[0] < 0:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return write(path, content)

    monkeypatch.setattr(Path, "write_bytes", full)
    words = ["animate", str(rock), "--size", "32x18", "--exposure=-3", "--workers", "1",
             "-o", str(folder)]  # fmt: skip
    assert main(words) == 2
    *_, reported, last = capsys.readouterr().err.splitlines()
    assert reported == "airlight: 2 frames are complete; the same command renders the others"
    assert "rock_00003.png: cannot be written: No space left on device" in last
    assert sorted(contents(folder)) == ["rock_00001.png", "rock_00002.png"]
    left[0] = 100
    assert main(words) == 0
    assert "2 rendered, 2 unchanged" in capsys.readouterr().out


def test_a_closed_folder_is_refused_before_anything_is_drawn(
    rock: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # as the system answers on a file system that is mounted read-only
    def closed(*_: object) -> int:
        raise OSError(errno.EROFS, os.strerror(errno.EROFS))

    monkeypatch.setattr("airlight.files.output_lock.os.open", closed)
    with pytest.raises(FileError, match="frames: cannot be written: read-only file system"):
        rendered(rock, tmp_path / "frames")


def test_a_movie_has_one_writer_and_is_whole(
    rock: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("imageio_ffmpeg")
    movie = tmp_path / "rock.mp4"
    hidden_file(movie, "part").write_text("of a killed run")
    rendered(rock, tmp_path / "frames", movie=movie)
    before = movie.read_bytes()
    monkeypatch.setattr("airlight.files.atomic_file.WAIT", 0.1)
    with output_lock(movie), pytest.raises(FileError, match="is being written by another"):
        rendered(rock, tmp_path / "frames", movie=movie)
    monkeypatch.setattr("airlight.studies.film.movie._frame_count", lambda file: 3)
    with pytest.raises(FileError, match="ffmpeg has written 3 of 4 frames; the disk has"):
        rendered(rock, tmp_path / "frames", movie=movie)
    assert movie.read_bytes() == before
    assert sorted(one.name for one in tmp_path.iterdir()) == ["frames", "rock.mp4", "rock.toml"]
    assert len(contents(tmp_path / "frames")) == 4


def test_a_long_film_is_verified_with_progress(rock: Path, tmp_path: Path) -> None:
    folder, seen = tmp_path / "frames", []
    rendered(rock, folder)
    shutil.copy(folder / "rock_00001.png", folder / "rock_00099.png")  # of no frame of this film
    rendered(
        rock, folder, progress=lambda done, total, message: seen.append((done, total, message))
    )
    assert seen == [(n, 4, "verifying") for n in (1, 2, 3, 4)]
    assert folders.FramesFolder(folder, "Rock", ".png", 4).others()
