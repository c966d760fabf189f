"""A file is there whole, or the old one stays."""

from __future__ import annotations

import errno
import os
import sys
from pathlib import Path

import pytest

from airlight.errors import FileError
from airlight.files.atomic_file import atomic_file, check_target


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_the_content_appears_at_the_end(tmp_path: Path) -> None:
    target = tmp_path / "out.txt"
    with atomic_file(target) as place:
        place.write_text("new")
        assert not target.exists()
    assert target.read_text() == "new"
    assert names(tmp_path) == ["out.txt"]


@pytest.mark.parametrize("interruption", [RuntimeError, KeyboardInterrupt])
def test_an_interrupted_write_leaves_the_old_file_alone(
    tmp_path: Path, interruption: type[BaseException]
) -> None:
    target = tmp_path / "out.txt"
    target.write_text("old")
    with pytest.raises(interruption), atomic_file(target) as place:
        place.write_text("half")
        raise interruption
    assert target.read_text() == "old"
    assert names(tmp_path) == ["out.txt"]


def test_a_full_disk_is_one_clear_line(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="cannot be written: No space left") as refusal:
        with atomic_file(tmp_path / "out.txt"):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    assert "\n" not in str(refusal.value)
    assert names(tmp_path) == []


def test_a_link_is_followed_and_stays_a_link(tmp_path: Path) -> None:
    real = tmp_path / "real.txt"
    link = tmp_path / "link.txt"
    real.write_text("old")
    link.symlink_to(real)
    with atomic_file(link) as place:
        place.write_text("new")
    assert link.is_symlink()
    assert real.read_text() == "new"


@pytest.mark.skipif(sys.platform == "win32", reason="permission bits are POSIX")
def test_the_file_has_the_rights_of_any_new_file(tmp_path: Path) -> None:
    # a second method: what an ordinary write gives under the same umask
    (tmp_path / "plain.txt").write_text("x")
    with atomic_file(tmp_path / "out.txt") as place:
        place.write_text("x")
    plain, ours = (tmp_path / name for name in ("plain.txt", "out.txt"))
    assert ours.stat().st_mode == plain.stat().st_mode


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("no/such/out.txt", "there is no folder"),
        (".", "is a folder"),
        ("x" * 300, "too long"),
        ("zero\0byte", "null byte"),
    ],
)
def test_a_place_that_cannot_be_written_is_refused(tmp_path: Path, name: str, reason: str) -> None:
    with pytest.raises(FileError, match=reason) as refusal:
        check_target(tmp_path / name)
    assert "\n" not in str(refusal.value)


@pytest.mark.skipif(not Path("/dev/null").exists(), reason="no device files")
def test_a_device_is_never_replaced() -> None:
    with pytest.raises(FileError, match="not a regular file"):
        check_target("/dev/null")


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write")
def test_a_closed_folder_is_refused(tmp_path: Path) -> None:
    closed = tmp_path / "closed"
    closed.mkdir(mode=0o500)
    with pytest.raises(FileError, match="cannot be written to"):
        check_target(closed / "out.txt")
