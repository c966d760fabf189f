"""Tables from others: whatever the files hold, one line, soon, and without much memory."""

from __future__ import annotations

import hashlib
import io
import json
import struct
import zipfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from airlight.engines.baking.array_files import read_arrays
from airlight.engines.baking.bake import bake
from airlight.engines.baking.table_files import load_table, load_tables, write_tables
from airlight.errors import AirlightError, FileError
from airlight.planets import load_planet


@pytest.fixture(scope="module")
def whole(solved: Any, tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    solution = solved(load_planet("earth-openspace"), (680.0, 550.0, 440.0), quality="preview")
    baked = bake(solution, "atmosphere-plus", size=(4, 8, 4), points=8)
    folder = tmp_path_factory.mktemp("baked")
    write_tables(folder, baked)
    return {file.name: file.read_bytes() for file in folder.iterdir()}


def put(folder: Path, whole: dict[str, bytes], name: str, content: bytes) -> None:
    """Tables with one file replaced, and its checksum in the manifest, as made on purpose."""
    for other, data in whole.items():
        (folder / other).write_bytes(content if other == name else data)
    if name != "manifest.json":
        said = json.loads(whole["manifest.json"])
        old, new = (hashlib.sha256(one).hexdigest() for one in (whole[name], content))
        text = json.dumps(said).replace(old, new)
        (folder / "manifest.json").write_text(text, encoding="utf-8")


def archive(members: dict[str, bytes]) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as file:
        for name, data in members.items():
            file.writestr(name, data)
    return stream.getvalue()


def array(shape: str, kind: str = "<f4", data: bytes = b"") -> bytes:
    head = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}\n".encode()
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head + data


@cache
def bomb() -> bytes:
    """1 GB of zeros in 4 MB."""
    stream = io.BytesIO()
    with (
        zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as file,
        file.open("values.npy", "w", force_zip64=True) as member,
    ):
        for _ in range(1000):
            member.write(bytes(10**6))
    return stream.getvalue()


HUGE = "(1000000, 1000000, 1000000)"
DAMAGED: dict[str, Callable[[bytes], bytes]] = {
    "nothing": lambda _: b"",
    "text": lambda _: b"hello",
    "half": lambda data: data[: len(data) // 2],
    "no archive": lambda data: b"PK\x05\x06" + data[4:],
    "flipped": lambda data: data[:60] + bytes([data[60] ^ 255]) + data[61:],
    "terabytes in the header": lambda _: archive({"values.npy": array(HUGE)}),
    "negative size": lambda _: archive({"values.npy": array("(-1,)")}),
    "objects": lambda _: archive({"values.npy": array("(1,)", "|O", b"\x80\x04K\x05.")}),
    "header of code": lambda _: archive({"values.npy": array("__import__('os').abort()")}),
    "nested header": lambda _: archive({"values.npy": array("(" * 20000)}),
    "no header": lambda _: archive({"values.npy": b""}),
    "version": lambda _: archive({"values.npy": b"\x93NUMPY\x09\x09aaaaaaaaaaaa"}),
    "bomb": lambda _: bomb(),
    "other names": lambda _: archive({"../../x.npy": array("(1,)", "<f4", bytes(4))}),
}


@pytest.mark.parametrize("damage", DAMAGED)
@pytest.mark.parametrize("name", ["scattering.npz", "phase-functions.npz"])
def test_a_damaged_array_is_one_line(
    whole: dict[str, bytes], tmp_path: Path, name: str, damage: str
) -> None:
    put(tmp_path, whole, name, DAMAGED[damage](whole[name]))
    with pytest.raises(AirlightError) as error:
        load_tables(tmp_path)
    assert "\n" not in str(error.value)
    assert len(str(error.value)) < 500


def test_numbers_that_are_not_finite_reach_no_look_up(
    whole: dict[str, bytes], tmp_path: Path
) -> None:
    arrays = read_arrays(tmp_path, whole["scattering.npz"], 10**9)
    values = arrays["values"].copy()
    values[0, 0, 0, :2] = np.nan, np.inf
    stream = io.BytesIO()
    np.savez(stream, values=values)
    put(tmp_path, whole, "scattering.npz", stream.getvalue())
    with pytest.raises(FileError, match="contains 2 values of values that are not finite"):
        load_tables(tmp_path)


def _nested(data: bytes) -> bytes:
    return data[:-2] + b', "x": ' + b"[" * 200_000 + b"]" * 200_000 + b"}"


MANIFESTS: dict[str, Callable[[dict[str, Any]], object]] = {
    "size": lambda said: said["tables"]["scattering"]["layout"].update(
        altitudes=10**15, views=10**15, suns=10**15
    ),
    "text for a number": lambda said: said["tables"]["scattering"].update(scale="much"),
    "infinite": lambda said: said["light"].update(reference=float("inf")),
    "list": lambda said: said.update(tables=[]),
    "path": lambda said: said["tables"].update({"../x": said["tables"]["scattering"]}),
    "digits": lambda said: said["tables"]["scattering"].update(scale=10**400),
    "null": lambda said: said["light"].update(files=None),
    "unit": lambda said: said["tables"]["scattering"].update(layout=None),
}


@pytest.mark.parametrize("damage", MANIFESTS)
def test_a_manifest_of_other_values_is_one_line(
    whole: dict[str, bytes], tmp_path: Path, damage: str
) -> None:
    said = json.loads(whole["manifest.json"])
    MANIFESTS[damage](said)
    put(tmp_path, whole, "manifest.json", json.dumps(said).encode())
    with pytest.raises(AirlightError) as error:
        load_tables(tmp_path)
        load_table(tmp_path)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    "content",
    [b"", b"\xff\xfe", b"[]", b"{", b"[" * 10**6, b'{"format": ' + b"9" * 10**6 + b"}", b"null"],
)
def test_what_is_no_manifest_is_one_line(
    whole: dict[str, bytes], tmp_path: Path, content: bytes
) -> None:
    put(tmp_path, whole, "manifest.json", content)
    with pytest.raises(FileError):
        load_tables(tmp_path)
    put(tmp_path, whole, "manifest.json", _nested(whole["manifest.json"]))
    with pytest.raises(FileError):
        load_tables(tmp_path / "manifest.json")
