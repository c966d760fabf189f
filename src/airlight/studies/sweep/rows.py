"""Radiances of a long table of observers, block by block: bounded memory, resumed after a kill."""

from __future__ import annotations

import contextlib
import hashlib
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple, TextIO

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError
from airlight.files.atomic_file import check_target
from airlight.files.output_lock import output_lock
from airlight.kernel.cost import LINES, announce_all
from airlight.planets.planet import Planet
from airlight.studies.distribution import opened_runner
from airlight.studies.distribution.fingerprint import check_code, code_digest, digest
from airlight.studies.sweep.cases import (
    Cases,
    case_blocks,
    check_table,
    polarised_answers,
    radiance_columns,
    write_head,
    write_rows,
)
from airlight.studies.sweep.shared_solution import shared_solution

if TYPE_CHECKING:
    from airlight.kernel.threads import Progress
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]

#: Rows of a block.
BLOCK: Final = 1 << 13
_SOURCE: Final = Path(__file__)
#: End of the name of a hidden file: fingerprint and purpose.
_NAME: Final = re.compile(r"[0-9a-f]{32}\.(rows|index)")


@dataclass(frozen=True, kw_only=True)
class Lines:
    """Lines of sight of one block, or those of a table without their values.

    Attributes
    ----------
    planet : Planet
        Planet.
    wavelengths : tuple of float
        Wavelengths. [nm]
    quality : str
        Quality of its solution.
    polarisation, stokes : bool
        Whether light is polarised, and whether I, Q and U, degree and angle are wanted.
    cache : bool
        Whether the solution is kept on disk.
    values : array, shape (n, 4), or None
        Altitude, zenith angles of sun and view, azimuth. [m, deg, deg, deg]
    """

    planet: Planet
    wavelengths: tuple[float, ...]
    quality: str = "default"
    polarisation: bool = True
    stokes: bool = False
    cache: bool = True
    values: FloatArray | None = None


def answer_rows(
    lines: Lines,
    source: str,
    target: str,
    *,
    scheduler: str | None = None,
    workers: int | None = 1,
    progress: Progress | None = None,
) -> int:
    """Write a table of observers with their radiances appended.

    Computed rows are in hidden files in the target's folder, and a second start with the same
    table, planet, wavelengths and quality goes on from there, from the first block that is not as
    it was written; the target appears when it is whole. One process writes it at a time.

    Parameters
    ----------
    lines : Lines
        What is asked for: planet, wavelengths and settings.
    source : str
        Path of a CSV as ``case_blocks`` reads it. It is read twice: first every cell is checked.
    target : str
        Path of the new CSV; ``-`` is the standard output, which keeps nothing.
    scheduler, workers : optional
        See ``distribution.opened_runner``; one process, with all its threads, by default.
    progress : callable, optional
        See ``airlight.kernel.threads``.

    Returns
    -------
    int
        Number of rows that an earlier start had computed.

    Raises
    ------
    FileError
        If a file cannot be read or written.
    ParameterError
        For the first cell that is not a number in its range.
    WorkerError
        If workers or their scheduler are lost.
    """
    check_table(target, (".csv",))
    with case_blocks(source, BLOCK) as (head, blocks):
        total = sum(len(block.rows) for block in blocks)
    nm, stokes = lines.wavelengths, lines.stokes
    _solution(lines, progress)
    code = code_digest(_SOURCE)
    asked = (lines.planet, nm, lines.quality, lines.polarisation, stokes, code)
    mark = digest(asked, (Path(source),))
    with _Table.opened(target, mark) as table, case_blocks(source, BLOCK) as (head, blocks):
        if not table.blocks:
            write_head(table.stream, head, radiance_columns(nm, stokes=stokes))
        waiting: dict[int, Cases] = {}

        def tasks() -> Iterator[tuple[int, tuple[Lines, str]]]:
            for number, block in enumerate(blocks):
                if number >= table.kept:
                    waiting[number] = block
                    yield number, (replace(lines, values=block.values), code)

        rest = total - min(table.kept * BLOCK, total)
        amount = float(rest * len(nm) * (3 if stokes else 1))
        announce_all(f"{rest} lines of sight", [(LINES, amount)])
        found: dict[int, FloatArray] = {}
        count = -(-total // BLOCK) - table.kept
        with opened_runner(count, scheduler=scheduler, workers=workers) as runner:
            for number, values in runner.run(radiances_of_lines, tasks()):
                found[number] = values
                while table.blocks in found:  # blocks end in any order, and are written in theirs
                    at = table.blocks
                    write_rows(table.stream, waiting.pop(at), found.pop(at))
                    table.end_block()
                if progress is not None:
                    progress(min(table.blocks * BLOCK, total), total, "radiance")
        return min(table.kept * BLOCK, total)


def radiances_of_lines(lines: Lines, code: str) -> FloatArray:
    """Radiances of a block, shape (n, wavelengths), or what ``polarised_answers`` returns.

    Parameters
    ----------
    lines : Lines
        Lines of sight.
    code : str
        Hash of the source of the process that sent them.
    """
    check_code(code, _SOURCE)
    solution = _solution(lines)
    assert lines.values is not None
    altitude, sun, view, azimuth = lines.values.T
    found = solution.radiance(
        altitude=altitude, sun_zenith=sun, view_zenith=view, azimuth=azimuth, stokes=lines.stokes
    )
    return polarised_answers(found) if lines.stokes else np.asarray(found, float)


def _solution(lines: Lines, progress: Progress | None = None) -> MomentsSolution:
    """Solution shared by all blocks."""
    return shared_solution(
        lines.planet,
        lines.wavelengths,
        lines.quality,
        polarisation=lines.polarisation,
        cache=lines.cache,
        progress=progress,
    )


class _Table:
    """Table that grows block by block: its stream, and how many blocks it has.

    Attributes
    ----------
    stream : text stream
        Stream that rows are written to.
    kept, blocks : int
        Number of blocks that were there, and that are there now.
    """

    def __init__(
        self, stream: TextIO, index: TextIO | None, kept: int, part: Path | None = None
    ) -> None:
        self.stream, self._index, self.kept, self.blocks = stream, index, kept, kept
        self._part, self._end = part, 0 if part is None else part.stat().st_size

    def end_block(self) -> None:
        """Note that a block is whole, and its checksum, after it has left this process."""
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
                if table is None or table.blocks == 0:  # nothing to go on from
                    part.unlink(missing_ok=True)
                    index.unlink(missing_ok=True)


class _Note(NamedTuple):
    """Line of the index: number of a block, 1 the first, its end in the file, its checksum."""

    number: int
    end: int
    checksum: str

    def __str__(self) -> str:
        return f"{self.number} {self.end} {self.checksum}\n"


def _literal(name: str) -> str:
    """Name without a meaning of its letters for ``glob``."""
    return "".join(f"[{letter}]" if letter in "*?[" else letter for letter in name)


def _noted(index: Path, part: Path) -> list[_Note]:
    """Notes of the blocks that are as they were written, up to the first that is not."""
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
