import pytest
from numpy.testing import assert_allclose

from airlight.errors import FileError, ParameterError
from airlight.planets import load_planet
from airlight.planets.matter.particle_index import GivenIndex, MixedIndex, TableIndex
from airlight.planets.matter.particle_sizes import GammaSizes, LogNormalSizes, SingleSize
from airlight.planets.matter.particles import Particles
from airlight.planets.matter.turbidity import LiteralTurbidity, Turbidity
from airlight.planets.medium import Medium
from airlight.planets.reading.reader import read_planet
from airlight.planets.spectral import PerWavelength

TOP = """
name = "Dusty"
[shell]
bottom_radius = "3389.5 km"
top_radius = "3489.5 km"
[ground]
albedo = 0.2
[star]
spectrum = "astm-g173"
[[constituents]]
name = "dust"
profile = { kind = "exponential", scale_height = "11 km" }
wavelengths = "680, 550, 440 nm"
"""
#: Small particles, which are computed quickly.
SMALL = """
sizes = { kind = "single", radius = "0.05 um" }
optical_depth = 0.5
"""
WATER = "[constituents.particles]\nindex = 'water'\noptical_depth = 1\n"
HAZE = "turbidity = { optical_depth = 0.1, junge = 4 }\n"
PHASE = 'phase_function = { kind = "henyey-greenstein", asymmetry = 0.7 }\n'


def _matter(text):
    return read_planet(TOP + text, "dusty.toml").constituents[0].matter


def test_particles_are_read_with_all_their_units():
    # The numbers of the file, in SI.
    found = _matter("""
[constituents.particles]
index = { real = 1.52, imaginary = [0.001, 0.006, 0.013] }
sizes = { kind = "gamma", effective_radius = "0.06 um", effective_variance = 0.1 }
number_density = "1 /cm^3"
""")
    k = PerWavelength(wavelengths=(680.0, 550.0, 440.0), values=(0.001, 0.006, 0.013))
    sizes = GammaSizes(effective_radius=6e-8, effective_variance=0.1)
    assert isinstance(found, Particles)
    assert found.index == GivenIndex(real=1.52, imaginary=k)
    assert_allclose(found.sizes.effective_radius, sizes.effective_radius, rtol=1e-12)
    assert found.sizes.effective_variance == 0.1
    assert_allclose(found.number_density, 1e6, rtol=1e-12)


def test_named_and_mixed_indices_and_other_sizes_are_read():
    # The numbers of the file, in SI.
    found = _matter(f"""
[constituents.particles]
index = {{ matrix = {{ real = 1.5 }}, inclusions = "hematite", fraction = 0.02 }}
at = "0.6 um"
{SMALL}""")
    assert found.index == MixedIndex(
        matrix=GivenIndex(real=1.5), inclusions=TableIndex(table="hematite"), fraction=0.02
    )
    assert_allclose(found.at, 600.0)
    assert isinstance(found.sizes, SingleSize)
    found = _matter("""
[constituents.particles]
index = "sulphuric-acid"
sizes = { kind = "log-normal", median_radius = "50 nm", geometric_deviation = 1.0 }
optical_depth = 0.5
""")
    assert found.index == TableIndex(table="sulphuric-acid")
    assert isinstance(found.sizes, LogNormalSizes)


def test_a_table_beside_the_planet_file_is_found(tmp_path):
    # A relative path starts at the planet file, not at the working directory.
    rows = "# source: me\nwavelength_nm,real,imaginary\n400,1.4,0\n800,1.4,0\n"
    (tmp_path / "mine.csv").write_text(rows)
    file = tmp_path / "dusty.toml"
    file.write_text(TOP + f'[constituents.particles]\nindex = "mine.csv"\n{SMALL}')
    planet = load_planet(file)
    assert planet.wavelength_limits == (390.0, 810.0)
    file.write_text(TOP + f'[constituents.particles]\nindex = "other.csv"\n{SMALL}')
    with pytest.raises(FileError, match=r"other\.csv: cannot be read: No such file"):
        load_planet(file)


