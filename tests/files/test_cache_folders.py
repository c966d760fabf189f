"""Caches that others can write to are neither read nor written; what is made is for one user."""

from __future__ import annotations

import hashlib
import os
import pickle
import shutil
import stat
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from airlight.errors import AirlightWarning
from airlight.files import cache_folders
from airlight.files.cache_folders import make_folder, open_trusted, trusted_folder
from airlight.kernel import disk

pytestmark = pytest.mark.skipif(os.name != "posix", reason="owners and modes of POSIX")

#: A user who is neither this one nor root.
OTHER = 54321
FORMULA = """
from airlight.kernel import compiled_loop, kernel
@kernel
def squared(x):
    return x * x
@compiled_loop
def cubed(x):
    return squared(x) * x
"""
SCRIPT = """
import os, sys
os.umask(0o{umask:o})
sys.path.insert(0, {folder!r})
{before}
import formula
print(formula.cubed(3.0), sum(formula.cubed.stats.cache_hits.values()))
"""
LINE = (
    "{}, and is not used: nothing is cached, and code is compiled in memory; "
    "remove it, or set AIRLIGHT_CACHE to a folder of your own"
)


def run(folder: Path, *, before: str = "", umask: int = 0o022) -> tuple[str, str]:
    """Result of the formula and hits of its cache, and what is said of the cache."""
    (folder / "formula.py").write_text(FORMULA)
    text = SCRIPT.format(folder=str(folder), before=before, umask=umask)
    done = subprocess.run(
        [sys.executable, "-W", "always", "-c", text], capture_output=True, text=True, timeout=300,
        env={**os.environ, "AIRLIGHT_CACHE": str(folder / "cache")}, check=True,
    )  # fmt: skip
    said = [line for line in done.stderr.splitlines() if "AirlightWarning" in line]
    return done.stdout.strip(), "\n".join(line.partition("Warning: ")[2] for line in said)


def contents(folder: Path) -> dict[Path, bytes]:
    return {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()}


@pytest.fixture(scope="module")
def compiled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("compiled")
    assert run(folder) == ("27.0 0", "")
    assert run(folder) == ("27.0 1", "")
    return folder


@pytest.fixture
def used(compiled: Path, tmp_path: Path) -> Path:
    """Folder with a formula whose code is in its cache."""
    return Path(shutil.copytree(compiled, tmp_path / "used"))


@pytest.fixture(autouse=True)
def nothing_said() -> Iterator[None]:
    cache_folders._said.clear()
    yield
    cache_folders._said.clear()


def give_away(path: Path) -> str:
    """Make a file or folder another user's; return what a process of this user runs before."""
    if os.geteuid() == 0:
        os.chown(path, OTHER, -1, follow_symlinks=False)
        return ""
    return "os.geteuid = lambda uid=os.geteuid(): uid + 1"  # whose files all are another's


def levels(cache: Path) -> list[Path]:
    (index,) = cache.rglob("formula.cubed*.nbi")
    return [one for one in (index, *index.parents) if one == cache or cache in one.parents]


@pytest.mark.parametrize(
    ("level", "mode"),
    [(0, 0o1777), (4, 0o702)],
)
def test_a_folder_that_others_can_write_to_is_left_alone(level: int, mode: int, used: Path) -> None:
    folder = levels(used / "cache")[::-1][level]
    folder.chmod(mode)
    before = contents(used / "cache")
    said = LINE.format(f"{folder} can be written by others")
    assert run(used) == ("27.0 0", said)
    assert contents(used / "cache") == before


def test_a_folder_of_another_user_is_left_alone(used: Path) -> None:
    before = contents(used / "cache")
    said = LINE.format(f"{used / 'cache'} belongs to another user")
    assert run(used, before=give_away(used / "cache")) == ("27.0 0", said)
    assert contents(used / "cache") == before


def test_an_empty_folder_for_all_stays_empty(tmp_path: Path) -> None:
    (tmp_path / "cache").mkdir()
    (tmp_path / "cache").chmod(0o777)
    result, said = run(tmp_path)
    assert result == "27.0 0"
    assert said == LINE.format(f"{tmp_path / 'cache'} can be written by others")
    assert list((tmp_path / "cache").iterdir()) == []


class Hostile:
    """Object whose pickle writes a witness when it is read."""

    def __init__(self, witness: Path) -> None:
        self.witness = witness

    def __reduce__(self) -> tuple[Callable[..., object], tuple[str]]:
        return os.mkdir, (str(self.witness),)


def put_hostile(index: Path, witness: Path, *, checksum: bool) -> None:
    content = pickle.dumps(Hostile(witness))
    if checksum:
        content += hashlib.sha256(index.name.encode() + b"\0" + content).digest()
    index.write_bytes(content)


