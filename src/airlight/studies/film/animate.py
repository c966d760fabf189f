"""``animate``: parallel, resumable rendering of a film to a folder of frames."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from airlight.kernel import disk
from airlight.kernel.cost import announce_all
from airlight.render.picture import LINEAR
from airlight.scene.metering import METERED
from airlight.studies.distribution import Runner, opened_runner
from airlight.studies.distribution.fingerprint import check_code, code_digest, digest
from airlight.studies.film.exposure_curve import ExposureCurve, metered_numbers
from airlight.studies.film.film import Film
from airlight.studies.film.finish import Finish, finished
from airlight.studies.film.frame_checksum import BLANK, CHECKSUM, with_checksum
from airlight.studies.film.frame_spec import FrameSpec, Quality, distinct_solutions
from airlight.studies.film.frames_folder import FINGERPRINT, FramesFolder
from airlight.studies.film.movie import check_movie, write_movie

if TYPE_CHECKING:
    from airlight.kernel.threads import Progress

#: Maximum number of cached frame specifications; if the planet varies, each holds a planet.
_CACHE_SIZE: Final = 512
#: Number of frames from which the number of a film's solutions is estimated.
_SAMPLED: Final = 32
#: Modules whose source is part of a frame's fingerprint.
_SOURCES: Final = tuple(Path(__file__).with_name(name) for name in ("frame_spec.py", "finish.py"))


def _code() -> str:
    return code_digest(*_SOURCES)


@dataclass(frozen=True, kw_only=True)
class Animated:
    """Result of ``animate``.

    Attributes
    ----------
    frames : FramesFolder
        Folder of its frames.
    rendered, kept : int
        Number of frames rendered, and of existing frames.
    damaged : int
        Number of rendered frames that replaced damaged ones.
    exposures : (float, float) or None
        Lowest and highest exposure, for PNG. [EV]
    """

    frames: FramesFolder
    rendered: int
    kept: int
    damaged: int
    exposures: tuple[float, float] | None


def animate(
    film: Film,
    folder: str | Path,
    *,
    how: Quality | None = None,
    finish: Finish | None = None,
    movie: str | Path | None = None,
    scheduler: str | None = None,
    workers: int | None = None,
    on_message: Callable[[str], None] | None = None,
    progress: Progress | None = None,
) -> Animated:
    """Render the missing, damaged and changed frames of a film.

    The header of each file has a fingerprint of all inputs and a checksum. Files are written
    atomically: an interrupted run loses only the frames in progress.

    Parameters
    ----------
    film : Film
        Film from ``load_film``, whose name is the prefix of the frames' file names.
    folder : str or Path
        Folder of the frames.
    how : Quality, optional
        Size of the frames, accuracy of the solution and the rendering.
    finish : Finish, optional
        Format, exposure and display; default: those of the film's file.
    movie : str or Path, optional
        Path of an MP4.
    scheduler, workers : optional
        See ``airlight.studies.distribution.opened_runner``.
    on_message : callable, optional
        Receives progress messages.
    progress : callable, optional
        See ``airlight.kernel.threads``.

    Raises
    ------
    ParameterError
        If a key of the film or an option is invalid.
    FileError
        If the folder or the MP4 cannot be written, the disk is full, another film is being written
        to the folder, or a file with the name of a frame is not a frame.
    WorkerError
        If the connection to workers or their scheduler is lost.
    """
    how, finish = how or Quality(), finish or Finish(**film.display)
    job = _Job(film, how, finish, progress)
    frames = FramesFolder(Path(folder), film.name, finish.suffix, film.plan.count)
    say = on_message or (lambda line: None)
    for number in {0, film.plan.count // 2, film.plan.count - 1}:
        job.frame_spec(number)  # raise errors here that a worker would raise later
    if movie is not None:
        check_movie(Path(movie), "movie")
    with frames.claimed(), contextlib.ExitStack() as stack:
        present = frames.present(progress)
        if present.damaged:
            count = len(present.damaged)
            say(f"{count} of {frames.count} frames were damaged and are rendered again")
        runner: Runner | None = None

        def opened(tasks: int) -> Runner:
            nonlocal runner
            if runner is None:
                runner = stack.enter_context(
                    opened_runner(tasks, scheduler=scheduler, workers=workers)
                )
                say(f"{tasks} frames to render by {runner.description}")
                job.announce(tasks)
                job.prepare(runner)
            return runner

        curve = job.curve(lambda: opened(film.plan.count))
        whole = present.fingerprints
        missing = [n for n in range(frames.count) if whole.get(n) != job.fingerprint(n)]
        if missing:
            job.light_clouds(opened(len(missing)), missing)
            say_rendered = opened(len(missing)).run(rendered_frame, job.tasks(missing))
            for done, (number, content) in enumerate(say_rendered):
                frames.write(number, content)
                if progress is not None:
                    progress(done + 1, len(missing), "frames")
        if movie is not None:
            write_movie(Path(movie), frames.paths, film.plan.rate, progress)
    others = frames.others()
    if others:
        say(f"{others[0]} and {len(others) - 1} more are not of this film")
    span = None
    if curve is not None:
        values = [curve(number) for number in range(frames.count)]
        span = min(values), max(values)
    return Animated(
        frames=frames,
        rendered=len(missing),
        kept=frames.count - len(missing),
        damaged=len(present.damaged),
        exposures=span,
    )


class _Job:
    """Film at a given size and finish."""

    def __init__(self, film: Film, how: Quality, finish: Finish, progress: Progress | None) -> None:
        self._film, self._how, self._finish, self._progress = film, how, finish, progress
        self._specs: dict[int, FrameSpec] = {}
        self._digests: dict[int, str] = {}
        self._curve: Callable[[int], float] | None = None
        self._lit: set[int] = set()
        self._given = False  # whether the film's key frames determine the exposure

    def frame_spec(self, number: int) -> FrameSpec:
        if number not in self._specs:
            if len(self._specs) >= _CACHE_SIZE:
                self._specs.clear()
            spec = self._film.frame_spec(number, self._how)
            self._specs[number] = spec.of_radiance() if self._finish.suffix in LINEAR else spec
        return self._specs[number]

    def _digest(self, number: int) -> str:
        """Fingerprint of a frame's radiance."""
        if number not in self._digests:
            spec = self.frame_spec(number)
            self._digests[number] = digest((spec.defined_by, _code()), spec.files)
        return self._digests[number]

    # --- exposure -----------------------------------------------------------------------------

    def curve(self, opened: Callable[[], Runner]) -> Callable[[int], float] | None:
        """Exposure curve of the film; None for linear files."""
        if self._finish.suffix in LINEAR:
            return None
        exposure = self._finish.exposure
        if isinstance(exposure, (int, float)):
            fixed = float(exposure)
            self._curve = lambda number: fixed
            return self._curve
        if exposure == "auto" and self._film.plan.exposure(0) is not None:
            self._given = True
            self._curve = lambda number: self._film.plan.exposure(number) or 0.0
            return self._curve
        numbers = [0] if exposure == "locked" else metered_numbers(self._film.plan)
        found = {number: self._kept_exposure(number) for number in numbers}
        unknown = [number for number, value in found.items() if value is None]
        if unknown:
            tasks = ((number, (self.frame_spec(number), _code())) for number in unknown)
            runner = opened()
            self.light_clouds(runner, unknown)
            for done, (number, value) in enumerate(runner.run(metered_exposure, tasks)):
                disk.save(self._key(number), {"exposure": np.array(value)})
                found[number] = value
                if self._progress is not None:
                    self._progress(done + 1, len(unknown), "exposure")
        metered = [value for value in found.values() if value is not None]
        self._curve = ExposureCurve(numbers, metered).at
        return self._curve

    def _key(self, number: int) -> str:
        return digest(("exposure", METERED, self._digest(number)))

    def _kept_exposure(self, number: int) -> float | None:
        kept = disk.load(self._key(number))
        return None if kept is None else float(kept["exposure"])

    # --- frames -------------------------------------------------------------------------------

    def _finish_of(self, number: int) -> Finish:
        """Finish of a frame, with its exposure."""
        metered = isinstance(self._finish.exposure, str) and not self._given
        exposure = 0.0 if self._curve is None else self._curve(number)
        return replace(self._finish, exposure=exposure, eye=metered)

    def fingerprint(self, number: int) -> str:
        """Fingerprint of a frame's file."""
        return digest((self._digest(number), self._finish_of(number)))

    def tasks(self, numbers: Sequence[int]) -> Iterator[tuple[int, tuple[Any, ...]]]:
        """Tasks of ``rendered_frame``."""
        for number in numbers:
            finish, mark = self._finish_of(number), self.fingerprint(number)
            yield number, (self.frame_spec(number), finish, mark, _code())

    def announce(self, frames: int) -> None:
        """Announce long rendering, and the number of solutions."""
        count = self._film.plan.count
        sampled = min(count, _SAMPLED)
        some = [self.frame_spec(count * k // sampled) for k in range(sampled)]
        changes = distinct_solutions(some)
        cost = some[0].cost()
        # A single solution reports its progress if it is not on disk.
        solutions = 0.0 if changes == 1 else frames * changes / sampled
        pictures = [(kind, frames * amount) for kind, amount in cost.items() if kind != "solve"]
        announce_all(
            f"{frames} frames of {self._how.width}x{self._how.height} pixels",
            [*pictures, ("solve", solutions * cost["solve"])],
        )

    def prepare(self, runner: Runner) -> None:
        """Solve the common solution once on each machine."""
        count = self._film.plan.count
        some = [self.frame_spec(n) for n in sorted({0, count // 3, 2 * count // 3, count - 1})]
        if distinct_solutions(some) == 1:
            some[0].prepare(self._progress)
            runner.once_per_machine(prepared, some[0], _code())

    def light_clouds(self, runner: Runner, numbers: Sequence[int]) -> None:
        """Solve the light of the clouds of frames once, before several workers need it."""
        if runner.workers == 1:
            return
        nodes = [node for node in self._film.lit_frames(numbers) if node not in self._lit]
        tasks = ((node, (self.frame_spec(node), _code())) for node in nodes)
        for done, _ in enumerate(runner.run(prepared, tasks)):
            if self._progress is not None:
                self._progress(done + 1, len(nodes), "light of clouds")
        self._lit.update(nodes)


# --- on a worker ------------------------------------------------------------------------------


def prepared(spec: FrameSpec, code: str) -> None:
    """Solve for a frame and store the solution on this machine."""
    check_code(code, *_SOURCES)
    spec.prepare()


def metered_exposure(spec: FrameSpec, code: str) -> float:
    """Exposure metered from a small frame. [EV]"""
    check_code(code, *_SOURCES)
    return float(spec.render(METERED).exposure)


def rendered_frame(spec: FrameSpec, finish: Finish, fingerprint: str, code: str) -> bytes:
    """Bytes of a frame's file, with fingerprint and checksum in the header.

    Parameters
    ----------
    finish : Finish
        Format and display, with the frame's own exposure.
    fingerprint : str
        Fingerprint of the file.
    code : str
        Hash of the source code of the run.
    """
    check_code(code, *_SOURCES)
    metadata = {**spec.metadata(), FINGERPRINT: fingerprint, CHECKSUM: BLANK}
    return with_checksum(finished(spec.render(), finish, metadata))
