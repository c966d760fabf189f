"""Light of boxes of cloud: laws, exact limits, one-dimensional transfer and the I3RC consensus."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics
from airlight.errors import AirlightWarning, Cancelled, ConvergenceError, CostError, ParameterError
from airlight.kernel import memory
from airlight.planets.matter.phases.formulas import HenyeyGreenstein, Rayleigh
from airlight.solver.boxes.light import BoxAir, BoxLight
from airlight.solver.boxes.settings import BoxSettings, settings_for
from airlight.solver.boxes.solve import sky_directions, solve_box
from airlight.validation.i3rc import DIRECTIONS, EXPERIMENTS


def _optics(albedo=1.0, asymmetry=0.85, wavelengths=(550.0,)):
    count = len(wavelengths)
    return CloudOptics(
        wavelengths=np.array(wavelengths),
        extinction=np.ones(count),
        albedo=np.full(count, albedo),
        phase=HenyeyGreenstein(asymmetry=asymmetry),
    )


def _slab(depth, levels=24, **changes):
    cells = np.full((1, 1, levels), depth / 1000.0, np.float32)
    given = {"spacing": (100.0, 100.0, 1000.0 / levels), "base": 0.0, "beyond": "periodic"}
    return CloudField(extinction=cells, **(given | changes))


def _towards(zenith, azimuth=0.0):
    angle, turn = np.radians(zenith), np.radians(azimuth)
    return np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), np.cos(angle)


def _light(zenith=60.0, albedo=0.0, **changes):
    return BoxLight(towards=_towards(zenith), albedo=np.atleast_1d(albedo), **changes)


def _clumps(shape=(10, 8, 12), **changes):
    random = np.random.default_rng(3)
    cells = np.where(random.random(shape) < 0.4, random.random(shape) * 0.05, 0.0)
    given = {"spacing": (60.0, 50.0, 40.0), "base": 500.0, "beyond": "periodic"}
    return CloudField(**({"extinction": cells.astype(np.float32)} | given | changes))


@pytest.mark.parametrize(
    ("depth", "zenith", "albedo"), [(0.5, 30.0, 1.0), (8.0, 60.0, 1.0), (30.0, 75.0, 0.99)]
)
def test_a_uniform_field_agrees_with_discrete_ordinates_in_one_dimension(depth, zenith, albedo):
    # PythonicDISORT with 48 streams; 1 % of the incident light.
    from PythonicDISORT import pydisort

    mu, streams, ground = np.cos(np.radians(zenith)), 48, 0.2
    moments = 0.85 ** np.arange(streams + 1)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # albedos near 1
        _, up, down, _ = pydisort(
            np.array([depth]), np.array([min(albedo, 1.0 - 1e-9)]), streams, moments[None],
            mu, 1.0, 0.0, NLeg=streams, f_arr=moments[-1], BDRF_Fourier_modes=[ground],
            only_flux=True,
        )  # fmt: skip
    found = solve_box(_slab(depth), _optics(albedo), _light(zenith, ground), cache=False)
    assert_allclose(found.up, up(0.0), atol=0.01 * mu)
    assert_allclose(found.down + found.direct, sum(down(depth)), atol=0.01 * mu)


@pytest.mark.parametrize("experiment", [one for one in EXPERIMENTS if one.case == 1], ids=str)
@pytest.mark.parametrize(("quality", "spread", "mean"), [("default", 5, 2), ("preview", 10, 4)])
def test_the_step_cloud_agrees_with_the_consensus(experiment, quality, spread, mean):
    # I3RC case 1; targets in per cent of the mean of each quantity.
    field, cosine = experiment.field, experiment.towards[2]
    light = BoxLight(towards=experiment.towards, albedo=np.zeros(1))
    solution = solve_box(field, experiment.optics, light, quality=quality, cache=False)
    east = field.west + (np.arange(96) + 0.5) * field.spacing[0] / 3
    for name, expected in experiment.results.items():
        if name in DIRECTIONS:
            looking = -np.array(DIRECTIONS[name])
            altitude = field.top if looking[2] < 0.0 else field.base
            origins = np.stack([east, 0.0 * east, np.full_like(east, altitude)], axis=1)
            radiance = solution.radiance(origins, looking[None])[:, 0]
            found = np.pi / cosine * radiance.reshape(-1, 3).mean(axis=1)
        elif name in "RT":
            flux = solution.up if name == "R" else solution.down + solution.direct
            found = flux[:, 0, 0] / cosine
        else:
            continue
        off = 100.0 * (found - expected) / expected.mean()
        assert np.sqrt(np.mean(off**2)) < spread, name
        assert abs(off.mean()) < mean, name


def test_energy_is_conserved_in_three_dimensions():
    # Half a per cent of the incident light, over ground and with absorbing particles.
    light = _light(50.0, 0.4, ground=0.0, sky=lambda ways: np.full((len(ways), 1), 0.02))
    found = solve_box(_clumps(), _optics(0.98), light, cache=False)
    assert_allclose(found.report.energy, 0.0, atol=5e-3)
    incident = light.cosine + 0.02 * np.pi
    ground = 0.6 * (found.down + found.direct).mean()
    assert_allclose(found.up.mean() + ground + found.absorbed[0], incident, rtol=5e-3)


@pytest.mark.parametrize("beyond", ["periodic", "clear"])
def test_optically_thick_cells_beside_clear_ones_converge(beyond):
    # Cells of optical depth 12 to 18, as in a coarse grid of cumulus.
    cells = np.where(_clumps().extinction > 0.0, 0.3, 0.0)
    found = solve_box(
        _clumps(extinction=cells, beyond=beyond),
        _optics(),
        _light(60.0, 0.1, ground=0.0),
        quality="preview",
        cache=False,
    )
    assert found.report.sweeps < 40
    assert_allclose(found.report.energy, 0.0, atol=5e-3)
    assert np.all(found.moments[..., 0, :] > 0.0)


@pytest.mark.parametrize(("quality", "within"), [("preview", 0.02), ("default", 0.01)])
def test_thick_layers_let_through_what_diffusion_does(quality, within):
    # T = (3/7)(1 + 2 µ)/(3/4 (1 - g) τ + 1.07) of a conservative layer over black ground, King
    # (1987), J. Atmos. Sci. 44, 1734; cells of scaled optical depth 3.
    found = solve_box(_slab(100.0, 16), _optics(), _light(60.0), quality=quality, cache=False)
    assert found.report.sweeps < 20
    assert_allclose(found.report.energy, 0.0, atol=5e-3)
    expected = 0.5 * (3.0 / 7.0) * 2.0 / (0.75 * 0.15 * 100.0 + 1.07)
    assert_allclose(found.down + found.direct, expected, rtol=within)


@pytest.mark.parametrize("depth", [300.0, 1000.0])
@pytest.mark.parametrize(("quality", "within"), [("preview", 0.15), ("default", 0.08)])
def test_levels_too_thick_for_light_to_pass_are_split(depth, quality, within):
    # King's law again; in 16 levels as they are, 31 and 78 % too much light passes at preview. The
    # tolerance is chosen after the results, 0.1 % of the incident light.
    found = solve_box(_slab(depth, 16), _optics(), _light(60.0), quality=quality, cache=False)
    expected = 0.5 * (3.0 / 7.0) * 2.0 / (0.75 * 0.15 * depth + 1.07)
    assert_allclose(found.down + found.direct, expected, rtol=within)
    assert_allclose(found.report.energy, 0.0, atol=0.01)


def test_layers_of_air_too_thick_for_light_to_pass_are_named():
    # A level is split by what is in its cells, not by an even layer of other clouds.
    air = BoxAir(
        edges=np.array([0.0, 1000.0]),
        extinction=np.full((1, 1), 0.3),
        albedo=np.ones((1, 1)),
        moments=0.85 ** np.arange(9.0)[None, None],
    )
    with pytest.warns(AirlightWarning, match="levels of clouds have scaled optical depths"):
        solve_box(_slab(1.0, 16), _optics(), _light(60.0, air=air), quality="preview", cache=False)


def test_wide_cells_of_a_thick_layer_converge():
    # Cells ten times as wide as deep, horizontally of scaled optical depth 1 to 10.
    random = np.random.default_rng(5)
    columns = 0.06 * np.exp(random.normal(size=(12, 12, 1)) * 0.6)
    cells = np.repeat(columns, 16, axis=2).astype(np.float32)
    field = _clumps(extinction=cells, spacing=(200.0, 200.0, 20.0))
    found = solve_box(field, _optics(), _light(60.0, 0.1), quality="preview", cache=False)
    assert found.report.sweeps < 25
    assert_allclose(found.report.energy, 0.0, atol=5e-3)


def test_light_that_does_not_converge_is_refused():
    quality = replace(settings_for("preview"), max_sweeps=2)
    with pytest.raises(ConvergenceError, match="still changes"):
        solve_box(_slab(100.0, 16), _optics(), _light(60.0), quality=quality, cache=False)


def test_light_that_converges_slowly_is_warned_of(monkeypatch):
    monkeypatch.setattr("airlight.solver.boxes.iterate._REJECTED", 1.0)
    quality = replace(settings_for("preview"), max_sweeps=2)
    energy = pytest.warns(AirlightWarning, match="misses the balance of energy")
    with energy, pytest.warns(AirlightWarning, match="still changes"):
        solve_box(_slab(100.0, 16), _optics(), _light(60.0), quality=quality, cache=False)


def test_a_field_without_matter_changes_nothing():
    # Optical depth 1e-6: the ground sends back its share of sun and sky. Light that passes the
    # periodic sides of an empty box many times converges slowly.
    light = _light(40.0, 0.3, ground=0.0, sky=lambda ways: np.full((len(ways), 1), 0.05))
    found = solve_box(
        _clumps(extinction=_clumps().extinction * 1e-6), _optics(), light, cache=False
    )
    lit = light.cosine + 0.05 * np.pi
    assert_allclose(found.direct, light.cosine, rtol=1e-4)
    assert_allclose(found.up, 0.3 * lit, rtol=5e-3)
    down = found.radiance([[0.0, 0.0, 900.0]], [[0.0, 0.0, -1.0]])
    assert_allclose(down, 0.3 * lit / np.pi, rtol=5e-3)
    up = found.radiance([[0.0, 0.0, 600.0]], [[0.6, 0.0, 0.8]])
    assert_allclose(up, 0.05, rtol=1e-3)


@pytest.mark.parametrize("beyond", ["periodic", "clear"])
def test_light_turns_with_cloud_and_sun(beyond):
    # A quarter turn of field and sun about the vertical.
    field = _clumps((6, 6, 6), spacing=(50.0, 50.0, 40.0), beyond=beyond)
    turned = replace(field, extinction=np.rot90(field.extinction, axes=(0, 1)))
    quality = replace(settings_for("preview"), tolerance=1e-5)
    first, second = (
        solve_box(
            one,
            _optics(0.99),
            BoxLight(towards=_towards(55.0, angle), albedo=np.full(1, 0.2), ground=300.0),
            quality=quality,
            cache=False,
        )
        for one, angle in ((field, 20.0), (turned, 110.0))
    )
    assert_allclose(np.rot90(first.up), second.up, rtol=1e-3)
    assert_allclose(np.rot90(first.down), second.down, rtol=1e-3)
    mean = np.rot90(first.moments[..., 0, :])
    assert_allclose(mean, second.moments[..., 0, :], rtol=1e-3)


def test_a_drift_moves_the_box_with_its_lines_of_sight():
    still, moved = (
        solve_box(
            _clumps(beyond="clear", drift=drift),
            _optics(),
            _light(60.0),
            quality="preview",
            cache=False,
        )
        for drift in ((0.0, 0.0), (2000.0, -3000.0))
    )
    origins, looking = np.array([[0.0, 0.0, 2000.0], [100.0, 60.0, 2000.0]]), [[0.0, 0.0, -1.0]]
    found = moved.radiance(origins + np.array([2000.0, -3000.0, 0.0]), looking)
    expected = still.radiance(origins, looking)
    assert np.all(expected > 0.0)
    assert_allclose(found, expected, rtol=1e-4)


def test_clear_sides_let_in_the_light_of_clear_air():
    # Without cloud a finite box is as bright as one that repeats itself.
    air = BoxAir(
        edges=np.array([0.0, 2000.0]),
        extinction=np.full((1, 1), 2e-4),
        albedo=np.ones((1, 1)),
        moments=Rayleigh().moments([550.0], 3)[None],
    )
    light = _light(60.0, 0.3, ground=0.0, air=air)
    fields = [_clumps(extinction=np.zeros((5, 4, 6)), beyond=one) for one in ("clear", "periodic")]
    # In an empty box that repeats itself light passes many times: more sweeps.
    quality = replace(settings_for("preview"), tolerance=1e-4)
    found = [solve_box(field, _optics(), light, quality=quality, cache=False) for field in fields]
    assert_allclose(found[0].up, found[1].up, rtol=2e-3)
    assert_allclose(found[0].down, found[1].down, rtol=2e-3)
    views = [one.radiance([[0.0, 0.0, 0.0]], [[0.0, 0.0, 1.0]]) for one in found]
    assert_allclose(views[0], views[1], rtol=2e-3)


def test_depth_along_the_beam_is_that_of_the_cloud():
    # Uniform cloud of vertical depth 4, sun at 60°: twice that at the bottom.
    found = solve_box(_slab(4.0, levels=8), _optics(), _light(60.0), cache=False)
    middle = 8.0 * (1.0 - (np.arange(8) + 0.5) / 8)
    assert_allclose(found.unscaled_depth[0, 0], middle, rtol=1e-5)
    truncated = 0.85**6  # delta-M at degree 5
    assert_allclose(found.depth[0, 0], (1.0 - truncated) * middle, rtol=1e-4)
    rays = found.rays([[0.0, 0.0, 0.0]], [[0.6, 0.0, 0.8]])
    assert_allclose(rays.transmittance, np.exp(-(1.0 - truncated) * 4.0 / 0.8), rtol=1e-4)
    assert_allclose(rays.distance, 1250.0)
    assert not rays.grounded.any()


def test_wavelengths_are_independent_of_each_other():
    # Six wavelengths fill two groups of lanes, which may take different numbers of sweeps.
    many = _optics(wavelengths=np.linspace(400.0, 700.0, 6))
    many = replace(many, albedo=np.linspace(0.9, 1.0, 6))
    one = replace(_optics(), albedo=many.albedo[5:])
    quality = replace(settings_for("preview"), tolerance=1e-3)
    found = [
        solve_box(_clumps(), given, _light(30.0), quality=quality, cache=False)
        for given in (many, one)
    ]
    assert_allclose(found[0].moments[..., 5:], found[1].moments, atol=5e-3)


@pytest.mark.parametrize("beyond", ["periodic", "clear"])
def test_solutions_are_equal_again_and_from_the_cache(beyond, tmp_path, monkeypatch):
    monkeypatch.setenv("AIRLIGHT_CACHE", str(tmp_path))
    given = _clumps((6, 5, 6), beyond=beyond), _optics(), _light(30.0)
    first, second, fresh = (
        solve_box(*given, quality="preview", cache=cache) for cache in (True, True, False)
    )
    assert second.report.seconds == 0.0
    assert second.report.provenance == first.report.provenance
    for name in ("moments", "depth", "down", "direct", "up", "absorbed"):
        assert_array_equal(getattr(first, name), getattr(second, name))
        assert_array_equal(getattr(first, name), getattr(fresh, name))


def test_an_array_of_the_sky_is_that_of_its_function():
    def sky(ways):
        return 0.1 * (1.0 - ways[:, 2:]) + 0.05 * ways[:, :1]

    quality = "preview"
    given = [sky, sky(sky_directions(quality))]
    found = [
        solve_box(_clumps(), _optics(), _light(30.0, sky=one), quality=quality, cache=False).up
        for one in given
    ]
    assert_array_equal(*found)


def test_work_can_be_cancelled_and_large_boxes_are_refused(monkeypatch):
    with pytest.raises(Cancelled):
        solve_box(_clumps(), _optics(), _light(), cache=False, cancel=lambda: True)
    monkeypatch.setattr(memory, "free_memory", lambda: 1e5)
    with pytest.raises(CostError, match="box of"):
        solve_box(_clumps(), _optics(), _light(), cache=False)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: _light(albedo=1.5), "albedo"),
        (lambda: BoxLight(towards=(1.0, 1.0, 1.0), albedo=np.zeros(1)), "towards"),
        (lambda: solve_box(_slab(1.0), _optics(), _light(ground=10.0)), "ground"),
        (lambda: solve_box(_slab(1.0), _optics(), _light(albedo=[0.1, 0.2])), "albedo"),
        (lambda: solve_box(_slab(1.0), _optics(), _light(sky=np.zeros((2, 1)))), "sky"),
        (lambda: solve_box(_slab(1.0), _optics(), _light(), quality="best"), "preview"),
        (lambda: replace(settings_for("default"), azimuths=6), "azimuths"),
    ],
)
def test_bad_values_get_one_line(make, message):
    with pytest.raises(ParameterError, match=message):
        make()


def test_settings_are_taken_as_they_are():
    assert isinstance(settings_for("default"), BoxSettings)
