"""Declaration of the fields of a NamedTuple for shaders: numbers and tables.

A field of type ``int``, ``float`` or ``bool`` is a number of a uniform struct. ``Annotated`` adds
``CHOICE`` for an index that is constant in a frame, ``Always`` for a constant of all shaders,
``InTexture`` for an array. Struct, read functions, texture layout and upload are generated
(``render.gpu.emit.uniform_struct``).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Final, NamedTuple, get_args, get_origin, get_type_hints


@dataclass(frozen=True)
class InTexture:
    """Array in a flat texture, which it shares with the other tables of that name.

    Attributes
    ----------
    texture : str
        Name of the texture.
    rank : int
        Number of axes, without that of the wavelengths; of four, the last has the length two.
    spectral : bool
        Whether an element is a texel of four wavelengths rather than a single number.
    whole : bool
        Whether the table is the whole texture, without lengths: the target of a pass.
    packed : bool
        Whether it is a texture of 8-bit RGBA texels, see ``airlight.image.texels``.
    image : bool
        Whether the texture is an image, read by row and column, rather than flat.
    halved : bool
        Whether numbers have 16 bits, in a texture with rows as long as those of packed texels.
    """

    texture: str
    rank: int = 1
    spectral: bool = False
    whole: bool = False
    packed: bool = False
    image: bool = False
    halved: bool = False

    @property
    def channels(self) -> int:
        """Channels of the texture."""
        return 4 if self.spectral or self.packed else 1


@dataclass(frozen=True)
class Choice:
    """Index that is constant in a frame, as are all booleans."""


@dataclass(frozen=True)
class Always:
    """Number that is constant in shaders, but not on the CPU.

    Attributes
    ----------
    value : int
        Its value.
    """

    value: int


#: Marks of fields: an index, a table of four wavelengths, one that an edit of the light renews, and
#: two that each light of a picture has for itself.
CHOICE: Final = Choice()
SPECTRA: Final = InTexture("spectra", spectral=True)
FIELDS: Final = InTexture("fields", 3, spectral=True)
DISC: Final = InTexture("disc", spectral=True)
FACE: Final = InTexture("disc", 2, spectral=True)


def image(texture: str) -> InTexture:
    """Image of four channels in a separate texture."""
    return InTexture(texture, 2, spectral=True, whole=True, image=True)


def spectra(rank: int) -> InTexture:
    """Table of four wavelengths.

    Parameters
    ----------
    rank : int
        Number of axes.
    """
    return InTexture("spectra", rank, spectral=True)


def scalars(rank: int = 1) -> InTexture:
    """Table of scalars."""
    return InTexture("scalars", rank)


class ShaderField(NamedTuple):
    """Field of a NamedTuple.

    Attributes
    ----------
    name : str
        Name of the field.
    kind : type
        Type; a NamedTuple is a group of further fields.
    mark : InTexture, Choice, Always or None
        Mark of an array, of an index or of a constant.
    """

    name: str
    kind: Any
    mark: InTexture | Choice | Always | None

    @property
    def is_group(self) -> bool:
        """Whether it is a NamedTuple."""
        return hasattr(self.kind, "_fields")

    @property
    def vector(self) -> tuple[str, ...]:
        """Fields of a NamedTuple of numbers alone, whose names in a struct begin with its own."""
        hints = get_type_hints(self.kind) if self.is_group else {}
        return tuple(hints) if set(hints.values()) == {float} else ()


def shader_fields(bundle: Any) -> list[ShaderField]:
    """Fields of a NamedTuple in their order.

    Examples
    --------
    >>> class Light(NamedTuple):
    ...     degree: int
    ...     basis: Annotated[Any, SPECTRA]
    >>> [(one.name, one.mark == SPECTRA) for one in shader_fields(Light)]
    [('degree', False), ('basis', True)]
    """
    found = []
    for name, hint in get_type_hints(bundle, include_extras=True).items():
        kind, mark = hint, None
        if get_origin(hint) is Annotated:
            kind, *marks = get_args(hint)
            mark = next(
                (one for one in marks if isinstance(one, (InTexture, Choice, Always))), None
            )
        found.append(ShaderField(name, kind, mark))
    return found


def scalars_of(bundle: Any, numbers: Mapping[str, float]) -> dict[str, Any]:
    """Values of the numbers and vectors among the fields of a NamedTuple, from those of a struct.

    Examples
    --------
    >>> class Light(NamedTuple):
    ...     degree: int
    ...     basis: Annotated[Any, SPECTRA]
    >>> scalars_of(Light, {"degree": 2.0})
    {'degree': 2}
    """
    found: dict[str, Any] = {}
    for one in shader_fields(bundle):
        if one.vector:
            values = (float(numbers[f"{one.name}_{of}"]) for of in one.vector)
            found[one.name] = one.kind(*values)
        elif one.kind in (float, int, bool):
            found[one.name] = one.kind(numbers[one.name])
    return found


def numbers_of(values: Any, start: str = "") -> dict[str, float]:
    """Numbers and vectors among the fields of a NamedTuple, by their names in a struct.

    Parameters
    ----------
    values : NamedTuple
        Values.
    start : str
        Beginning of the names, see ``UniformStruct.named``.

    Examples
    --------
    >>> class Light(NamedTuple):
    ...     degree: int
    ...     basis: Annotated[Any, SPECTRA]
    >>> numbers_of(Light(2, None))
    {'degree': 2.0}
    """
    found: dict[str, float] = {}
    for one in shader_fields(type(values)):
        value, name = getattr(values, one.name), f"{start}{one.name}"
        if one.vector:
            found |= {f"{name}_{of}": float(getattr(value, of)) for of in one.vector}
        elif one.is_group:
            found |= numbers_of(value, f"{name}_" if start else "")
        elif one.kind in (float, int, bool):
            found[name] = float(value)
    return found
