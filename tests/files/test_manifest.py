"""Files that are not ours: what a manifest lists unchanged may be replaced, and nothing else."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pytest

from airlight.errors import FileError
from airlight.files.atomic_folder import atomic_folder, check_folder
from airlight.files.manifest import (
    MANIFEST,
    fingerprint,
    is_sealed,
    read_manifest,
    sealed,
    write_manifest,
)
from airlight.studies.reports.report_pictures import check_pictures, write_pictures

FORM = "airlight test 1"
FILES = ("*.bin", "code.js")


def write(folder: Path, names: tuple[str, ...] = ("a.bin", "code.js"), **options: Any) -> None:
    with atomic_folder(folder, FORM, FILES, **options) as part:
        for name in names:
            (part / name).write_text(f"new {name}", encoding="utf-8")
        files = {name: fingerprint(part / name) for name in names}
        write_manifest(part, {"format": FORM, "files": files})


def contents(folder: Path) -> dict[str, bytes]:
    return {
        file.relative_to(folder).as_posix(): file.read_bytes()
        for file in sorted(folder.rglob("*"))
        if file.is_file()
    }


def tampered(folder: Path, files: dict[str, Any], *, seal: bool) -> None:
    """Manifest as received from somebody: with other files, and with a seal that fits or not."""
    content = json.loads((folder / MANIFEST).read_text(encoding="utf-8"))
    content["files"] |= files
    content = sealed(content) if seal else content
    (folder / MANIFEST).write_text(json.dumps(content), encoding="utf-8")


def test_own_files_are_replaced_and_stale_ones_removed(tmp_path: Path) -> None:
    write(tmp_path / "out")
    (tmp_path / "out" / "notes.txt").write_text("mine", encoding="utf-8")
    write(tmp_path / "out", ("b.bin",))
    assert sorted(contents(tmp_path / "out")) == ["b.bin", MANIFEST, "notes.txt"]
    assert is_sealed(read_manifest(tmp_path / "out" / MANIFEST, FORM))


@pytest.mark.parametrize("moves", range(4))
def test_a_folder_whose_writer_is_killed_is_replaced_by_the_next(
    moves: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # after any number of files the folder has a manifest, and no file that it does not list
    class Killed(BaseException):
        pass

    folder, left = tmp_path / "out", iter(range(moves))
    write(folder, ("a.bin", "b.bin", "stale.bin"))
    replace = Path.replace

    def killed(path: Path, target: Path) -> Path:
        if target.parent == folder and next(left, None) is None:
            raise Killed
        return replace(path, target)

    with monkeypatch.context() as patch, pytest.raises(Killed):
        patch.setattr(Path, "replace", killed)
        write(folder, ("a.bin", "b.bin", "code.js"))
    listed = read_manifest(folder / MANIFEST, FORM)["files"]
    assert set(contents(folder)) <= {*listed, MANIFEST}
    write(folder, ("a.bin", "b.bin", "code.js"))
    assert sorted(contents(folder)) == ["a.bin", "b.bin", "code.js", MANIFEST]


@pytest.mark.parametrize("name", ["a.bin", "b.bin", "code.js"])
def test_a_changed_or_foreign_file_stops_before_the_work_and_is_named(
    tmp_path: Path, name: str
) -> None:
    # a.bin and code.js: edited since; b.bin: never written by us, although of a name that we may
    # write
    folder = tmp_path / "out"
    write(folder)
    (folder / name).write_text("mine", encoding="utf-8")
    before = contents(tmp_path)
    for attempt in (lambda: check_folder(folder, FORM, FILES), lambda: write(folder, ("b.bin",))):
        with pytest.raises(FileError, match=f"{name}: is not .*allow overwriting"):
            attempt()
        assert contents(tmp_path) == before
    write(folder, (name,), overwrite=True)
    assert (folder / name).read_text(encoding="utf-8") == f"new {name}"


def test_overwrite_deletes_no_file_that_was_changed(tmp_path: Path) -> None:
    write(tmp_path / "out")
    (tmp_path / "out" / "code.js").write_text("mine", encoding="utf-8")
    write(tmp_path / "out", ("b.bin",), overwrite=True)
    assert (tmp_path / "out" / "code.js").read_text(encoding="utf-8") == "mine"
    assert not (tmp_path / "out" / "a.bin").exists()


HOSTILE = [
    "..", ".", "", "../victim.txt", "/etc/hostname", "sub/victim.txt", "..\\victim.txt", "C:x",
    "a\nb", "\u202egpj.exe", "x" * 300, "MANIFEST.json", " ..", "con:stream",
]  # fmt: skip


@pytest.mark.parametrize("seal", [False, True])
@pytest.mark.parametrize("name", HOSTILE)
def test_a_received_manifest_reaches_nothing_outside_its_folder(
    tmp_path: Path, name: str, seal: bool
) -> None:
    folder = tmp_path / "out"
    write(folder)
    (tmp_path / "victim.txt").write_text("mine", encoding="utf-8")
    (folder / "sub").mkdir()
    (folder / "sub" / "victim.txt").write_text("mine", encoding="utf-8")
    tampered(folder, {name: fingerprint(tmp_path / "victim.txt")}, seal=seal)
    before = contents(tmp_path)
    with pytest.raises(FileError, match=r"lists .* names of files in its own folder"):
        write(folder)
    assert contents(tmp_path) == before
    write(folder, overwrite=True)
    after = contents(tmp_path)
    assert after.pop(f"out/{MANIFEST}") != before.pop(f"out/{MANIFEST}")
    assert after == before


@pytest.mark.parametrize("seal", [False, True])
def test_a_file_named_in_a_received_manifest_is_not_deleted(tmp_path: Path, seal: bool) -> None:
    # With a checksum that does not fit the file is not what was listed; with one that does, but
    # added later, the manifest is not as it was written.
    folder = tmp_path / "out"
    write(folder)
    (folder / "photo.jpg").write_text("mine", encoding="utf-8")
    wrong = {"bytes": 4, "sha256": "0" * 64}
    said = wrong if seal else fingerprint(folder / "photo.jpg")
    tampered(folder, {"photo.jpg": said}, seal=seal)
    before = contents(tmp_path)
    with pytest.raises(
        FileError, match="photo.jpg: is not what" if seal else "since airlight wrote it"
    ):
        write(folder)
    assert contents(tmp_path) == before
    write(folder, overwrite=True)
    assert (folder / "photo.jpg").read_text(encoding="utf-8") == "mine"


@pytest.mark.skipif(os.name == "nt", reason="links need rights there")
@pytest.mark.parametrize("name", ["a.bin", MANIFEST])
@pytest.mark.parametrize("overwrite", [False, True])
def test_links_are_neither_followed_nor_replaced(
    tmp_path: Path, name: str, overwrite: bool
) -> None:
    folder = tmp_path / "out"
    write(folder)
    (folder / name).rename(tmp_path / "victim")
    (folder / name).symlink_to(tmp_path / "victim")
    before = contents(tmp_path)
    with pytest.raises(FileError, match=f"{name}: is"):
        write(folder, overwrite=overwrite)
    assert contents(tmp_path) == before


@pytest.mark.parametrize(
    "text", ["", "[]", "{", "[" * 100_000, '{"format": 1}', '{"format": "airlight test 1"', "\0"]
)
def test_a_damaged_manifest_stops_in_one_line(tmp_path: Path, text: str) -> None:
    (tmp_path / MANIFEST).write_text(text, encoding="utf-8")
    with pytest.raises(FileError, match="allow overwriting") as error:
        check_folder(tmp_path, FORM, FILES)
    assert len(str(error.value)) < 400
    write(tmp_path, overwrite=True)


def test_pictures_and_the_page_beside_them_follow_the_same_rule(tmp_path: Path) -> None:
    folder, page = tmp_path / "pictures", tmp_path / "report.md"
    write_pictures(folder, {"a.png": b"one"}, page, "text")
    page.write_text("text", encoding="utf-8")
    write_pictures(folder, {"b.png": b"two"}, page, "more")
    page.write_text("mine", encoding="utf-8")
    with pytest.raises(FileError, match=r"report\.md: is not"):
        check_pictures(folder, page)
    check_pictures(folder, page, overwrite=True)
    (folder / "c.png").write_bytes(b"mine")
    with pytest.raises(FileError, match=r"c\.png: is not"):
        check_pictures(folder)
    assert sorted(contents(folder)) == ["b.png", "c.png", MANIFEST]
