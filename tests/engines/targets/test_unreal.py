"""The editor script for Unreal, run against a module that knows the documented properties only."""

import sys
import types

import pytest
from numpy.testing import assert_allclose

from airlight.engines.targets import target_of
from airlight.engines.targets.unreal import planet_from_unreal, properties_of
from airlight.errors import ParameterError
from airlight.planets import load_planet, replace
from airlight.planets.medium import Medium

NM = (680.0, 550.0, 440.0)


class LinearColor:
    def __init__(self, r=0.0, g=0.0, b=0.0, a=0.0):
        self.r, self.g, self.b, self.a = (checked(float, one) for one in (r, g, b, a))


class Color:
    def __init__(self, b=0, g=0, r=0, a=0):  # the order of Unreal's Python
        self.b, self.g, self.r, self.a = (checked(int, one) for one in (b, g, r, a))
        assert all(0 <= one <= 255 for one in (b, g, r, a))


class TentDistribution:
    def __init__(self, tip_altitude=0.0, tip_value=0.0, width=0.0):
        self.tip_altitude, self.tip_value, self.width = (
            checked(float, one) for one in (tip_altitude, tip_value, width)
        )


def checked(kind, value):
    if type(value) is not kind:
        raise TypeError(f"{value!r} is no {kind.__name__}")
    return value


#: Editor properties of unreal.SkyAtmosphereComponent and their types (Python API 5.1, 5.7).
PROPERTIES = {
    "bottom_radius": float, "atmosphere_height": float, "ground_albedo": Color,
    "multi_scattering_factor": float, "trace_sample_count_scale": float,
    "rayleigh_scattering_scale": float, "rayleigh_scattering": LinearColor,
    "rayleigh_exponential_distribution": float, "mie_scattering_scale": float,
    "mie_scattering": LinearColor, "mie_absorption_scale": float, "mie_absorption": LinearColor,
    "mie_anisotropy": float, "mie_exponential_distribution": float,
    "other_absorption_scale": float, "other_absorption": LinearColor,
    "other_tent_distribution": TentDistribution, "sky_luminance_factor": LinearColor,
    "aerial_pespective_view_distance_scale": float, "height_fog_contribution": float,
    "transmittance_min_light_elevation_angle": float, "aerial_perspective_start_depth": float,
}  # fmt: skip


class Component:
    def __init__(self):
        self.properties = {}

    def set_editor_property(self, name, value):
        if name not in PROPERTIES:
            raise AttributeError(f"Failed to find property {name!r}")
        self.properties[name] = checked(PROPERTIES[name], value)


class SkyAtmosphere:
    def __init__(self):
        self.component = Component()

    def get_component_by_class(self, kind):
        assert kind is Component
        return self.component


class Editor:
    """Level with some actors; a SkyAtmosphere among them or not."""

    def __init__(self, actors):
        self.actors = actors

    def get_all_level_actors(self):
        return list(self.actors)

    def spawn_actor_from_class(self, kind, place):
        assert isinstance(place, tuple)
        self.actors.append(kind())
        return self.actors[-1]


class Transaction:
    def __init__(self, label):
        assert isinstance(label, str)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        return None


def run(script, monkeypatch, actors):
    editor = Editor(actors)
    module = types.ModuleType("unreal")
    module.LinearColor, module.Color, module.TentDistribution = LinearColor, Color, TentDistribution
    module.SkyAtmosphere, module.SkyAtmosphereComponent = SkyAtmosphere, Component
    module.EditorActorSubsystem, module.ScopedEditorTransaction = Editor, Transaction
    module.Vector = lambda x, y, z: (x, y, z)
    module.get_editor_subsystem = lambda kind: editor if kind is Editor else None
    monkeypatch.setitem(sys.modules, "unreal", module)
    exec(compile(script.read_text(encoding="utf-8"), script, "exec"), {"__name__": "__main__"})
    return next(one for one in editor.actors if isinstance(one, SkyAtmosphere)).component.properties


@pytest.mark.parametrize("actors", [[], ["light", SkyAtmosphere()]])
def test_script_sets_documented_properties_of_their_types(solved, tmp_path, monkeypatch, actors):
    planet = load_planet("earth-bruneton")
    solution = solved(planet, NM, quality="preview")
    export = target_of("unreal").write(solution, tmp_path / "out")
    properties = run(tmp_path / "out" / "sky_atmosphere.py", monkeypatch, actors)
    # Unreal's default sky is this planet but for radius of the air's top and Henyey-Greenstein.
    assert properties["bottom_radius"] == 6360.0
    assert properties["atmosphere_height"] == 60.0
    assert_allclose(properties["rayleigh_scattering_scale"], 0.0331, rtol=1e-4)
    assert_allclose(properties["rayleigh_scattering"].g, 0.013558 / 0.0331, rtol=1e-6)
    assert_allclose(properties["mie_scattering_scale"], 0.003996, rtol=1e-4)
    assert_allclose(properties["mie_absorption_scale"], 0.000444, rtol=1e-4)
    assert_allclose(properties["other_absorption_scale"], 0.001881, rtol=1e-3)
    tent = properties["other_tent_distribution"]
    assert_allclose([tent.tip_altitude, tent.tip_value, tent.width], [25.0, 1.0, 15.0], rtol=1e-3)
    assert_allclose(properties["mie_anisotropy"], 0.8436, atol=5e-5)
    made = planet_from_unreal(properties, solution.planet.star, "again")
    again = Medium.from_planet(made, NM)
    assert_allclose(again.vertical_optical_depth, solution.medium.vertical_optical_depth, rtol=1e-6)
    # Eight bits of the ground's albedo of 0.1, half a step of the curve of sRGB.
    assert_allclose(again.ground_albedo, 0.1, atol=1.5e-3)
    assert any("lux" in note for note in export.notes)


def test_planet_without_particles_or_ozone_has_none():
    planet = replace(load_planet("mars-rayleigh"), refraction="none")
    from airlight.engines.targets.fits.formula_planet import Formulas, formula_planet
    from airlight.engines.targets.fits.lobe import HENYEY_GREENSTEIN

    medium = Medium.from_planet(planet, NM)
    fit = formula_planet(medium, "x", Formulas(lobe=HENYEY_GREENSTEIN, absorber="tent"))
    properties = properties_of(fit)
    assert properties["mie_scattering_scale"] == properties["other_absorption_scale"] == 0.0
    made = planet_from_unreal(properties, planet.star, "again")
    assert [one.name for one in made.constituents] == ["molecules"]
    del properties["mie_anisotropy"]
    with pytest.raises(ParameterError, match="mie_anisotropy"):
        planet_from_unreal(properties, planet.star, "again")


def test_light_is_that_of_the_planets_star(solved, tmp_path):
    # The sun at 1 au: 683 lm/W times its luminance of 194.9 W/m².
    planet = replace(load_planet("earth-openspace"), refraction="none")
    solution = solved(planet, NM, quality="preview")
    export = target_of("unreal").write(solution, tmp_path / "out")
    said = next(note for note in export.notes if "lux" in note)
    assert "1.331e+05 lux, source angle 0.533 deg" in said
