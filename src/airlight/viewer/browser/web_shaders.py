"""The shaders that a browser needs, in both languages."""

from __future__ import annotations

from functools import cache
from typing import Any, Final

from airlight.gpu.device.fragment_pass import declared_bindings, wgsl
from airlight.gpu.emit.translated import entry_points, translated
from airlight.gpu.picture.shaders import Shader, picture_shader, sky_air_shader, sky_peaks_shader
from airlight.gpu.solver.passes import PASSES, shader

#: The vertex function of all passes, and its file.
CORNERS: Final = "full_screen_triangle"
#: The fragment function of the solver's passes, and what their modules are called.
FILL: Final = "fill"
_SOLVER: Final = "solver_{name}"


def shaders() -> tuple[Shader, ...]:
    """The shaders of a picture by the table of the sky."""
    return (sky_air_shader(), sky_peaks_shader(), picture_shader(False))


@cache
def web_texts() -> dict[str, str]:
    """The WGSL of every module by its name: what the GLSL is made of."""
    return {CORNERS: wgsl(CORNERS), **{shader.name: shader.text for shader in shaders()}}


@cache
def web_shaders() -> dict[str, dict[str, Any]]:
    """Every shader as ``web/drawing/program.js`` takes it: WGSL, and GLSL by entry point.

    Raises
    ------
    FileError
        If the GLSL is not of this WGSL.
    """
    texts = web_texts()
    corners = translated(CORNERS, CORNERS, texts[CORNERS])
    found = {}
    for name, text in texts.items():
        if name == CORNERS:
            continue
        entries = {entry: translated(name, entry, text) for _, entry in entry_points(text)}
        found[name] = {"wgsl": f"{texts[CORNERS]}\n{text}", "glsl": {CORNERS: corners, **entries}}
    return found


@cache
def solver_texts() -> dict[str, str]:
    """The WGSL of the solver's passes by the names of their modules."""
    return {_SOLVER.format(name=name): shader(name) for name in sorted(PASSES)}


@cache
def solver_shaders() -> dict[str, dict[str, Any]]:
    """Every pass of the solver as ``web/solving/solver.js`` takes it, with the slots that it reads.

    Raises
    ------
    FileError
        If the GLSL is not of this WGSL.
    """
    corners = wgsl(CORNERS)
    vertex = translated(CORNERS, CORNERS, corners)
    found = {}
    for name in sorted(PASSES):
        module = _SOLVER.format(name=name)
        text = solver_texts()[module]
        slots = {
            one.name: (f"{one.group}/{one.binding}", "texture" in one.layout)
            for one in declared_bindings(text, name)
        }
        found[name] = {
            "wgsl": f"{corners}\n{text}",
            "glsl": {CORNERS: vertex, FILL: translated(module, FILL, text)},
            "uniforms": {one: slot for one, (slot, texture) in slots.items() if not texture},
            "reads": {slot: one for one, (slot, texture) in slots.items() if texture},
        }
    return found
