import miepython
import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import Cancelled, ParameterError
from airlight.physics.optics import mie
from airlight.physics.optics.size_distribution import SizeNodes, gamma_sizes, single_size

DUST = [(680.0, 0.001), (550.0, 0.006), (440.0, 0.013)]


@pytest.mark.parametrize(
    ("nm", "k", "q_ext", "albedo", "g"),
    [
        (680, 0.001, 2.135, 0.972, 0.750),
        (550, 0.006, 2.267, 0.822, 0.792),
        (440, 0.013, 2.382, 0.689, 0.880),
    ],
)
def test_one_sphere_of_martian_dust(nm, k, q_ext, albedo, g):
    # The dust check of the specification; half the last printed digit.
    found = mie.scattering(single_size(1.6e-6), nm, 1.52 + 1j * k, [0.0, 180.0])
    area = np.pi * 1.6e-6**2
    assert_allclose(found.extinction / area, q_ext, rtol=0, atol=5e-4)
    assert_allclose(found.scattering / found.extinction, albedo, rtol=0, atol=5e-4)
    assert_allclose(found.asymmetry, g, rtol=0, atol=5e-4)


@pytest.mark.parametrize(
    ("nm", "k", "q_ext", "albedo", "g"),
    [
        (680, 0.001, 2.440, 0.970, 0.718),
        (550, 0.006, 2.370, 0.839, 0.774),
        (440, 0.013, 2.310, 0.702, 0.834),
    ],
)
def test_a_distribution_of_martian_dust(nm, k, q_ext, albedo, g):
    # The dust check of the specification, whose means were taken over fewer radii. Converged (6000
    # radii, miepython's own efficiencies): efficiency 2.4349, 2.3675, 2.3094; albedo 0.9705,
    # 0.8390, 0.7024; g 0.7191, 0.7740, 0.8340. The tolerances are the steps to the print.
    sizes = gamma_sizes(1.6e-6, 0.3, 800)
    found = mie.scattering(sizes, nm, 1.52 + 1j * k, [0.0, 180.0])
    area = np.pi * (sizes.weights @ sizes.radii**2)
    assert_allclose(found.extinction / area, q_ext, rtol=2.2e-3)
    assert_allclose(found.scattering / found.extinction, albedo, rtol=0, atol=6e-4)
    assert_allclose(found.asymmetry, g, rtol=0, atol=1.1e-3 if nm == 680 else 5e-4)


def test_few_radii_give_the_mean_of_many():
    # Second method: Gauss-Legendre in ln r with miepython's own efficiencies, 1500 radii. 680 nm is
    # the hardest: nearly clear spheres have sharp resonances.
    nm, index = 680.0, 1.52 + 0.001j
    x, w = np.polynomial.legendre.leggauss(1500)
    log_r = 0.5 * (np.log(5e-9) + np.log(1.6e-5)) + 0.5 * np.log(3200) * x
    r = np.exp(log_r)
    weights = w * r ** (3 + (1 - 0.9) / 0.3) * np.exp(-r / 0.48e-6)
    q_ext = np.array(
        [miepython.efficiencies_mx(index.conjugate(), 2e9 * np.pi * a / nm)[0] for a in r]
    )
    expected = weights @ q_ext / weights.sum()
    sizes = gamma_sizes(1.6e-6, 0.3, 800)
    found = mie.scattering(sizes, nm, index, [0.0])
    area = np.pi * (sizes.weights @ sizes.radii**2)
    # 800 radii leave 4e-4 of noise at the resonances, the 1500 of the other rule 2e-4.
    assert_allclose(found.extinction / area, expected, rtol=1e-3)


