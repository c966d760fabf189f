"""Files of a map: what their headers say, what halves hold, and the scenes beside them."""

from __future__ import annotations

import json
import struct
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
import OpenEXR
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.engines.environment.environment_map import EnvironmentMap
from airlight.engines.environment.files import write_map
from airlight.engines.environment.texels import texel_solid_angles
from airlight.errors import FileError, ParameterError
from airlight.image.exr import read_exr
from airlight.render.picture import read_picture_metadata

Made = Callable[..., EnvironmentMap]


def header(path: Path) -> dict[str, Any]:
    with OpenEXR.File(str(path), header_only=True) as image:
        return dict(image.header())


def test_a_float_map_is_read_back_as_it_was_made(made: Made, tmp_path: Path) -> None:
    written = write_map(tmp_path / "sky.exr", made())
    rgb, texts = read_exr(tmp_path / "sky.exr")
    assert_array_equal(rgb, made().rgb)
    assert (written.scale, texts["airlight.scale"]) == (1.0, "1")
    assert texts["airlight.bearing_of_middle"] == "90 deg"
    assert texts["airlight.axes"] == "east (1, 0, 0); north (0, 1, 0); up (0, 0, 1)"
    assert texts["airlight.sun_disc"] == "include"


@pytest.mark.parametrize("consumer", ["blender", "godot"])
def test_halves_are_finite_and_their_scale_is_undone_by_the_header(
    made: Made, tmp_path: Path, consumer: str
) -> None:
    # Godot stores halves of a float file too: the same scale
    precision = "half" if consumer == "blender" else "float"
    shown = made(consumer, width=512)
    assert shown.rgb.max() > 65504.0
    path = tmp_path / "sky.exr"
    written = write_map(path, shown, precision=precision)
    assert written.scale < 1.0
    rgb = read_exr(path)[0].astype(np.float32)
    assert np.isfinite(rgb.astype(np.float16)).all()
    unit = header(path)["whiteLuminance"] / 683.0
    assert_allclose(rgb * unit, shown.rgb, rtol=2.0**-11 if precision == "half" else 1e-6)
    solid = texel_solid_angles(shown.scene.camera)[..., None]
    # the sun survives: the sum over the map is that of the radiances
    assert_allclose((rgb * unit * solid).sum(), (shown.rgb * solid).sum(), rtol=1e-3)
    described = json.loads((tmp_path / "sky.json").read_text(encoding="utf-8"))
    assert described["scale"] == written.scale
    assert_allclose(described["white_luminance_cd_m2"], header(path)["whiteLuminance"], rtol=1e-6)


def test_a_scale_that_halves_do_not_hold_is_refused(made: Made, tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="half floats end at 65504"):
        write_map(tmp_path / "sky.exr", made(width=512), precision="half", scale=10.0)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("precision", ["float", "half"])
def test_dwa_is_small_and_keeps_sky_and_sun(made: Made, tmp_path: Path, precision: str) -> None:
    # lossy, and of halves inside whatever the channels are: without a scale the sun would be
    # infinite. Measured: the sky's light to 0.1 %, the sun's texel to 1 %
    for sun in ("include", "exclude"):
        shown = made(sun=sun, width=256)
        for name in ("zip", "dwa"):
            written = write_map(
                tmp_path / f"{name}.exr", shown, precision=precision, compression=name
            )
        rgb = read_exr(tmp_path / "dwa.exr")[0].astype(np.float64) / written.scale
        solid = texel_solid_angles(shown.scene.camera)[..., None]
        wanted = (shown.rgb * solid).sum(axis=(0, 1))
        assert_allclose((rgb * solid).sum(axis=(0, 1)), wanted, rtol=0.02)
        sizes = [(tmp_path / f"{name}.exr").stat().st_size for name in ("dwa", "zip")]
        assert sizes[0] < 0.5 * sizes[1]


