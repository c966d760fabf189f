"""Write generated clouds as a NetCDF file in the form of a large-eddy simulation.

python builders/les_clouds.py cumulus clouds.nc [cover=0.3 …]

Liquid water and effective radius with CF units, on x, y and z in metres; about 17 MB.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import xarray as xr

from airlight.clouds.cloud_files import extinction_efficiency
from airlight.clouds.cloud_types import SIZE, cloud_field
from airlight.planets.clouds import CLOUDS, CloudType


def les_like(clouds: CloudType, *, size: float = SIZE) -> xr.Dataset:
    """Dataset of liquid water whose extinction is that of generated clouds.

    Parameters
    ----------
    clouds : CloudType
        Clouds of water.
    size : float
        Side of the box. [m]
    """
    field = cloud_field(clouds, size=size)
    radius = clouds.effective_radius
    efficiency = extinction_efficiency(radius, clouds.effective_variance)
    water = field.extinction * np.float32(1000.0 * radius / (0.75 * efficiency))
    nx, ny, nz = water.shape
    step_x, step_y, step_z = field.spacing
    axes = {
        "x": ((np.arange(nx) + 0.5) * step_x, "projection_x_coordinate", "X"),
        "y": ((np.arange(ny) + 0.5) * step_y, "projection_y_coordinate", "Y"),
        "z": (field.base + (np.arange(nz) + 0.5) * step_z, "height_above_reference_ellipsoid", "Z"),
    }
    order = ("z", "y", "x")
    name = "mass_concentration_of_cloud_liquid_water_in_air"
    reff = np.where(water > 0.0, np.float32(radius * 1e6), np.float32(0.0))
    data = xr.Dataset(
        {
            "lwc": (("x", "y", "z"), 1e3 * water, {"units": "g m-3", "standard_name": name}),
            "reff": (("x", "y", "z"), reff, {"units": "um"}),
        },
        {
            key: ((key,), values, {"units": "m", "standard_name": standard, "axis": axis})
            for key, (values, standard, axis) in axes.items()
        },
        {"Conventions": "CF-1.10", "title": f"{clouds.title} of airlight"},
    )
    return data.transpose(*order)


if __name__ == "__main__":
    kind, path, *given = sys.argv[1:]
    values = {name: float(number) for name, number in (one.split("=") for one in given)}
    les_like(CLOUDS.of(kind)(**values)).to_netcdf(Path(path), engine="scipy")
