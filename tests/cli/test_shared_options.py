"""Options that several commands share: one name, one default, one help; and each has its effect."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import typer.main
from numpy.testing import assert_allclose
from PIL import Image

from airlight.cli import main
from airlight.cli.app import app, word_of
from airlight.cli.option_groups import expand_groups, given_options
from airlight.cli.place_options import PlaceOptions
from airlight.errors import ParameterError
from airlight.image.camera_exposure import camera_exposure

SNAP = ["--iso=100", "--aperture=f/8", "--shutter=1/250s"]
EXPOSURE = camera_exposure(iso=100.0, aperture=8.0, shutter=1.0 / 250.0)
PLANET = "earth-atmosphere-plus"
QUICK = ["--quality=preview", "--wavelengths=rgb"]
#: Options of one command that mean something else there, or of a default of its own.
OWN = {
    "fit": {"sun_zenith", "altitude", "projection", "fov", "look", "roll", "encoding", "tone_map"},
    "plot": {"sun_zenith", "altitude", "quality", "wavelengths"},
    "radiance": {"sun_zenith", "sun_azimuth", "altitude", "wavelengths"},
    "irradiance": {"wavelengths", "quality"},
    "spectrum": {"sun_zenith", "wavelengths"},
    "sweep": {"sun_zenith", "altitude", "wavelengths"},
    "bake": {"size", "wavelengths"},
    "sky": {"size"},
    "compose": {"altitude", "planet"},
    "animate": {"exposure", "set_"},
    "view": {"look_at", "device"},
    "export-page": {"wavelengths"},
}
SHARED = {
    *("at", "time_", "zone", "season", "sun_distance", "altitude", "sun_zenith", "sun_azimuth"),
    *("latitude", "longitude", "moon", "second_star", "stars", "look", "look_at", "roll", "fov"),
    *("projection", "size", "exposure", "iso", "aperture", "shutter", "tone_map", "glare"),
    *("white_balance", "style"),
    *("encoding", "primaries", "bits", "wavelengths", "quality", "no_polarisation", "no_cache"),
    *("device", "exact", "samples", "set_", "ground_albedo", "planet", "scheduler", "workers"),
    *("overwrite", "star_temperature"),
}


def test_an_option_of_a_name_is_the_same_in_every_command() -> None:
    root: Any = typer.main.get_command(app)
    known: dict[str, tuple[str, Any]] = {}
    for name in root.list_commands(None):
        for one in root.get_command(None, name).params:
            if one.name not in SHARED - OWN.get(name, set()):
                continue
            declared = (one.opts, one.default, one.help, one.metavar)
            first, expected = known.setdefault(one.name, (name, declared))
            assert declared == expected, f"{one.name} of {first} and {name}"
    assert set(known) == SHARED


def test_no_command_has_many_parameters() -> None:
    from importlib import import_module

    for name in typer.main.get_command(app).list_commands(None):  # type: ignore[attr-defined]
        word = word_of(name)
        command = getattr(import_module(f"airlight.cli.{word}"), word)
        assert command.__code__.co_argcount + command.__code__.co_kwonlyargcount < 10
        assert len(expand_groups(command).__annotations__) >= command.__code__.co_argcount


def test_given_options_are_those_that_differ_from_their_defaults() -> None:
    place = PlaceOptions(at="1N,2E", season="90", sun_distance="true")
    assert given_options(place) == {"--at": "1N,2E", "--ls": 90.0}


def test_a_text_is_read_by_the_word_for_it_under_the_name_of_its_option() -> None:
    place = PlaceOptions(altitude="35km", sun_zenith="0.5 turn", sun_azimuth="SE")
    assert place.numbers() == {"altitude": 35e3, "sun_zenith": 180.0, "sun_azimuth": 135.0}
    assert PlaceOptions(altitude=35e3) == PlaceOptions(altitude="35 km")
    for field, option in (("sun_zenith", "--sun-zenith"), ("season", "--ls")):
        with pytest.raises(ParameterError, match=f"^{option} is 'low'"):
            PlaceOptions(**{field: "low"})


def test_a_sky_is_exposed_by_a_camera(tmp_path: Path) -> None:
    words = ["sky", PLANET, "--for=dome", "--size=32", "--glare=0", *QUICK]
    assert main([*words, *SNAP, "-o", str(tmp_path / "a.png")]) == 0
    assert main([*words, f"--exposure={EXPOSURE!r}", "-o", str(tmp_path / "b.png")]) == 0
    a, b = (np.asarray(Image.open(tmp_path / f"{one}.png")) for one in "ab")
    assert (a == b).all()


def test_aerial_perspective_is_lit_at_a_distance_and_from_a_bearing(tmp_path: Path) -> None:
    words = ["aerial", PLANET, "--farthest=1km", *QUICK]
    when = ["--at=10S,0E", "--time=2026-01-03T12:00Z"]
    for distance in ("true", "file"):
        given = [f"--sun-distance={distance}", "-o", str(tmp_path / distance)]
        assert main([*words, *when, *given]) == 0
    manifests = {
        one: json.loads((tmp_path / one / "manifest.json").read_text("utf-8"))
        for one in ("true", "file")
    }
    true, file = (np.array(m["radiance_of_1_W_m-2_sr-1"]) for m in manifests.values())
    # perihelion: the star is at 0.9833 au (almanacs), and light follows 1/d²
    assert_allclose(true / file, 0.98329**-2, rtol=2e-3)
    assert main([*words, "--sun-azimuth=ESE", "-o", str(tmp_path / "east")]) == 0
    assert json.loads((tmp_path / "east" / "manifest.json").read_text("utf-8"))["altitude_m"] == 2.0


def test_a_film_is_exposed_by_a_camera(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["animate", PLANET, "--frames=1", "--size=16x9", "--workers=1", *QUICK, *SNAP]
    assert main([*words, "-o", str(tmp_path / "frames")]) == 0
    assert f"exposure {EXPOSURE:+.2f} to {EXPOSURE:+.2f} EV" in capsys.readouterr().out
    assert main([*words, "--format=exr", "-o", str(tmp_path / "linear")]) == 2
    assert "--iso does not apply to .exr files" in capsys.readouterr().err


def test_a_view_is_exposed_by_a_camera(monkeypatch: pytest.MonkeyPatch) -> None:
    starts: list[Any] = []
    monkeypatch.setattr("airlight.viewer.window.start.show", starts.append)
    assert main(["view", "earth", *SNAP]) == 0
    assert starts[0].view["display.exposure"] == pytest.approx(EXPOSURE)
    assert starts[0].view["display.automatic"] is False
