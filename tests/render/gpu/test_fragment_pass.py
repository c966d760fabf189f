"""Passes: every texel once, resources by name, errors reported with their line."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from airlight.errors import ParameterError
from airlight.render.gpu.device.flat import (
    empty_flat_texture,
    flat_texture,
    read_flat,
    read_texture,
)
from airlight.render.gpu.device.fragment_pass import FragmentPass, ShaderError, declared_bindings

SUM = """
struct Numbers { scale: vec4f }
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var first: texture_2d<f32>;
@group(1) @binding(3) var second: texture_2d<f32>; // a second group, with a gap
@fragment fn total(@builtin(position) at: vec4f) -> @location(0) vec4f {
  let p = vec2i(at.xy);
  return numbers.scale * (textureLoad(first, p, 0).x + textureLoad(second, p, 0));
}
"""


def buffer(device, values):
    import wgpu

    return device.device.create_buffer_with_data(
        data=np.asarray(values, np.float32), usage=wgpu.BufferUsage.UNIFORM
    )


def resources(device, count=3000):
    random = np.random.default_rng(5)
    first = random.integers(-99, 99, count).astype(np.float32)
    second = random.integers(-99, 99, (count, 4)).astype(np.float32)
    given = {
        "numbers": buffer(device, [1.0, 2.0, 0.5, -1.0]),
        "first": flat_texture(device, first),
        "second": flat_texture(device, second).create_view(),
        "of another pass": None,
    }
    return given, np.float32([1.0, 2.0, 0.5, -1.0]) * (first[:, None] + second)


def test_a_pass_computes_every_texel_from_named_resources(device):
    # Integers: the same arithmetic in NumPy, bit for bit.
    given, expected = resources(device)
    target = empty_flat_texture(device, 3000, 4)
    FragmentPass(device, SUM, "total", ["rgba32float"]).draw(given, [target])
    assert_array_equal(read_flat(device, target, 3000), expected)


def test_two_targets_are_written_at_once(device):
    # 2 × 16 bytes a texel: the browser's limit.
    source = """
    struct Two { @location(0) a: vec4f, @location(1) b: vec4f }
    @fragment fn two(@builtin(position) at: vec4f) -> Two {
      return Two(vec4f(at.x), vec4f(-at.y));
    }"""
    targets = [empty_flat_texture(device, 4096, 4) for _ in range(2)]
    FragmentPass(device, source, "two", ["rgba32float"] * 2).draw({}, targets)
    rows, columns = np.indices((2, 2048))
    assert_array_equal(read_texture(device, targets[0])[..., 0], columns + 0.5)
    assert_array_equal(read_texture(device, targets[1])[..., 3], -rows - 0.5)


def test_three_wide_targets_are_refused_as_in_a_browser(device):
    # There maxColorAttachmentBytesPerSample is 32.
    source = """
    struct Three { @location(0) a: vec4f, @location(1) b: vec4f, @location(2) c: vec4f }
    @fragment fn three() -> Three { return Three(vec4f(), vec4f(), vec4f()); }"""
    with pytest.raises(ShaderError, match=r"^shader three"):
        FragmentPass(device, source, "three", ["rgba32float"] * 3)


@pytest.mark.parametrize("keep", [True, False])
def test_an_area_leaves_the_other_texels(device, keep):
    # Texels outside keep their value or become 0, as documented.
    source = "@fragment fn one() -> @location(0) vec4f { return vec4f(7.0); }"
    target = flat_texture(device, np.full(2048 * 3, 3.0))
    one = FragmentPass(device, source, "one", ["r32float"])
    encoder = device.device.create_command_encoder()
    one.run(encoder, one.bind({}), [target], area=(5, 1, 10, 2), keep=keep)
    device.device.queue.submit([encoder.finish()])
    expected = np.full((3, 2048), 3.0 if keep else 0.0)
    expected[1:3, 5:15] = 7.0
    assert_array_equal(read_texture(device, target)[..., 0], expected)


@pytest.mark.parametrize(
    ("source", "line", "text", "what"),
    [
        ("fn f() -> f32 {\n  return nope(1.0);\n}", 2, "return nope(1.0);", "nope"),
        ("\n\nfn f( {\n}", 3, "fn f( {", "expected identifier"),
        ("fn g() {}\nfn f() -> f32 {\n  return 1u;\n}", 3, "return 1u;", "return"),
    ],
)
def test_a_mistake_is_named_with_its_line(device, source, line, text, what):
    # The line is known from the source: wrong name, wrong form, wrong type.
    with pytest.raises(ShaderError) as refused:
        FragmentPass(device, source, "f", ["r32float"], label="a pass")
    assert (refused.value.label, refused.value.line, refused.value.text) == ("a pass", line, text)
    assert str(refused.value).startswith(f"shader a pass, line {line}, `{text}`: ")
    assert what in refused.value.message
    assert "\n" not in str(refused.value)


def test_an_entry_that_is_not_there_is_refused(device):
    with pytest.raises(ShaderError, match=r"(?i)^shader missing.*entry"):
        FragmentPass(device, SUM, "missing", ["rgba32float"])


def test_a_missing_resource_is_named(device):
    one = FragmentPass(device, SUM, "total", ["rgba32float"])
    given, _ = resources(device)
    del given["second"]
    with pytest.raises(ParameterError, match=r"a list with second$"):
        one.bind(given)


def test_declarations_are_read_as_they_stand():
    # By inspection; comments declare nothing.
    source = SUM + "\n/* @group(0) @binding(9) var no: sampler; */"
    found = [(one.group, one.binding, one.name) for one in declared_bindings(source)]
    assert found == [(0, 0, "numbers"), (0, 1, "first"), (1, 3, "second")]


def test_what_webgl2_does_not_have_is_refused_with_its_line():
    # WebGL2 has no storage buffers and no storage textures.
    source = "// a comment\n@group(0) @binding(0) var<storage, read> many: array<f32>;"
    with pytest.raises(ShaderError, match=r"^shader it, line 2, .*uniforms, samplers and sampled"):
        declared_bindings(source, "it")


def test_passes_are_kept_while_in_use_or_among_the_last(device, monkeypatch):
    # On a software GPU one of pixels takes 50 to 60 MB of the process. All are used minutes apart.
    clock = itertools.count(0.0, 100.0)
    monkeypatch.setattr("airlight.kernel.cache.time.monotonic", lambda: next(clock))
    apart = device.duplicate()
    most = 12 if device.software else 64

    def of(number):
        source = f"@fragment fn one() -> @location(0) vec4f {{ return vec4f({number}.0); }}"
        return FragmentPass.of(apart, source, "one", ["r32float"])

    in_use = of(0)
    for number in range(1, most + 3):
        of(number)
    assert len(apart.passes) == most + 1
    assert of(0) is in_use
