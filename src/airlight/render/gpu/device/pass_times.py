"""Duration of passes by GPU timestamps."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from airlight.errors import ParameterError
from airlight.render.gpu.device.device import Device

#: Two timestamps a pass, 8 bytes each; a set has at most 4096 (W3C WebGPU, "GPUQuerySet").
_MOST_PASSES: Final = 2048
_BYTES: Final = 8


class PassTimes:
    """Timestamp queries of passes, named while recording and read after submission.

    Parameters
    ----------
    device : Device
        Device that ``measures_time``.
    most : int
        Number of passes that can be timed in one submission.

    Raises
    ------
    ParameterError
        If the device cannot measure time, or there are more than 2048 passes.

    Examples
    --------
    ``times = PassTimes(device)``, then ``one.run(encoder, groups, views, timestamps=times("sky"))``
    for each pass, ``times.resolve(encoder)`` before ``encoder.finish()``, and after the submission
    ``times.read()``.
    """

    def __init__(self, device: Device, most: int = 64) -> None:
        import wgpu

        if not device.measures_time:
            raise ParameterError("device", device.name, "a device with timestamp queries")
        if not 0 < most <= _MOST_PASSES:
            raise ParameterError("most", most, f"1 to {_MOST_PASSES}")
        self.device = device
        self.most = most
        self._names: list[str] = []
        self._set = device.device.create_query_set(type="timestamp", count=2 * most)
        self._buffer = device.device.create_buffer(
            size=2 * _BYTES * most,
            usage=wgpu.BufferUsage.QUERY_RESOLVE | wgpu.BufferUsage.COPY_SRC,
        )

    def __call__(self, name: str) -> dict[str, Any]:
        """Make the next pass's ``timestamps`` for ``FragmentPass.run``, also for compute passes.

        Parameters
        ----------
        name : str
            Name of the pass; times of passes with the same name are added.

        Raises
        ------
        ParameterError
            If there are more passes in the submission than ``most``.
        """
        if len(self._names) == self.most:
            raise ParameterError("name", name, f"at most {self.most} passes in one submission")
        self._names.append(name)
        last = 2 * len(self._names) - 1
        return {
            "query_set": self._set,
            "beginning_of_pass_write_index": last - 1,
            "end_of_pass_write_index": last,
        }

    def resolve(self, encoder: Any) -> None:
        """Record, after all passes, the copy of the timestamps to a readable buffer.

        Parameters
        ----------
        encoder : wgpu.GPUCommandEncoder
            Encoder of the passes, not yet finished.
        """
        if self._names:
            encoder.resolve_query_set(self._set, 0, 2 * len(self._names), self._buffer, 0)

    def read(self) -> dict[str, float]:
        """Durations by name since the last reading, summed over equal names. [s]

        Blocks until the submission is complete, and resets the queries.
        """
        names, self._names = self._names, []
        if not names:
            return {}
        size = 2 * _BYTES * len(names)
        ticks = np.frombuffer(self.device.device.queue.read_buffer(self._buffer, 0, size), "u8")
        begin, end = ticks.astype(np.float64).reshape(-1, 2).T
        seconds: dict[str, float] = dict.fromkeys(names, 0.0)
        for name, one in zip(names, 1e-9 * _tick(self.device) * (end - begin), strict=True):
            seconds[name] += float(one)
        return seconds


def _tick(device: Device) -> float:
    """Timestamp period; 1 in browsers, adapter-dependent in native APIs. [ns]"""
    from wgpu.backends.wgpu_native import lib

    return float(lib.wgpuQueueGetTimestampPeriod(device.device.queue._internal))
