"""Edits of a planet's tables: the value itself, and the values that depend on it."""

from __future__ import annotations

from typing import Final

import numpy as np

from airlight.physics.constants import SOLAR_RADIUS
from airlight.physics.optics.phase_table import moments
from airlight.planets.matter.phases import PHASES
from airlight.planets.reading.declared_keys import key_at
from airlight.planets.reading.nested_tables import Tables, get, put
from airlight.planets.reading.shell_edit import BOTTOM, lifted
from airlight.planets.schema.measures import number_in, text_of
from airlight.planets.schema.tagged_union import TaggedUnion
from airlight.planets.star import BLACK_BODY
from airlight.viewer.parameters.cloud_kinds import (
    is_cloud_kind,
    original_clouds,
    with_cloud_kind,
)
from airlight.viewer.parameters.parameter import Parameter, Value

#: IAU 2015 Resolution B3: nominal effective temperature of the sun.
_SUN_TEMPERATURE: Final = "5772 K"


def edited(tables: Tables, parameter: Parameter, value: Value) -> Tables:
    """Copy of the tables with a parameter's new value.

    Another kind (of a profile, a phase function, a size distribution) gets typical values; mole
    fractions keep their sum, the shell its thickness, and a tabulated phase function its
    normalisation.

    Parameters
    ----------
    tables : dict
        Tables before the edit; not modified.
    parameter : Parameter
        Parameter from ``parameters_of(tables)``.
    value : float or str
        New value, as returned by ``parameter.checked``. [parameter.unit]

    Examples
    --------
    >>> tables = {"shell": {"bottom_radius": "6360 km", "top_radius": "6460 km"}}
    >>> radius = Parameter(path="shell.bottom_radius", label="radius", group="shell", help="-")
    >>> edited(tables, radius, 6000.0)["shell"]
    {'bottom_radius': '6000 km', 'top_radius': '6100 km'}
    """
    path = parameter.path
    key = key_at(tables, path)
    if parameter.kind != "number":
        table, _, last = path.rpartition(".")
        if is_cloud_kind(path):
            return with_cloud_kind(tables, path, str(value))
        if last == "kind":
            return put(tables, table, _fresh(tables, table, str(value)))
        if path == "star.spectrum":
            return put(tables, "star", _star(tables["star"], str(value)))
        if last == "method" and value != "mie":
            tables = _with_phase(tables, table.rpartition(".")[0])
        return put(tables, path, value)
    assert isinstance(value, float)
    if ".composition." in path:
        return _mixed(tables, path, value)
    before, tables = tables, put(tables, path, text_of(value, key.shown_unit))
    if path == BOTTOM:
        return lifted(tables, before)
    table, _, last = path.partition(".phase_function.")
    if last.startswith(("values[", "angles[")):
        return _normalised(tables, f"{table}.phase_function")
    return tables


def _normalised(tables: Tables, path: str) -> Tables:
    """Divide a tabulated phase function by its integral over the sphere, row by row.

    An invalid table, such as one with angles that do not increase, is left for the reader to
    reject.
    """
    table = get(tables, path)
    angles = np.array([number_in(one, "deg", "deg", path) for one in table["angles"]])
    values = table["values"]
    rows = values if isinstance(values[0], list) else [values]
    numbers = np.array([[number_in(one, "/sr", "1/sr", path) for one in row] for row in rows])
    grows = angles.size >= 2 and bool((np.diff(angles) > 0.0).all())
    if not grows or numbers.shape[1] != angles.size or not numbers.any(axis=1).all():
        return tables
    integrals = moments(angles, numbers, 0)
    unit = [[float(f"{x:.9g}") for x in row] for row in (numbers / integrals).tolist()]
    return put(tables, f"{path}.values", unit if rows is values else unit[0])


def _mixed(tables: Tables, path: str, share: float) -> Tables:
    """Set a mole fraction and rescale the others, so that the sum is unchanged."""
    table, _, name = path.rpartition(".")
    shares = {one: number_in(text, "1", "1", path) for one, text in get(tables, table).items()}
    total = sum(shares.values())
    rest = total - shares[name]
    if len(shares) == 1:
        return put(tables, path, 1.0)
    share = min(share, total)
    room = total - share
    for one, old in shares.items():
        if one != name:
            shares[one] = old * room / rest if rest > 0.0 else room / (len(shares) - 1)
    shares[name] = share
    return put(tables, table, {one: float(f"{x:.9g}") for one, x in shares.items()})


def _thickness(tables: Tables) -> float:
    """Thickness of the shell. [km]"""
    bottom, top = (
        number_in(tables["shell"][key], "km", "m", f"shell.{key}")
        for key in ("bottom_radius", "top_radius")
    )
    return max(top - bottom, 1e-3)


def _with_phase(tables: Tables, constituent: str) -> Tables:
    """Add a phase function to a constituent that has none."""
    if get(tables, f"{constituent}.phase_function") is not None:
        return tables
    fresh = PHASES.default_table("henyey-greenstein", {}, 1e3 * _thickness(tables))
    return put(tables, f"{constituent}.phase_function", fresh)


def _star(old: Tables, spectrum: str) -> Tables:
    """Star with another spectrum at the same distance; a black body is like the sun."""
    if spectrum != BLACK_BODY:
        kept: Tables = {key: old[key] for key in ("distance", "angular_radius") if key in old}
        return {"spectrum": spectrum, **kept}
    sun: Tables = {"temperature": _SUN_TEMPERATURE, "radius": text_of(1e-3 * SOLAR_RADIUS, "km")}
    return {**sun, "distance": old.get("distance", "1 au")}


def _fresh(tables: Tables, path: str, kind: str) -> Tables:
    """Table of another kind, filled with typical values."""
    kinds = key_at(tables, path).table
    assert isinstance(kinds, TaggedUnion)
    return kinds.default_table(kind, get(tables, path), 1e3 * _thickness(tables))


def restored(tables: Tables, base: Tables, path: str) -> Tables:
    """Copy of the tables with the original value at a path.

    Dependent values are restored together: a composition, the shell, the keys of a profile of
    another kind.

    Parameters
    ----------
    tables, base : dict
        Current and original tables; not modified.
    path : str
        Path of the value to restore.
    """
    table, _, last = path.rpartition(".")
    if path == "star.spectrum":
        return put(tables, "star", get(base, "star"))
    if is_cloud_kind(path):
        return put(tables, "clouds", get(base, "clouds"))
    if path.startswith("clouds["):
        return put(tables, path, get(original_clouds(base, tables), path))
    if table.endswith(".composition") or table == "shell" or last == "kind":
        path, table = table, table.rpartition(".")[0]
    old = get(base, path)
    while table and old is None and get(base, table) is None:
        path, table = table, table.rpartition(".")[0]
        old = get(base, path)
    if path.startswith("constituents[") and old is None and path.endswith("]"):
        return tables  # the original had no such constituent
    kind, old_kind = (get(one, f"{table}.kind") if table else None for one in (tables, base))
    if kind != old_kind:
        return put(tables, table, get(base, table))
    return put(tables, path, old)
