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


SCENE = """
name = "Planet and rock"
[[bodies]]
name = "rock"
radius = "400 km"
position = ["0 km", "20000 km", "0 km"]
[[lights]]
star = { spectrum = "astm-g173" }
direction = [0.3, -1, 0.2]
[observer]
position = ["0 km", "0 km", "0 km"]
[camera]
direction = [0.2, 1, 0]
field_of_view = "40 deg"
"""
AIR = f"""
[[bodies]]
name = "planet"
planet = "{PLANET}"
position = ["9000 km", "28000 km", "0 km"]
"""


def test_a_scene_on_the_gpu_is_the_cpu_s(tmp_path: Path, device: Device) -> None:
    # As tests/render/gpu/test_scene_bodies.py has it.
    file = tmp_path / "scene.toml"
    file.write_text(SCENE + AIR, encoding="utf-8")
    found = {}
    for name in ("gpu", "cpu"):
        out = tmp_path / f"{name}.exr"
        words = ["--size", "32x18", "--quality", "preview", "--wavelengths", "rgb"]
        assert main(["render", str(file), "-o", str(out), *words, "--device", name]) == 0
        found[name], said = read_exr(out)
        assert (device.name in said.values()) == (name == "gpu")
    gpu, cpu = found["gpu"], found["cpu"]
    assert np.quantile(np.abs(gpu - cpu), 0.98) < 0.01 * cpu.max()
    assert np.abs(gpu - cpu).max() < 0.15 * cpu.max()  # a sample or two of an edge


def test_a_scene_that_the_gpu_does_not_draw_is_the_cpu_s_with_the_reason(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # A film has frames of one device alone.
    file, out = tmp_path / "scene.toml", tmp_path / "a.png"
    file.write_text(SCENE, encoding="utf-8")
    assert main(["render", str(file), "--size", "32x18", "--device", "gpu", "-o", str(out)]) == 0
    reason = "scene has no planet with air, which only the CPU draws"
    assert f"falling back to the CPU: {reason}" in capsys.readouterr().err
    film = ["--frames", "2", "--size", "32x18", "--workers", "1", "-o", str(tmp_path / "film")]
    assert main(["animate", str(file), "--device", "gpu", *film]) == 2
    assert f"device gpu cannot render a frame: {reason}" in capsys.readouterr().err
