"""Cache of decoded ground maps on disk, shared by all processes.

A map of the ground with its levels has some hundred million bytes, which take longer to decode than
a frame takes to render. The file is memory-mapped: processes share its pages, and the system
reclaims those in no use.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Final

import numpy as np

from airlight.files.input_files import LARGEST_MAP, check_input
from airlight.kernel import disk
from airlight.kernel.fingerprints import fingerprint
from airlight.scene.map_levels import Levels

#: Folder of the cache.
_FOLDER: Final = "maps"
#: Smallest map that is cached; smaller ones are decoded quickly. [byte]
SMALLEST: Final = 1 << 22


def cached_levels(
    source: Path, files: Sequence[Path | None], decode: Callable[[], Levels]
) -> Levels:
    """Levels of a map, from the cache or decoded and cached.

    Parameters
    ----------
    source : Path
        Source file of the decoder, whose code belongs to the cache key.
    files : sequence of Path or None
        Pictures; None, or one that is missing, for a part that the map lacks.
    decode : callable
        Decodes the pictures.

    Returns
    -------
    Levels
        Size and texels, read-only; memory-mapped if cached.
    """
    try:
        key = _key(source, files)
    except OSError:  # the reader reports the error
        return decode()
    kept = _load(key)
    if kept is None:
        made = decode()
        if made.flat.nbytes < SMALLEST:
            return made
        disk.save(key, {"size": np.array(made[:2]), "flat": made.flat}, _FOLDER)
        kept = _load(key)
    return made if kept is None else kept


def _load(key: str) -> Levels | None:
    arrays = disk.load(key, _FOLDER, in_place=True)
    if arrays is None or not {"size", "flat"} <= set(arrays):
        return None
    rows, columns = arrays["size"].tolist()
    return Levels(rows, columns, arrays["flat"])


def _key(source: Path, files: Sequence[Path | None]) -> str:
    digest = hashlib.sha256(fingerprint(source).encode())
    for file in files:
        if file is None or not file.is_file():
            digest.update(bytes(1))
            continue
        check_input(file, LARGEST_MAP)
        with file.open("rb") as stream:
            digest.update(hashlib.file_digest(stream, "sha256").digest())
    return digest.hexdigest()[:32]
