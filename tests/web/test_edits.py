"""Edits of a planet in its page: solved in the browser, compared with native solutions."""

from __future__ import annotations

import base64
import dataclasses
import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PIL import Image
from test_pictures import FIXED, HEIGHT, SKY, WAVELENGTHS, WIDTH, drawn
from waiting import until

from airlight.planets import load_planet
from airlight.planets.medium import Medium
from airlight.planets.surface import PLAIN
from airlight.render.gpu.picture.gpu_renderer import GpuRenderer
from airlight.solver.moments.settings import QUALITIES
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.moments.solve import solve
from airlight.viewer.browser.page import page_text
from airlight.viewer.browser.page_data import page_data
from airlight.viewer.browser.page_solver import page_settings
from airlight.viewer.parameters.amounts import amounts_of
from airlight.viewer.parameters.view_parameters import DEFAULTS

GROUND = {"view.altitude": 2.0, "view.look_zenith": 80.0, "display.exposure": -3.0}
SPACE = {"view.altitude": 2e6, "view.look_zenith": 150.0, "view.sun_zenith": 80.0,
         "display.exposure": -2.5}  # fmt: skip
ORBIT = {"view.altitude": 2e6, "view.look_zenith": 150.0, "view.sun_zenith": 60.0,
         "display.exposure": -2.5}  # fmt: skip
SUNSET = {"view.altitude": 2.0, "view.look_zenith": 84.0, "view.sun_zenith": 87.0,
          "display.exposure": 1.0}  # fmt: skip
#: Planet, factors of its constituents and of its ground, view.
EDITS = {
    "three times the aerosol": ("earth", {1: 3.0}, 1.0, GROUND),
    "half the air and a brighter ground": ("earth", {0: 0.5}, 2.5, SPACE),
    "half the dust": ("mars", {1: 0.5}, 0.5, GROUND),
    "twice the dust": ("mars", {1: 2.0}, 1.0, GROUND),
    "twice the dust at sunset": ("mars", {1: 2.0}, 1.0, SUNSET),
    "twice the haze of Titan": ("titan", {1: 2.0, 2: 2.0, 3: 2.0}, 1.0, GROUND),
    "half the clouds of Venus": ("venus", {1: 0.5, 2: 0.5, 3: 0.5, 4: 0.5}, 1.0, ORBIT),
    "twice the clouds of Venus": ("venus", {1: 2.0, 2: 2.0, 3: 2.0, 4: 2.0}, 1.0, GROUND),
}

#: Edits whose reference takes a minute.
CLOUDY = ("half the clouds of Venus", "twice the clouds of Venus")
#: Edits that the check leaves out: it has less of some air on another ground, and more of it below.
LATER = ("twice the dust", "three times the aerosol", "half the air and a brighter ground",
         "twice the haze of Titan", *CLOUDY)  # fmt: skip


def solution_of(name: str, amounts: dict[int, float], ground: float, settings: Any) -> Any:
    """Solution of a planet without a ground map, with edited amounts."""
    planet = load_planet(name)
    medium = Medium.from_planet(planet, WAVELENGTHS)
    factors = np.array([amounts.get(c, 1.0) for c in range(len(medium.names))])[:, None]
    edited = dataclasses.replace(
        medium,
        scattering=factors * medium.scattering,
        absorption=factors * medium.absorption,
        ground_albedo=ground * medium.ground_albedo,
        surface=PLAIN,
    )
    solution = solve(edited, settings, cache=False)
    solution.planet = planet
    return solution


@pytest.fixture(scope="module")
def native(gpu: Any) -> GpuRenderer:
    """Renderer of pictures without a browser; like a page it fills the sky-view LUT itself.

    By the CPU, with fewer points, the horizon under three times the aerosol is 2.5/255 off.
    """
    return GpuRenderer(gpu, SKY, sky_view_on_cpu=False)


@pytest.fixture(scope="module")
def plain() -> Callable[[str], MomentsSolution]:
    """Solutions of unedited planets."""
    kept: dict[str, MomentsSolution] = {}

    def of(name: str) -> MomentsSolution:
        if name not in kept:
            kept[name] = solution_of(name, {}, 1.0, QUALITIES["default"])  # that of a page
        return kept[name]

    return of


@pytest.fixture(scope="module")
def page_by(
    plain: Callable[[str], MomentsSolution], kept_open: Callable[..., Any],
    tmp_path_factory: pytest.TempPathFactory,
) -> Callable[[str, str], Any]:  # fmt: skip
    """Page of an unedited planet on a device, which compiles its shaders once for all edits."""
    folder = tmp_path_factory.mktemp("pages")
    pages: dict[tuple[str, str], Any] = {}

    def page(name: str, device: str) -> Any:
        if (name, device) not in pages:
            data = page_data(plain(name), name, name, {**DEFAULTS, **FIXED}, "three")
            data["picture"]["sky"]["full"] = list(SKY)
            file = folder / f"{name}.html"
            file.write_text(page_text(name, json.loads(json.dumps(data))), encoding="utf-8")
            pages[name, device] = kept_open(file, f"?device={device}")
        return pages[name, device]

    return page


