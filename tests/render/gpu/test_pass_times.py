"""Times of passes by the device's clock."""

from __future__ import annotations

from time import perf_counter

import pytest

from airlight.errors import ParameterError
from airlight.render.gpu.device.flat import empty_flat_texture
from airlight.render.gpu.device.fragment_pass import FragmentPass
from airlight.render.gpu.device.pass_times import PassTimes

LONG = """
@fragment fn long(@builtin(position) at: vec4f) -> @location(0) vec4f {
  var x = at.x;
  for (var i = 0; i < 2000; i++) { x = fract(x * 1.618 + 0.1); }
  return vec4f(x);
}"""


@pytest.fixture
def times(device):
    if not device.measures_time:
        pytest.skip(f"{device.name} has no clocks for passes")
    return PassTimes(device, most=3)


def submit(device, times, long):
    """Submit a long pass over all of a target, a short one over one row, the long one again."""
    target = empty_flat_texture(device, 2048 * 64, 1)
    encoder = device.device.create_command_encoder()
    groups = long.bind({})
    long.run(encoder, groups, [target], timestamps=times("long"))
    long.run(encoder, groups, [target], area=(0, 0, 16, 1), timestamps=times("short"))
    long.run(encoder, groups, [target], timestamps=times("long"))
    times.resolve(encoder)
    device.device.queue.submit([encoder.finish()])
    return times.read()


def test_the_passes_of_a_submission_take_most_of_its_time_and_no_more(device, times):
    # A second clock, the CPU's, around the same work; 8192 times the texels take longer. Other
    # work on the machine stops a pass for some time, but not the same one each time.
    long = FragmentPass(device, LONG, "long", ["r32float"])
    submit(device, times, long)  # compiles
    fractions, ratios = [0.0], [1.0]
    for _ in range(20):
        started = perf_counter()
        seconds = submit(device, times, long)
        passed = perf_counter() - started
        assert list(seconds) == ["long", "short"]
        assert seconds["short"] >= 0.0
        assert seconds["long"] + seconds["short"] <= passed
        fractions.append(seconds["long"] / passed)
        ratios.append(seconds["short"] / seconds["long"])
        if min(ratios) < 0.1 and max(fractions) > 0.02:
            break
    assert min(ratios) < 0.1
    assert max(fractions) > 0.02  # ticks of a microsecond would fall below


def test_more_passes_than_promised_are_refused(device, times):
    for name in "abc":
        times(name)
    with pytest.raises(ParameterError, match="at most 3 passes"):
        times("d")


def test_nothing_timed_is_nothing_read(times):
    assert times.read() == {}
