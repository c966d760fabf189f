import re

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.errors import Cancelled, ParameterError
from airlight.kernel import cost, disk
from airlight.kernel.cache import Cache
from airlight.physics.optics import mie
from airlight.physics.optics.size_distribution import single_size
from airlight.planets.constituent import Constituent
from airlight.planets.matter import mie_nodes, particles
from airlight.planets.matter.particle_index import GivenIndex, MixedIndex, TableIndex
from airlight.planets.matter.particle_sizes import GammaSizes, LogNormalSizes, SingleSize
from airlight.planets.matter.particles import Particles
from airlight.planets.matter.phases import HenyeyGreenstein
from airlight.planets.matter.profiles import Exponential
from airlight.planets.medium import Medium
from airlight.planets.planet import Planet
from airlight.planets.spectral import PerWavelength

RGB = (680.0, 550.0, 440.0)
DUST = GivenIndex(real=1.52, imaginary=PerWavelength(wavelengths=RGB, values=(0.001, 0.006, 0.013)))
FINE = GammaSizes(effective_radius=2e-7, effective_variance=0.1)


@pytest.fixture(autouse=True)
def _nothing_kept(monkeypatch, tmp_path):
    """Clear what other tests kept in memory and on disk."""
    mie_nodes._kept.clear()
    monkeypatch.setattr(disk, "cache_folder", lambda: tmp_path)
    particles._phase.cache_clear()


def _planet(dust, phase_function=None, star=None):
    from airlight.planets import load_planet, replace

    air = Constituent(
        name="dust",
        profile=Exponential(scale_height=11e3),
        matter=dust,
        phase_function=phase_function,
    )
    earth = load_planet("earth-atmosphere-plus")
    return replace(earth, constituents=(air,))


def test_golden_dust_goes_through_a_planet():
    # The dust check of the specification for one radius, through every layer; half the last digit.
    dust = Particles(index=DUST, sizes=SingleSize(radius=1.6e-6), optical_depth=0.5)
    medium = Medium.from_planet(_planet(dust), RGB)
    assert_allclose(medium.single_scattering_albedo[0], [0.972, 0.822, 0.689], rtol=0, atol=5e-4)
    depth = medium.vertical_optical_depth[0]
    assert_allclose(depth[1], 0.5, rtol=1e-12)
    assert_allclose(depth / depth[1] * 2.267, [2.135, 2.267, 2.382], rtol=0, atol=1e-3)
    # A single size has rings, which 0.1° steps resolve to 1e-3.
    assert_allclose(medium.phase_moments(1)[0, :, 1], [0.750, 0.792, 0.880], rtol=0, atol=1.5e-3)


def test_number_density_counts_cross_sections():
    # A law: coefficient = number × cross-section, and no column in it.
    dust = Particles(index=DUST, sizes=FINE, number_density=2e6)
    extinction, scattering = dust.cross_sections(RGB)
    assert_allclose(dust.scattering_coefficients(RGB, 1e4), 2e6 * scattering, rtol=1e-14)
    total = dust.scattering_coefficients(RGB, 5.0) + dust.absorption_coefficients(RGB, 5.0)
    assert_allclose(total, 2e6 * extinction, rtol=1e-14)


@pytest.mark.parametrize(
    ("index", "sizes"),
    [
        (TableIndex(table="titan-haze"), GammaSizes(effective_radius=3e-7, effective_variance=0.1)),
        pytest.param(
            TableIndex(table="sulphuric-acid"),
            LogNormalSizes(median_radius=3.5e-7, geometric_deviation=1.6),
            marks=pytest.mark.slow,
        ),
    ],
)
def test_interpolation_between_nodes_is_within_half_a_per_cent(index, sizes):
    # Second method: the same theory exactly half-way between nodes, where the error is largest.
    haze = Particles(index=index, sizes=sizes, optical_depth=0.1)
    nodes = np.array(mie_nodes.bracketing(haze._nodes, np.linspace(550.0, 630.0, 30)))
    middle = np.sqrt(nodes[1:] * nodes[:-1])
    exact = mie_nodes.mie_nodes(index, sizes, middle.tolist())
    extinction, scattering = haze.cross_sections(middle)
    assert_allclose(extinction, [one.extinction for one in exact], rtol=5e-3)
    assert_allclose(scattering, [one.scattering for one in exact], rtol=5e-3)
    assert_allclose(haze.asymmetries(middle), [one.asymmetry for one in exact], rtol=0, atol=3e-3)


