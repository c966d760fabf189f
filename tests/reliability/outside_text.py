"""Texts and values that come from outside and have broken programs before."""

from __future__ import annotations

import re

#: Names: markup of Rich, of matplotlib, of HTML; escape sequences, halves of pairs, null
#: characters; letters that fonts lack, that run to the left, that are not shown.
NAMES = (
    "[/x]", "[bold]", "$x_{$", "$$", "_hidden", "</script><b>", "<!--", "&amp;", "\x1b[31mred",
    "\x9b31m", "a\x00b", "\udc80", "a\nb", "a\tb", "\u202eabc", "❄ 大気", "🌍", "%s %d", "{name}",
    "\\", "'", '"', "`rm`", "x" * 61, "", " ", "../../x", "-o", "nan", "$\\alpha$", ":smile:",
)  # fmt: skip
#: Values of options, most of them wrong everywhere.
VALUES = (
    *NAMES, "5", "5 Pa", "1.5 R_earth", "1 degC", "8 kg", "inf", "-inf", "-1", "1e400", "9" * 400,
    "1e-400", "0", "-0.0", "1e12m", "0.5", "180", "89.99999", "1,2", "1,2,3", "0:90:30", "0:1:1e-9",
    "1:0:1", "rgb", "auto", "2x2", "0x0", "999999x999999", "100000", "8x6", "1_0", "٣", "0x10",
    "--", "-", "=", "a=b", "ground.albedo=0.5", "name=[/x]", "name=$x_{$", "air=3", "constituents=",
    "shell.top_radius=1 km", "/dev/full", "/dev/null", "loop", "loop/x.png", ".", "folder", "no/x",
    "a.png", "a.exr", "a.csv", "a.html", "a.svg", "planet.toml", "broken.toml", "2026-06-21T20:00Z",
    "earth", "mars-rayleigh", "earth-openspace", "Europe/Stockholm", "sun", "horizon", "NE/20",
)  # fmt: skip
#: Values of a planet file, as its text has them.
FILE_VALUES = (
    *("nan", "inf", "-inf", "0", "-1", "1e308", "1e-308", "-0.0", "1e999", "9" * 400, "true"),
    *("{}", "[]", "[[]]", '""', '"nan"', '"1e400 km"', '"680, 550 nm"', '"0 nm"', '"km"', '"8 kg"'),
    *('"1 m"', '"1e6 km"', '"1e9 m"', '"1e12 m"', "0.999", "-0.999", "0.5", "1", "1e-300"),
    *('"1e-12 /m"', '"1 /m"', '"0.01 /m"', '"1e-300 /m"', '"1e-6 deg"', '"30 deg"'),
    *('"20, 30, 1e6 nm"', '"1e9 W/m^2/nm"', '"exponential"', "[1, [2]]", "[nan, nan, nan]"),
    *("1979-05-27", "0x7f", '"1 km" # ', '"\\u0000"', "[1e308, 1e308, 1e308]", "[0, 0, 0]"),
    *('{ rayleigh = "air" }', '{ ozone = "1e30 DU" }', '"own.csv"', '"/dev/zero.csv"'),
    *("{ composition = { N2 = 1 } }", "{ N2 = 1e308, O2 = -1e308 }", "{ CO2 = 1 }"),
    '{ cross_section = "ozone-293k", number_density = "1e29 /m^3" }',
    *('"5"', "5", '"1.5 R_earth"', '"1 degC"', '"[/x]"', '"$x_{$"', '"\\u001b[31m"', '"❄"'),
    *('"</script>"', '"\\u202e"', '"_a"'),
)
#: Characters that a terminal obeys, other than the end of a line.
OBEYED = re.compile("[\x00-\x09\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\ud800-\udfff]")
