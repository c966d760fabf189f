"""Files that the user names: devices, pipes, folders, files without end: one line, at once."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import pytest

from airlight.cli import main
from airlight.errors import FileError
from airlight.files.input_files import check_input, read_bytes, read_text

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="no pipes in folders there")

#: Command lines that read FILE.
COMMANDS = {
    "planet": ["show", "FILE"],
    "planet of a picture": ["render", "FILE", "-o", "a.png"],
    "film": ["animate", "FILE", "-o", "frames"],
    "data": ["fit", "earth-openspace", "--data", "FILE", "--free", "ground.albedo", "-o", "a.toml"],
    "photo": ["fit", "earth-openspace", "--photo", "FILE", "--free", "ground.albedo", "--fov", "60",
              "--sun-zenith", "50", "--look", "60,0", "-o", "a.toml"],
    "cases": ["radiance", "earth-openspace", "--input", "FILE", "-o", "b.csv"],
    "observers of another solver": ["radiance", "earth-openspace", "--input", "FILE", "--solver",
                                    "montecarlo", "-o", "b.csv"],
    "colour": ["compose", "FILE", "-o", "a.png"],
    "map": ["render", "earth-openspace", "--set", "ground.map=FILE", "-o", "a.png", "--device",
            "cpu"],
    "clouds": ["render", "earth-openspace", "--set", "ground.clouds=FILE", "-o", "a.png",
               "--device", "cpu"],
    "spectrum of the star": ["show", "earth-openspace", "--set", "star.spectrum=",
                             "--set", "star.irradiance=FILE"],
}  # fmt: skip


@pytest.mark.parametrize("kind", ["pipe", "device", "folder", "missing"])
@pytest.mark.parametrize("command", COMMANDS)
def test_what_is_no_file_is_one_line_at_once(
    command: str,
    kind: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    # the suffix is the one that each of them asks for: no name alone is refused
    monkeypatch.chdir(tmp_path)
    suffix = {"data": ".csv", "photo": ".exr", "colour": ".exr", "map": ".png", "clouds": ".png",
              "spectrum of the star": ".csv"}.get(command, ".toml")  # fmt: skip
    file = tmp_path / f"input{suffix}"
    if kind == "pipe":
        os.mkfifo(file)
    elif kind == "device":
        file.symlink_to("/dev/zero")
    elif kind == "folder":
        file.mkdir()
    words = [word.replace("FILE", str(file)) for word in COMMANDS[command]]
    started = time.process_time()
    assert main(words) == 2
    assert time.process_time() - started < 20.0
    err = capsys.readouterr().err
    assert err.count("\n") == 1, err
    assert file.name in err
    assert "internal error" not in err


@pytest.mark.parametrize("name", ["pipe.csv", "zero.csv", "deep.csv"])
def test_files_that_other_files_name_are_read_as_carefully(tmp_path: Path, name: str) -> None:
    from airlight.engines.composition.pinhole import camera_from_json
    from airlight.image.exr import read_exr
    from airlight.image.hdr import read_hdr_header
    from airlight.physics.optics.index_table import read_index

    os.mkfifo(tmp_path / "pipe.csv")
    (tmp_path / "zero.csv").symlink_to("/dev/zero")
    (tmp_path / "deep.csv").write_text("[" * 100_000, encoding="utf-8")
    file = str(tmp_path / name)
    for read in (read_index, lambda path: camera_from_json(path, ""), read_exr, read_hdr_header):
        with pytest.raises(FileError, match=name.replace(".", r"\.")):
            read(file)


def test_a_file_that_grows_beyond_its_limit_is_not_read(tmp_path: Path) -> None:
    file = tmp_path / "large.csv"
    with file.open("wb") as stream:
        stream.truncate(10**12)  # a hole, which takes no room
    for read in (check_input, read_bytes):
        with pytest.raises(FileError, match="too large, 1e\\+03 GB; allowed: at most 32 MB"):
            read(file, 32_000_000)
    assert main(["fit", "earth-openspace", "--data", str(file), "--free", "ground.albedo", "-o",
                 str(tmp_path / "a.toml")]) == 2  # fmt: skip
    # files of the kernel say that they have no bytes, and have some
    if Path("/proc/self/maps").exists():
        with pytest.raises(FileError, match="too large"):
            read_bytes("/proc/self/maps", 10)
        assert "r-xp" in read_text("/proc/self/maps")
