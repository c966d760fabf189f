"""Probe thread: first with the displayed solution, then with a finer spectrum."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, Final

from airlight.planets.picture_wavelengths import picture_wavelengths
from airlight.render.solve_planet import solve_planet
from airlight.viewer.background.latest_thread import LatestThread
from airlight.viewer.painting.picture_source import Request
from airlight.viewer.painting.probe import Probe, probe_pixel

#: Number of wavelengths of the finer spectrum, solved with the settings of the displayed solution.
FINER: Final = 16


@dataclass(frozen=True, kw_only=True, eq=False)
class ProbeResult:
    """Result of a probe.

    Attributes
    ----------
    probe : Probe
        Probe of the displayed solution.
    spectrum : Probe
        Probe with the finest available spectrum.
    quality : str
        Description of the wavelengths of ``spectrum``.
    place : (float, float)
        Position in the picture, as fractions of its width and height. [1]
    request : Request
        Request that the picture answers.
    """

    probe: Probe
    spectrum: Probe
    quality: str
    place: tuple[float, float]
    request: Request


class Probing(LatestThread[tuple[Request, tuple[float, float], bool]]):
    """Thread that evaluates the latest query.

    A query is a picture's request, a point of it as fractions, and whether the spectrum is refined.

    Parameters
    ----------
    wake : callable
        Function without arguments, called on the thread after each result.

    Attributes
    ----------
    reading : ProbeResult or None
        Newest result; None before the first, and outside a fisheye's circle.
    """

    def __init__(self, wake: Callable[[], None]) -> None:
        self._finer: tuple[Any, Any] = (None, None)  # solution shown, finer solution
        self._doing = ""
        self.reading: ProbeResult | None = None
        super().__init__("airlight-probing", wake)

    @property
    def working(self) -> str:
        """Status in one line; empty if idle."""
        return self._doing if self.busy else ""

    def ask(self, request: Request, place: tuple[float, float]) -> None:
        """Probe a point of a picture; replaces an older query.

        Parameters
        ----------
        request : Request
            Request that the picture answers.
        place : (float, float)
            Position, as fractions of the picture's width and height. [1]
        """
        self._doing = "reading …"
        self.want((request, place, True))

    def follow(self, request: Request) -> None:
        """Probe the same point of a picture with another view or other light.

        A finer spectrum is used if it is solved already.
        """
        if self.reading is not None and not request.same_light(self.reading.request):
            self.want((request, self.reading.place, False))

    def serve(self, query: tuple[Request, tuple[float, float], bool]) -> None:
        """Probe a point with the displayed solution, then with a finer spectrum."""
        request, place, solves = query
        camera, shown = request.scene.camera, request.solution
        x, y = place[0] * camera.width, place[1] * camera.height
        found = probe_pixel(shown, request.scene, x, y)
        if found is None:
            self.reading = None
            return
        count = shown.wavelengths.size
        read = partial(ProbeResult, probe=found, place=place, request=request)
        more = "" if solves or count >= FINER else f"; a click solves {FINER}"
        clear = "" if request.clouds is None else "without clouds; "
        as_shown = read(spectrum=found, quality=f"{clear}{count} wavelengths, as shown{more}")
        known = self._finer[1] if self._finer[0] is shown else None
        if known is None and count < FINER and solves:
            self.reading = as_shown
            self._doing = f"{count} wavelengths as shown; {FINER} follow …"
            self._wake()
            known = self._solved(request)
            self._finer = (shown, known)
        finer = None if known is None else probe_pixel(known, request.scene, x, y)
        if finer is None:
            self.reading = as_shown
        else:
            self.reading = read(spectrum=finer, quality=f"{clear}{FINER} wavelengths")

    def _solved(self, request: Request) -> Any:
        """Solution at more wavelengths; None without a planet."""
        planet = request.solution.planet
        if planet is None:
            return None

        def newer() -> bool:
            asked = self._wanted
            return self._closing or (
                asked is not None and asked[0].solution is not request.solution
            )

        nm = picture_wavelengths(planet, FINER)
        return solve_planet(planet, nm, request.solution.settings, cache=False, cancel=newer)