def test_standard_attributes(made: Made, tmp_path: Path) -> None:
    shown = made()
    moment = datetime(2026, 6, 21, 18, 10, 30, tzinfo=UTC)
    scene = replace(shown.scene, latitude=59.33, longitude=18.07, altitude=30.0, time=moment)
    write_map(tmp_path / "a.exr", replace(shown, scene=scene, placed=True))
    write_map(tmp_path / "b.exr", shown)
    known, unknown = header(tmp_path / "a.exr"), header(tmp_path / "b.exr")
    assert known["envmap"] == OpenEXR.ENVMAP_LATLONG
    assert_allclose([known["latitude"], known["longitude"], known["altitude"]],
                    [59.33, 18.07, 30.0], rtol=1e-6)  # fmt: skip
    assert (known["capDate"], known["utcOffset"]) == ("2026:06:21 18:10:30", 0.0)
    assert "chromaticities" in known
    assert not {"latitude", "longitude", "capDate", "utcOffset"} & set(unknown)
    write_map(tmp_path / "c.exr", made("pbrt"))
    assert "envmap" not in header(tmp_path / "c.exr")


@pytest.mark.parametrize("name", ["map.exr", "map.png"])
def test_a_map_without_a_place_names_none(made: Made, tmp_path: Path, name: str) -> None:
    # nobody named a place: the scene's own stands for no place of the planet
    shown = made()
    for placed in (False, True):
        map_ = replace(shown, placed=placed)
        write_map(tmp_path / name, map_, metadata=map_.scene.metadata())
        texts = read_picture_metadata(tmp_path / name)
        assert ("airlight.latitude" in texts) is placed
        assert ("airlight.longitude" in texts) is placed
        assert "airlight.sun_zenith" in texts
        observer = json.loads((tmp_path / "map.json").read_text(encoding="utf-8"))["observer"]
        assert ("latitude_deg" in observer) is placed


def test_the_json_says_where_the_sun_stands_in_the_program_s_axes(
    made: Made, tmp_path: Path
) -> None:
    for consumer in ("blender", "mitsuba", "unity"):
        write_map(tmp_path / "sky.exr", made(consumer, "light"))
        reported = json.loads((tmp_path / "sky.json").read_text(encoding="utf-8"))
        (light,) = reported["lights"]
        frame = {name: np.array(reported["frame"][name]) for name in ("east", "north", "up")}
        turn, high = np.radians(215.0), np.radians(light["elevation_deg"])
        wanted = np.cos(high) * (np.sin(turn) * frame["east"] + np.cos(turn) * frame["north"])
        assert_allclose(light["direction"], wanted + np.sin(high) * frame["up"], atol=1e-4)
        assert_allclose(light["bearing_deg"], 215.0, atol=0.01)
        assert_allclose(light["illuminance_lx"], 683.0 * np.array(light["irradiance_W_m2"])
                        @ [0.2126729, 0.7151522, 0.072175], rtol=1e-5)  # fmt: skip
        # darkened to a mean of 1 over the disc, darker and redder at the rim
        law = np.array(light["limb_darkening"])
        assert_allclose(law @ (2.0 / (np.arange(6) + 2.0)), 1.0, rtol=1e-6)
        assert np.all(np.diff(law[:, 0]) < 0.0)
        assert reported["sun_bearing_deg"] == 215.0


def test_a_scene_for_mitsuba_has_the_map_and_the_sun(made: Made, tmp_path: Path) -> None:
    shown = made("mitsuba", "light")
    write_map(tmp_path / "sky.exr", shown, scale=0.25)
    scene = ElementTree.parse(tmp_path / "sky.xml").getroot()
    dome, sun = scene.findall("emitter")
    assert dome.find("string").attrib == {"name": "filename", "value": "sky.exr"}  # type: ignore[union-attr]
    assert float(dome.find("float").attrib["value"]) == 4.0  # type: ignore[union-attr]
    shining = [float(v) for v in sun.find("vector").attrib["value"].split(",")]  # type: ignore[union-attr]
    assert_allclose(shining, -shown.consumer.direction(shown.discs[0].direction), atol=1e-8)
    write_map(tmp_path / "sky.exr", made("mitsuba", "include"))
    assert len(ElementTree.parse(tmp_path / "sky.xml").getroot().findall("emitter")) == 1


