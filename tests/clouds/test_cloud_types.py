"""Generated clouds: cover and optical depth, seeds, periods, bases, spectra, widths."""

import numpy as np
import pytest
from scipy.ndimage import center_of_mass, label

from airlight.clouds import heaps
from airlight.clouds.cloud_grid import CloudGrid
from airlight.clouds.cloud_types import cloud_field
from airlight.clouds.fibres import TURN
from airlight.clouds.heaps import CONGESTUS, HUMILIS
from airlight.clouds.layers import STRATOCUMULUS, adiabatic, layer_extinction
from airlight.clouds.organisation import (
    SPECTRUM,
    gathered_places,
    number_density,
    overlapping,
)
from airlight.clouds.power_law_field import power_law_field
from airlight.planets.clouds import (
    CLOUD_TYPES,
    Cirrus,
    Cumulonimbus,
    CumulusCongestus,
    CumulusHumilis,
)
from airlight.validation.cloudy_lines import field_at


@pytest.mark.parametrize("kind", CLOUD_TYPES, ids=lambda kind: kind.keyword)
def test_cover_and_optical_depth_are_those_wanted(kind):
    for cover, depth in ((0.15, 5.0), (0.6, 30.0)):
        clouds = kind(cover=cover, optical_depth=depth, seed=3.0, beyond="periodic")
        columns = cloud_field(clouds, spacing=200.0).column_optical_depth
        cloudy = columns > 0.0
        np.testing.assert_allclose(cloudy.mean(), cover, rtol=0.01)
        np.testing.assert_allclose(columns[cloudy].mean(), depth, rtol=0.01)


@pytest.mark.parametrize("kind", CLOUD_TYPES, ids=lambda kind: kind.keyword)
def test_full_and_no_cover_are_kept(kind):
    full, none = (
        cloud_field(kind(cover=cover), size=6400.0, spacing=200.0) for cover in (1.0, 0.0)
    )
    assert np.all(full.column_optical_depth > 0.0)
    assert np.all(none.extinction == 0.0)


@pytest.mark.parametrize("kind", CLOUD_TYPES, ids=lambda kind: kind.keyword)
def test_a_seed_determines_the_field(kind):
    first, again, other = (
        cloud_field(kind(seed=seed), size=6400.0, spacing=200.0).extinction
        for seed in (1.0, 1.0, 2.0)
    )
    np.testing.assert_array_equal(first, again)
    assert np.abs(first - other).max() > 1e-3


@pytest.mark.parametrize("kind", CLOUD_TYPES, ids=lambda kind: kind.keyword)
def test_fields_have_no_seam(kind):
    # the change across the period is like that between neighbours within
    clouds = kind(beyond="periodic")
    columns = cloud_field(clouds, size=12800.0, spacing=200.0).column_optical_depth
    for axis in (0, 1):
        steps = np.abs(np.diff(columns, axis=axis, append=columns.take([0], axis))).mean(1 - axis)
        assert steps[-1] < max(3.0 * steps[:-1].mean(), steps[:-1].max())


def test_a_field_that_ends_has_whole_clouds():
    periodic, field = (
        cloud_field(CumulusHumilis(cover=0.1, seed=2.0, beyond=one))
        for one in ("periodic", "clear")
    )
    columns = field.column_optical_depth
    for side in (columns[0], columns[-1], columns[:, 0], columns[:, -1]):
        assert not side.any()
    assert columns.max() == periodic.column_optical_depth.max()
    assert 0.7 < (columns > 0.0).sum() / (periodic.column_optical_depth > 0.0).sum() < 1.0
    overcast = cloud_field(CumulusHumilis(cover=1.0, beyond="clear"), size=6400.0)
    assert np.all(overcast.column_optical_depth > 0.0)