def test_optical_depth_is_spread_over_the_profile():
    # A law: coefficient × column = optical depth, at the wavelength named.
    text = TOP + f'[constituents.particles]\nindex = {{ real = 1.5 }}\nat = "440 nm"\n{SMALL}'
    medium = Medium.from_planet(read_planet(text, "dusty.toml"), [440.0])
    assert_allclose(medium.vertical_optical_depth, 0.5, rtol=1e-12)


def test_absorption_comes_on_top_of_particles():
    # The contract of all matter: its own absorption plus the given one.
    text = (
        TOP
        + 'absorption = "1e-6 /m"\n'
        + f"[constituents.particles]\nindex = {{ real = 1.5 }}\n{SMALL}"
    )
    medium = Medium.from_planet(read_planet(text, "dusty.toml"), [550.0])
    assert_allclose(medium.absorption, 1e-6, rtol=1e-9)


def test_haze_by_turbidity_is_read():
    # The numbers of the file.
    found = _matter(
        PHASE + "turbidity = { turbidity = 2.0, junge = 4.0, rayleigh_optical_depth = 0.0973 }\n"
    )
    assert found == Turbidity(turbidity=2.0, junge=4.0, rayleigh_optical_depth=0.0973)
    found = _matter(
        PHASE
        + "turbidity = { optical_depth = 0.1, angstrom = 1.3, single_scattering_albedo = 0.95 }\n"
    )
    assert found == Turbidity(optical_depth=0.1, angstrom=1.3, single_scattering_albedo=0.95)
    found = _matter(PHASE + "turbidity_literal = { turbidity = 2.0 }\n")
    assert found == LiteralTurbidity(turbidity=2.0)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "[constituents.particles]\nindex = 'watre'\n" + SMALL,
            r"constituents\[0\]\.particles\.index is 'watre'; allowed: .*water",
        ),
        (
            "[constituents.particles]\nindex = { real = 1.5, imaginary = -0.1 }\n" + SMALL,
            r"constituents\[0\]\.particles\.index\.imaginary is -0\.1; allowed: 0 to 10",
        ),
        (
            WATER
            + "sizes = { kind = 'gamma', effective_radius = '1 um', effective_variance = 0.5 }",
            r"constituents\[0\]\.particles\.sizes\.effective_variance is 0\.5; allowed: more",
        ),
        (
            WATER
            + "sizes = { kind = 'log-normal', median_radius = '1 um', geometric_deviation = 0.5 }",
            r"constituents\[0\]\.particles\.sizes\.geometric_deviation is 0\.5; allowed: 1 to 5",
        ),
        (
            WATER + "sizes = { kind = 'sinle', radius = '1 um' }",
            r"constituents\[0\]\.particles\.sizes\.kind is 'sinle'; .*did you mean 'single'",
        ),
        (
            "[constituents.particles]\nindex = 'water'\nmethod = 'anomalous-diffraction'\n" + SMALL,
            r"constituents\[0\]\.phase_function is required for anomalous",
        ),
        (
            "[constituents.particles]\nindex = 'water'\nradius = '1 um'\n" + SMALL,
            r"a key of constituents\[0\]\.particles is 'radius'; allowed",
        ),
        (
            "scattering = '1e-6 /m'\n[constituents.particles]\nindex = 'water'\n" + SMALL,
            r"constituents\[0\]\.scattering cannot be combined with particles",
        ),
        (
            PHASE + "turbidity_literal = { turbidity = 2.0, junge = 3.5 }\n",
            r"constituents\[0\]\.turbidity_literal\.junge is 3\.5; allowed: 4 to 4",
        ),
        (
            HAZE,
            r"constituents\[0\]\.phase_function is required for turbidity",
        ),
        (
            PHASE + HAZE + "turbidity_literal = { turbidity = 2.0 }\n",
            r"constituents\[0\]\.turbidity_literal cannot be combined",
        ),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(text, message):
    # File, field, value, range.
    with pytest.raises(ParameterError, match=f"^dusty.toml: {message}"):
        read_planet(TOP + text, "dusty.toml")
