"""Rings of planet files: values, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import observe, solve
from airlight.errors import AirlightWarning, ParameterError
from airlight.planets import load_planet, replace
from airlight.planets.rings import Ring
from airlight.solver.tables.ring_shadow import ring_tables

PLANET = load_planet("earth-atmosphere-plus")
FILE = """
name = "Ringed"
[shell]
bottom_radius = "6000 km"
top_radius = "6100 km"
[star]
temperature = "5800 K"
radius = "7e5 km"
distance = "1 au"
[[constituents]]
name = "air"
scattering = "1e-5 /m"
profile = { kind = "exponential", scale_height = "8 km" }
phase_function = { kind = "rayleigh" }
[ground]
albedo = 0.1
[[rings]]
inner_radius = "7000 km"
outer_radius = "9000 km"
optical_depth = 0.5
"""


def ring(**values):
    return Ring(**({"inner_radius": 7e6, "outer_radius": 9e6, "optical_depth": 0.5} | values))


@pytest.mark.parametrize(
    ("values", "field"),
    [
        ({"outer_radius": 6.5e6}, "outer_radius"),
        ({"optical_depth": -0.1}, "optical_depth"),
        ({"single_scattering_albedo": 1.2}, "single_scattering_albedo"),
        ({"dust": 1.5}, "dust"),
        ({"optical_depth": None}, "optical_depth"),
        ({"optical_depth": None, "radii": (7e6, 8e6)}, "optical_depths"),
        ({"profile": "saturn"}, "profile"),
        ({"optical_depth": None, "profile": "none"}, "profile"),
        ({"radii": (7e6, 8e6), "optical_depths": (1.0, 2.0)}, "optical_depth"),
        ({"optical_depth": None, "radii": (8e6, 7e6), "optical_depths": (1.0, 2.0)}, "radii"),
        ({"optical_depth": None, "radii": (6e6, 8e6), "optical_depths": (1.0, 2.0)}, "radii"),
    ],
)
def test_impossible_rings_are_refused_in_one_line(values, field):
    with pytest.raises(ParameterError, match=rf"^{field}") as refused:
        ring(**values)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    "rings",
    [
        (ring(inner_radius=PLANET.top_radius - 1e3),),
        (ring(), ring(inner_radius=8e6, outer_radius=1e7)),
        (ring(),) * 17,
    ],
)
def test_rings_in_the_air_or_in_each_other_are_refused(rings):
    with pytest.raises(ParameterError, match="rings"):
        replace(PLANET, rings=rings)


def test_keys_of_a_file_are_read_and_unknown_ones_refused(tmp_path):
    file = tmp_path / "ringed.toml"
    file.write_text(FILE)
    assert load_planet(file).rings == (ring(),)
    assert load_planet(file, {"rings[0].optical_depth": "2"}).rings[0].optical_depth == 2.0
    file.write_text(FILE + "opacity_of_ring = 1\n")
    with pytest.raises(ParameterError, match="opacity_of_ring"):
        load_planet(file)


def test_profile_is_linear_between_its_radii_and_zero_beyond_the_edges():
    one = ring(optical_depth=None, radii=(7.5e6, 8.5e6), optical_depths=(1.0, 3.0))
    assert_allclose(one.depths([6.9e6, 7.1e6, 8e6, 8.9e6, 9.1e6]), [0.0, 1.0, 2.0, 3.0, 0.0])


def test_tables_keep_the_depth_of_rings_narrower_than_a_row():
    # the integral of optical depth over radius, by the trapezoidal rule: a law of the averaging,
    # to a sixteenth of a row at either edge
    rings = (ring(), ring(inner_radius=30e6, outer_radius=30.002e6, optical_depth=2.0))
    tables = ring_tables(rings, np.array([550.0]))
    radii = tables.ring_inner + np.arange(len(tables.ring_layers)) / tables.ring_rows
    total = np.trapezoid(tables.ring_layers[:, 0], radii)
    step = 1.0 / tables.ring_rows
    assert_allclose(total, 0.5 * 2e6 + 2.0 * 2e3, atol=step / 8.0 * 2.5)


def test_preset_has_the_published_rings():
    # edges of PDS, in the preset's header
    saturn = load_planet("saturn")
    assert [one.name for one in saturn.rings] == ["C", "B", "Cassini division", "A", "F"]
    assert saturn.rings[1].outer_radius == 117570e3
    assert float(saturn.rings[3].depths([133500e3])[0]) == 0.0  # gap of Encke


def test_numbers_without_the_rings_say_so():
    # pictures have the rings: without a line two answers would contradict each other
    ringed = replace(PLANET, rings=(ring(),))
    solution = solve(ringed, [550.0], "preview")
    asked = {"altitude": 0.0, "sun_zenith": 60.0}
    for what, ask in (
        ("radiance", lambda: solution.radiance(**asked, view_zenith=30.0)),
        ("irradiance", lambda: solution.irradiance(**asked)),
        ("geometric-albedo", lambda: observe(solution, "geometric-albedo")),
    ):
        with pytest.warns(AirlightWarning, match=rf"^{what} without rings"):
            ask()
    solve(PLANET, [550.0], "preview").radiance(**asked, view_zenith=30.0)  # warns of nothing


def test_profile_of_saturn_has_the_published_edges_and_ranges():
    # edges: PDS, as in the preset's header, within a row of 20 km; those of ring B are 140 km apart
    # in longitude. Ranges of optical depth: PDS's; A and B have less in this direction (wakes).
    saturn = {one.name: one for one in load_planet("saturn").rings}
    radii = np.arange(74.5e6, 136.8e6, 5e3)
    depth = sum(saturn[name].depths(radii) for name in ("C", "B", "Cassini division", "A"))

    def crossing(low, high, level):
        part = (radii > low) & (radii < high)
        (change,) = np.flatnonzero(np.diff(depth[part] > level))
        return radii[part][change]

    assert_allclose(crossing(133.35e6, 133.5e6, 0.25), 133.423e6, atol=2e4)  # gap of Encke
    assert_allclose(crossing(133.65e6, 133.8e6, 0.25), 133.745e6, atol=2e4)
    assert_allclose(crossing(136.7e6, 136.8e6, 0.25), 136.77e6, atol=2e4)  # ring A
    assert_allclose(crossing(117.42e6, 117.6e6, 0.25), 117.57e6, atol=1e5)  # ring B
    ranges = (
        (74.6e6, 91.9e6, 0.05, 0.35),
        (104e6, 110e6, 2.0, 5.0),
        (117.9e6, 122e6, 0.05, 0.15),
        (122.1e6, 133.4e6, 0.4, 1.0),
    )
    for low, high, least, most in ranges:
        part = (radii > low) & (radii < high)
        assert least < -np.log(np.exp(-depth[part]).mean()) < most


def test_profile_of_a_file_is_read_beside_the_planet(tmp_path):
    (tmp_path / "rows.csv").write_text("radius_km,optical_depth\n7000,1\n9000,3\n")
    file = tmp_path / "ringed.toml"
    file.write_text(FILE.replace("optical_depth = 0.5", 'profile = "rows.csv"'))
    (one,) = load_planet(file).rings
    assert_allclose(one.depths([6.9e6, 7.5e6, 8e6]), [0.0, 1.5, 2.0])
    file.write_text(FILE.replace("optical_depth = 0.5", 'profile = "none"'))
    with pytest.raises(ParameterError, match="none"):
        load_planet(file)


def test_brightness_of_a_profile_keeps_the_mean_albedo(tmp_path):
    # a sum rule: the light that the ring intercepts is scattered with its mean albedo
    (tmp_path / "rows.csv").write_text(
        "radius_km,optical_depth,brightness\n7000,1,0.5\n8000,1,1\n9000,0.1,1.5\n"
    )
    one = Ring(inner_radius=7e6, outer_radius=9e6, profile=str(tmp_path / "rows.csv"))
    radii = np.array([7e6, 8e6, 9e6])
    stopped = (1.0 - np.exp(-one.depths(radii))) * radii
    assert_allclose(np.average(one.relative_albedo(radii), weights=stopped), 1.0)
    assert_allclose(one.relative_albedo([7e6, 7.5e6]) / one.relative_albedo([8e6]), [0.5, 0.75])
    tables = ring_tables((one,), np.array([550.0]))
    assert tables.ring_albedo.max() > 1.75 * 0.5  # of the last row, 1.81 times the mean
    assert_allclose(ring().relative_albedo(radii), 1.0)
    with pytest.raises(ParameterError, match=r"single_scattering_albedo is 0\.9; .*at most 0\.55"):
        replace(one, single_scattering_albedo=0.9)
    with pytest.raises(ParameterError, match=r"profile is .*from 6000000 to 9000000 m"):
        replace(one, inner_radius=6e6)