@pytest.mark.parametrize("seed", [0.0, 1.0, 2.0])
def test_a_storm_is_narrow_below_its_anvil(seed):
    # cloudy shares of levels: most of the cover in the anvil, of which a fifth is the tower
    field = cloud_field(Cumulonimbus(seed=seed), spacing=200.0)
    share = (field.extinction > 0.0).mean(axis=(0, 1))
    assert share[52:].max() > 0.2
    assert 0.005 < share[24:40].min() < 0.06
    assert field.beyond == "clear"
    # the anvil reaches farther downwind, to the east, and holds less ice than the tower
    deep = field.column_optical_depth
    tower = np.unravel_index(deep.argmax(), deep.shape)
    anvil = np.argwhere((field.extinction[:, :, :40] == 0.0).all(axis=2) & (deep > 0.0)) - tower
    assert anvil[:, 0].mean() > 0.2 * np.abs(anvil[:, 0]).max()
    assert deep[tuple((anvil + tower).T)].mean() < 0.1 * deep.max()


def test_a_storm_without_room_for_an_anvil_is_finite():
    field = cloud_field(Cumulonimbus(cover=1e-3, beyond="periodic"), size=3200.0, spacing=200.0)
    assert np.isfinite(field.extinction).all()
    assert (field.column_optical_depth > 0.0).any()


def test_cumuli_have_flat_bases_and_grow_with_height():
    field = cloud_field(CumulusHumilis())
    low, high = (field.extinction[:, :, k] for k in (0, 8))
    cloudy = field.column_optical_depth > 1.0
    assert (low[cloudy] > 0.0).mean() > 0.7
    # h^(2/3) in the cores: 8.5 and 0.5 levels above the base
    np.testing.assert_allclose(high.max() / low.max(), 17.0 ** (2.0 / 3.0), rtol=0.02)


def test_widths_of_cumuli_follow_a_power_law():
    from airlight.clouds.heaps import WIDTHS, cloud_widths

    grid = CloudGrid(columns=1024, levels=4, spacing=25.0, depth=900.0)
    widths = cloud_widths(grid, np.random.default_rng(0), 2000.0, 0.3)
    # the share above w is that of the integral of w^-1.7
    low, high, power = widths.min(), 2000.0, 1.0 - WIDTHS
    for width in (300.0, 600.0, 1200.0):
        share = (width**power - high**power) / (low**power - high**power)
        error = 4.0 * np.sqrt(share * (1.0 - share) / widths.size)
        np.testing.assert_allclose((widths > width).mean(), share, atol=error)


def test_strewn_cumuli_are_those_of_the_radiances_by_monte_carlo():
    """Their sum when the radiances were traced; a change makes the reference invalid. Compiled
    code rounds places of thermals differently, by 5e-12 m, and the sum by 2e-9."""
    total = field_at([550.0])[0].extinction.sum(dtype=np.float64)
    assert total == pytest.approx(8738.133338, rel=1e-8)


def _counts(clouds):
    """Number of separate clouds in squares of 3.2 km."""
    marked, count = label(cloud_field(clouds).column_optical_depth > 0.0)
    middles = np.array(center_of_mass(marked > 0, marked, range(1, count + 1)))
    return np.histogram2d(*middles.T, bins=8, range=[(0, 256)] * 2)[0]


@pytest.mark.parametrize("seed", [0.0, 1.0, 2.0])
def test_cumuli_are_strewn_or_gathered(seed):
    """Variance of counts over their mean: 1 at random, less of clouds that keep apart. Clouds that
    gather grow together: their cover varies instead."""
    counts = _counts(CumulusHumilis(seed=seed, organisation=0.0))
    assert 0.4 < counts.var() / counts.mean() < 0.8
    covers = [
        (columns > 0.0).reshape(8, 32, 8, 32).mean(axis=(1, 3)).var()
        for organisation in (0.0, 1.6)
        for columns in [
            cloud_field(CumulusHumilis(seed=seed, organisation=organisation)).column_optical_depth
        ]
    ]
    assert covers[1] > 2.0 * covers[0]