def test_a_png_is_a_picture_to_look_at(made: Made, tmp_path: Path) -> None:
    display = {"bits": 16, "exposure": -4.0}
    written = write_map(tmp_path / "sky.png", made(), display=display)
    assert written.exposure == -4.0
    width, height, depth = struct.unpack(">IIB", (tmp_path / "sky.png").read_bytes()[16:25])
    assert (width, height, depth) == (128, 64, 16)
    assert json.loads((tmp_path / "sky.json").read_text(encoding="utf-8"))["map"] == "sky.png"


def test_files_that_cannot_be_written_are_refused(made: Made, tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"\.png, \.exr, \.hdr"):
        write_map(tmp_path / "sky.tif", made())
    (tmp_path / "sky.json").mkdir()
    with pytest.raises(FileError, match="is a folder"):
        write_map(tmp_path / "sky.exr", made())
    with pytest.raises(ParameterError, match="zip, dwa, none"):
        write_map(tmp_path / "other.exr", made(), compression="rle")


def test_files_beside_a_map_that_are_not_ours_stop_before_any_is_written(
    made: Made, tmp_path: Path
) -> None:
    # a.json and a.xml are somebody else's: neither is replaced, and no map is written
    shown = made("mitsuba", sun="light", width=32)
    for name in ("a.json", "a.xml"):
        (tmp_path / name).write_text('{"mine": 1}', encoding="utf-8")
        with pytest.raises(FileError, match=rf"{name}: is .*allow overwriting"):
            write_map(tmp_path / "a.exr", shown)
        assert [file.name for file in tmp_path.iterdir()] == [name]
        write_map(tmp_path / "a.exr", shown, overwrite=True)
        for file in tmp_path.iterdir():
            file.unlink()


def test_files_beside_a_map_are_replaced_until_somebody_edits_them(
    made: Made, tmp_path: Path
) -> None:
    path = tmp_path / "a[ 1 ].exr"
    for _ in range(2):
        write_map(path, made("mitsuba", sun="light", width=32))
    write_map(path, made(width=32))  # of another program: its scene goes with its JSON
    assert sorted(file.name for file in tmp_path.iterdir()) == ["a[ 1 ].exr", "a[ 1 ].json"]
    sidecar = tmp_path / "a[ 1 ].json"
    text = sidecar.read_text(encoding="utf-8")
    sidecar.write_text(text.replace('"sun":', '"note": "mine", "sun":'), encoding="utf-8")
    with pytest.raises(FileError, match="modified since airlight wrote it"):
        write_map(path, made(width=32))
    assert "mine" in sidecar.read_text(encoding="utf-8")


def test_a_name_is_no_pattern(made: Made, tmp_path: Path) -> None:
    (tmp_path / "ab.json").write_text("mine", encoding="utf-8")
    for name in ("a*.exr", "a[b].exr", "a?.exr"):
        write_map(tmp_path / name, made(width=32))
        assert (tmp_path / name).with_suffix(".json").is_file()
    assert (tmp_path / "ab.json").read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize("ended", [1, 2])
def test_a_run_that_was_killed_is_repeated_without_being_asked(
    made: Made, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ended: int
) -> None:
    # killed before the first or the second file beside the map: what is left is airlight's own
    from airlight.engines.environment import files

    class Killed(BaseException):
        pass

    shown, path, write, calls = made("mitsuba", "light", width=32), tmp_path / "a.exr", [], []
    write_map(path, shown)
    write.append(files._write)

    def counted(file: Path, content: bytes) -> None:
        calls.append(file)
        if len(calls) == ended:
            raise Killed
        write[0](file, content)

    monkeypatch.setattr(files, "_write", counted)
    with pytest.raises(Killed):
        write_map(path, replace(shown, planet="Another"))
    monkeypatch.undo()
    write_map(path, shown)
    assert sorted(file.name for file in tmp_path.iterdir()) == ["a.exr", "a.json", "a.xml"]
