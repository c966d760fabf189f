"""The USD layer, read by OpenUSD itself."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NoReturn

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.environment.environment_map import EnvironmentMap
from airlight.environment.files import write_map

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