@pytest.mark.parametrize("cover", [0.1, 0.25])
def test_sizes_of_cumuli_as_seen_from_above_have_the_published_slope(cover):
    """Diameters of equal area fall as D^-2.19 (Zhao & Di Girolamo 2007, JGR 112, D24205): trade
    cumuli of a cover of 0.086, half of it of clouds below 2 km. Other places have 2.93 (De Vera
    et al. 2024, ACP 24, 5603) and, in simulations, 1.7. Bins of 24 clouds or more, as DeWitt &
    Garrett (2024), ACP 24, 8457."""
    found = []
    for seed in range(8):
        cloudy = cloud_field(CumulusHumilis(cover=cover, seed=float(seed))).column_optical_depth > 0
        marked, _ = label(cloudy)
        found.append(np.sqrt(np.bincount(marked.ravel())[1:] * 0.01 * 4.0 / np.pi))
    widths = np.sort(np.concatenate(found))
    edges = np.geomspace(0.3, 6.0, 10)
    counts, _ = np.histogram(widths, bins=edges)
    enough = counts >= 24
    middles = np.sqrt(edges[1:] * edges[:-1])[enough]
    slope = np.polyfit(np.log(middles), np.log((counts / np.diff(edges))[enough]), 1)[0]
    np.testing.assert_allclose(slope, -2.19, atol=0.3)
    if cover == 0.1:
        half = widths[np.searchsorted(np.cumsum(widths**2), 0.5 * (widths**2).sum())]
        assert 1.0 < half < 2.0


def test_number_density_has_a_spectrum_that_falls_as_a_power():
    grid = CloudGrid(columns=512, levels=4, spacing=100.0, depth=900.0)
    density = number_density(grid, np.random.default_rng(2), 2000.0, 0.0, 1.3)
    assert density.mean() == pytest.approx(1.0)
    assert np.log(density).std() == pytest.approx(1.3)
    power = (np.abs(np.fft.rfft(np.log(density), axis=0)) ** 2).mean(axis=1)
    bands = np.array([power[n : 2 * n].mean() for n in (16, 32, 64)])
    slope = np.polyfit(np.log([16.0, 32.0, 64.0]), np.log(bands), 1)[0]
    np.testing.assert_allclose(slope, SPECTRUM, atol=0.35)


def test_shear_stretches_streets_along_the_wind():
    grid = CloudGrid(columns=256, levels=4, spacing=100.0, depth=900.0)
    log = np.log(number_density(grid, np.random.default_rng(2), 2000.0, 5e-4, 1.3))
    along, across = (np.mean((np.roll(log, 10, axis) - log) ** 2) for axis in (0, 1))
    assert across > 1.5 * along


