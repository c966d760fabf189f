"""Table files: NPZ for programs, EXR for engines, and a JSON manifest.

``<name>.npz`` has the array ``values``, shape (axes in the manifest's order, channels);
``<name>.exr`` has the same values as a picture of the texture's slices, the first on top, in the
memory order of the texture. ``value = scale * stored``. ``phase-functions.npz`` has the phase
functions. The manifest describes them, with a SHA-256 of each file.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.baking.array_files import read_arrays
from airlight.engines.baking.bake import Baked
from airlight.engines.baking.look_up_code import (
    DIALECTS,
    NOT_READ,
    PHASES,
    has_look_up,
    look_up_code,
    phase_texture,
    texture_name,
    vectors_of,
)
from airlight.engines.baking.table_errors import TableErrors
from airlight.errors import FileError, ParameterError
from airlight.files.atomic_folder import atomic_folder
from airlight.files.input_files import read_bytes
from airlight.files.manifest import MANIFEST, SEAL, fingerprint, read_manifest, write_manifest
from airlight.files.provenance import version
from airlight.image.exr import write_exr_channels
from airlight.kernel.threads import run_blocks
from airlight.solver.tables.scattered_light import PhaseFunctions, ScatteredLight
from airlight.solver.tables.table import Table, layout_of

#: Format named in the manifest.
FORMAT: Final = "airlight tables 1"
_PHASES: Final = "phase-functions.npz"
_PHASE_TEXTURE: Final = "phase-functions.exr"
_VECTORS: Final = "test_vectors.json"
#: Names of the files beside the manifest, as patterns.
FILES: Final = ("*.npz", "*.exr", *DIALECTS, _VECTORS)
#: Largest table, and the largest phase functions. [byte]
_LARGEST: Final = 4_000_000_000
_LARGEST_PHASES: Final = 250_000_000
#: Errors of manifests of other programs.
_DAMAGE: Final = (
    KeyError,
    TypeError,
    ValueError,
    AttributeError,
    IndexError,
    ArithmeticError,
    MemoryError,
)
_READING: Final = {
    "value": "scale * stored, in the table's unit",
    "npz": "array values, axes from slow to fast as in axes, then channels",
    "texture": "axes of width, height and depth; of two axes that share one the second runs "
    "fastest; first row and first slice hold the first values of their axes, of r the ground",
    "exr": "slices of the depth one above the other, the first on top, its first row the topmost "
    "line of the picture; a loader that flips pictures, as three.js's does, turns it upside down",
    "texel_centres": "texel k of n is at x = k / (n - 1): texture coordinate 0.5/n + x (1 - 1/n)",
}
_FORMULAS: Final = {
    "phase-included": "radiance = scattering",
    "separate": "radiance = scattering * p_0(nu) + sum over the other phase functions of "
    "table(name) * p_name(nu); p_0: the first of phase_functions",
    "combined": "radiance_l = scattering_l * p_0(nu) + alpha * c_l * scattering_l / "
    "scattering_ref * p_particles(nu); alpha: the last channel; c: colours; ref: reference",
    "rgba": "radiance_l = scattering_l * p_0(nu) + alpha * p_particles(nu); alpha: the last "
    "channel",
}


def write_tables(folder: str | Path, baked: Baked, *, overwrite: bool = False) -> Path:
    """Write all tables of a bake, and their manifest.

    Parameters
    ----------
    folder : str or Path
        New or empty folder, or one with tables, which are replaced.
    baked : Baked
        Tables from ``bake``.
    overwrite : bool
        Whether to replace files of these names that airlight did not write or that were modified.

    Raises
    ------
    FileError
        If the folder holds other files of these names, or cannot be written to; it is then
        unchanged.
    """
    with atomic_folder(folder, FORMAT, FILES, overwrite=overwrite) as part:
        manifest = _manifest(baked)
        files = [part / f"{name}.{kind}" for name in baked.tables for kind in ("npz", "exr")]

        def write(index: int) -> None:
            path = files[index]
            table = baked.tables[path.stem]
            if path.suffix == ".exr":
                write_exr_channels(path, exr_channels(table), _texts(baked, table))
                return
            with path.open("wb") as stream:
                np.savez_compressed(stream, values=table.values)

        run_blocks(write, len(files))  # compressing lets other threads run
        for path in files:
            stored = manifest["tables"][path.stem].setdefault("files", {})
            stored[path.name] = fingerprint(path)
        manifest["light"]["files"] = {}
        if has_look_up(baked):
            _write_look_up(part, baked, manifest)
        with (part / _PHASES).open("wb") as stream:
            np.savez_compressed(
                stream,
                names=np.array(baked.light.phases.names),
                values=baked.light.phases.values,
            )
        manifest["light"]["files"][_PHASES] = fingerprint(part / _PHASES)
        write_manifest(part, manifest)
    return Path(folder) / MANIFEST


def _write_look_up(part: Path, baked: Baked, manifest: dict[str, Any]) -> None:
    """Write look-up code, its test vectors, and the phase functions as a texture."""
    texels = phase_texture(baked)
    channels = {name: texels[..., k] for k, name in enumerate("RGB")}
    about = {"planet": baked.about["planet"], "rows": " ".join(baked.light.phases.names)}
    write_exr_channels(part / _PHASE_TEXTURE, channels, about)
    manifest["light"]["files"][_PHASE_TEXTURE] = fingerprint(part / _PHASE_TEXTURE)
    for name, dialect in DIALECTS.items():
        (part / name).write_text(look_up_code(baked, dialect), encoding="utf-8")
    (part / _VECTORS).write_text(json.dumps(vectors_of(baked)), encoding="utf-8")
    manifest["look_up"] = {
        "textures": {
            **{name: texture_name(name) for name in baked.tables if name not in NOT_READ},
            "phase functions": PHASES,
        },
        "files": {name: fingerprint(part / name) for name in (*DIALECTS, _VECTORS)},
    }


def _manifest(baked: Baked) -> dict[str, Any]:
    light = baked.light
    return {
        "format": FORMAT,
        "airlight": version(),
        **baked.about,
        "reading": _READING,
        "light": {
            "packing": light.packing,
            "formula": _FORMULAS[light.packing],
            "unit": "sr-1, per irradiance of the star: times solar_irradiance it is radiance",
            "phase_functions": list(light.phases.names),
            "phase_functions_axis": "sin(theta/2), even from 0 to 1; theta between view and sun",
            "colours": light.colours.tolist(),
            "reference": light.reference,
        },
        "tables": {name: _described(table) for name, table in baked.tables.items()},
        "errors": {name: errors.as_dict() for name, errors in baked.errors.items()},
    }


def _described(table: Table) -> dict[str, Any]:
    width, height, depth = texture_size(table)
    return {
        "quantity": table.quantity,
        "unit": table.unit,
        "precision": table.precision,
        "scale": table.scale,
        "channels": list(table.channels),
        "axes": [
            {**asdict(axis), "parameters": dict(axis.parameters)} for axis in table.layout.axes
        ],
        "layout": {"kind": table.layout.kind, **table.layout.parameters()},
        "texture": {
            "width": width,
            "height": height,
            "depth": depth,
            "axes": [list(names) for names in table.layout.texture_axes],
            "exr": "slices of the depth one above the other, the first on top; of two axes "
            "that share one, the second runs fastest",
        },
        "provenance": dict(table.provenance),
    }


def texture_size(table: Table) -> tuple[int, int, int]:
    """Width, height and depth of a table as a texture. [texel]"""
    sizes = {axis.name: axis.size for axis in table.layout.axes}
    width, height, depth = (
        int(np.prod([sizes[name] for name in names])) for names in table.layout.texture_axes
    )
    return width, height, depth


def exr_channels(table: Table) -> dict[str, NDArray[Any]]:
    """Stored values as channels of a picture, each of shape (depth·height, width).

    Three wavelengths, longest first, are R, G and B; the particles' channel is A.
    """
    width, height, depth = texture_size(table)
    names = [axis.name for axis in table.layout.axes]
    order = [name for axis in reversed(table.layout.texture_axes) for name in axis]
    turned = np.transpose(table.values, [*(names.index(name) for name in order), len(names)])
    flat = turned.reshape(depth * height, width, -1)
    labels = [label.replace(" ", "").replace(".", "_") for label in table.channels]
    if labels[-1] == "particles":
        labels[-1] = "A"
    colours = [label for label in labels if label != "A"]
    nm = [float(label.split()[0]) for label in table.channels if label != "particles"]
    if len(colours) == 3 and nm[0] > nm[1] > nm[2]:
        labels[:3] = ["R", "G", "B"]
    return {label: np.ascontiguousarray(flat[..., k]) for k, label in enumerate(labels)}


def _texts(baked: Baked, table: Table) -> dict[str, str]:
    return {
        "planet": baked.about["planet"],
        "table": table.name,
        "quantity": table.quantity,
        "unit": table.unit,
        "scale": repr(table.scale),
        "manifest": MANIFEST,
    }


def load_tables(manifest: str | Path) -> Baked:
    """Tables written by ``write_tables``, with bit-identical look-ups.

    Parameters
    ----------
    manifest : str or Path
        Path of the manifest, or of its folder.

    Raises
    ------
    FileError
        If a file is missing, damaged, or of another kind.

    Examples
    --------
    >>> import airlight
    >>> from tempfile import TemporaryDirectory
    >>> solution = airlight.solve("mars-rayleigh", quality="preview")
    >>> with TemporaryDirectory() as folder:
    ...     baked = airlight.bake(solution, size=(4, 8, 4, 2), points=20)
    ...     _ = write_tables(f"{folder}/tables", baked)
    ...     load_tables(f"{folder}/tables")
    <Baked tables of Mars (Rayleigh): transmittance, irradiance, scattering>
    """
    path = _manifest_path(manifest)
    content = _read_manifest(path)
    try:
        tables = {name: _table(path, content, name) for name in content["tables"]}
        phases = _checked(
            path.parent / _PHASES, content["light"]["files"][_PHASES], _LARGEST_PHASES
        )
        light = ScatteredLight(
            packing=content["light"]["packing"],
            tables=tables,
            phases=PhaseFunctions(tuple(str(x) for x in phases["names"]), phases["values"]),
            colours=np.array(content["light"]["colours"], float),
            reference=int(content["light"]["reference"]),
        )
        errors = {name: TableErrors(**fields) for name, fields in content["errors"].items()}
        own = {"format", "airlight", "reading", "light", "look_up", "tables", "errors", SEAL}
        about = {name: value for name, value in content.items() if name not in own}
    except _DAMAGE as error:
        raise FileError(path, f"is not a manifest of tables: {error}") from error
    return Baked(light=light, tables=tables, about=about, errors=errors)


def load_table(manifest: str | Path, name: str = "scattering") -> Table:
    """Load one table of a manifest; see ``load_tables``."""
    path = _manifest_path(manifest)
    content = _read_manifest(path)
    if name not in content["tables"]:
        raise ParameterError("table", name, ", ".join(content["tables"]), path)
    try:
        return _table(path, content, name)
    except _DAMAGE as error:
        raise FileError(path, f"is not a manifest of tables: {error}") from error


def _manifest_path(manifest: str | Path) -> Path:
    path = Path(manifest)
    return path / MANIFEST if path.is_dir() else path


def _read_manifest(path: Path) -> dict[str, Any]:
    content = read_manifest(path, FORMAT)
    if not isinstance(content.get("tables"), dict) or not isinstance(content.get("light"), dict):
        raise FileError(path, "is not a manifest of tables: tables or light are missing")
    return content


def _checked(path: Path, said: dict[str, Any], largest: int) -> dict[str, NDArray[Any]]:
    data = read_bytes(path, largest)
    if hashlib.sha256(data).hexdigest() != said["sha256"]:
        raise FileError(path, "is damaged: its SHA-256 differs from the manifest")
    return read_arrays(path, data, largest)


def _table(manifest: Path, content: dict[str, Any], name: str) -> Table:
    said = content["tables"][name]
    file = f"{name}.npz"
    parameters = dict(said["layout"])
    return Table(
        name=name,
        quantity=said["quantity"],
        unit=said["unit"],
        layout=layout_of(parameters.pop("kind"), parameters),
        channels=tuple(said["channels"]),
        values=_checked(manifest.parent / file, said["files"][file], _LARGEST)["values"],
        scale=float(said["scale"]),
        provenance=said["provenance"],
    )
