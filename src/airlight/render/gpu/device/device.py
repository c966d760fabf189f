"""WebGPU device: adapter selection, with the limits of a browser."""

from __future__ import annotations

import contextlib
import os
import sys
import tempfile
import threading
from collections.abc import Hashable, Iterator
from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Any, Final
from weakref import WeakValueDictionary

from airlight.errors import AirlightError
from airlight.kernel.cache import Cache

#: Environment variable with the adapter: ``off``, or a part of its name. Not set: the fastest.
CHOICE: Final = "AIRLIGHT_GPU"

#: Limits granted by every browser by default (W3C WebGPU, 3.6.2 "Limits", column of defaults).
BROWSER_LIMITS: Final = {
    "max-texture-dimension-1d": 8192,
    "max-texture-dimension-2d": 8192,
    "max-texture-dimension-3d": 2048,
    "max-texture-array-layers": 256,
    "max-bind-groups": 4,
    "max-bind-groups-plus-vertex-buffers": 24,
    "max-bindings-per-bind-group": 1000,
    "max-dynamic-uniform-buffers-per-pipeline-layout": 8,
    "max-dynamic-storage-buffers-per-pipeline-layout": 4,
    "max-sampled-textures-per-shader-stage": 16,
    "max-samplers-per-shader-stage": 16,
    "max-storage-buffers-per-shader-stage": 8,
    "max-storage-textures-per-shader-stage": 4,
    "max-uniform-buffers-per-shader-stage": 12,
    "max-uniform-buffer-binding-size": 65536,
    "max-storage-buffer-binding-size": 134217728,
    "min-uniform-buffer-offset-alignment": 256,
    "min-storage-buffer-offset-alignment": 256,
    "max-vertex-buffers": 8,
    "max-buffer-size": 268435456,
    "max-vertex-attributes": 16,
    "max-vertex-buffer-array-stride": 2048,
    "max-inter-stage-shader-variables": 16,
    "max-color-attachments": 8,
    "max-color-attachment-bytes-per-sample": 32,
    "max-compute-workgroup-storage-size": 16384,
    "max-compute-invocations-per-workgroup": 256,
    "max-compute-workgroup-size-x": 256,
    "max-compute-workgroup-size-y": 256,
    "max-compute-workgroup-size-z": 64,
    "max-compute-workgroups-per-dimension": 65535,
}
#: Optional features: timing of passes.
_WELCOME: Final = frozenset({"timestamp-query"})

#: Numbers of which wgpu allocates arrays.
_NUMBERS: Final = ("char", "uint8_t", "uint32_t")
#: Kinds of types of which it allocates some.
_KINDS: Final = ("StructType", "EnumType", "PointerType")

#: Number of passes that are kept, and on a software GPU, where one of pixels takes 50 to 60 MB: a
#: view has three of these, and four of the display.
_KEPT_PASSES: Final = 64
_KEPT_IN_SOFTWARE: Final = 12
#: Time since the last use for which others are kept too, so that no frame compiles its own. [s]
_KEPT_SECONDS: Final = 30.0

#: Environment variable with the folder of a session's sockets.
_RUNTIME: Final = "XDG_RUNTIME_DIR"

_lock = threading.Lock()


class NoDevice(AirlightError):
    """No usable GPU; the message has the reason and a remedy."""

    def __init__(self, reason: str) -> None:
        self.reason = " ".join(reason.split())
        super().__init__(self.reason)

    def __str__(self) -> str:
        return f"no GPU: {self.reason}"


@dataclass(frozen=True, kw_only=True, eq=False)
class Device:
    """Open WebGPU device.

    Attributes
    ----------
    device : wgpu.GPUDevice
        Device with ``BROWSER_LIMITS``, so that shaders also run in a browser.
    adapter : wgpu.GPUAdapter
        Adapter.
    name : str
        Name of the adapter and its API.
    software : bool
        Whether it is a software renderer on the CPU.
    """

    device: Any
    adapter: Any
    name: str
    software: bool

    @property
    def measures_time(self) -> bool:
        """Whether GPU timestamps are available."""
        return "timestamp-query" in self.device.features

    def wait(self) -> None:
        """Block until all submitted work is done."""
        # By a read: the queue's own call for this is unusable in wgpu 0.32.
        self.device.queue.read_buffer(self._last)

    def duplicate(self) -> Device:
        """Second device on the same adapter, with an independent queue."""
        return replace(self, device=_requested(self.adapter))

    @cached_property
    def passes(self) -> WeakValueDictionary[Hashable, Any]:
        """Compiled passes, see ``FragmentPass.of``."""
        return WeakValueDictionary()

    @cached_property
    def last_passes(self) -> Cache[Hashable, Any]:
        """Passes that were used last, which are kept."""
        return Cache(_KEPT_IN_SOFTWARE if self.software else _KEPT_PASSES, _KEPT_SECONDS)

    @cached_property
    def maps(self) -> WeakValueDictionary[Hashable, Any]:
        """Textures of ground maps in use, shared by all renderers."""
        return WeakValueDictionary()

    @cached_property
    def _last(self) -> Any:
        import wgpu

        return self.device.create_buffer(size=4, usage=wgpu.BufferUsage.COPY_SRC)

    def __str__(self) -> str:
        return self.name