def test_wavelengths_that_the_index_was_given_at_are_exact():
    # The nodes hold them: Mie's theory itself is the second method.
    index = GivenIndex(real=PerWavelength(wavelengths=(500.0, 600.0), values=(1.5, 1.4)))
    one = Particles(index=index, sizes=SingleSize(radius=1e-6), number_density=1.0)
    for nm, n in ((500.0, 1.5), (600.0, 1.4)):
        exact = mie.scattering(single_size(1e-6), nm, complex(n), [0.0])
        assert_allclose(one.cross_sections([nm])[1], exact.scattering, rtol=1e-12)


def test_phase_functions_integrate_to_one_and_keep_the_mean_cosine():
    # Laws, for any wavelength between nodes; 2e-4 is the error of straight lines between angles.
    haze = Particles(index=DUST, sizes=FINE, optical_depth=0.1)
    nm = np.array([445.0, 500.0, 610.0, 688.0])
    moments = haze.phase_function(nm).moments(nm, 1)
    assert_allclose(moments[:, 0], 1.0, rtol=1e-12)
    assert_allclose(moments[:, 1], haze.asymmetries(nm), rtol=0, atol=2e-4)


def test_results_are_kept_in_memory_and_on_disk(monkeypatch):
    # Kept results equal the computed ones bit for bit, and nothing is computed again.
    haze = Particles(index=DUST, sizes=FINE, optical_depth=0.1)
    first = haze.cross_sections(RGB), haze.phase_function(RGB)
    particles._phase.cache_clear()

    def never(*_):
        raise AssertionError("computed again")

    monkeypatch.setattr(mie_nodes, "_computed", never)
    assert_array_equal(haze.cross_sections(RGB), first[0])
    mie_nodes._kept.clear()
    assert_array_equal(haze.cross_sections(RGB), first[0])
    assert haze.phase_function(RGB) == first[1]


def test_another_particle_finds_nothing_kept(monkeypatch):
    # The key holds index, sizes and wavelength.
    calls = []
    compute = mie_nodes._computed
    monkeypatch.setattr(mie_nodes, "_computed", lambda *a: calls.append(a) or compute(*a))
    for k, radius, nm in (
        (0.1, 2e-7, 550.0),
        (0.2, 2e-7, 550.0),
        (0.1, 3e-7, 550.0),
        (0.1, 2e-7, 440.0),
    ):
        sizes = SingleSize(radius=radius)
        mie_nodes.mie_nodes(GivenIndex(real=1.5, imaginary=k), sizes, [nm])
    assert len(calls) == 4


def test_a_damaged_file_is_computed_anew(tmp_path):
    # A damaged file counts as absent.
    index, sizes = GivenIndex(real=1.5), SingleSize(radius=1e-7)
    (good,) = mie_nodes.mie_nodes(index, sizes, [550.0])
    mie_nodes._kept.clear()
    (file,) = (tmp_path / "solutions").glob("mie*.npz")
    file.write_bytes(file.read_bytes()[:200])
    (again,) = mie_nodes.mie_nodes(index, sizes, [550.0])
    assert_array_equal(again.phase, good.phase)


def test_progress_is_reported_and_work_can_be_cancelled():
    # One step for each wavelength; a cancelled read returns no planet.
    dust = Particles(index=DUST, sizes=FINE, optical_depth=0.5)
    steps = []
    with pytest.raises(Cancelled):
        Medium.from_planet(_planet(dust), RGB, cancel=lambda: True)
    Medium.from_planet(_planet(dust), RGB, progress=lambda *step: steps.append(step))
    assert steps[-1][0] == steps[-1][1]
    assert steps[-1][2] == "particles"


def test_five_hundred_wavelengths_cost_no_more_than_the_nodes(monkeypatch):
    # 430 to 690 nm lie between 13 nodes; a plot has hundreds of wavelengths.
    calls = []
    compute = mie_nodes._computed
    monkeypatch.setattr(mie_nodes, "_computed", lambda *a: calls.append(a) or compute(*a))
    dust = Particles(index=DUST, sizes=FINE, optical_depth=0.5)
    medium = Medium.from_planet(_planet(dust), np.linspace(430.0, 690.0, 501))
    assert len(calls) <= 13
    assert (np.abs(np.diff(np.log(medium.scattering[0]))) < 0.02).all()


