"""One writer of an output at a time; a killed one holds nothing, and what it left goes."""

from __future__ import annotations

import contextlib
import itertools
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from airlight.engines.baking import atomic_file as files
from airlight.engines.baking import atomic_folder as folders
from airlight.engines.baking import output_lock as locks
from airlight.errors import FileError
from airlight.files.atomic_file import atomic_file
from airlight.files.atomic_folder import atomic_folder
from airlight.files.manifest import MANIFEST, fingerprint, write_manifest
from airlight.files.output_lock import hidden_file, output_lock

#: Program that enters one of the three, says so, and waits to be killed.
HOLDER = """if True:
    import sys, time
    from pathlib import Path
    from airlight.files.output_lock import output_lock
    from airlight.files.atomic_file import atomic_file
    from airlight.files.atomic_folder import atomic_folder
    path = Path(sys.argv[1])
    way = {"lock": lambda: output_lock(path), "file": lambda: atomic_file(path),
           "folder": lambda: atomic_folder(path, "a form")}[sys.argv[2]]
    with way() as part:
        if part is not None:
            (part / "table" if part.is_dir() else part).write_text("half")
        print("in", flush=True)
        time.sleep(600)
"""


@contextlib.contextmanager
def holder(path: Path, way: str) -> Iterator[subprocess.Popen]:
    process = subprocess.Popen(
        [sys.executable, "-c", HOLDER, str(path), way], stdout=subprocess.PIPE, text=True
    )
    try:
        assert process.stdout is not None
        assert process.stdout.readline() == "in\n"
        yield process
    finally:
        process.kill()
        process.communicate()


def write(path: Path, way: str, text: str) -> None:
    if way == "file":
        with atomic_file(path) as part:
            part.write_text(text)
    elif way == "folder":
        with atomic_folder(path, "a form") as part:
            (part / "table").write_text(text)
            listed = {"table": fingerprint(part / "table")}
            write_manifest(part, {"format": "a form", "files": listed})
    else:
        with output_lock(path):
            path.write_text(text)


def names(folder: Path) -> list[str]:
    return sorted(file.name for file in folder.iterdir())


@pytest.mark.parametrize("way", ["lock", "file", "folder"])
def test_a_second_process_is_refused_in_one_line(
    tmp_path: Path, way: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(files, "WAIT", 0.1)
    monkeypatch.setattr(folders, "WAIT", 0.1)
    with holder(tmp_path / "out", way):
        with pytest.raises(FileError, match="out: is being written by another process") as refusal:
            write(tmp_path / "out", way, "mine")
        assert "\n" not in str(refusal.value)
        write(tmp_path / "other", way, "mine")  # another output of the same folder is free


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no kill -9")
@pytest.mark.parametrize("way", ["lock", "file", "folder"])
def test_what_a_killed_process_left_goes_with_the_next_and_nothing_else(
    tmp_path: Path, way: str
) -> None:
    # the operating system releases the locks of a process
    with holder(tmp_path / "out", way) as process:
        process.send_signal(signal.SIGKILL)
        process.wait()
    left = names(tmp_path)
    assert len(left) == (1 if way == "lock" else 2)
    others = [".0123456789abcdef.part", ".note.part", "x.part"]
    for name in others:
        (tmp_path / name).touch()
    write(tmp_path / "out2", way, "mine")
    assert names(tmp_path) == sorted([*left, *others, "out2"])
    write(tmp_path / "out", way, "mine")
    assert names(tmp_path) == sorted([*others, "out", "out2"])


@pytest.mark.parametrize("way", ["file", "folder"])
def test_writers_wait_for_each_other_and_each_result_is_whole(tmp_path: Path, way: str) -> None:
    # eight threads write one output five times each: never two at once, and the last one stays
    inside: list[int] = []
    faults: list[BaseException] = []

    def work(number: int) -> None:
        try:
            for _ in range(5):
                with (atomic_file(tmp_path / "out") if way == "file"
                      else atomic_folder(tmp_path / "out", "a form")) as part:  # fmt: skip
                    inside.append(number)
                    assert len(inside) == 1
                    (part / "table" if way == "folder" else part).write_text(str(number) * 1000)
                    if way == "folder":
                        listed = {"table": fingerprint(part / "table")}
                        write_manifest(part, {"format": "a form", "files": listed})
                    time.sleep(0.002)
                    inside.remove(number)
        except BaseException as fault:
            faults.append(fault)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(120)
    assert faults == []
    content = (tmp_path / "out" / "table" if way == "folder" else tmp_path / "out").read_text()
    assert len(content) == 1000
    assert len(set(content)) == 1
    assert names(tmp_path) == ["out"]
    if way == "folder":
        assert names(tmp_path / "out") == [MANIFEST, "table"]


def test_hidden_files_belong_to_one_output(tmp_path: Path) -> None:
    # names as long as a file system allows, of any bytes; equal ones where letters' case is ignored
    outputs = [tmp_path / name for name in ("a.png", "b.png", "x" * 250, os.fsdecode(b"\xff\xfe"))]
    for one, other in itertools.combinations(outputs, 2):
        assert hidden_file(one, "part") != hidden_file(other, "part")
    for one in outputs:
        assert hidden_file(one, "part").parent == tmp_path
        with atomic_file(one) as part:
            part.touch()
    assert len(names(tmp_path)) == len(outputs)
    assert hidden_file(tmp_path / "A.PNG", "part") == hidden_file(outputs[0], "part")


@pytest.mark.skipif(sys.platform == "win32", reason="links need rights on Windows")
def test_links_in_the_place_of_hidden_files_are_not_followed(tmp_path: Path) -> None:
    note = tmp_path / "note.txt"
    note.write_text("mine")
    out = tmp_path / "out"
    hidden_file(out, "part").symlink_to(note)
    write(out, "file", "new")
    assert (note.read_text(), out.read_text()) == ("mine", "new")
    hidden_file(out, "lock").symlink_to(note)
    with pytest.raises(FileError, match="cannot be written"):
        write(out, "file", "newer")
    assert note.read_text() == "mine"


def test_a_file_system_without_locks_is_written_to(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # as Lustre answers where it is mounted without flock
    import errno

    def unknown(*_: Any) -> None:
        raise OSError(errno.ENOSYS, os.strerror(errno.ENOSYS))

    monkeypatch.setattr(locks.fcntl, "flock", unknown)
    write(tmp_path / "out", "file", "new")
    assert names(tmp_path) == ["out"]