def open_device(choice: str | None = None) -> Device:
    """Open the device of this process, or return it if it is open.

    Parameters
    ----------
    choice : str, optional
        ``off``, or a part of an adapter's name, case ignored; by default the environment variable
        AIRLIGHT_GPU, and without it the fastest adapter: a GPU before software.

    Raises
    ------
    NoDevice
        If wgpu is not installed, no adapter is found (by Vulkan, Metal or Direct3D 12), no name
        matches, or the choice is ``off``.
    """
    named = os.environ.get(CHOICE, "") if choice is None else choice
    with _lock:
        return _opened(named.strip().lower())


@cache
def _opened(choice: str) -> Device:
    if choice == "off":
        raise NoDevice(f"it is switched off ({CHOICE}=off)")
    with _runtime_folder():
        adapter = _adapter(_wgpu(), choice)
        try:
            device = _requested(adapter)
        except RuntimeError as error:
            raise NoDevice(f"{adapter.summary} cannot be opened: {_last_line(error)}") from error
    return Device(
        device=device,
        adapter=adapter,
        name=adapter.summary,
        software=adapter.info["adapter_type"] == "CPU",
    )


@contextlib.contextmanager
def _runtime_folder() -> Iterator[None]:
    """Set the runtime folder of sockets if the environment does not.

    Without a folder, as in containers and batch jobs, Wayland's library writes to stderr each time
    a driver searches for a display.
    """
    if os.environ.get(_RUNTIME, "").startswith("/") or not sys.platform.startswith("linux"):
        yield
        return
    before = os.environ.get(_RUNTIME)
    with tempfile.TemporaryDirectory() as folder:
        os.environ[_RUNTIME] = folder
        try:
            yield
        finally:
            del os.environ[_RUNTIME]
            if before is not None:
                os.environ[_RUNTIME] = before


def _requested(adapter: Any) -> Any:
    """Device of an adapter, with the features and limits that the shaders use."""
    return adapter.request_device_sync(
        label="airlight",
        required_features=sorted(_WELCOME & set(adapter.features)),
        required_limits=_limits(adapter.limits),
    )


def _wgpu() -> Any:
    try:
        import wgpu
    except ImportError as error:
        raise NoDevice("wgpu is not installed: pip install 'airlight[view]'") from error
    except Exception as error:  # its library cannot be loaded here, with one of several errors
        raise NoDevice(f"wgpu cannot be loaded: {_last_line(error)}") from error
    _know_types()
    _leave_out_opengl()
    return wgpu


def _know_types() -> None:
    """Add pointers to wgpu's structures, and arrays, to cffi's cache of parsed type names.

    wgpu allocates structures by type name, such as ``"WGPUExtent3D *"``, which cffi parses with a C
    parser in Python: 26 ms for each of about fifty names, two thirds of the time until a window's
    first frame. One declaration with all types as arguments takes as long as two names. The cache
    is not a public interface of cffi; if it is missing or different, this has no effect.
    """
    try:
        from wgpu.backends.wgpu_native import ffi

        table: Any = ffi._parsed_types
        names = [name for name in ffi.list_types()[0] if _kind(ffi, name)]
        structures = [name for name in names if _kind(ffi, name) == "StructType"]
        texts = [f"{name} *" for name in structures]
        arrays = [f"{name}[]" for name in names] + [f"{name} []" for name in _NUMBERS]
        behind = [text.replace("[]", "(*)[]") for text in arrays]
        known = ffi.typeof(f"void(*)({', '.join(texts + behind)})").args
        for text, kind in zip(texts, known, strict=False):
            table.setdefault(text, (kind, False))
        for text, pointer in zip(arrays, known[len(texts) :], strict=True):
            table.setdefault(text, (pointer.item, False))
    except Exception:  # whatever has changed there: it only took less time
        return


def _kind(ffi: Any, name: str) -> str:
    """Kind of a type: structure, handle or enumeration; empty for others."""
    declared = ffi._parser._declarations.get(f"typedef {name}", (None,))[0]
    kind = type(declared).__name__
    return kind if name.startswith("WGPU") and kind in _KINDS else ""


def _leave_out_opengl() -> None:
    """Exclude OpenGL, whose adapter search is slow and writes to stderr."""
    try:
        from wgpu.backends.wgpu_native.extras import set_instance_extras

        set_instance_extras(backends=("Primary",))
    except (ImportError, RuntimeError):  # the adapter of an earlier request in this process is used
        return


def _adapter(wgpu: Any, choice: str) -> Any:
    if choice:
        found = wgpu.gpu.enumerate_adapters_sync()
        fitting = [one for one in found if choice in one.summary.lower()]
        if fitting:
            return fitting[0]
        there = "; there are: " + ", ".join(one.summary for one in found) if found else ""
        raise NoDevice(f"no adapter's name contains {choice!r} ({CHOICE}){there}")
    try:
        adapter = wgpu.gpu.request_adapter_sync(power_preference="high-performance")
    except RuntimeError:
        adapter = None
    if adapter is None:
        raise NoDevice(
            "no adapter found (software adapter on Debian: "
            "apt-get install libvulkan1 mesa-vulkan-drivers)"
        )
    return adapter


def _limits(offered: dict[str, int]) -> dict[str, int]:
    """Browser limits, or the adapter's own where it offers less."""
    limits = {}
    for name, browser in BROWSER_LIMITS.items():
        if name in offered:
            weaker = max if name.startswith("min-") else min
            limits[name] = weaker(browser, offered[name])
    return limits


def _last_line(error: BaseException) -> str:
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    return lines[-1] if lines else type(error).__name__