def test_anomalous_diffraction_takes_the_phase_function_given():
    # The dust check of the specification, through a planet; it has no phase function of its own.
    dust = Particles(
        index=DUST,
        sizes=SingleSize(radius=1.6e-6),
        method="anomalous-diffraction",
        optical_depth=0.5,
    )
    medium = Medium.from_planet(_planet(dust, HenyeyGreenstein(asymmetry=0.7)), RGB)
    assert_allclose(medium.single_scattering_albedo[0], [0.980, 0.874, 0.748], rtol=0, atol=5e-4)
    with pytest.raises(ParameterError, match="phase_function is required for anom"):
        Medium.from_planet(_planet(dust), RGB)


@pytest.mark.slow
def test_dust_with_hematite_reddens_the_light_that_it_scatters():
    # Hematite absorbs blue: published albedos of Martian dust rise from blue to red.
    index = MixedIndex(
        matrix=GivenIndex(real=1.5, imaginary=0.0005),
        inclusions=TableIndex(table="hematite"),
        fraction=0.02,
    )
    sizes = GammaSizes(effective_radius=1.6e-6, effective_variance=0.3)
    dust = Particles(index=index, sizes=sizes, optical_depth=0.5)
    extinction, scattering = dust.cross_sections(RGB)
    red, green, blue = scattering / extinction
    assert red > green > blue
    assert 0.6 < blue < 0.8
    assert red > 0.93


def test_the_sizes_of_one_radius_agree():
    # σ_g = 1 is a single radius.
    one = LogNormalSizes(median_radius=1e-6, geometric_deviation=1.0)
    assert_array_equal(one.sizes(9).radii, SingleSize(radius=1e-6).sizes(9).radii)
    assert_allclose(one.moment(3), 1e-18, rtol=1e-12)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: GammaSizes(effective_radius=1e-6, effective_variance=0.5),
            r"effective_variance is 0\.5; allowed: more than 0 to less than 0\.5",
        ),
        (
            lambda: LogNormalSizes(median_radius=1e-6, geometric_deviation=0.9),
            r"geometric_deviation is 0\.9; allowed: 1 to 5",
        ),
        (lambda: SingleSize(radius=0.0), r"radius is 0\.0; allowed: 1e-10 to 0\.001 m"),
        (
            lambda: GivenIndex(real=1.5, imaginary=-0.1),
            r"imaginary is -0\.1; allowed: 0 to 10",
        ),
        (lambda: GivenIndex(real=0.0), r"real is 0\.0; allowed: 0\.1 to 10"),
        (
            lambda: MixedIndex(matrix=DUST, inclusions=DUST, fraction=1.5),
            r"fraction is 1\.5; allowed: 0 to 1",
        ),
        (
            lambda: Particles(index=DUST, sizes=FINE),
            r"optical_depth is missing; allowed: either optical_depth or number_density",
        ),
        (
            lambda: Particles(index=DUST, sizes=FINE, optical_depth=0.5, number_density=1e6),
            r"optical_depth is 0\.5; allowed: either optical_depth or number_density",
        ),
        (
            lambda: Particles(index=DUST, sizes=FINE, optical_depth=0.5, at=1000.0),
            r"at is 1000\.0; allowed: 430 to 690 nm, the range of the index",
        ),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(make, message):
    # Field, value, range.
    with pytest.raises(ParameterError, match=f"^{message}$"):
        make()


@pytest.mark.parametrize("radius", [15e-6, 40e-6, 80e-6, 150e-6, 250e-6, 1e-3])
def test_large_drops_of_one_size_keep_their_light_and_its_mean_cosine(radius):
    # Laws: the integral is 1, and the mean cosine of the table is that of Mie's series, beyond
    # 2πr/λ = 3000 that of the sphere which stands for it.
    drops = Particles(
        index=TableIndex(table="water"), sizes=SingleSize(radius=radius), optical_depth=0.5
    )
    medium = Medium.from_planet(_planet(drops), [550.0])
    (moments,) = drops.phase_function([550.0]).moments([550.0], 1)
    assert_allclose(moments[0], 1.0, rtol=0, atol=1e-6)
    assert_allclose(moments[1], drops.asymmetries([550.0]), rtol=4e-4)
    assert_allclose(medium.vertical_optical_depth[0], 0.5, rtol=1e-12)
    assert_allclose(medium.phase_moments(1)[0, :, 1], moments[1], rtol=1e-6)


