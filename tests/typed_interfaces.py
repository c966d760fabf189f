"""Texts and quantities as users write them: mypy checks this file with the package."""

from __future__ import annotations

from dataclasses import replace

import airlight


def accepted() -> None:
    """Every call has the types of its parameters; what is ignored must be an error."""
    camera = airlight.Camera(field_of_view="1 rad", look_zenith=30)
    scene = airlight.Scene(altitude="400 km", sun_azimuth="SW", camera=camera)
    higher: float = 2.0 * replace(scene, altitude="500 km").altitude
    airlight.render("earth", replace(scene, altitude=higher))
    sky = airlight.solve("earth", "0.5:0.6:0.05 um", "preview")
    sky.radiance(altitude="2 km", sun_zenith="60 deg", view_zenith=["0 deg", "40 deg"])
    airlight.observe("earth", "limb", tangent_heights="0:20:10 km")
    airlight.Scene(altitude=None)  # type: ignore[arg-type]
