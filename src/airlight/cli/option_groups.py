"""Groups of options shared by commands, declared as dataclasses.

A command parameter whose type is a dataclass represents its fields as options.
"""

from __future__ import annotations

import contextlib
import dataclasses
import functools
import inspect
from collections.abc import Callable, Iterator, Mapping
from typing import Any, get_type_hints

from airlight.errors import ParameterError


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
    return [
        inspect.Parameter(
            one.name,
            inspect.Parameter.KEYWORD_ONLY,
            default=inspect.Parameter.empty if one.default is dataclasses.MISSING else one.default,
            annotation=hints[one.name],
        )
        for one in dataclasses.fields(kind)
    ]


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
    defaults: Mapping[str, Any] = {one.name: one.default for one in dataclasses.fields(group)}
    values = {name: getattr(group, name) for name in fields or defaults}
    return {option_name(name): v for name, v in values.items() if v != defaults[name]}


def read_options(group: Any, readers: Mapping[str, Callable[[str, str], Any]]) -> dict[str, Any]:
    """Values of the texts of a group that are not None, by field.

    Parameters
    ----------
    readers : mapping
        Functions of text and name of the option, by field.
    """
    texts = {name: getattr(group, name) for name in readers}
    return {
        name: readers[name](text, option_name(name))
        for name, text in texts.items()
        if text is not None
    }


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
        if error.field not in names:
            raise
        raise error.named(names[error.field]) from None
