"""Bundler that joins the viewer's JavaScript into one module, for a page and for a notebook.

The files in ``web/`` are ES modules with relative imports. A page opened from disk cannot load
other modules, so they are joined in the order of their dependencies, each in a function.
"""

from __future__ import annotations

import json
import posixpath
import re
from collections.abc import Callable, Mapping
from importlib import resources
from typing import Final

from airlight.errors import FileError
from airlight.render.gpu.device.flat import FORMATS, PACKED_FORMAT
from airlight.render.gpu.emit.shader_types import FLAT_WIDTH, PACKED_WIDTH
from airlight.render.pixels.polarising_filter import ALONG, ASLANT, NONE
from airlight.render.pixels.render_tables import WAVELENGTHS
from airlight.render.pixels.star_disc import SMALL
from airlight.render.render_system import SAMPLES
from airlight.scene.ground_detail import LEAST_HEIGHT, NOMINAL_ROWS
from airlight.viewer.browser.formulas import formulas_text
from airlight.viewer.navigation import keys

#: ``import { a, b as c } from "./file.js";``, at the start of a line, over one or several lines.
_IMPORT: Final = re.compile(r'^import \{([^}]*)\} from "(\.[\w./]+)";\n', re.MULTILINE)
#: ``export`` before a named declaration.
_EXPORT: Final = re.compile(
    r"^export (?=(?:const|let|class|function\*?|async function)\s+([\w$]+))", re.MULTILINE
)
#: Any other line that is only valid in a module.
_OTHER: Final = re.compile(r"^(?:import|export)\b.*$", re.MULTILINE)


def _keys_module() -> str:
    """Text of the module with the table of keys."""
    return f"export const KEYS = {json.dumps(keys.as_json('page'), ensure_ascii=False)};\n"


def _sizes_module() -> str:
    """Text of the module with texture sizes shared by shaders and page."""
    channels = {form: count for count, form in FORMATS.items()} | {PACKED_FORMAT: 4}
    return (
        f"export const ROW = {FLAT_WIDTH};\nexport const PACKED_ROW = {PACKED_WIDTH};\n"
        f"export const PACKED_FORMAT = {json.dumps(PACKED_FORMAT)};\n"
        f"export const DISC_FORMAT = {json.dumps(FORMATS[4])};\n"
        f"export const NONE = {NONE};\nexport const ALONG = {ALONG};\n"
        f"export const ASLANT = {ASLANT};\n"
        f"export const LANES = {WAVELENGTHS};\nexport const NOMINAL_ROWS = {NOMINAL_ROWS};\n"
        f"export const LEAST_HEIGHT = {LEAST_HEIGHT};\n"
        f"export const SAMPLES = {SAMPLES};\nexport const SMALL_DISC = {SMALL};\n"
        f"export const CHANNELS = {json.dumps(channels)};\n"
    )


#: Modules generated from Python's declarations.
GENERATED: Final[Mapping[str, Callable[[], str]]] = {
    "generated/formulas.js": formulas_text,
    "generated/keys.js": _keys_module,
    "generated/sizes.js": _sizes_module,
}


def web_file(name: str) -> str:
    """Text of one of the viewer's files for the browser.

    Parameters
    ----------
    name : str
        Path in the folder ``web``, with ``/``; or one of ``GENERATED``.
    """
    if name in GENERATED:
        return GENERATED[name]()
    file = resources.files("airlight.viewer") / "web" / name
    if not file.is_file():
        raise FileError(name, "is not a file of the viewer's web folder")
    return file.read_text(encoding="utf-8")


def join_modules(entry: str, read: Callable[[str], str] = web_file) -> str:
    r"""Join a module and all its imports into one ES module.

    Parameters
    ----------
    entry : str
        Path of the file in the folder; the joined module has its exports.
    read : callable
        Function that returns the text of a file by path.

    Returns
    -------
    str
        Text of the joined module.

    Examples
    --------
    >>> files = {"a.js": 'import { b } from "./b.js";\nb();', "b.js": "export function b() {}\n"}
    >>> print(join_modules("a.js", files.__getitem__))
    // b.js
    const module_b = (() => {
    function b() {}
    return { b };
    })();
    // a.js
    const { b } = module_b;
    b();
    """
    done: list[str] = []
    parts: list[str] = []

    def add(name: str, above: tuple[str, ...]) -> None:
        if name in above:
            raise FileError(name, f"imports itself by way of {' and '.join(above)}")
        if name in done:
            return
        folder = posixpath.dirname(name)
        text = read(name)
        for _, target in _IMPORT.findall(text):
            add(_resolved(folder, target), (*above, name))
        body = _IMPORT.sub(lambda found: _taken(found, folder), text)
        if name != entry:
            body = _closed(name, body)
        done.append(name)
        parts.append(f"// {name}\n{body}")

    add(entry, ())
    return "\n".join(parts)


def _resolved(folder: str, target: str) -> str:
    """Path in the folder ``web`` of an import from a file in ``folder``."""
    return posixpath.normpath(posixpath.join(folder, target))


def _taken(match: re.Match[str], folder: str) -> str:
    names = [part.strip().replace(" as ", ": ") for part in match[1].split(",") if part.strip()]
    return f"const {{ {', '.join(names)} }} = {_variable(_resolved(folder, match[2]))};\n"


def _variable(name: str) -> str:
    return "module_" + re.sub(r"\W", "_", name.removesuffix(".js"))


def _closed(name: str, text: str) -> str:
    exported = _EXPORT.findall(text)
    body = _EXPORT.sub("", text)
    other = _OTHER.search(body)
    if other is not None:
        raise FileError(name, f"has a line that cannot be joined: {other[0]}")
    names = ", ".join(exported)
    return f"const {_variable(name)} = (() => {{\n{body.rstrip()}\nreturn {{ {names} }};\n}})();"
