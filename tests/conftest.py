"""What all tests share: reference data, a room of their own for solutions, and error tables."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from airlight.planets import Planet
    from airlight.solvers.moments.solution import MomentsSolution

_LINES = pytest.StashKey[list[str]]()


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "slow: takes more than ten seconds")
    config.stash[_LINES] = []


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    lines = terminalreporter.config.stash[_LINES]
    if lines:
        terminalreporter.section("measured")
        for line in lines:
            terminalreporter.write_line(line)


@pytest.fixture
def tell(pytestconfig: pytest.Config) -> Callable[[str], None]:
    """Puts a line into the section "measured" at the end of the run, passed or failed."""
    return pytestconfig.stash[_LINES].append


@pytest.fixture(scope="session")
def reference_data() -> Path:
    """The folder of reference data that is not part of the repository."""
    named = os.environ.get("AIRLIGHT_DATA")
    folder = Path(named) if named else Path(__file__).parents[2] / "shared" / "data"
    if not folder.is_dir():
        pytest.skip("no reference data: AIRLIGHT_DATA names no folder, and ../shared/data is none")
    return folder


@pytest.fixture(scope="session", autouse=True)
def own_solutions(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A fresh folder for solutions; compiled code stays where it is, shared between runs."""
    from airlight.tables import cache

    folder = tmp_path_factory.mktemp("cache")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cache, "cache_folder", lambda: folder)
        yield folder / "solutions"


@pytest.fixture(scope="session")
def reference_earth() -> Callable[..., Planet]:
    """Makes the planet of the reference radiances: AP2's air, a point star of irradiance 1.

    ``aerosol`` is "cornette-shanks", "henyey-greenstein" or None, ``ozone`` says whether there is
    any; the aerosol's absorption is that of the reference data and the golden scattering table.
    """
    from airlight.planets import Constituent, Ground, Planet, Star
    from airlight.planets.phases import CornetteShanks, HenyeyGreenstein, Rayleigh
    from airlight.planets.profiles import Exponential, Tent
    from airlight.planets.spectral import PerWavelength

    rgb = (680.0, 550.0, 440.0)

    def make(
        *, albedo: float, aerosol: str | None = "cornette-shanks", ozone: bool = True,
        aerosol_absorption: float = 4.40e-6,
    ) -> Planet:  # fmt: skip
        air = Constituent(
            name="air",
            profile=Exponential(scale_height=8000.0),
            scattering=PerWavelength(wavelengths=rgb, values=(5.802e-6, 13.558e-6, 33.1e-6)),
            phase_function=Rayleigh(),
        )
        parts = [air]
        if aerosol is not None:
            lobe = CornetteShanks if aerosol == "cornette-shanks" else HenyeyGreenstein
            parts.append(
                Constituent(
                    name="aerosol",
                    profile=Exponential(scale_height=1200.0),
                    scattering=3.996e-6,
                    absorption=aerosol_absorption,
                    phase_function=lobe(asymmetry=0.8),
                )
            )
        if ozone:
            parts.append(
                Constituent(
                    name="ozone",
                    profile=Tent(center=25e3, half_width=15e3),
                    absorption=PerWavelength(wavelengths=rgb, values=(0.65e-6, 1.881e-6, 0.085e-6)),
                )
            )
        return Planet(
            name="reference",
            bottom_radius=6360e3,
            top_radius=6460e3,
            ground=Ground(albedo=albedo),
            star=Star(irradiance=1.0, angular_radius=0.0),
            constituents=tuple(parts),
        )

    return make


@pytest.fixture(scope="session")
def solved() -> Callable[..., MomentsSolution]:
    """``solve``, each planet, wavelengths and quality only once in a run."""
    from airlight import solve

    kept: dict[Any, MomentsSolution] = {}

    def solution(
        planet: Planet, wavelengths: tuple[float, ...] | None = None, quality: str = "default"
    ) -> MomentsSolution:
        key = (repr(planet), wavelengths, quality)
        if key not in kept:
            kept[key] = solve(planet, wavelengths, quality, cache=False)
        return kept[key]

    return solution
