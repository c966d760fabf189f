"""How bright planets are: geometric albedos, from the moments, beside telescopes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import load_planet, replace
from airlight.solver.moments.solution import MomentsSolution
from airlight.validation.published.giant_planets import disc_albedo, seen_albedos
from airlight.validation.published.other_planets import ALBEDOS
from airlight.validation.published.rayleigh_sphere import geometric_albedo


@pytest.mark.parametrize(
    ("name", "wavelengths", "expected", "within"),
    [
        # Mallama (2007), Icarus 192, 404: R, V, B. The ground has these albedos, and the dust,
        # which is part of them, must not change them by more than 15 %
        ("mars", (700.0, 550.0, 440.0), (0.289, 0.170, 0.089), 0.15),
        # Mallama, Krobusek & Pavlov (2017), Icarus 282, 19, Table 7: R, V, B, by which the
        # ground's albedo is set: three digits
        ("mercury", (700.0, 550.0, 440.0), (0.172, 0.142, 0.105), 0.01),
        # optics.moon_phase: 0.1498 at 550 nm, 0.1168 at 440 nm, as the ground's
        ("moon", (550.0, 440.0), (0.1498, 0.1168), 0.01),
        # NASA, Pluto Fact Sheet: 0.52 in the visible, from 0.72, which the ground has
        ("pluto", (550.0,), (0.52,), 0.10),
        # NASA, Neptunian Satellite Fact Sheet: 0.76, two digits; published grains
        ("triton", (550.0,), (0.76,), 0.10),
        # NASA, Saturnian Satellite Fact Sheet: 0.2, one digit
        pytest.param("titan", (550.0,), (0.2,), 0.25, marks=pytest.mark.slow),
        # Mallama, Wang & Howard (2006), Icarus 182, 10: V 0.67; clouds vary by some per cent
        pytest.param("venus", (550.0,), (0.67,), 0.10, marks=pytest.mark.slow),
    ],
)
def test_geometric_albedos_are_those_that_telescopes_see(
    name: str,
    wavelengths: tuple[float, ...],
    expected: tuple[float, ...],
    within: float,
    solved: Callable[..., MomentsSolution],
    tell: Callable[[str], None],
) -> None:
    ours = geometric_albedo(solved(load_planet(name), wavelengths, "preview"))
    tell(f"{name}: geometric albedo {ours.round(3)} at {wavelengths} nm, seen {expected}")
    assert_allclose(ours, expected, rtol=within)


@pytest.mark.filterwarnings("ignore::airlight.AirlightWarning")  # of the methane
def test_methane_darkens_titan_as_the_telescope_saw(
    solved: Callable[..., MomentsSolution], tell: Callable[[str], None]
) -> None:
    # Karkoschka (1998), Icarus 133, 134, the full disc, 10 nm means. In the bands about 720 and
    # 800 nm within 15 % (4 % calibration, 2 % phase, one coefficient for a mean over lines);
    # without methane a quarter too bright and more
    nm = (800.0, 720.0)
    titan = load_planet("titan")
    both = titan, replace(titan, constituents=titan.constituents[:-1])
    seen = np.array([ALBEDOS[one] for one in nm])
    ours, without = (geometric_albedo(solved(one, nm, "preview")) for one in both)
    tell(f"titan at {nm} nm: {ours.round(3)}, without methane {without.round(3)}, seen {seen}")
    assert_allclose(ours, seen, rtol=0.15)
    assert np.all(without > 1.24 * seen)


@pytest.mark.parametrize("name", [pytest.param("venus", marks=pytest.mark.slow), "titan"])
def test_the_light_on_the_ground_of_venus_and_titan_is_orange(
    name: str, solved: Callable[..., MomentsSolution], tell: Callable[[str], None]
) -> None:
    # Venera 13: Pieters et al. (1986), Science 234, 1379, had to take out "orange-colored incident
    # radiation"; Huygens: Tomasko et al. (2005), Nature 438, 765. Orange: each colour much weaker
    # than the last, over the star's own light
    solution = solved(load_planet(name), (680.0, 550.0, 440.0), "preview")
    light = solution.irradiance(altitude=0.0, sun_zenith=50.0)
    share = (light["direct"] + light["diffuse"]).to_numpy().ravel()
    red, green, blue = share / solution.medium.solar_irradiance
    tell(f"{name}: of red, green, blue the ground gets {red:.3g}, {green:.3g}, {blue:.3g}")
    assert 0.0 < blue < 0.5 * green
    assert green < 0.75 * red
    # Venera 8 (Avduevsky et al. 1973, J. Atmos. Sci. 30, 1215) and Huygens: some per cent in all
    assert 0.01 < green < 0.2


@pytest.mark.slow
@pytest.mark.parametrize("name", ["jupiter", "saturn", "uranus", "neptune", "titan"])
def test_discs_of_the_giant_planets_and_titan_have_the_albedos_that_telescopes_see(
    name: str,
    solved: Callable[..., MomentsSolution],
    tell: Callable[[str], None],
) -> None:
    # Karkoschka (1998), means over 10 nm; targets: median 10 %, worst 20 %. Wavelengths between
    # those of the presets' lists, the bands of Uranus and Neptune, and Titan were not fitted.
    nm, seen = seen_albedos(name)
    nm, seen = nm[4:35:2], seen[4:35:2]
    ours = disc_albedo(solved(load_planet(name), tuple(nm.tolist()), "preview"), name)
    error = 100.0 * np.abs(ours / seen - 1.0)
    tell(f"{name}: median {np.median(error):.1f} %, worst {error.max():.1f} %")
    assert np.median(error) < 10.0
    assert error.max() < 20.0
