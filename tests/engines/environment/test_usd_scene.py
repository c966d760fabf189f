"""The USD layer, read by OpenUSD itself."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import NoReturn

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.engines.environment.environment_map import EnvironmentMap
from airlight.engines.environment.files import write_map
from airlight.errors import ParameterError

Made = Callable[..., EnvironmentMap]


@pytest.mark.parametrize("zenith", [3.0, 50.0, 89.0])
def test_the_sun_shines_from_where_it_stands_with_its_irradiance(
    made: Made, tmp_path: Path, zenith: float, lacking: Callable[[str], NoReturn]
) -> None:
    try:
        from pxr import Gf, Usd, UsdGeom, UsdLux
    except ImportError:
        lacking("no OpenUSD (pip install usd-core)")
    shown = made("usd", "light", zenith=zenith)
    write_map(tmp_path / "sky.exr", shown, scale=0.5)
    stage = Usd.Stage.Open(str(tmp_path / "sky.usda"))
    assert UsdGeom.GetStageUpAxis(stage) == "Y"
    assert stage.GetDefaultPrim().GetPath() == "/Sky"
    dome = UsdLux.DomeLight.Get(stage, "/Sky/Dome")
    assert dome.GetIntensityAttr().Get() == 2.0
    assert dome.GetTextureFormatAttr().Get() == "latlong"
    assert Path(dome.GetTextureFileAttr().Get().resolvedPath).name == "sky.exr"
    light = UsdLux.DistantLight.Get(stage, "/Sky/Sun")
    # it shines along its -z
    world = UsdGeom.Xformable(light).ComputeLocalToWorldTransform(Usd.TimeCode.Default())
    assert_allclose(world.GetDeterminant(), 1.0, rtol=1e-6)
    shining = np.array(world.TransformDir(Gf.Vec3d(0.0, 0.0, -1.0)))
    (disc,) = shown.discs
    east, north, up = disc.direction
    assert_allclose(shining, [-east, -up, north], atol=1e-6)
    assert_allclose(light.GetAngleAttr().Get(), 0.533, rtol=1e-5)
    assert light.GetNormalizeAttr().Get() is True
    colour = light.GetIntensityAttr().Get() * np.array(light.GetColorAttr().Get())
    assert_allclose(colour, disc.irradiance, rtol=1e-5, atol=1e-6 * disc.irradiance.max())


def test_the_dome_s_pole_can_be_said_by_the_newer_dome(
    made: Made, tmp_path: Path, lacking: Callable[[str], NoReturn]
) -> None:
    try:
        from pxr import Usd, UsdLux
    except ImportError:
        lacking("no OpenUSD (pip install usd-core)")
    write_map(tmp_path / "sky.exr", made("usd", "exclude"))
    stage = Usd.Stage.Open(str(tmp_path / "sky.usda"))
    assert not stage.GetPrimAtPath("/Sky/Sun")
    stage.GetPrimAtPath("/Sky").GetVariantSet("dome").SetVariantSelection("DomeLight_1")
    dome = UsdLux.DomeLight_1.Get(stage, "/Sky/Dome")
    assert dome.GetPoleAxisAttr().Get() == "Y"
    assert dome.GetTextureFormatAttr().Get() == "latlong"


@pytest.mark.parametrize("schema", ["DomeLight", "DomeLight_1"])
def test_a_layer_with_z_up_is_the_one_with_y_up_turned(
    made: Made, tmp_path: Path, schema: str, lacking: Callable[[str], NoReturn]
) -> None:
    # east, north and the zenith are the layer's x, y and z; both domes look up at y before they
    # are turned (UsdLux: DomeLight, and poleAxis of DomeLight_1)
    try:
        from pxr import Gf, Usd, UsdGeom, UsdLux
    except ImportError:
        lacking("no OpenUSD (pip install usd-core)")
    shown = made("usd", "light", zenith=50.0)
    write_map(tmp_path / "sky.exr", replace(shown, consumer=shown.consumer.with_up("z")))
    stage = Usd.Stage.Open(str(tmp_path / "sky.usda"))
    assert UsdGeom.GetStageUpAxis(stage) == "Z"
    stage.GetPrimAtPath("/Sky").GetVariantSet("dome").SetVariantSelection(schema)
    now = Usd.TimeCode.Default()

    def turned(path: str, vector: tuple[float, float, float]) -> np.ndarray:
        world = UsdGeom.Xformable(stage.GetPrimAtPath(path)).ComputeLocalToWorldTransform(now)
        return np.array(world.TransformDir(Gf.Vec3d(*vector)))

    for pole, enu in (((0, 1, 0), (0, 0, 1)), ((1, 0, 0), (1, 0, 0)), ((0, 0, -1), (0, 1, 0))):
        assert_allclose(turned("/Sky/Dome", pole), enu, atol=1e-9)
    if schema == "DomeLight_1":
        assert UsdLux.DomeLight_1.Get(stage, "/Sky/Dome").GetPoleAxisAttr().Get() == "Y"
    assert_allclose(turned("/Sky/Sun", (0, 0, 1)), shown.discs[0].direction, atol=1e-6)
    said = json.loads((tmp_path / "sky.json").read_text(encoding="utf-8"))
    assert said["frame"]["up"] == [0.0, 0.0, 1.0]
    assert_allclose(said["lights"][0]["direction"], shown.discs[0].direction, atol=1e-8)
    with pytest.raises(ParameterError, match="requires usd"):
        made().consumer.with_up("z")


def test_a_map_in_eight_bits_is_the_exr_s(made: Made, tmp_path: Path) -> None:
    # the same radiances by the definition of the format: within 1/256 of the largest channel
    shown = made("unity")
    written = write_map(tmp_path / "sky.hdr", shown)
    head, _, rest = (tmp_path / "sky.hdr").read_bytes().partition(b"\n\n")
    raw = np.frombuffer(rest.partition(b"\n")[2], np.uint8).reshape(*shown.rgb.shape[:2], 4)
    light = raw[..., :3] * 2.0 ** (raw[..., 3:].astype(float) - 136.0) / written.scale
    assert f"EXPOSURE={written.scale:.9g}".encode() in head
    largest = shown.rgb.max(axis=-1, keepdims=True)
    assert (np.abs(light - shown.rgb) <= largest / 256.0).all()
