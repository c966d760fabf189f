"""The shaders in the language of WebGL2: translated from WGSL once, and kept beside it.

A browser without WebGPU reads GLSL ES 3.00. ``builders/webgl_shaders.py`` writes it from the same
WGSL and puts a hash of that text into each file's head, so that a file that no longer belongs to
its WGSL is never used.
"""

from __future__ import annotations

import hashlib
import re
from importlib import resources
from importlib.resources.abc import Traversable
from typing import Final

from airlight.errors import FileError

#: The line that names the source, the second of a file: the first must be the version.
_HEAD: Final = "// of {module}.wgsl {stamp}, by {translator}"
_ENTRY: Final = re.compile(r"^@(vertex|fragment)\s+fn\s+(\w+)", re.MULTILINE)
_STAMP: Final = re.compile(
    r"^// of (?P<module>\S+)\.wgsl (?P<stamp>[0-9a-f]{16}), by ", re.MULTILINE
)


def stamp(wgsl: str) -> str:
    """A short hash of a shader's text.

    Examples
    --------
    >>> stamp("")
    'e3b0c44298fc1c14'
    """
    return hashlib.sha256(wgsl.encode()).hexdigest()[:16]


def entry_points(wgsl: str) -> list[tuple[str, str]]:
    r"""Stage and name of each entry point of a module, in the order of the text.

    Examples
    --------
    >>> entry_points("@vertex\nfn corners() {}\n@fragment fn sky() {}")
    [('vertex', 'corners'), ('fragment', 'sky')]
    """
    return _ENTRY.findall(wgsl)


def file_name(module: str, entry: str) -> str:
    """The name of the file with one entry point of a module.

    Examples
    --------
    >>> file_name("sky", "fragment")
    'sky.fragment.glsl'
    """
    return f"{module}.{entry}.glsl"


def with_head(module: str, wgsl: str, glsl: str, translator: str) -> str:
    r"""A translated shader with the line that names its source.

    Examples
    --------
    >>> print(with_head("sky", "", "#version 300 es\nvoid main() {}", "hand"))
    #version 300 es
    // of sky.wgsl e3b0c44298fc1c14, by hand
    void main() {}
    <BLANKLINE>
    """
    version, _, body = glsl.lstrip().partition("\n")
    head = _HEAD.format(module=module, stamp=stamp(wgsl), translator=translator)
    return f"{version}\n{head}\n{body.strip()}\n"


def translated(module: str, entry: str, wgsl: str, folder: Traversable | None = None) -> str:
    """The GLSL ES 3.00 of one entry point.

    Parameters
    ----------
    module : str
        Name of the shader.
    entry : str
        Of its vertex or fragment function.
    wgsl : str
        The module's text, of which the file must have been made.
    folder : Traversable, optional
        Where to look; the package's own ``gpu/glsl`` if left out.

    Raises
    ------
    FileError
        If the file is missing, or was made of another text.
    """
    name = file_name(module, entry)
    file = (resources.files("airlight.gpu") / "glsl" if folder is None else folder) / name
    if not file.is_file():
        raise FileError(name, "is missing: python builders/webgl_shaders.py writes it")
    text = file.read_text(encoding="utf-8")
    found = _STAMP.search(text)
    if found is None or found["stamp"] != stamp(wgsl):
        reason = f"belongs to another text of {module}.wgsl: run python builders/webgl_shaders.py"
        raise FileError(name, reason)
    return text
