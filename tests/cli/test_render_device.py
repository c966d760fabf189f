"""``airlight render --device``: the GPU's picture, and the CPU's with the reason."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from airlight.cli import main
from airlight.image.exr import read_exr
from airlight.render.gpu.device.device import Device

PLANET = "earth-atmosphere-plus"
VIEW = ["--altitude", "35km", "--size", "32x18", "--quality", "preview"]


def rendered(path: Path, *words: str) -> tuple[np.ndarray, dict[str, str]]:
    assert main(["render", PLANET, "-o", str(path), *VIEW, *words]) == 0
    return read_exr(path)


def test_the_gpu_draws_what_the_cpu_renders(
    tmp_path: Path, device: Device, capsys: pytest.CaptureFixture[str]
) -> None:
    # The same wavelengths and weights: 1 %, as tests/render/gpu/test_gpu_renderer.py has it.
    words = ["--wavelengths", "rgb"]
    gpu, said = rendered(tmp_path / "gpu.exr", *words, "--device", "gpu")
    assert capsys.readouterr().err == ""
    cpu, also = rendered(tmp_path / "cpu.exr", *words)
    assert np.abs(gpu - cpu).max() < 0.01 * cpu.max()
    assert device.name in said.values()
    assert "CPU" in also.values()


def test_without_wavelengths_the_gpu_takes_the_four_with_fitted_weights(
    tmp_path: Path, device: Device
) -> None:
    # docs/live.md: the fit errs by 0.2 ΔE against many wavelengths; 5 % of the brightest channel
    # is several times that, while other weights of the same four are 20 % off.
    gpu, said = rendered(tmp_path / "gpu.exr", "--device", "gpu")
    assert "440, 500, 560, 620 nm" in said.values()
    cpu, _ = rendered(tmp_path / "cpu.exr")
    assert np.abs(gpu - cpu).max() < 0.05 * cpu.max()


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["--wavelengths", "5"], "wavelengths is 5; allowed: at most 4 on the GPU"),
        (["--wavelengths", "rgb"], "no GPU: it is switched off (AIRLIGHT_GPU=off)"),
    ],
)
def test_where_the_gpu_cannot_the_cpu_does_and_one_line_says_why(
    tmp_path: Path,
    words: list[str],
    reason: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("AIRLIGHT_GPU", "off")
    instead, _ = rendered(tmp_path / "gpu.exr", *words, "--device", "gpu")
    assert capsys.readouterr().err == f"airlight: falling back to the CPU: {reason}\n"
    wanted, _ = rendered(tmp_path / "cpu.exr", *words)
    assert_array_equal(instead.view(np.uint32), wanted.view(np.uint32))


def test_auto_says_nothing_where_there_is_no_gpu(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("AIRLIGHT_GPU", "off")
    words = ["--wavelengths", "rgb"]
    chosen, _ = rendered(tmp_path / "auto.exr", *words, "--device", "auto")
    assert capsys.readouterr().err == ""
    wanted, _ = rendered(tmp_path / "cpu.exr", *words)
    assert_array_equal(chosen.view(np.uint32), wanted.view(np.uint32))
