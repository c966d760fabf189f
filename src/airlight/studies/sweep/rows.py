"""Radiances of a long table of observers, block by block, in bounded memory, resumable."""

from __future__ import annotations

import contextlib
import hashlib
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple, TextIO

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError
from airlight.files.atomic_file import check_target
from airlight.files.output_lock import output_lock
from airlight.kernel.cost import LINES, announce_all
from airlight.studies.distribution import opened_runner
from airlight.studies.distribution.fingerprint import check_code, code_digest, digest
from airlight.studies.sweep.cases import (
    Cases,
    case_blocks,
    check_table,
    radiance_columns,
    write_head,
    write_rows,
)
from airlight.studies.sweep.shared_solution import RadianceTask

if TYPE_CHECKING:
    from airlight.kernel.threads import Progress

FloatArray = NDArray[np.float64]

#: Rows of a block.
BLOCK: Final = 1 << 13
_SOURCE: Final = Path(__file__)
#: Suffix of the name of a hidden file: fingerprint and purpose.
_NAME: Final = re.compile(r"[0-9a-f]{32}\.(rows|index)")


def answer_rows(
    task: RadianceTask,
    source: str,
    target: str,
    *,
    scheduler: str | None = None,
    workers: int | None = 1,
    progress: Progress | None = None,
) -> int:
    """Write a table of observers with their radiances appended.

    Computed rows are in hidden files in the target's folder, from which a run with the same inputs
    resumes at the first missing or damaged block. The target appears when complete and is locked
    meanwhile.

    Parameters
    ----------
    task : RadianceTask
        Planet, wavelengths and accuracy.
    source : str
        Path of a CSV for ``case_blocks``, read twice: first for validation.
    target : str
        Path of the new CSV; ``-`` is the standard output, which keeps nothing.
    scheduler, workers : optional
        See ``airlight.studies.distribution.opened_runner``; default: one process.

    Returns
    -------
    int
        Number of rows from an earlier run.
    """
    check_table(target, (".csv",))
    with case_blocks(source, BLOCK) as (head, blocks):
        total = sum(len(block.rows) for block in blocks)
    nm, stokes = task.wavelengths, task.stokes
    task.solution(progress)
    code = code_digest(_SOURCE)
    with (
        _Table.opened(target, digest((task, code), (Path(source),))) as table,
        case_blocks(source, BLOCK) as (head, blocks),
    ):
        if not table.blocks:
            write_head(table.stream, head, radiance_columns(nm, stokes=stokes))
        waiting: dict[int, Cases] = {}

        def tasks() -> Iterator[tuple[int, tuple[RadianceTask, FloatArray, str]]]:
            for number, block in enumerate(blocks):
                if number >= table.kept:
                    waiting[number] = block
                    yield number, (task, block.values, code)

        rest = total - min(table.kept * BLOCK, total)
        amount = float(rest * len(nm) * (3 if stokes else 1))
        announce_all(f"{rest} lines of sight", [(LINES, amount)])
        found: dict[int, FloatArray] = {}
        count = -(-total // BLOCK) - table.kept
        with opened_runner(count, scheduler=scheduler, workers=workers) as runner:
            for number, values in runner.run(radiances_of_lines, tasks()):
                found[number] = values
                while table.blocks in found:  # blocks end in any order, and are written in sequence
                    at = table.blocks
                    write_rows(table.stream, waiting.pop(at), found.pop(at))
                    table.end_block()
                if progress is not None:
                    progress(min(table.blocks * BLOCK, total), total, "radiance")
        return min(table.kept * BLOCK, total)


def radiances_of_lines(task: RadianceTask, lines: FloatArray, code: str) -> FloatArray:
    """Radiances of a block, shape (n, wavelengths), or ``stokes_layers`` side by side.

    Parameters
    ----------
    task : RadianceTask
        Planet, wavelengths and accuracy.
    lines : array, shape (n, 4)
        Altitude, zenith angles of sun and view, azimuth. [m, deg, deg, deg]
    code : str
        Hash of the sender's source code.
    """
    check_code(code, _SOURCE)
    altitude, sun, view, azimuth = lines.T
    parts = task.layers(altitude=altitude, sun_zenith=sun, view_zenith=view, azimuth=azimuth)
    return np.concatenate(parts, axis=-1)


class _Table:
    """Output table with its stream and number of blocks.

    Attributes
    ----------
    stream : text stream
        Stream that rows are written to.
    kept, blocks : int
        Number of blocks of earlier runs, and of all blocks.
    """

    def __init__(
        self, stream: TextIO, index: TextIO | None, kept: int, part: Path | None = None
    ) -> None:
        self.stream, self._index, self.kept, self.blocks = stream, index, kept, kept
        self._part, self._end = part, 0 if part is None else part.stat().st_size

    def end_block(self) -> None:
        """Record a complete block and its checksum after flushing it."""
        self.blocks += 1
        self.stream.flush()
        if self._index is None or self._part is None:
            return
        with self._part.open("rb") as written:
            written.seek(self._end)
            content = written.read()
        self._end += len(content)
        self._index.write(str(_Note(self.blocks, self._end, _checksum(content))))
        self._index.flush()

    @classmethod
    @contextlib.contextmanager
    def opened(cls, target: str, mark: str) -> Iterator[_Table]:
        """Open the output table, with the rows of an earlier run of the same fingerprint."""
        if target == "-":
            yield cls(sys.stdout, None, 0)
            return
        path = check_target(target)
        part = path.with_name(f".{path.name}.{mark}.rows")
        index = path.with_name(f".{path.name}.{mark}.index")
        table: _Table | None = None
        with output_lock(path):
            try:
                for old in path.parent.glob(f".{_literal(path.name)}.*"):
                    if _NAME.fullmatch(old.name[len(path.name) + 2 :]) and old not in (part, index):
                        old.unlink(missing_ok=True)  # of another planet, or of another input
                noted = _noted(index, part)
                with part.open("a", encoding="utf-8", newline="") as stream:
                    stream.truncate(noted[-1].end if noted else 0)
                    with index.open("w", encoding="ascii") as notes:
                        notes.writelines(map(str, noted))
                        table = cls(stream, notes, len(noted), part)
                        yield table
                part.replace(path)
                index.unlink(missing_ok=True)
            except OSError as error:
                reason = f"cannot be written: {error.strerror or error}"
                if table is not None and table.blocks:
                    reason += f"; {table.blocks} blocks are kept, and the same command goes on"
                raise FileError(target, reason) from error
            finally:
                if table is None or table.blocks == 0:  # nothing to resume
                    part.unlink(missing_ok=True)
                    index.unlink(missing_ok=True)


class _Note(NamedTuple):
    """Line of the index: number of a block from 1, its end in the file, its checksum."""

    number: int
    end: int
    checksum: str

    def __str__(self) -> str:
        return f"{self.number} {self.end} {self.checksum}\n"


def _literal(name: str) -> str:
    """Name escaped for ``glob``."""
    return "".join(f"[{letter}]" if letter in "*?[" else letter for letter in name)


def _noted(index: Path, part: Path) -> list[_Note]:
    """Index lines of the intact blocks up to the first damaged one."""
    found: list[_Note] = []
    try:
        with part.open("rb") as stream, index.open(encoding="ascii") as lines:
            for number, line in enumerate(lines, 1):
                _, end, checksum = line.split()
                content = stream.read(max(int(end) - stream.tell(), 0))
                note = _Note(number, stream.tell(), checksum)
                if line != str(note) or checksum != _checksum(content):
                    break
                found.append(note)
    except (OSError, ValueError):  # absent, or damaged from here on
        pass
    return found


def _checksum(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
