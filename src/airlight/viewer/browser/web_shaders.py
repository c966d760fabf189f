"""Shaders for the browser, in WGSL and GLSL."""

from __future__ import annotations

from functools import cache
from typing import Any, Final

from airlight.render.gpu.device.fragment_pass import declared_bindings
from airlight.render.gpu.emit.dialect import ShaderDialect
from airlight.render.gpu.emit.glsl import GLSL
from airlight.render.gpu.emit.wgsl import WGSL
from airlight.render.gpu.picture.display_shaders import (
    added_shader,
    coarser_shader,
    covering_shader,
    display_shader,
    layered_shader,
    spread_shader,
)
from airlight.render.gpu.picture.shaders import (
    Shader,
    body_shader,
    disc_shader,
    picture_shader,
    sky_air_shader,
    sky_mirrored_shader,
    sky_peaks_shader,
    sky_polarised_shader,
    small_disc_shader,
    transmittance_shader,
)
from airlight.render.gpu.solver.passes import PASSES, shader

#: Vertex function of all passes.
CORNERS: Final = "full_screen_triangle"
#: Fragment function of the solver's passes.
FILL: Final = "fill"


#: Passes of ``scene_shaders`` that draw a planet in front of the stars.
STARRY: Final = ("through", "layered")
#: Passes of a scene of several bodies.
LAYERED: Final = (*STARRY, "body", "coverage", "disc", "small_disc", "covering", "added")


def scene_shaders(dialect: ShaderDialect) -> dict[str, Shader]:
    """Shaders of a scene of several bodies, by the names of their passes in a page.

    Parameters
    ----------
    dialect : ShaderDialect
        Shading language.
    """
    return {
        "through": transmittance_shader(dialect),
        "body": body_shader(False, (), dialect),
        "coverage": body_shader(True, (), dialect),
        "disc": disc_shader((), dialect),
        "small_disc": small_disc_shader((), dialect),
        "layered": layered_shader(dialect),
        "covering": covering_shader(dialect),
        "added": added_shader(dialect),
    }


@cache
def web_shaders(marched: bool = False, layers: tuple[str, ...] = ()) -> dict[str, dict[str, Any]]:
    """Rendering and display shaders, for ``web/drawing/program.js``.

    Parameters
    ----------
    marched : bool
        Whether every pixel is marched, as with rings or an oblate planet.
    layers : tuple of str
        Those of ``scene_shaders`` that are among them.

    Returns
    -------
    dict
        Texts by name: ``wgsl``, and ``glsl`` by entry point.
    """
    found: dict[str, dict[str, Any]] = {}
    for dialect in (WGSL, GLSL):
        plain = (
            sky_air_shader(dialect),
            sky_peaks_shader(dialect),
            sky_polarised_shader(dialect),
            sky_mirrored_shader(dialect),
            picture_shader(marched, (), marched, dialect),
            coarser_shader(dialect),
            spread_shader(dialect),
            added_shader(dialect),
            display_shader((), dialect),
        )
        named = {one.name: one for one in plain}
        named |= {name: scene_shaders(dialect)[name] for name in layers}
        for name, one in named.items():
            texts = found.setdefault(name, {})
            if dialect is WGSL:
                texts["wgsl"] = f"{WGSL.triangle}\n{one.text}"
            else:
                entries = {entry: one.entry_text(entry) for entry in one.entries}
                texts["glsl"] = {CORNERS: GLSL.triangle, **entries}
    return found


@cache
def solver_shaders() -> dict[str, dict[str, Any]]:
    """Passes of the solver with their binding slots, for ``web/solving/solver.js``.

    Returns
    -------
    dict
        By name: ``wgsl``, ``glsl`` by entry point, number of ``targets``, ``uniforms`` and
        ``reads``.
    """
    found = {}
    for name in sorted(PASSES):
        text = shader(name)
        slots = {
            one.name: (f"{one.group}/{one.binding}", "texture" in one.layout)
            for one in declared_bindings(text, name)
        }
        found[name] = {
            "wgsl": f"{WGSL.triangle}\n{text}",
            "glsl": {CORNERS: GLSL.triangle, FILL: shader(name, GLSL)},
            "targets": len(PASSES[name].targets),
            "uniforms": {one: slot for one, (slot, texture) in slots.items() if not texture},
            "reads": {slot: one for one, (slot, texture) in slots.items() if texture},
        }
    return found