@pytest.mark.parametrize(
    ("x", "index", "n", "a", "b"),
    [
        (1e-3, 1.33, 1, 1.8498134920682636e-20 - 1.3600784874661695e-10j, None),
        (np.pi, 1.33, 1, 0.598530588875581 - 0.49019559673239743j,
         0.7463159477728687 - 0.4351188962487764j),
        (30.0, 0.5 + 3j, 31, 0.6618941844735341 + 0.2522503408085374j,
         0.037872399187262554 + 0.17485754653423802j),
        (412.0, 1.5 + 0.01j, 300, 0.5329611005080965 + 0.02347788185825457j,
         0.37238945845185234 - 0.0910363940257878j),
        (1245.25, 2.5, 1262, 0.012965921598703684 - 0.11312739047551637j,
         0.0002384042562906206 + 0.015438504451571827j),
        (2627.0, 1.33 + 1e-9j, 2640, 4.552570337692783e-05 - 0.006719075992097901j,
         0.000257969467283094 + 0.016049107299201254j),
    ],
)  # fmt: skip
def test_coefficients_of_spheres_are_exact(x, index, n, a, b):
    # Second method: upward recurrences of Riccati-Bessel functions with 600 digits (mpmath 1.3).
    # Beside larger and smaller spheres, whose recurrences are the same.
    found = mie._coefficients(np.array([1.0, x, 3000.0]), np.full(3, complex(index)))
    assert_allclose(found[0][1, n - 1], a, rtol=1e-11)
    if b is not None:  # 3e-34 there, of which 6e-9 is lost
        assert_allclose(found[1][1, n - 1], b, rtol=1e-11)


@pytest.mark.parametrize("x", [0.01, 0.7, 5.0, 60.0])
def test_efficiencies_and_intensities_are_those_of_miepython(x):
    # Second method: miepython's own sums, one sphere and one angle at a time.
    m = 1.4 + 0.02j
    mu = np.linspace(-1.0, 1.0, 9)
    q_ext, q_sca, _, g = miepython.efficiencies_mx(m.conjugate(), x)
    assert_allclose(mie.efficiencies(x, m), (q_ext, q_sca, g), rtol=1e-6)
    found = mie.scattering(single_size(x * 5e-7 / (2 * np.pi)), 500.0, m, np.degrees(np.arccos(mu)))
    expected = miepython.i_unpolarized(m.conjugate(), x, mu, norm="one")
    assert_allclose(found.phase, expected, rtol=1e-6)


def test_small_spheres_scatter_like_molecules():
    # The exact limit x → 0: Rayleigh's cross-section and phase function; x² is what is left.
    x, m = 1e-3, 1.5
    _, q_sca, g = mie.efficiencies(x, complex(m))
    assert_allclose(q_sca, 8 / 3 * x**4 * ((m**2 - 1) / (m**2 + 2)) ** 2, rtol=2 * x**2)
    assert abs(g) < x**2
    mu = np.linspace(-1, 1, 11)
    angles = np.degrees(np.arccos(mu))
    found = mie.scattering(single_size(x * 5e-7 / (2 * np.pi)), 500.0, complex(m), angles)
    assert_allclose(found.phase, 3 / (16 * np.pi) * (1 + mu**2), rtol=2 * x**2)


def test_large_spheres_extinguish_twice_what_they_shade():
    # The exact limit; at finite x the edge adds 1.9924 x^(-2/3) (Nussenzveig & Wiscombe 1980).
    x = 2500.0
    q_ext, _, _ = mie.efficiencies(x, 1.5 + 0.1j)
    assert_allclose(q_ext, 2 + 1.9924 * x ** (-2 / 3), rtol=5e-4)


@pytest.mark.parametrize(("nm", "k"), DUST)
def test_phase_function_integrates_to_one_and_has_the_mean_cosine(nm, k):
    # Laws; the series is a polynomial in the cosine, so Gauss-Legendre is exact.
    mu, w = np.polynomial.legendre.leggauss(400)
    sizes = gamma_sizes(1.6e-6, 0.3, 60)
    found = mie.scattering(sizes, nm, 1.52 + 1j * k, np.degrees(np.arccos(mu)))
    assert_allclose(2 * np.pi * (w @ found.phase), 1.0, rtol=1e-9)
    assert_allclose(2 * np.pi * (w @ (mu * found.phase)), found.asymmetry, rtol=1e-9)


def test_clear_spheres_absorb_nothing():
    # A law: without k, what is not scattered is not lost.
    found = mie.scattering(gamma_sizes(1e-6, 0.1, 30), 550.0, 1.33 + 0j, [0.0])
    assert found.extinction == found.scattering