@pytest.mark.parametrize("ours", [True, False])
def test_an_index_by_another_is_not_unpickled(ours: bool, used: Path) -> None:
    # whoever can write it writes its checksum too: the first case shows that it is no guarantee
    index = levels(used / "cache")[0]
    put_hostile(index, used / "witness", checksum=True)
    before = "" if ours else give_away(index)
    result, said = run(used, before=before)
    assert result == "27.0 0"
    assert (used / "witness").exists() == ours
    assert ("belongs to another user" in said) != ours


def test_a_damaged_index_is_not_unpickled(used: Path) -> None:
    put_hostile(levels(used / "cache")[0], used / "witness", checksum=False)
    assert run(used) == ("27.0 0", "")
    assert not (used / "witness").exists()
    assert run(used) == ("27.0 1", "")  # it was compiled again


@pytest.mark.parametrize("suffix", ["nbi", "nbc"])
def test_a_file_that_others_can_write_is_replaced(suffix: str, used: Path) -> None:
    for file in (used / "cache").rglob(f"*.{suffix}"):
        file.chmod(0o666)
    result, said = run(used)
    assert result == "27.0 0"
    assert "can be written by others" in said
    assert len(said.splitlines()) == 1
    assert run(used) == ("27.0 1", "")


def test_what_is_made_is_for_this_user_alone(tmp_path: Path) -> None:
    assert run(tmp_path, umask=0) == ("27.0 0", "")
    made = [tmp_path / "cache", *(tmp_path / "cache").rglob("*")]
    modes = {stat.S_IMODE(one.stat().st_mode) for one in made if one.is_dir()}
    assert modes == {0o700}
    files = [one for one in made if one.suffix in (".nbi", ".nbc")]
    assert {stat.S_IMODE(one.stat().st_mode) for one in files} == {0o600}
    assert run(tmp_path, umask=0) == ("27.0 1", "")


def test_what_root_has_made_is_trusted(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    # as the cache of an image or a system; root may do all in any case
    folder = tmp_path if os.geteuid() == 0 else Path("/usr")
    monkeypatch.setattr(os, "geteuid", lambda: OTHER)
    assert trusted_folder(folder) == folder


@pytest.mark.skipif(os.geteuid() != 0, reason="only root gives links away")
def test_a_link_of_another_user_is_not_followed(tmp_path: Path) -> None:
    make_folder(tmp_path / "own")
    link = tmp_path / "link"
    link.symlink_to("own")
    assert trusted_folder(link) == link
    give_away(link)
    with pytest.warns(AirlightWarning, match="link belongs to another user"):
        assert trusted_folder(link) is None


def test_solutions_of_others_are_not_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    cache = tmp_path / "cache"
    monkeypatch.setenv("AIRLIGHT_CACHE", str(cache))
    monkeypatch.setattr(disk, "cache_folder", cache_folders.cache_folder)
    disk.save("abc", {"a": np.arange(3.0)})
    assert_array_equal((disk.load("abc") or {})["a"], np.arange(3.0))
    file = cache / "solutions" / "abc.npz"
    file.chmod(0o660)
    with pytest.warns(AirlightWarning, match=r"abc\.npz can be written by others"):
        assert disk.load("abc") is None
    file.chmod(0o600)
    cache.chmod(0o777)
    assert disk.load("abc") is None  # said once
    disk.save("def", {"a": np.arange(3.0)})
    assert [one.name for one in (cache / "solutions").iterdir()] == ["abc.npz"]
    cache.chmod(0o700)
    assert disk.load("abc") is not None


def test_a_file_is_judged_as_it_was_opened(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("ours")
    with open_trusted(tmp_path / "a") as stream:
        assert stream.read() == b"ours"
    with pytest.raises(FileNotFoundError):
        open_trusted(tmp_path / "b")


def test_the_units_of_others_are_not_unpickled(tmp_path: Path) -> None:
    # pint keeps what it has parsed as pickles
    script = "import airlight.physics.units as u; print(u.quantity('1 parsec', 'm') > 3e16)"
    cache = tmp_path / "cache"
    for mode, made in ((0o777, False), (0o700, True)):
        make_folder(cache)
        cache.chmod(mode)
        done = subprocess.run(
            [sys.executable, "-c", script], capture_output=True, text=True, check=True,
            env={**os.environ, "AIRLIGHT_CACHE": str(cache)},
        )  # fmt: skip
        assert done.stdout == "True\n"
        assert (cache / "units").exists() == made


def test_nothing_is_compiled_ahead_where_nothing_is_kept(tmp_path: Path) -> None:
    (tmp_path / "cache").mkdir()
    (tmp_path / "cache").chmod(0o777)
    before = (
        "import formula\n"
        "from airlight.kernel.background_compiler import BackgroundCompiler\n"
        "ahead = BackgroundCompiler('formula:none', [formula.cubed])\n"
        "assert ahead._process is None and ahead.ready(formula.cubed)\n"
        "formula.cubed(2.0)\n"
        "assert ahead.compiling.done == ahead.compiling.total == 2\n"
    )
    assert run(tmp_path, before=before)[0] == "27.0 0"