def test_the_forward_peak_of_a_large_drop_is_airy_s():
    # A second method: Airy's disc, x²/(16π) (2 J₁(z)/z)² 4 with z = x sin θ, within what rays add
    # and edges take; its first dark ring at z = 3.8317.
    from scipy.special import j1

    radius = 150e-6
    drops = Particles(
        index=TableIndex(table="water"), sizes=SingleSize(radius=radius), optical_depth=0.5
    )
    phase = drops.phase_function([550.0])
    x = 2.0 * np.pi * radius / 550e-9
    z = np.array([1e-6, 0.5, 1.0, 2.0])
    airy = x**2 / (8.0 * np.pi) * (2.0 * j1(z) / z) ** 2
    found = phase.values(np.cos(z / x), [550.0])[:, 0]
    assert_allclose(found, airy, rtol=0.05)
    dark = phase.values(np.cos(np.array([3.8317]) / x), [550.0])[0, 0]
    assert dark < 0.01 * found[0]


def test_planet_of_particles_is_a_planet():
    # Round trip of limits: the range of the index, and no more.
    dust = Particles(index=DUST, sizes=FINE, optical_depth=0.5)
    planet = _planet(dust)
    assert isinstance(planet, Planet)
    assert planet.wavelength_limits == (430.0, 690.0)


def test_a_call_keeps_what_it_uses_when_memory_forgets(monkeypatch):
    # more nodes in one call than are remembered; the second call finds some on disk alone
    monkeypatch.setattr(mie_nodes, "_kept", Cache(2))
    index, wavelengths = GivenIndex(real=1.5, imaginary=0.01), [440.0, 500.0, 550.0, 600.0, 680.0]
    first = mie_nodes.mie_nodes(index, FINE, wavelengths)
    again = mie_nodes.mie_nodes(index, FINE, wavelengths)
    assert len(mie_nodes._kept) == 2
    for one, other in zip(first, again, strict=True):
        assert_array_equal(one.phase, other.phase)
        assert one.extinction == other.extinction


@pytest.mark.parametrize("listening", [True, False])
def test_the_time_of_large_spheres_is_said_before_any_is_computed(
    listening, tmp_path, monkeypatch, caplog
):
    # Drops of 50 µm at six wavelengths are some 1e11 terms times angles: more than the ten seconds
    # from which work is announced, at the rate of a machine that has measured none.
    def computed(*_):
        raise Cancelled("computed")

    monkeypatch.setattr(cost, "cache_folder", lambda: tmp_path)
    monkeypatch.setattr(mie_nodes, "_computed", computed)
    said = []
    token = cost.announce.set(said.append if listening else None)
    drops = GammaSizes(effective_radius=50e-6, effective_variance=0.1)
    try:
        with pytest.raises(Cancelled):
            mie_nodes.mie_nodes(TableIndex(table="water"), drops, range(440, 680, 10))
    finally:
        cost.announce.reset(token)
    (line,) = said if listening else [record.message for record in caplog.records]
    assert re.fullmatch(r"particles at 24 wavelengths: about \S+ (s|min)", line)


@pytest.mark.parametrize("method", ["mie", "anomalous-diffraction"])
def test_particles_of_the_index_of_the_air_extinguish_nothing(method):
    clear = Particles(
        index=GivenIndex(real=1.0, imaginary=0.0), sizes=FINE, optical_depth=0.1, method=method
    )
    with pytest.raises(ParameterError, match=r"index\.real is 1\.0|refractive index is 1"):
        clear.absorption_coefficients([550.0], 1e4)


def test_absorbing_particles_of_the_index_of_the_air():
    # Without a phase shift a sphere absorbs, and diffracts the shadow of what it absorbs.
    dark = GivenIndex(real=1.0, imaginary=0.05)
    soot = Particles(index=dark, sizes=FINE, optical_depth=0.1, method="anomalous-diffraction")
    absorbed = soot.absorption_coefficients([550.0], 1e4)
    total = absorbed + soot.scattering_coefficients([550.0], 1e4)
    assert_allclose(total, 0.1 / 1e4, rtol=1e-12)
    assert 0.5 < (absorbed / total).item() < 1.0
