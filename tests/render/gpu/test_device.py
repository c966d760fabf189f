"""Device: opened once, with a browser's limits, or refused in one line."""

from __future__ import annotations

import builtins
import os
import subprocess
import sys
from time import perf_counter
from typing import Any

import pytest

from airlight.errors import AirlightError
from airlight.render.gpu.device.device import BROWSER_LIMITS, NoDevice, open_device
from airlight.render.gpu.device.flat import empty_flat_texture
from airlight.render.gpu.device.fragment_pass import FragmentPass
from airlight.render.gpu.device.pass_times import PassTimes

LONG = """
@fragment fn long(@builtin(position) at: vec4f) -> @location(0) vec4f {
  var x = at.x;
  for (var i = 0; i < 2000; i++) { x = fract(x * 1.618 + 0.1); }
  return vec4f(x);
}"""


def test_the_device_is_opened_once(device):
    # open_device promises the same object to everyone in the process.
    assert open_device() is device
    assert device.name


def test_the_device_grants_no_more_than_a_browser(device):
    # W3C WebGPU, table of limits: granted are the requested limits, so overruns are detected.
    for name, browser in BROWSER_LIMITS.items():
        granted = device.device.limits[name]
        assert granted >= browser if name.startswith("min-") else granted <= browser, name


def test_more_bind_groups_than_a_browser_has_are_refused(device):
    # A browser grants four; lavapipe and current GPUs have eight or more.
    import wgpu

    layout = device.device.create_bind_group_layout(entries=[])
    device.device.create_pipeline_layout(bind_group_layouts=[layout] * 4)
    with pytest.raises(wgpu.GPUError):
        device.device.create_pipeline_layout(bind_group_layouts=[layout] * 5)


def test_the_choice_names_an_adapter(device):
    # A part of its own name selects the adapter again, case ignored.
    chosen = open_device(device.adapter.info["device"].upper())
    assert chosen.adapter.info["device"] == device.adapter.info["device"]


def test_a_name_that_no_adapter_has_is_refused_with_the_names_there_are(device):
    # The line must offer the choices.
    with pytest.raises(NoDevice, match=r"no adapter's name contains 'no such gpu'") as refused:
        open_device("no such gpu")
    assert device.adapter.summary in str(refused.value)
    assert "\n" not in str(refused.value)


def test_off_is_off(monkeypatch):
    # The variable is the documented switch.
    monkeypatch.setenv("AIRLIGHT_GPU", "Off")
    with pytest.raises(AirlightError, match=r"^no GPU: it is switched off \(AIRLIGHT_GPU=off\)$"):
        open_device()


def test_without_wgpu_one_line_names_the_extra(monkeypatch):
    # Message for a user who installed airlight alone.
    imported = builtins.__import__

    def without_wgpu(name, *arguments, **named):
        if name.split(".")[0] == "wgpu":
            raise ImportError(name)
        return imported(name, *arguments, **named)

    monkeypatch.setattr(builtins, "__import__", without_wgpu)
    line = r"^no GPU: wgpu is not installed: pip install 'airlight\[view\]'$"
    with pytest.raises(NoDevice, match=line):
        open_device("an adapter that nobody asked for before")


def test_importing_airlight_and_its_gpu_modules_imports_no_wgpu():
    # A fresh interpreter; the loaded modules show it.
    program = (
        "import sys, airlight, airlight.cli, airlight.render.gpu.device.device; "
        "import airlight.render.gpu.device.flat, airlight.render.gpu.device.fragment_pass; "
        "sys.exit(any(name.split('.')[0] in ('wgpu', 'rendercanvas') for name in sys.modules))"
    )
    subprocess.run([sys.executable, "-c", program], check=True)


def test_waiting_ends_when_the_work_is_done(device):
    # The device's own clock: waiting takes at least as long as the submitted work.
    if not device.measures_time:
        pytest.skip(f"{device.name} has no clocks for passes")
    times = PassTimes(device)
    long = FragmentPass(device, LONG, "long", ["r32float"])
    target = empty_flat_texture(device, 2048 * 64, 1)
    for _ in range(2):  # the first compiles
        encoder = device.device.create_command_encoder()
        long.run(encoder, [], [target], timestamps=times("long"))
        times.resolve(encoder)
        started = perf_counter()
        device.device.queue.submit([encoder.finish()])
        device.wait()
        passed = perf_counter() - started
        assert passed >= times.read()["long"] > 0.0


def test_types_of_structures_are_known_without_parsing_them(device: Any) -> None:
    # Each text that cffi has to parse takes some 20 ms; a window's first frame has fifty.
    from wgpu.backends.wgpu_native import ffi

    table = ffi._parsed_types
    assert device.name
    for name in ("WGPUExtent3D", "WGPURenderPipelineDescriptor", "WGPUBindGroupEntry"):
        assert table[f"{name} *"][0] is ffi.typeof(f"{name}  *")
        assert table[f"{name}[]"][0] is ffi.typeof(f"{name} [ ]")


def test_a_device_is_opened_without_words_where_no_session_is(device):
    # as in a container: drivers search a Wayland display, whose library complains by itself
    code = """import os
from airlight.render.gpu.device.device import open_device
open_device()
print(os.environ.get("XDG_RUNTIME_DIR"))
"""
    bare = {name: one for name, one in os.environ.items() if name != "XDG_RUNTIME_DIR"}
    run = [sys.executable, "-c", code]
    done = subprocess.run(run, env=bare, capture_output=True, text=True, check=True)
    assert (done.stderr, done.stdout.strip()) == ("", "None")
