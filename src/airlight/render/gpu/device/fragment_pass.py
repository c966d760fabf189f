"""Fragment pass: a fragment shader over all texels of its render targets."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, Self

from airlight.errors import AirlightError, ParameterError
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.emit.wgsl import WGSL

#: Declaration such as ``@group(0) @binding(1) var<uniform> name: Type;``.
_DECLARATION: Final = re.compile(
    r"@group\(\s*(\d+)\s*\)\s*@binding\(\s*(\d+)\s*\)\s*"
    r"var\s*(?:<\s*([^>]*?)\s*>)?\s*(\w+)\s*:\s*(\w+)\s*(?:<\s*(\w+)\s*>)?"
)
_COMMENT: Final = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
_TEXTURES: Final = {"texture_2d": "2d", "texture_2d_array": "2d-array", "texture_3d": "3d"}
_SAMPLES: Final = {"f32": "unfilterable-float", "i32": "sint", "u32": "uint"}
#: Position in a message of naga.
_PLACE: Final = re.compile(r"┌─ [^\n]*?:(\d+):(\d+)")


class ShaderError(AirlightError):
    """Shader that does not compile; the message gives name, line, source text and error.

    Attributes
    ----------
    label, line, text, message : str, int, str, str
        Parts of the message; the line counts from 1, and is 0 if unknown.
    """

    def __init__(self, label: str, line: int, text: str, message: str) -> None:
        self.label = label
        self.line = line
        self.text = text.strip()
        self.message = " ".join(message.split())
        super().__init__(label, line, text, message)

    def __str__(self) -> str:
        where = f", line {self.line}, `{self.text}`" if self.line else ""
        return f"shader {self.label}{where}: {self.message}"


@dataclass(frozen=True)
class Binding:
    """Resource that a shader declares: group and binding, name and kind."""

    group: int
    binding: int
    name: str
    layout: dict[str, Any]


def declared_bindings(source: str, label: str = "shader") -> tuple[Binding, ...]:
    """Resources that a WGSL source declares, in the order of the source.

    Uniforms, samplers and sampled textures are supported, as in WebGL2. Textures of f32 are assumed
    to be read by ``textureLoad``; if the source declares a sampler they may be filtered.

    Parameters
    ----------
    label : str
        Name in error messages.
    """
    bare = _COMMENT.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), source)
    found = list(_DECLARATION.finditer(bare))
    filtered = any(one[5] == "sampler" for one in found)
    return tuple(
        Binding(int(one[1]), int(one[2]), one[4], _layout(one, filtered, source, label))
        for one in found
    )


def _layout(found: re.Match[str], filtered: bool, source: str, label: str) -> dict[str, Any]:
    space, kind, of = found[3], found[5], found[6]
    if space == "uniform":
        return {"buffer": {"type": "uniform"}}
    if space is None and kind == "sampler":
        return {"sampler": {"type": "filtering"}}
    if space is None and kind in _TEXTURES and of in _SAMPLES:
        sample = "float" if filtered and of == "f32" else _SAMPLES[of]
        return {"texture": {"sample_type": sample, "view_dimension": _TEXTURES[kind]}}
    line = source.count("\n", 0, found.start()) + 1
    raise ShaderError(
        label,
        line,
        source.splitlines()[line - 1],
        "only uniforms, samplers and sampled textures are supported",
    )


def compiled(device: Device, source: str, label: str) -> Any:
    """Compile a WGSL source to a module."""
    import wgpu

    try:
        return device.device.create_shader_module(label=label, code=source)
    except wgpu.GPUError as error:
        raise _shader_error(source, label, str(error)) from error


def _shader_error(source: str, label: str, report: str) -> ShaderError:
    lines = source.splitlines()
    place = _PLACE.search(report)
    line = int(place[1]) if place else 0
    wrong = re.search(r"[Ss]hader[^\n]*?error: ([^\n]*)", report)
    message = wrong[1] if wrong else report
    reasons = re.findall(r"^\s*= ([^\n]*)", report, re.MULTILINE)
    if place:  # the caret's line is more precise than the position, the function's beginning
        below = report[place.end() :].split("\n")
        carets = [index for index, one in enumerate(below) if "^^" in one and "│" in one]
        if carets:
            numbered = re.match(r"\s*(\d+) │", below[carets[0] - 1])
            line = int(numbered[1]) if numbered else line
    text = lines[line - 1] if 0 < line <= len(lines) else ""
    return ShaderError(label, line, text, ": ".join([message, *reasons]))


class FragmentPass:
    """Render pipeline of a fragment entry point.

    Parameters
    ----------
    device : Device
        Device from ``open_device``.
    source : str
        WGSL source, with the declarations of everything that it reads.
    entry : str
        Name of the ``@fragment`` function.
    targets : sequence of str
        Formats of the textures that it writes, such as ``("rgba32float",)``; together at most
        32 bytes a texel.
    label : str
        Label in messages; by default the entry point's name.
    """

    def __init__(
        self, device: Device, source: str, entry: str, targets: Sequence[str], label: str = ""
    ) -> None:
        import wgpu

        self.device = device
        self.label = label or entry
        self.targets = tuple(targets)
        self.bindings = declared_bindings(source, self.label)
        gpu, module = device.device, compiled(device, source, self.label)
        try:
            self._layouts = [
                gpu.create_bind_group_layout(label=self.label, entries=entries)
                for entries in _entries(self.bindings)
            ]
            corners = compiled(device, WGSL.triangle, "full_screen_triangle")
            self.pipeline = gpu.create_render_pipeline(
                label=self.label,
                layout=gpu.create_pipeline_layout(bind_group_layouts=self._layouts),
                vertex={"module": corners, "entry_point": "full_screen_triangle"},
                primitive={"topology": "triangle-list"},
                fragment={
                    "module": module,
                    "entry_point": entry,
                    "targets": [{"format": one} for one in self.targets],
                },
            )
        except wgpu.GPUError as error:
            raise _shader_error(source, self.label, _without_frame(str(error))) from error

    @classmethod
    def of(cls, device: Device, source: str, entry: str, targets: Sequence[str]) -> Self:
        """Pass that is in use or was used recently, or a new one; see the constructor."""
        key = source, entry, tuple(targets)
        one = device.passes.get(key)
        if one is None:
            one = device.passes[key] = cls(device, source, entry, targets)
        found: Self = device.last_passes.put(key, one)
        return found

    def bind(self, resources: Mapping[str, Any]) -> list[Any]:
        """Bind groups of named resources, for ``run``; reusable.

        Parameters
        ----------
        resources : mapping
            Resources by name in the source: a buffer for a uniform, a texture or a view of one, a
            sampler. Names that the source does not declare are ignored, so that one mapping can
            serve several passes.
        """
        gpu = self.device.device
        groups = []
        for number, layout in enumerate(self._layouts):
            entries = [
                {"binding": one.binding, "resource": _resource(resources, one)}
                for one in self.bindings
                if one.group == number
            ]
            groups.append(gpu.create_bind_group(label=self.label, layout=layout, entries=entries))
        return groups

    def run(
        self,
        encoder: Any,
        groups: Sequence[Any],
        views: Sequence[Any],
        area: tuple[int, int, int, int] | None = None,
        keep: bool = False,
        timestamps: Mapping[str, Any] | None = None,
    ) -> None:
        """Record the pass into a command encoder.

        Parameters
        ----------
        encoder : wgpu.GPUCommandEncoder
            Encoder, which the caller submits.
        groups : sequence
            Bind groups from ``bind``.
        views : sequence
            Textures or views of them, one for each target, all of the same size.
        area : (x, y, width, height), optional
            Texels that are written; by default all. [texel]
        keep : bool
            Whether texels outside the area keep their values; otherwise they become 0.
        timestamps : mapping, optional
            ``query_set`` and indices of ``beginning_of_pass_write_index`` and
            ``end_of_pass_write_index``, for a device that ``measures_time``.
        """
        if len(views) != len(self.targets):
            raise ParameterError("views", len(views), f"{len(self.targets)} targets")
        begun = encoder.begin_render_pass(
            label=self.label,
            color_attachments=[
                {
                    "view": _view(one),
                    "load_op": "load" if keep else "clear",
                    "clear_value": (0.0, 0.0, 0.0, 0.0),
                    "store_op": "store",
                }
                for one in views
            ],
            **({} if timestamps is None else {"timestamp_writes": dict(timestamps)}),
        )
        begun.set_pipeline(self.pipeline)
        for number, group in enumerate(groups):
            begun.set_bind_group(number, group)
        if area is not None:
            begun.set_scissor_rect(*area)
        begun.draw(3)
        begun.end()

    def draw(self, resources: Mapping[str, Any], views: Sequence[Any]) -> None:
        """Bind, run and submit a pass once."""
        encoder = self.device.device.create_command_encoder(label=self.label)
        self.run(encoder, self.bind(resources), views)
        self.device.device.queue.submit([encoder.finish()])


def _resource(resources: Mapping[str, Any], wanted: Binding) -> Any:
    if wanted.name not in resources:
        raise ParameterError("resources", sorted(resources), f"a list with {wanted.name}")
    given = resources[wanted.name]
    if "buffer" in wanted.layout:
        return {"buffer": given, "offset": 0, "size": given.size}
    return _view(given) if "texture" in wanted.layout else given


def _view(given: Any) -> Any:
    """View of a texture; a view is returned unchanged."""
    return given.create_view() if hasattr(given, "create_view") else given


def _without_frame(report: str) -> str:
    """Last lines of a pipeline error message."""
    lines = [line.strip() for line in report.splitlines() if line.strip()]
    return ": ".join(lines[2:]) if len(lines) > 2 else report


def _entries(bindings: Sequence[Binding]) -> list[list[dict[str, Any]]]:
    """Entries of the layout of each bind group."""
    import wgpu

    seen = wgpu.ShaderStage.FRAGMENT
    groups = 1 + max((one.group for one in bindings), default=-1)
    return [
        [
            {"binding": one.binding, "visibility": seen, **one.layout}
            for one in bindings
            if one.group == group
        ]
        for group in range(groups)
    ]
