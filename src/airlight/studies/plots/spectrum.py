"""Spectra of observables: over wavelength, or one curve per wavelength over angle or height."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from airlight.studies.plots.figure import PALETTE, chosen, grid, look, new_figure, wavelength_curves

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Variable that the figure of each observable shows.
COLOR_BARS: Final = {
    "geometric-albedo": "geometric_albedo",
    "bond-albedo": "spherical_albedo",
    "phase-curve": "reflectance",
    "transmission": "effective_height",
    "limb": "radiance",
    "disc": "reflectance",
}
#: Largest number of curves.
_MOST: Final = 6


def spectrum(data: xarray.Dataset) -> Figure:
    """Figure of an observable.

    Parameters
    ----------
    data : xarray.Dataset
        Spectrum from ``observe``.

    Returns
    -------
    Figure
        Over wavelength; over the phase angle or the tangent height, with one curve for each of at
        most six wavelengths, where these are an axis.
    """
    of = data.attrs["observable"]
    shown = data[COLOR_BARS[of]]
    figure = new_figure(data.attrs["title"], _caption(data))
    axes = figure.subplots()
    grid(axes)
    if of in ("phase-curve", "limb"):
        _over_other(axes, data, shown)
    else:
        _over_wavelength(axes, shown)
    return figure


def _caption(data: xarray.Dataset) -> str:
    notes = data.attrs["notes"].replace("; ", ";\n", 1)
    if "bond_albedo" in data:
        bond = data["bond_albedo"]
        return f"Bond albedo {bond.item():.3g}: {bond.attrs['long_name']}."
    return str(notes[:1].upper() + notes[1:] + ".")


def _label(values: xarray.DataArray) -> str:
    unit = values.attrs["units"]
    return f"{values.attrs['long_name']} [{unit.replace('-2', '⁻²').replace('-1', '⁻¹')}]"


def _over_wavelength(axes: Axes, shown: xarray.DataArray) -> None:
    order = np.argsort(shown["wavelength"].values)
    nm = shown["wavelength"].values[order]
    other = next((str(name) for name in shown.dims if name != "wavelength"), None)
    rows = shown.transpose(..., "wavelength").to_numpy().reshape(-1, nm.size)[:, order]
    for index in chosen(np.arange(len(rows), dtype=float), _MOST):
        label = None if other is None else f"{shown[other].values[index]:.4g}°"
        factor = 1e-3 if shown.attrs["units"] == "m" else 1.0
        style = look(index, PALETTE[index % len(PALETTE)], label)
        marker = "o" if nm.size < 12 else None
        axes.plot(nm, factor * rows[index], marker=marker, markersize=4, **style)
    axes.set(xlabel="wavelength [nm]", ylabel=_label(shown).replace("[m]", "[km]"))
    if shown.attrs["units"] == "1":
        axes.set_ylim(bottom=0.0)
    if other is not None and len(rows) > 1:
        axes.legend(title="phase angle", fontsize=9, framealpha=1.0)


def _over_other(axes: Axes, data: xarray.Dataset, shown: xarray.DataArray) -> None:
    nm = shown["wavelength"].values
    upright = "tangent_height" in shown.dims
    place = data["tangent_height"].values * 1e-3 if upright else data["phase_angle"].values
    for k, style in wavelength_curves(nm, _MOST).items():
        values = shown.isel(wavelength=k).values
        seen = np.where(values > 0.0, values, np.nan)
        curve = (seen, place) if upright else (place, values)
        axes.plot(*curve, **style)
    if upright:
        axes.set(xscale="log", xlabel=_label(shown), ylabel="tangent height [km]")
    else:
        axes.set(xlabel="phase angle [°]", ylabel=_label(shown), xlim=(0.0, 180.0))
        axes.set_xticks(range(0, 181, 30))
        axes.set_ylim(bottom=0.0)
    axes.legend(fontsize=9, framealpha=1.0)
