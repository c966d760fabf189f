"""Colours of four wavelengths against those of forty, on planets that were solved for both."""

from __future__ import annotations

import numpy as np
import pytest

from airlight.image.four_wavelengths import fitted_weights
from airlight.image.spectral import default_wavelengths, rgb_weights
from airlight.image.xyz import luminance, rgb_to_xyz
from airlight.planets import load_planet
from airlight.planets.picture_wavelengths import picture_wavelengths

#: Altitudes that stand for the ground, a balloon and space. [m]
PLACES = {"ground": 2.0, "35 km": 35e3, "400 km": 400e3}
#: Angles between sun and zenith; the last is a sun 4° below the horizon. [°]
SUNS = {"noon": 20.0, "afternoon": 60.0, "low sun": 85.0, "sunset": 89.5, "twilight": 94.0}
VIEWS = np.array([0, 30, 60, 75, 85, 89, 91, 95, 100, 105, 110, 120, 150])
AZIMUTHS = np.array([0, 20, 60, 120, 180])
#: What is darker than this beside the brightest of a picture is not compared.
DARK = 1e-3


def lines_of_sight():
    """Altitude, sun zenith, view zenith, azimuth of all lines, as four arrays, and their names."""
    kinds = [(place, sun) for place in PLACES for sun in SUNS]
    view, azimuth = (one.ravel() for one in np.meshgrid(VIEWS, AZIMUTHS, indexing="ij"))
    each = np.ones(view.size)
    lines = [(PLACES[place] * each, SUNS[sun] * each, view, azimuth) for place, sun in kinds]
    names = [kind for kind in kinds for _ in range(view.size)]
    return [np.concatenate(one) for one in zip(*lines, strict=True)], names


def ways(planet):
    """Name → wavelengths and weights: fitted, and what there was before."""
    star, limits = planet.star.irradiances, planet.wavelength_limits
    four, three = picture_wavelengths(planet, "four"), picture_wavelengths(planet, "three")
    samples, channels = default_wavelengths(4, *limits), default_wavelengths(3, *limits)
    return {
        "four, fitted": (four, fitted_weights(four, star)),
        "four, interpolated": (samples, rgb_weights(samples, star)),
        "three, fitted": (three, fitted_weights(three, star)),
        "three, a channel each": (channels, rgb_weights(channels, star)),
    }


def differences(rgb, reference):
    """ΔE of CIE 2000, difference of chromaticity xy, and of luminance relative to the reference.

    Each reference is exposed to half the luminance of white, so that dusk counts as noon does.
    """
    with np.printoptions():  # colour-science changes how NumPy prints, for everyone
        colour = pytest.importorskip("colour")
    exposure = 0.5 / luminance(reference)[:, None]
    xyz = [np.maximum(rgb_to_xyz(exposure * one), 1e-9) for one in (rgb, reference)]
    xy = [one[:, :2] / one.sum(axis=1, keepdims=True) for one in xyz]
    lab = [colour.XYZ_to_Lab(one) for one in xyz]
    return (
        colour.delta_E(*lab, method="CIE 2000"),
        np.hypot(*(xy[0] - xy[1]).T),
        np.abs(xyz[0][:, 1] / xyz[1][:, 1] - 1.0),
    )


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::Warning")  # of colour-science, about its own extras
@pytest.mark.parametrize(
    ("name", "median", "most", "largest"),
    [
        ("earth", 0.5, 1.0, 2.5),
        pytest.param("earth-volcanic", 0.5, 1.2, 3.0, marks=pytest.mark.validation),
        # the edge of ferric oxides at 560 nm is steep
        ("mars", 0.4, 1.0, 2.0),
        # methane's bands are narrower than the samples' distance
        pytest.param("titan", 4.0, 8.0, 10.0, marks=pytest.mark.validation),
        ("exoplanet", 0.4, 2.0, 2.5),
    ],
)
def test_four_wavelengths_have_the_colours_of_forty(name, median, most, largest, solved, tell):
    # A second method: forty wavelengths meet the whole spectrum within ΔE 0.1. ΔE 1 is just
    # noticed; most is what 95 % of all lines of sight keep.
    planet = load_planet(name)
    lines, names = lines_of_sight()

    def colours(wavelengths, weights):
        solution = solved(planet, tuple(wavelengths.tolist()), "preview")
        altitude, sun, view, azimuth = lines
        radiance = solution.radiance(
            altitude=altitude, sun_zenith=sun, view_zenith=view, azimuth=azimuth
        )
        return np.asarray(radiance) @ weights

    forty = default_wavelengths(40, *planet.wavelength_limits)
    reference = colours(forty, rgb_weights(forty, planet.star.irradiances))
    bright = luminance(reference)
    seen = np.zeros(bright.size, bool)
    for kind in dict.fromkeys(names):
        here = np.array([one == kind for one in names])
        seen |= here & (bright > max(DARK * bright[here].max(), 1e-6 * bright.max()))
    found = {}
    for way, chosen in ways(planet).items():
        delta, xy, relative = differences(colours(*chosen)[seen], reference[seen])
        found[way] = delta
        parts = [
            f"{np.median(one):.3g}/{np.quantile(one, 0.95):.3g}/{one.max():.3g}"
            for one in (delta, xy, relative)
        ]
        tell(f"{name}, {way}: ΔE {parts[0]}, xy {parts[1]}, luminance {parts[2]}")
    kept = [one for one, is_seen in zip(names, seen, strict=True) if is_seen]
    for group in (PLACES, SUNS):
        tell(
            f"{name}, four, fitted: "
            + ", ".join(
                f"{one} {np.median(here):.2f}/{np.quantile(here, 0.95):.2f}/{here.max():.2f}"
                for one in group
                if (here := found["four, fitted"][[one in kind for kind in kept]]).size
            )
        )
    fitted = found["four, fitted"]
    assert np.median(fitted) < median
    assert np.quantile(fitted, 0.95) < most
    assert fitted.max() < largest
    for way, delta in found.items():
        assert np.quantile(fitted, 0.95) <= np.quantile(delta, 0.95), way
