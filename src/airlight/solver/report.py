"""``Report``: provenance of a solution."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Report:
    """Provenance of a solution.

    Attributes
    ----------
    solver : str
        Name of the solver.
    settings : str
        Settings on one line.
    sweeps : int
        Number of sweeps, or of successive orders of scattering.
    residual : tuple of float
        Largest relative change of the mean radiance by the last sweep, per wavelength. [1]
    seconds : float
        Wall time; 0 if the solution was read from the cache. [s]
    energy : tuple of float
        Energy balance error, over the incident energy, per wavelength: positive if energy is
        created; empty if the solver does not compute it. [1]
    note : str
        Neglected properties of the planet, on one line; empty if none.
    ground : str
        Region that supplies the mean ground, on one line; empty for the whole planet.
    """

    solver: str
    settings: str
    sweeps: int
    residual: tuple[float, ...]
    seconds: float
    energy: tuple[float, ...] = ()
    note: str = ""
    ground: str = ""

    def __str__(self) -> str:
        return self._described(f", {self.seconds:.2f} s" if self.seconds else ", from the cache")

    @property
    def provenance(self) -> str:
        """Report without wall time, equal for equal computations."""
        return self._described("")

    def _described(self, took: str) -> str:
        return (
            f"{self.solver}: {self.sweeps} sweeps, last change {max(self.residual):.1e}{took} "
            f"({self.settings})" + "".join(f"; {one}" for one in (self.note, self.ground) if one)
        )