def test_rainbow_and_glory_of_water_drops():
    # Descartes' ray of least deviation: cos² i = (n² - 1)/3, D = 180° + 2i - 4 arcsin(sin i/n),
    # 138.1° for n = 1.3345 (0.55 µm). Airy's theory puts the brightest place outside of it, by
    # 1.087 · ray curvature: less than 1.6° for drops of 100 µm.
    n = 1.3345
    incidence = np.arccos(np.sqrt((n**2 - 1) / 3))
    bow = np.degrees(2 * incidence - 4 * np.arcsin(np.sin(incidence) / n)) + 180
    assert 138.0 < bow < 138.3
    angles = np.linspace(100, 180, 801)
    drops = gamma_sizes(1e-4, 0.01, 60)
    phase = mie.scattering(drops, 550.0, complex(n), angles).phase
    inner = angles < 170
    top = angles[inner][phase[inner].argmax()]
    assert bow < top < bow + 1.6
    # Alexander's dark band between the bows, and more light back at the sun than beside it.
    band = phase[(angles > 131) & (angles < 136)].mean()
    assert phase[np.abs(angles - top).argmin()] > 5 * band
    assert phase[-1] > 2 * phase[(angles > 165) & (angles < 175)].mean()


@pytest.mark.parametrize(
    ("index", "field"),
    [(1.5 - 0.01j, "index.imaginary"), (0.05 + 0j, "index.real"), (1.5 + 11j, "index.imaginary")],
)
def test_an_index_that_cannot_be_is_refused(index, field):
    # k below 0 would be light from nothing.
    with pytest.raises(ParameterError, match=f"^{field} is "):
        mie.scattering(single_size(1e-6), 550.0, index, [0.0])


def ray_asymmetry(n: float) -> float:
    """Mean cosine of the rays that a clear large sphere reflects and refracts, by Fresnel's laws.

    Ray p, incident at i and refracted at r, is turned by 2(i - r) + (p - 1)(π - 2r), the reflected
    one by π - 2i.
    """
    share = (np.arange(200_000) + 0.5) / 200_000  # sin² i is even over the disc
    i = np.arcsin(np.sqrt(share))
    r = np.arcsin(np.sin(i) / n)
    total = 0.0
    for amplitude in (np.sin(i - r) / np.sin(i + r), np.tan(i - r) / np.tan(i + r)):
        reflected = amplitude**2
        total += 0.5 * np.mean(reflected * np.cos(np.pi - 2.0 * i))
        for p in range(1, 60):
            turned = 2.0 * (i - r) + (p - 1) * (np.pi - 2.0 * r)
            light = (1.0 - reflected) ** 2 * reflected ** (p - 1)
            total += 0.5 * np.mean(light * np.cos(turned))
    return float(total)


@pytest.mark.parametrize("n", [1.31, 1.333, 1.5])
def test_spheres_beyond_mie_s_reach_are_those_of_geometric_optics(n):
    # A second method: half of the light is diffracted straight on, half goes by Fresnel's laws.
    # Edges, x^(-2/3) at x = 3000, are left.
    found = mie.scattering(single_size(1e-3), 550.0, complex(n), [0.0, 90.0])
    assert_allclose(found.extinction, 2.0 * np.pi * 1e-6, rtol=6e-3)
    assert_allclose(found.scattering, found.extinction, rtol=1e-12)
    assert_allclose(found.asymmetry, 0.5 * (1.0 + ray_asymmetry(n)), rtol=2e-3)


@pytest.mark.parametrize("k", [0.0, 1e-5, 1e-4, 1e-2])
def test_a_sphere_that_stands_for_a_larger_one_has_its_light(k, monkeypatch):
    # A second method: Mie's own sums for the larger sphere, x = 2900 by one of 1000; edges,
    # x^(-2/3) = 0.01 there, and resonances of one clear sphere are left.
    index, sizes = 1.4 + 1j * k, single_size(2900.0 * 5e-7 / (2.0 * np.pi))
    exact = mie.scattering(sizes, 500.0, index, [0.0])
    monkeypatch.setattr(mie, "LARGEST_SIZE_PARAMETER", 1000.0)
    found = mie.scattering(sizes, 500.0, index, [0.0])
    assert_allclose(found.extinction, exact.extinction, rtol=0.015)
    albedos = [one.scattering / one.extinction for one in (found, exact)]
    assert_allclose(albedos[0], albedos[1], rtol=0, atol=0.01)
    assert_allclose(found.asymmetry, exact.asymmetry, rtol=0, atol=0.01)


def test_few_spheres_stand_for_many_large_ones():
    # A law: areas add up; absorbing ones keep their mean absorption along the diameter.
    sizes = gamma_sizes(500e-6, 0.1, 800)
    area = sizes.weights @ sizes.radii**2
    for index, most in ((1.33 + 0j, 1), (1.5 + 1e-5j, 30)):
        few, indices = mie.computed_spheres(sizes, 550.0, index)
        large = few.radii == few.radii.max()
        assert 1 <= np.count_nonzero(large) <= most
        assert_allclose(few.weights @ few.radii**2, area, rtol=1e-12)
        length = few.weights @ (few.radii**3 * indices.imag)
        assert_allclose(length, sizes.weights @ sizes.radii**3 * index.imag, rtol=1e-12)