@pytest.mark.slow
@pytest.mark.parametrize(
    ("edit", "device"),
    [
        *((edit, "webgl2") for edit in EDITS if edit not in LATER),
        *(pytest.param(edit, "webgl2", marks=pytest.mark.validation) for edit in LATER),
        *(
            pytest.param(edit, "webgpu", marks=pytest.mark.validation)  # 40 to 60 s in software
            for edit in EDITS
        ),
    ],
)
def test_an_edit_in_the_page_shows_what_is_solved_without_a_browser(
    edit: str,
    device: str,
    plain: Callable[[str], MomentsSolution],
    native: GpuRenderer,
    page_by: Callable[[str, str], Any],
    tell: Callable[[str], None],
) -> None:
    # the same passes as the CPU's sweeps, to the same tolerance; the rays' points, which depend on
    # the extinction, are those of the unedited planet. Under twice the clouds of Venus the nodes
    # of the reference, which are fewer, leave 3 to 9 % too much light.
    name, amounts, ground, view = EDITS[edit]
    values = {**DEFAULTS, **FIXED, **view}
    native.set_solution(solution_of(name, amounts, ground, page_settings()))
    wanted = drawn(native, values)
    native.set_solution(plain(name))
    assert np.abs(drawn(native, values) - wanted).max() > 10.0  # the edit is visible
    page = page_by(name, device)
    present = {one.path: one.present for one in amounts_of(load_planet(name))}
    changes = {f"air.amounts[{c}]": factor for c, factor in amounts.items()}
    if ground != 1.0:
        changes["air.ground"] = ground
    changes = {path: factor * present[path] for path, factor in changes.items()}
    url, took, words = page.evaluate(
        """async ([view, changes, width, height]) => {
          await airlight.ready;
          airlight.state.reset();
          await airlight.edits.settled();
          airlight.state.set(view);
          const began = performance.now();
          airlight.state.set(changes);
          await airlight.edits.settled();
          const took = performance.now() - began;
          const blob = await airlight.png(width, height);
          const reader = new FileReader();
          await new Promise((resolve) => { reader.onload = resolve; reader.readAsDataURL(blob); });
          const words = [airlight.edits.status(), airlight.parts.message.textContent];
          return [reader.result, took, words.filter(Boolean).join(", ")];
        }""",
        [{**FIXED, **view}, changes, WIDTH, HEIGHT],
    )
    assert page.evaluate("airlight.device.kind") == device
    image = Image.open(io.BytesIO(base64.b64decode(url.partition(",")[2])))
    got = np.asarray(image.convert("RGB"), np.float64)
    off = np.abs(got - wanted)
    tell(
        f"{edit}, {device}: {took / 1e3:.1f} s ({words}), at most {off.max():.1f}/255, "
        f"in the mean {off.mean():.3f}/255"
    )
    assert_allclose(off, 0.0, atol=5.0 if edit == CLOUDY[1] else 2.0)


def test_an_edit_that_is_refused_says_so_and_leaves_the_picture(
    plain: Callable[[str], MomentsSolution], kept_open: Callable[..., Any], tmp_path: Path
) -> None:
    # the optical depth exceeds the passes' limit; the URL carries the edit nevertheless
    data = page_data(plain("earth"), "earth", "earth", {**DEFAULTS, **FIXED}, "three")
    data["picture"]["sky"]["full"] = list(SKY)
    file = tmp_path / "page.html"
    file.write_text(page_text("earth", json.loads(json.dumps(data))), encoding="utf-8")
    edit = {"air.amounts[0]": 10.0, "air.amounts[1]": 10.0}
    fragment = "#" + json.dumps({"planet": "earth", "air": edit}, separators=(",", ":"))
    page = kept_open(file, f"?device=webgl2{fragment}")
    page.evaluate("airlight.settled()")
    said = page.evaluate("airlight.parts.message.textContent")
    assert said == "so much air is too thick to be solved here; the desktop viewer solves it"
    aerosol = amounts_of(load_planet("earth"))[1]
    got = page.evaluate("airlight.state.get('air.amounts[1]')")
    assert_allclose(got, 10.0 * aerosol.present, rtol=1e-12)
    link = json.loads(page.evaluate("decodeURI(airlight.state.asFragment())"))
    assert link["air"] == edit
    assert page.evaluate("airlight.picture.solutions") == 1


def test_the_newest_edit_wins_and_none_is_the_planet_as_it_was(
    page_by: Callable[[str, str], Any],
) -> None:
    # the first edit is stale before its first order: the picture shows only the second
    page = page_by("mars", "webgl2")
    before = page.evaluate(
        """async () => {
          await airlight.ready;
          airlight.state.reset();
          await airlight.edits.settled();
          return airlight.picture.solutions;
        }"""
    )
    text = "airlight.parts.probe.textContent"
    page.evaluate("airlight.probe.pin(300, 50)")
    unedited = until(page, text)
    took = page.evaluate(
        """async () => {
          for (const depth of [1, 0.15]) airlight.state.set({ "air.amounts[1]": depth });
          await airlight.edits.settled();
          return [airlight.picture.solutions, airlight.edits.shown.amounts];
        }"""
    )
    assert took == [before + 1, [1, 0.3]]
    assert "solved in" in page.evaluate("airlight.edits.status()")
    until(page, f"{text} !== {json.dumps(unedited)}")  # a point that is kept follows
    page.evaluate("airlight.probe.release()")
    undone = page.evaluate(
        """async () => {
          airlight.state.reset();
          await airlight.edits.settled();
          return [airlight.picture.solutions, airlight.edits.status()];
        }"""
    )
    assert undone == [before + 2, ""]
