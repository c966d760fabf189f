"""Query arguments (numbers, text, quantities) as arrays with named axes.

Arrays broadcast by the rules of NumPy, and each axis of the result has the name of the argument
that varies along it. Labelled arrays broadcast by the names of their dimensions.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final, Self

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.physics.units import values_in

if TYPE_CHECKING:
    from airlight.physics.units import Measures

FloatArray = NDArray[np.float64]

#: Name of an axis along which several arguments vary together.
TOGETHER: Final = "case"
#: Last dimension of every result; arguments do not have it.
LAST: Final = "wavelength"
#: Attributes of the wavelength, with its CF standard name.
WAVELENGTH: Final = {
    "units": "nm",
    "standard_name": "radiation_wavelength",
    "long_name": "wavelength in vacuum",
}
#: Attributes, other than units, of arguments as coordinates, by the CF conventions.
COORDINATES: Final[dict[str, dict[str, str]]] = {
    "altitude": {"standard_name": "height", "long_name": "altitude above the ground"},
    "sun_zenith": {
        "standard_name": "solar_zenith_angle",
        "long_name": "zenith angle of the star at the observer",
    },
    "view_zenith": {"long_name": "zenith angle of the line of sight at the observer"},
    "azimuth": {"long_name": "azimuth of the line of sight from the star"},
    "distance": {"long_name": "length of the path from the observer"},
}


@dataclass(frozen=True)
class Argument:
    """Argument of a query, with its range.

    Attributes
    ----------
    value : array
        Numbers in ``unit``, text with a unit such as ``"400 km"``, a quantity, a labelled array, or
        a list of these; see ``airlight.physics.units.values_in``.
    low, high : float
        Allowed range. [unit]
    unit : str
        ``"m"`` or ``"deg"``.
    """

    value: Measures
    low: float
    high: float
    unit: str

    def numbers(self, field: str) -> FloatArray:
        """Values as numbers within their range, shape (...). [unit]"""
        allowed = f"{self.low:g} to {self.high:g} {self.unit}"
        array = values_in(self.value, self.unit, field, allowed=f"numbers from {allowed}")
        wrong = ~((array >= self.low) & (array <= self.high))
        if wrong.any():
            raise ParameterError(field, float(array[wrong].flat[0]), allowed)
        return array

    @property
    def long_unit(self) -> str:
        """Unit in the spelling of coordinate attributes."""
        return "degree" if self.unit == "deg" else self.unit


def is_labelled(value: object) -> bool:
    """Whether a value is an xarray.DataArray; does not import xarray."""
    return hasattr(value, "dims") and hasattr(value, "coords")


@dataclass(frozen=True)
class NamedAxes:
    """Shape of a result, the names of its axes, and its coordinates.

    Attributes
    ----------
    dims : tuple of str
        Names of the axes before the wavelength.
    shape : tuple of int
        Their lengths.
    coordinates : dict
        Dimensions, values and attributes of each coordinate, as ``xarray.DataArray`` takes them.
    """

    dims: tuple[str, ...]
    shape: tuple[int, ...]
    coordinates: Mapping[str, Any]

    @classmethod
    def of(cls, **arguments: Argument) -> tuple[list[FloatArray], Self]:
        """Broadcast arguments against each other.

        Returns
        -------
        arrays : list of array, shape (n,)
            Values of each argument, raveled. [unit]
        axes : NamedAxes

        Examples
        --------
        >>> view = Argument([0.0, 30.0, 60.0], 0.0, 180.0, "deg")
        >>> arrays, axes = NamedAxes.of(altitude=Argument("2 km", 0.0, 1e6, "m"), view_zenith=view)
        >>> arrays[0].tolist(), axes.dims, axes.shape
        ([2000.0, 2000.0, 2000.0], ('view_zenith',), (3,))
        """
        numbers = {name: one.numbers(name) for name, one in arguments.items()}
        attributes = {
            name: {"units": one.long_unit, **COORDINATES.get(name, {})}
            for name, one in arguments.items()
        }
        if any(is_labelled(one.value) for one in arguments.values()):
            return cls._by_name(arguments, numbers, attributes)
        shape = _common_shape(numbers)
        dims = tuple(_axis_names(numbers, len(shape)))
        coordinates = {}
        for name, array in numbers.items():
            own = dims[len(shape) - array.ndim :]
            kept = [k for k in range(array.ndim) if array.shape[k] != 1 or own[k] == name]
            coordinates[name] = (
                tuple(own[k] for k in kept),
                array.reshape([array.shape[k] for k in kept]),
                attributes[name],
            )
        arrays = [
            np.ascontiguousarray(np.broadcast_to(array, shape)).ravel()
            for array in numbers.values()
        ]
        return arrays, cls(dims, shape, coordinates)

    @classmethod
    def _by_name(
        cls,
        arguments: Mapping[str, Argument],
        numbers: Mapping[str, FloatArray],
        attributes: Mapping[str, Mapping[str, str]],
    ) -> tuple[list[FloatArray], Self]:
        import xarray

        labelled = {}
        for name, argument in arguments.items():
            value: Any = argument.value
            if is_labelled(value):
                if LAST in value.dims:
                    raise ParameterError(name, value.dims, f"dimensions other than {LAST}")
                labelled[name] = value.copy(data=numbers[name])
            elif numbers[name].ndim > 1:
                raise ParameterError(
                    name,
                    f"an array of {numbers[name].ndim} unnamed dimensions",
                    "a labelled array, like the other arguments",
                )
            else:
                dims = (name,) * numbers[name].ndim
                labelled[name] = xarray.DataArray(
                    numbers[name], dims=dims, coords=dict.fromkeys(dims, numbers[name])
                )
        try:
            whole = xarray.broadcast(*xarray.align(*labelled.values(), join="exact"))
        except ValueError:
            raise _no_shape({name: one.shape for name, one in labelled.items()}) from None
        coordinates: dict[str, Any] = {}
        for one in labelled.values():
            for label, found in one.coords.items():
                coordinates[str(label)] = (found.dims, found.values, found.attrs)
        for name, one in labelled.items():
            coordinates[name] = (one.dims, one.values, attributes[name])
        dims = tuple(str(name) for name in whole[0].dims)
        arrays = [np.ascontiguousarray(one.values).ravel() for one in whole]
        return arrays, cls(dims, whole[0].shape, coordinates)

    def with_axis(self, name: str, labels: Sequence[str]) -> Self:
        """Axes with a labelled axis inserted before the wavelength."""
        return replace(
            self,
            dims=(*self.dims, name),
            shape=(*self.shape, len(labels)),
            coordinates={**self.coordinates, name: (name, list(labels), {})},
        )

    def labelled(
        self, values: NDArray[Any], wavelengths: FloatArray, name: str, unit: str, **attributes: str
    ) -> Any:
        """Values as an xarray.DataArray, shape (..., wavelength)."""
        import xarray

        return xarray.DataArray(
            values.reshape(*self.shape, wavelengths.size),
            dims=(*self.dims, LAST),
            coords={**self.coordinates, LAST: (LAST, wavelengths, WAVELENGTH)},
            name=name.replace(" ", "_"),
            attrs={"units": unit, "long_name": name, **attributes},
        )


def _common_shape(numbers: Mapping[str, FloatArray]) -> tuple[int, ...]:
    try:
        return np.broadcast_shapes(*(array.shape for array in numbers.values()))
    except ValueError:
        raise _no_shape({name: array.shape for name, array in numbers.items()}) from None


def _no_shape(shapes: Mapping[str, tuple[int, ...]]) -> ParameterError:
    shown = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
    first, *_ = (name for name, shape in shapes.items() if shape)
    return ParameterError(
        "shapes",
        shown,
        f"shapes that broadcast together: for a grid give {first}[:, None], or "
        "label each array by xarray.DataArray",
    )


def _axis_names(numbers: Mapping[str, FloatArray], count: int) -> list[str]:
    """Names of the axes: each that of the argument that varies along this axis alone."""
    names: list[str] = []
    for back in range(count, 0, -1):
        has = [name for name, array in numbers.items() if array.ndim >= back]
        along = [name for name in has if numbers[name].shape[-back] != 1] or has
        alone = len(along) == 1 and numbers[along[0]].size == numbers[along[0]].shape[-back]
        names.append(along[0] if alone else TOGETHER)
    if names.count(TOGETHER) > 1:
        places = [k for k, name in enumerate(names) if name == TOGETHER]
        for number, k in enumerate(places, start=1):
            names[k] = f"{TOGETHER}_{number}"
    return names
