"""Options that change a picture, and what each picture of the page of commands shows."""

from __future__ import annotations

from pathlib import Path

FOLDER = Path(__file__).parents[1] / "images" / "options"

#: What the left picture of each pair is of.
BASES = {"render": "earth --altitude 2m --sun-zenith 80 --look 82,25 --size 200x112"}

#: Option, and what is added for the right picture.
OPTIONS = {
    ("render", "--set"): "--set aerosol.amount=8",
    ("render", "--ground-albedo"): "--ground-albedo 0.8",
    ("render", "--star-temperature"): "--star-temperature 3000K",
    ("render", "--altitude"): "--altitude 12km",
    ("render", "--sun-zenith"): "--sun-zenith 91",
    ("render", "--look"): "--look 60,120",
    ("render", "--fov"): "--fov 110",
    ("render", "--roll"): "--roll 20deg",
    ("render", "--projection"): "--projection fisheye --size 112x112",
    ("render", "--polariser"): "--polariser 90deg --look 78,90",
    ("render", "--exposure"): "--exposure -7",
    ("render", "--tone-map"): "--tone-map agx",
    ("render", "--glare"): "--glare 0",
    ("render", "--white-balance"): "--white-balance d65",
    ("render", "--iso"): "--iso 100 --aperture 16 --shutter 1/100",
    ("render", "--style"): "--style punchy",
    ("render", "--second-star"): "--second-star 80,40,3500K,0.4deg",
}
