"""Groups of options shared by commands, declared as dataclasses.

A parameter of a command whose type is a dataclass stands for the options that are its fields, with
their names, defaults and help. A field declared by ``option`` holds the value of its text.
"""

from __future__ import annotations

import contextlib
import dataclasses
import functools
import inspect
from collections.abc import Callable, Iterator
from typing import Annotated, Any, Final, get_type_hints

import typer

from airlight.cli import options
from airlight.errors import ParameterError, changed

#: Function of the text of an option and of its name.
Reader = Callable[[str, str], Any]
#: Readers of texts by the word that stands for them in the help.
READERS: Final[dict[str | None, Reader]] = {
    "ANGLE": options.angle,
    "BEARING": options.bearing,
    "LENGTH": options.length,
    "ZENITH,AZIMUTH": options.direction,
}
#: Default of an option that is required.
REQUIRED: Final = dataclasses.MISSING


def option(
    words: str,
    metavar: str | None = None,
    default: Any = None,
    *,
    flags: tuple[str, ...] = (),
    read: Reader | None = None,
) -> Any:
    """Field of a group: an option, whose name is that of the field.

    Parameters
    ----------
    words : str
        Help text.
    metavar : str, optional
        Word that stands for the value in the help.
    default : object
        Value, or text of it, without the option; ``REQUIRED`` for none.
    flags : tuple of str
        Names of the option, if not that of the field alone.
    read : callable, optional
        Reader of the text; by default that of the metavar in ``READERS``.

    Examples
    --------
    >>> @dataclasses.dataclass(frozen=True, kw_only=True)
    ... class Lens(OptionGroup):
    ...     field_of_view: float = option("Field of view.", "ANGLE", "60deg")
    >>> Lens().field_of_view, Lens(field_of_view="0.5 turn").field_of_view
    (60.0, 180.0)
    """
    read = read or READERS.get(metavar)
    declared = {"words": words, "metavar": metavar, "flags": flags, "read": read, "text": default}
    if read is not None and isinstance(default, str):
        default = read(default, "default")
    return dataclasses.field(default=default, metadata=declared)


class OptionGroup:
    """Base of groups, in which texts of options are read."""

    def __post_init__(self) -> None:
        for one in dataclasses.fields(self):  # type: ignore[arg-type]
            read, value = one.metadata.get("read"), getattr(self, one.name)
            if read is not None and isinstance(value, str):
                object.__setattr__(self, one.name, read(value, option_name(one.name)))


def expand_groups(command: Callable[..., None]) -> Callable[..., None]:
    """Command with one parameter per option, which calls ``command`` with groups.

    Parameters
    ----------
    command : callable
        Function of a command, whose docstring is the help.

    Examples
    --------
    >>> @dataclasses.dataclass
    ... class Lens:
    ...     width: int = 3
    >>> def draw(name: str, lens: Lens) -> None:
    ...     print(name, lens.width)
    >>> draw.__annotations__ = {"name": str, "lens": Lens, "return": None}
    >>> expand_groups(draw)(name="a", width=4)
    a 4
    """
    hints = get_type_hints(command, include_extras=True)
    groups = {
        name: kind
        for name, kind in hints.items()
        if isinstance(kind, type) and dataclasses.is_dataclass(kind)
    }
    parameters: list[inspect.Parameter] = []
    for name, parameter in inspect.signature(command).parameters.items():
        if name in groups:
            parameters += _fields(groups[name])
        else:
            parameters.append(
                parameter.replace(annotation=hints[name], kind=inspect.Parameter.KEYWORD_ONLY)
            )
    names = [parameter.name for parameter in parameters]
    if len(set(names)) < len(names):
        raise TypeError(f"{command.__name__}: an option is declared twice among {names}")

    @functools.wraps(command)
    def flat(**values: Any) -> None:
        packed = {
            name: kind(**{one.name: values.pop(one.name) for one in dataclasses.fields(kind)})
            for name, kind in groups.items()
        }
        command(**values, **packed)

    vars(flat).pop("__wrapped__")
    flat.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    flat.__annotations__ = {one.name: one.annotation for one in parameters}
    return flat


def _fields(kind: type) -> list[inspect.Parameter]:
    """Parameters of the options of a group."""
    hints = get_type_hints(kind, include_extras=True)
    found = []
    for one in dataclasses.fields(kind):
        declared, hint, default = one.metadata, hints[one.name], one.default
        if declared:
            default = declared["text"]
            if declared["read"] is not None:
                hint = str | None if default is None else str
            flags = declared["flags"] or (option_name(one.name),)
            words = typer.Option(*flags, metavar=declared["metavar"], help=declared["words"])
            hint = Annotated[hint, words]
        if default is dataclasses.MISSING:
            default = inspect.Parameter.empty
        kind_of = inspect.Parameter.KEYWORD_ONLY
        found.append(inspect.Parameter(one.name, kind_of, default=default, annotation=hint))
    return found


def option_name(field: str) -> str:
    """Name of the option of a parameter.

    Examples
    --------
    >>> option_name("sun_zenith"), option_name("set_"), option_name("season")
    ('--sun-zenith', '--set', '--ls')
    """
    return {"season": "--ls"}.get(field, "--" + field.strip("_").replace("_", "-"))


def given_options(group: Any, *fields: str) -> dict[str, Any]:
    """Values that differ from the defaults of a group, by the name of the option.

    Parameters
    ----------
    group : dataclass
        Options of a command.
    *fields : str
        Names of the fields; default: all.
    """
    defaults = {one.name: one.default for one in dataclasses.fields(group)}
    values = {name: getattr(group, name) for name in fields or defaults}
    return {option_name(name): v for name, v in values.items() if v != defaults[name]}


def given_values(group: Any, *fields: str) -> dict[str, Any]:
    """Values of a group that are not None, by field."""
    values = {name: getattr(group, name) for name in fields}
    return {name: value for name, value in values.items() if value is not None}


@contextlib.contextmanager
def named_errors(*fields: str, **options: str) -> Iterator[None]:
    """Context that puts names of options into errors about fields.

    Parameters
    ----------
    **options : str
        Options of fields with another name.

    Examples
    --------
    >>> with named_errors("zone", free="--free"):
    ...     raise ParameterError("zone", "x", "UTC")
    Traceback (most recent call last):
    airlight.errors.ParameterError: --zone is 'x'; allowed: UTC
    """
    names = {field: option_name(field) for field in fields} | options
    try:
        yield
    except ParameterError as error:

        def renamed(one: ParameterError) -> ParameterError:
            return one.named(names[one.field]) if one.field in names else one

        raise changed(error, renamed) from None