def test_area_of_clouds_that_overlap_at_random_gives_their_cover():
    """Discs at random places of the density, by the law of empty space."""
    grid = CloudGrid(columns=256, levels=1, spacing=100.0, depth=900.0)
    random = np.random.default_rng(5)
    density = number_density(grid, random, 2000.0, 5e-4, 1.3)
    area = overlapping(0.3, density)
    covered = np.zeros(density.shape, bool)
    reach = 2  # discs of 2 cells: 13 of them
    x, y = np.mgrid[-reach : reach + 1, -reach : reach + 1]
    disc = x**2 + y**2 <= reach**2
    count = round(area * density.size / disc.sum())
    places = gathered_places(grid, random, np.full(count, 500.0), density)
    for i, j in (places // grid.spacing).astype(int):
        covered[(i + x[disc]) % 256, (j + y[disc]) % 256] = True
    assert covered.mean() == pytest.approx(0.3, abs=0.015)


def test_optical_depth_of_stratocumulus_falls_as_wavenumber_to_the_five_thirds():
    grid = CloudGrid(columns=512, levels=4, spacing=50.0, depth=300.0)
    random = np.random.default_rng(4)
    parts = {"cell": 3000.0, "cover": 1.0, "shear": 0.0}
    columns = np.log(layer_extinction(grid, random, pattern=STRATOCUMULUS, **parts).sum(axis=2))
    plain = power_law_field(grid, random, longest=3000.0)
    for field, tolerance in ((plain, 0.15), (columns, 0.35)):
        power = (np.abs(np.fft.rfft(field, axis=0)) ** 2).mean(axis=1)
        bands = np.array([power[n : 2 * n].mean() for n in (16, 32, 64)])
        slope = np.polyfit(np.log([16.0, 32.0, 64.0]), np.log(bands), 1)[0]
        np.testing.assert_allclose(slope, -5.0 / 3.0, atol=tolerance)


def test_layers_are_adiabatic():
    # means over cells of h^(2/3) up to the top; the optical depth grows as the 5/3rd power
    grid = CloudGrid(columns=4, levels=40, spacing=50.0, depth=400.0)
    depths = np.full((4, 4), 200.0)
    depths[0] = 400.0
    layer = adiabatic(grid, depths)
    np.testing.assert_allclose(layer[0, 0, 1:], grid.heights[1:] ** (2.0 / 3.0), rtol=0.01)
    assert np.all(layer[1, 0, 20:] == 0.0)
    np.testing.assert_allclose(layer.sum(2)[0] / layer.sum(2)[1], 2.0 ** (5.0 / 3.0), rtol=1e-9)


def test_congestus_is_as_deep_as_wanted():
    field = cloud_field(CumulusCongestus())
    levels = np.nonzero((field.extinction > 0.0).any(axis=(0, 1)))[0]
    assert field.top == 5500.0
    assert levels[-1] >= 25


@pytest.mark.parametrize("seed", [0.0, 1.0])
def test_towers_of_congestus_hardly_hang_over(seed):
    """Columns without cloud in the lowest quarter: a fortieth of the cloudy ones at most."""
    cloudy = cloud_field(CumulusCongestus(seed=seed)).extinction > 0.0
    lowest = cloudy.argmax(axis=2)[cloudy.any(axis=2)]
    assert np.mean(lowest > 8) < 0.025


def test_fibres_of_cirrus_trail_by_the_square_of_the_depth():
    # Δx = s Δh²/(2 v), Heymsfield (1975), with v = 0.8 m/s
    field = cloud_field(Cirrus(cover=1.0, shear=2e-3), size=25.6e3)
    top, lower = (np.log(field.extinction[:, :, k] + 1e-9) for k in (29, 12))
    product = np.fft.rfft2(top - top.mean()) * np.conj(np.fft.rfft2(lower - lower.mean()))
    shift = np.unravel_index(np.argmax(np.fft.irfft2(product)), top.shape)
    below = [(32 - k - 0.5) * field.spacing[2] for k in (29, 12)]
    expected = 2e-3 * (below[1] ** 2 - below[0] ** 2) / (2.0 * 0.8)
    assert field.trail * (below[1] ** 2 - below[0] ** 2) == pytest.approx(expected)
    assert abs(shift[0] * 100.0 - expected) < 250.0
    aside = TURN * field.trail * 32.0 * field.spacing[2] * (below[1] - below[0])
    assert abs(shift[1] * 100.0 - aside) < 150.0


@pytest.mark.parametrize("seed", [0.0, 1.0])
def test_fibres_of_cirrus_are_fine_across_and_long_along(seed):
    """Distances at which the optical depths of columns are alike by a half."""
    columns = cloud_field(Cirrus(seed=seed)).column_optical_depth
    spectrum = np.abs(np.fft.fft2(columns - columns.mean())) ** 2
    alike = np.fft.ifft2(spectrum).real
    alike /= alike[0, 0]
    across = np.argmax(alike[0] < 0.5)
    along = np.array([max(alike[-n, m] for m in range(-n, 1)) for n in range(60)])
    assert across <= 3
    assert np.argmax(along < 0.5) > 3 * across


@pytest.mark.parametrize("shape", [HUMILIS, CONGESTUS])
def test_compiled_thermals_are_those_of_numpys_generator(shape, monkeypatch):
    # Second method: the same source in Python, which draws by NumPy itself; and the next draw.
    clouds = np.array([[100.0, 200.0, 1500.0], [900.0, 50.0, 400.0], [300.0, 700.0, 260.0]])
    numbers = shape, 1e-3, 900.0, 30.0, 100.0
    randoms = [np.random.default_rng(5) for _ in range(2)]
    found = heaps._thermals(randoms[0], clouds, *numbers)
    for name in ("_cloud", "_plume", "_bulges"):
        monkeypatch.setattr(heaps, name, getattr(heaps, name).py_func)
    expected = heaps._thermals.py_func(randoms[1], clouds, *numbers)
    assert found.shape[0] > 100
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)
    assert randoms[0].random() == randoms[1].random()
