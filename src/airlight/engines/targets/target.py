"""Export target: a program that loads a folder of files, and the report of an export."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from airlight.errors import ConflictError, FileError, ParameterError
from airlight.files.atomic_folder import atomic_folder
from airlight.files.manifest import MANIFEST, fingerprint, read_manifest, write_manifest
from airlight.files.provenance import version
from airlight.kernel.threads import Progress
from airlight.planets.left_out import warn_of_shape
from airlight.solver.refracted_geometry import require_no_refraction
from airlight.solver.solution import Solution

#: Keys of the report in a manifest.
_REPORT: Final = ("fitted", "errors", "notes")


@dataclass(frozen=True, kw_only=True)
class FittedFormula:
    """Quantity of the planet that the program represents by a fitted formula.

    Attributes
    ----------
    name : str
        Constituent and quantity: ``dust: phase function``.
    form : str
        Formula: ``Cornette-Shanks``.
    parameters : mapping of str to float
        Fitted parameters by name with unit: ``g``, ``scale height [km]``.
    errors : mapping of str to float
        Errors of the fit by quantity: ``optical depth, relative``.
    where : str
        Range of the fit and of the comparison.
    """

    name: str
    form: str
    parameters: Mapping[str, float]
    errors: Mapping[str, float]
    where: str


@dataclass(frozen=True, kw_only=True)
class ErrorRow:
    """Error of the program's sky against the solution.

    Attributes
    ----------
    name : str
        Quantity compared: ``sky``, ``transmittance at 60 deg``.
    where : str
        Distribution of the points compared.
    measure : str
        ``relative``, ``absolute`` or ``delta E 2000``.
    points : int
        Number of values compared.
    median, percentile_95, largest : float
        Statistics of the absolute value of the error.
    """

    name: str
    where: str
    measure: str
    points: int
    median: float
    percentile_95: float
    largest: float

    @classmethod
    def of(cls, name: str, errors: ArrayLike, *, where: str, measure: str = "relative") -> ErrorRow:
        """Statistics of errors of any shape and sign.

        Examples
        --------
        >>> ErrorRow.of("sky", [-0.01, 0.02, 0.03], where="everywhere").median
        0.02
        """
        size = np.abs(np.asarray(errors, float)).ravel()
        if not size.size:
            raise ValueError(f"{name}: nothing was compared")
        return cls(
            name=name,
            where=where,
            measure=measure,
            points=size.size,
            median=float(np.median(size)),
            percentile_95=float(np.percentile(size, 95.0)),
            largest=float(size.max()),
        )


@dataclass(frozen=True, kw_only=True)
class ExportReport:
    """Report of an export: fits, errors, and what the program cannot represent.

    Attributes
    ----------
    fitted : tuple of FittedFormula
        Quantities that were fitted.
    errors : tuple of ErrorRow
        Errors against the solution, all fits included.
    notes : tuple of str
        One line for each property of the planet that the program cannot represent, with its size.
    about : mapping
        Further facts for the manifest.
    """

    fitted: tuple[FittedFormula, ...] = ()
    errors: tuple[ErrorRow, ...] = ()
    notes: tuple[str, ...] = ()
    about: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class Export:
    """Folder written for a program.

    Attributes
    ----------
    folder : Path
        Path of the folder.
    files : mapping of str to int
        Sizes of its files by name, without the manifest. [byte]
    fitted, errors, notes
        See ``ExportReport``.
    """

    folder: Path
    files: Mapping[str, int]
    fitted: tuple[FittedFormula, ...]
    errors: tuple[ErrorRow, ...]
    notes: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class Target:
    """Program that loads an exported folder.

    Attributes
    ----------
    name : str
        Name of the layout.
    program, version : str
        Program, and the version whose formats are written.
    fill : callable
        ``fill(solution, folder, progress=…, **options) -> ExportReport`` writes the files into an
        empty folder.
    files : tuple of str
        Names or patterns of the files that ``fill`` may write.
    wavelengths : tuple of float, optional
        Wavelengths required by the program; default: any. [nm]
    options : tuple of str
        Names of the options of ``fill``: ``size``, ``files``.
    bends_light : bool
        Whether the program supports refraction.
    default_wavelengths : str
        Default wavelengths, if the program requires none.
    """

    name: str
    program: str
    version: str
    fill: Callable[..., ExportReport]
    files: tuple[str, ...]
    wavelengths: tuple[float, ...] | None = None
    options: tuple[str, ...] = ()
    bends_light: bool = False
    default_wavelengths: str = "rgb"

    @property
    def form(self) -> str:
        """Format named in the manifest."""
        return f"airlight {self.name} 1"

    def write(
        self,
        solution: Solution,
        folder: str | Path,
        *,
        overwrite: bool = False,
        progress: Progress | None = None,
        **options: Any,
    ) -> Export:
        """Write the files and their manifest atomically.

        Parameters
        ----------
        solution : Solution
            Solution, at ``wavelengths`` if the program requires them.
        folder : str or Path
            New or empty folder, or an earlier export for this program, which is replaced.
        overwrite : bool
            Whether to replace files of these names that airlight did not write or that were
            modified.
        progress : callable, optional
            See ``airlight.kernel.threads``.
        **options
            Options named in ``options``.

        Returns
        -------
        Export

        Raises
        ------
        ParameterError
            For an unsupported option, wavelength, refraction or planet.
        FileError
            If the folder holds other files, or cannot be written to; it is then unchanged.
        """
        self.check_options(options)
        self._check_wavelengths(solution)
        if not self.bends_light:
            require_no_refraction(
                solution.medium, f"files for {self.program}, which draws straight lines"
            )
        warn_of_shape(solution.medium, f"files for {self.program}")
        with atomic_folder(folder, self.form, self.files, overwrite=overwrite) as part:
            found = self.fill(solution, part, progress=progress, **options)
            files = {file.name: fingerprint(file) for file in sorted(part.iterdir())}
            write_manifest(part, self._manifest(solution, found, files))
        return Export(
            folder=Path(folder),
            files={name: said["bytes"] for name, said in files.items()},
            fitted=found.fitted,
            errors=found.errors,
            notes=found.notes,
        )

    def check_options(self, options: Mapping[str, Any]) -> None:
        """Raise an error for an unsupported option."""
        for name in options:
            if name not in self.options:
                raise ConflictError(name, f"does not apply to layout {self.name}")

    def _check_wavelengths(self, solution: Solution) -> None:
        if self.wavelengths is None:
            return
        nm = solution.wavelengths
        if nm.size != len(self.wavelengths) or (np.abs(nm - self.wavelengths) > 1e-6).any():
            fixed = ", ".join(f"{one:g}" for one in self.wavelengths)
            raise ParameterError("wavelengths", nm.tolist(), f"{fixed} nm for {self.program}")

    def _manifest(
        self, solution: Solution, found: ExportReport, files: dict[str, Any]
    ) -> dict[str, Any]:
        content = asdict(found)
        return {
            "format": self.form,
            "airlight": version(),
            "program": self.program,
            "version": self.version,
            "planet": solution.planet.name if solution.planet is not None else "unnamed",
            "fingerprint": solution.medium.fingerprint(),
            "solver": solution.report.provenance,
            "wavelengths_nm": solution.wavelengths.tolist(),
            **content["about"],
            **{name: content[name] for name in _REPORT},
            "files": files,
        }


def read_export(folder: str | Path, target: Target) -> Export:
    """Read the export of a folder from its manifest.

    Parameters
    ----------
    folder : str or Path
        Folder written by ``target``.
    target : Target
        Target program.
    """
    path = Path(folder) / MANIFEST
    content = read_manifest(path, target.form)
    try:
        return Export(
            folder=Path(folder),
            files={name: said["bytes"] for name, said in content["files"].items()},
            fitted=tuple(FittedFormula(**one) for one in content["fitted"]),
            errors=tuple(ErrorRow(**one) for one in content["errors"]),
            notes=tuple(content["notes"]),
        )
    except (KeyError, TypeError, AttributeError) as error:
        raise FileError(path, f"is not a manifest of {target.program}: {error}") from error