def test_blocks_of_radii_do_not_change_the_sums():
    # A law: the mean is linear in the particles.
    sizes = gamma_sizes(1e-6, 0.2, 130)
    whole = mie.scattering(sizes, 550.0, 1.5 + 0.01j, [0.0, 90.0, 180.0])
    halves = [
        mie.scattering(
            SizeNodes(sizes.radii[part], sizes.weights[part]), 550.0, 1.5 + 0.01j, [0, 90, 180]
        )
        for part in (slice(0, 70), slice(70, 130))
    ]
    assert_allclose(whole.extinction, sum(one.extinction for one in halves), rtol=1e-13)
    scattered = sum(one.scattering * one.phase for one in halves)
    assert_allclose(whole.scattering * whole.phase, scattered, rtol=1e-12)


def test_phase_matrices_of_spheres_obey_their_laws():
    # Hovenier, van der Mee & Domke (2004), section 2.4: a single sphere loses no polarisation,
    # F12² + F33² + F34² = F11², a mixture some of it; nothing is polarised forward and backward.
    angles = np.linspace(0.0, 180.0, 91)
    sphere = mie.scattering(single_size(0.3e-6), 550.0, 1.5 + 0.01j, angles).ratios
    assert_allclose(np.square(sphere).sum(axis=0), 1.0, rtol=0, atol=1e-9)
    mixed = mie.scattering(gamma_sizes(0.3e-6, 0.2, 200), 550.0, 1.5 + 0.01j, angles).ratios
    assert (np.square(mixed).sum(axis=0) <= 1.0 + 1e-9).all()
    assert np.square(mixed).sum(axis=0).min() < 0.95
    for f12, f33, f34 in (sphere, mixed):
        assert_allclose(f12[[0, -1]], 0.0, atol=1e-9)
        assert_allclose(f34[[0, -1]], 0.0, atol=1e-9)
        assert_allclose(f33[[0, -1]], [1.0, -1.0], atol=1e-9)
        assert (np.abs(f12) <= 1.0).all()


def test_phase_matrices_of_spheres_are_miepythons():
    # A second method: its amplitudes S1 (across the plane) and S2 (along it), Bohren & Huffman
    # (1983), eq. 4.77. Its index has the other sign of the imaginary part: so has its F34.
    angles = np.array([5.0, 40.0, 90.0, 135.0, 170.0])
    index, radius, nm = 1.5 + 0.01j, 0.3e-6, 550.0
    ours = mie.scattering(single_size(radius), nm, index, angles).ratios
    s1, s2 = miepython.S1_S2(
        index.conjugate(), 2e9 * np.pi * radius / nm, np.cos(np.radians(angles)), norm="bohren"
    )
    whole = np.abs(s1) ** 2 + np.abs(s2) ** 2
    across = (np.abs(s2) ** 2 - np.abs(s1) ** 2) / whole
    both = 2.0 * s2 * s1.conjugate() / whole
    assert_allclose(ours[:2], [across, both.real], rtol=0, atol=1e-8)
    assert_allclose(np.abs(ours[2]), np.abs(both.imag), rtol=0, atol=1e-8)


def test_tiny_spheres_polarise_as_molecules_do():
    # The limit of small spheres: Rayleigh's matrix.
    angles = np.linspace(0.0, 180.0, 19)
    nu = np.cos(np.radians(angles))
    f12, f33, f34 = mie.scattering(single_size(2e-9), 550.0, 1.5 + 0j, angles).ratios
    assert_allclose(f12, -(1.0 - nu**2) / (1.0 + nu**2), atol=1e-3)
    assert_allclose(f33, 2.0 * nu / (1.0 + nu**2), atol=1e-3)
    assert_allclose(f34, 0.0, atol=1e-3)


def test_a_cancelled_average_ends_between_radii():
    asked = iter((False, False, True))
    sizes = gamma_sizes(2e-6, 0.2, 800)
    with pytest.raises(Cancelled):
        mie.scattering(sizes, 550.0, 1.33 + 0j, [0.0], cancel=lambda: next(asked))
    assert next(asked, None) is None
