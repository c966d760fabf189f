"""``airlight compose`` on files as Blender writes them, in one part and in several."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import OpenEXR
import pytest
import xarray
from numpy.testing import assert_allclose

from airlight.cli.app import main
from airlight.image.exr import read_exr
from airlight.image.png import read_png_header

SIZE = (16, 24)
MATRIX = [[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 30], [0, 0, 0, 1]]
QUICK = ["--wavelengths=rgb", "--quality=preview"]


def passes() -> dict[str, np.ndarray]:
    """A grey ball 100 m ahead of a camera that looks north, and its passes."""
    rows, columns = SIZE
    x, y = np.meshgrid((np.arange(columns) - 11.5) / 24.0, (7.5 - np.arange(rows)) / 24.0)
    ball = x**2 + y**2 < 0.05
    depth = np.where(ball, 100.0, 1e10).astype(np.float32)
    position = np.stack([x * depth, depth, 30.0 + y * depth], axis=-1)
    position[~ball] = 0.0
    named = {"Combined.A": ball, "Depth.Z": depth}
    named |= {f"Combined.{c}": 0.2 * ball for c in "RGB"}
    named |= {f"Position.{c}": position[..., i] for i, c in enumerate("XYZ")}
    return {f"ViewLayer.{k}": np.ascontiguousarray(v, np.float32) for k, v in named.items()}


def one_part(path: Path, channels: dict[str, np.ndarray], **header: object) -> Path:
    attributes = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage, **header}
    OpenEXR.File(attributes, dict(channels)).write(str(path))
    return path


def many_parts(path: Path, channels: dict[str, np.ndarray]) -> Path:
    """Blender 5: a part for each pass, named as its channels without their last letter."""
    groups: dict[str, dict[str, np.ndarray]] = {}
    for name, values in channels.items():
        groups.setdefault(name.rpartition(".")[0], {})[name] = values
    parts = [
        OpenEXR.Part({"name": name, "type": OpenEXR.scanlineimage}, dict(one))
        for name, one in groups.items()
    ]
    OpenEXR.File(parts).write(str(path))
    return path


def camera(folder: Path, **block: object) -> Path:
    place = {"planet": "earth-atmosphere-plus", "sun_zenith": 50.0, **block}
    data = {"w": 24, "h": 16, "fl_x": 24.0, "transform_matrix": MATRIX, "airlight": place}
    path = folder / "camera.json"
    path.write_text(json.dumps(data), encoding="utf-8")
    return path


def test_one_part_and_many_give_the_same_picture(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # the same passes in the layouts before and since Blender 5, and its positions in a second file
    found = passes()
    position = {k: v for k, v in found.items() if "Position" in k}
    depth = one_part(tmp_path / "position.exr", position)
    cases = {
        "old": (one_part(tmp_path / "old.exr", found), []),
        "new": (many_parts(tmp_path / "new.exr", found), []),
        "apart": (tmp_path / "new.exr", ["--depth", str(depth)]),
    }
    pictures, notes = {}, {}
    for name, (color, more) in cases.items():
        out = tmp_path / f"{name}-out.exr"
        words = ["compose", str(color), "--camera", str(camera(tmp_path)), "-o", str(out)]
        assert main([*words, *more, *QUICK]) == 0
        pictures[name], notes[name] = read_exr(out)
    printed = capsys.readouterr().out
    assert printed.count("depth planar") == 2
    assert printed.count("depth position") == 1
    assert_allclose(pictures["new"], pictures["old"], rtol=0)
    assert_allclose(pictures["apart"], pictures["old"], rtol=1e-5)
    assert notes["apart"]["airlight.depth_kind"] == "position"
    # 100 m of clear air change a grey of 0.2 by a per cent or two; behind is a blue sky
    middle, corner = pictures["old"][8, 12], pictures["old"][0, 0]
    assert_allclose(middle, 0.2, rtol=0.05)
    assert corner[2] > corner[1] > corner[0] > 0.0


@pytest.mark.parametrize("white", ["1", "2", "radiance"])
def test_the_luminance_of_white_is_that_of_the_radiance_of_1(tmp_path: Path, white: str) -> None:
    # OpenEXR, "Standard Attributes": cd m⁻² of RGB (1, 1, 1). Y of sRGB (IEC 61966-2-1), 683 lm/W
    color, out = one_part(tmp_path / "render.exr", passes()), tmp_path / "out.exr"
    words = ["compose", str(color), "--camera", str(camera(tmp_path)), "-o", str(out)]
    assert main([*words, f"--white={white}", *QUICK]) == 0
    header = read_exr(out)[1]
    radiance = [float(one) for one in header["airlight.radiance_of_1"].split(" W")[0].split(",")]
    expected = 683.0 * np.dot([0.2126, 0.7152, 0.0722], radiance)
    assert_allclose(OpenEXR.File(str(out)).header()["whiteLuminance"], expected, rtol=1e-4)


def test_matrices_in_the_header_stand_for_a_camera(tmp_path: Path) -> None:
    # OpenEXR's standard attributes, which multiply rows and look along +Z
    to_camera = np.diag([1.0, 1.0, -1.0, 1.0]) @ np.linalg.inv(np.array(MATRIX, float))
    project = np.array([[1.0, 0, 0.5, 0], [0, -1.5, 0.5, 0], [0, 0, 1, -0.1], [0, 0, 1, 0]])
    attributes = {
        "worldToCamera": np.ascontiguousarray(to_camera.T, np.float32),
        "worldToNDC": np.ascontiguousarray((project @ to_camera).T, np.float32),
    }
    named = one_part(tmp_path / "named.exr", passes(), **attributes)
    plain = one_part(tmp_path / "plain.exr", passes())
    planet = ["--planet=earth-atmosphere-plus", "--sun-zenith=50", *QUICK]
    outs = [tmp_path / "a.exr", tmp_path / "b.exr"]
    assert main(["compose", str(named), "-o", str(outs[0]), *planet]) == 0
    file = str(camera(tmp_path))
    assert main(["compose", str(plain), "--camera", file, "-o", str(outs[1]), *QUICK]) == 0
    assert_allclose(read_exr(outs[0])[0], read_exr(outs[1])[0], rtol=1e-4)


def test_surfaces_are_lit_by_their_passes(tmp_path: Path) -> None:
    # a ball that faces up is brighter than one that faces down; its own colours are not used
    found = passes()
    ball = found["ViewLayer.Combined.A"]
    found |= {f"ViewLayer.Diffuse Color.{c}": 0.5 * ball for c in "RGB"}
    found |= {f"ViewLayer.Normal.{c}": 0.0 * ball for c in "XY"}
    pictures = []
    for up in (1.0, -1.0):
        color = many_parts(tmp_path / "lit.exr", found | {"ViewLayer.Normal.Z": up * ball})
        words = ["compose", str(color), "--albedo", str(color), "--normals", str(color)]
        place = ["--camera", str(camera(tmp_path)), "-o", str(tmp_path / "out.exr"), *QUICK]
        assert main([*words, *place]) == 0
        pictures.append(read_exr(tmp_path / "out.exr")[0])
    above, below = (one[8, 12] for one in pictures)
    # cos 50° of the star, and a sky; from below the ground, which reflects a tenth
    assert 0.25 < above[1] < 0.45
    assert 0.01 < below[1] < 0.12


def test_the_sun_of_a_place_and_time_is_that_of_its_angles(tmp_path: Path) -> None:
    # by the ephemeris: the sun is 0.4° north of the zenith of 23°N at noon of the solstice
    color, file = one_part(tmp_path / "render.exr", passes()), str(camera(tmp_path))
    when = ["--at=23N,0E", "--time=2026-06-21T12:00Z", "--planet=earth-atmosphere-plus"]
    first = tmp_path / "a.exr"
    assert main(["compose", str(color), "--camera", file, "-o", str(first), *when, *QUICK]) == 0
    notes = read_exr(first)[1]
    assert float(notes["airlight.sun_zenith"].split()[0]) == pytest.approx(0.66, abs=0.1)
    assert notes["airlight.altitude"] == "30 m"


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (["missing.exr", "-o", "out.exr"], "missing.exr: cannot be read: No such file"),
        (["render.exr", "-o", "out.jpg"], "ends in .png, .exr, .hdr"),
        (["render.exr", "-o", "out.exr"], "--camera is required: render.exr lacks worldToCamera"),
        (["camera.json", "-o", "out.exr"], "camera.json: cannot be read as OpenEXR"),
        (["render.exr", "--camera", "camera.json", "-o", "out.exr", "--depth-channel=Q"],
         "--depth-channel is 'in channels ViewLayer.Combined.A"),
        (["render.exr", "--camera", "camera.json", "-o", "out.exr", "--white=-1"],
         "--white is '-1'; allowed: a number above 0, or radiance"),
        (["render.exr", "--camera", "camera.json", "-o", "out.exr", "--sun-zenith=190"],
         "--sun-zenith is 190.0; allowed: 0 to 180 deg"),
        (["render.exr", "--camera", "camera.json", "-o", "out.exr", "--layer=Fog"],
         "colour is 'in channels"),
        (["render.exr", "--camera", "camera.json", "-o", "out.exr", "--planet=vulcan"], "vulcan"),
        (["render.exr", "--camera", "camera.json", "-o", "out.exr", "--normals=render.exr"],
         "--normals requires --albedo"),
        (["render.exr", "--camera", "camera.json", "-o", "out.exr", "--altitude=-100m",
          "--planet=earth-atmosphere-plus", *QUICK], "camera's altitude is '-70 m'"),
    ],
)  # fmt: skip
def test_bad_input_gets_one_clear_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str],
    words: list[str], line: str,
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    one_part(tmp_path / "render.exr", passes())
    camera(tmp_path)
    assert main(["compose", *words]) == 2
    error = capsys.readouterr().err.strip().splitlines()[-1]
    assert line in error
    assert not (tmp_path / "out.exr").exists()


def test_a_composition_has_the_display_and_the_sun_of_a_picture(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    color, file = one_part(tmp_path / "render.exr", passes()), str(camera(tmp_path))
    words = ["compose", str(color), "--camera", file, *QUICK]
    shown = [
        *words,
        "--exposure=-9",
        "--bits=16",
        "--primaries=display-p3",
        "--encoding=gamma",
        "--glare=2",
    ]
    assert main([*shown, "-o", str(tmp_path / "a.png")]) == 0
    texts = read_png_header(tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes()[24] == 16  # bit depth of the IHDR
    assert float(texts["airlight.exposure"].split()[0]) == -9.0
    capsys.readouterr()
    assert main([*words, "--glare=2", "-o", str(tmp_path / "a.exr")]) == 2
    assert "--glare does not apply to .exr files" in capsys.readouterr().err
    # perihelion: the star is at 0.9833 au (almanacs), and linear light follows 1/d²
    when = ["--at=10S,0E", "--time=2026-01-03T12:00Z", "--white=radiance"]
    light = []
    for distance in ("true", "file"):
        out = tmp_path / f"{distance}.exr"
        assert main([*words, *when, f"--sun-distance={distance}", "-o", str(out)]) == 0
        light.append(read_exr(out)[0][2, 2])
    assert_allclose(light[0] / light[1], 0.98329**-2, rtol=2e-3)


@pytest.mark.slow
def test_clouds_are_behind_a_near_surface_and_change_the_sky(tmp_path: Path) -> None:
    """A wide even layer 1 km above a ball 100 m away; the light of the ball is the picture's."""
    axes = {"x": np.arange(4) * 1e3, "y": np.arange(4) * 1e3, "z": 1050.0 + 100.0 * np.arange(4)}
    layer = (("x", "y", "z"), np.full((4, 4, 4), 0.01), {"units": "m-1"})
    xarray.Dataset(
        {"extinction": layer}, {name: ((name,), at, {"units": "m"}) for name, at in axes.items()}
    ).to_netcdf(tmp_path / "layer.nc", engine="scipy")
    picture, place = one_part(tmp_path / "in.exr", passes()), camera(tmp_path)
    found = []
    for clouds in (str(tmp_path / "layer.nc"), "none"):
        words = ["compose", str(picture), "--camera", str(place), "--clouds", clouds, *QUICK]
        words += ["--set", "clouds.beyond=periodic"] if clouds != "none" else []
        assert main([*words, "-o", str(tmp_path / "out.exr")]) == 0
        found.append(read_exr(tmp_path / "out.exr")[0])
    ball = passes()["ViewLayer.Combined.A"] > 0.0
    assert_allclose(found[0][ball], found[1][ball], rtol=0.02)
    assert (found[0][:4].mean() / found[1][:4].mean()) > 1.3
