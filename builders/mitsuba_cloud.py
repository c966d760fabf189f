"""Remake ``validation/data/finite-cloud.csv``: a finite cloud over a plane by Mitsuba 3.

Run with ``python builders/mitsuba_cloud.py`` where mitsuba is installed (the extra ``dev``); takes
ten minutes on two cores. Mitsuba's path tracer with null collisions (``volpathmis``), cells of
constant extinction (``gridvolume``), no air.
"""

from __future__ import annotations

import sys
from pathlib import Path

import mitsuba as mi
import numpy as np

from airlight.validation.finite_cloud import (
    ALBEDO,
    ASYMMETRY,
    FILE,
    GROUND_ALBEDO,
    HALF_WIDTH,
    PIXELS,
    SUN,
    VIEWS,
    CloudView,
    centre,
    finite_cloud,
)

OUT = Path(__file__).parents[1] / "src" / "airlight" / "validation" / FILE
#: Independent pictures, and samples per pixel of each.
PICTURES, SAMPLES = 32, 2048
#: Half the width of the plane, and distance of the camera. [m]
PLANE, AWAY = 1e5, 3e3
HEAD = """\
# Radiance of a finite cloud over a Lambertian plane per irradiance of the sun, means over pixels,
# by Mitsuba {version}, {count} independent pictures of {samples} samples per pixel. Field, views
# and pixels: validation/finite_cloud.py. Made by builders/mitsuba_cloud.py.
view,row,column,radiance,error
"""


def world(view: CloudView) -> dict[str, object]:
    """Scene of a view."""
    field = finite_cloud()
    cells = np.ascontiguousarray(field.extinction.transpose(2, 1, 0)[..., None])
    low = [field.west, field.south, field.base]
    size = [2.0 * -field.west, 2.0 * -field.south, field.top - field.base]
    place = mi.ScalarTransform4f().translate(low).scale(size)
    target = np.array([0.0, 0.0, centre()])
    # A camera from below the plane would see its back: the zenith view starts just above it.
    away = AWAY if view.along[2] < 0.0 else centre() - 1.0
    origin = target - away * np.array(view.along)
    _, upwards = view.axes
    look = mi.ScalarTransform4f().look_at(
        origin=origin.tolist(), target=target.tolist(), up=upwards.tolist()
    )
    return {
        "type": "scene",
        "integrator": {"type": "volpathmis", "max_depth": -1, "rr_depth": 200},
        "sun": {"type": "directional", "direction": [-x for x in SUN], "irradiance": 1.0},
        "plane": {
            "type": "rectangle",
            "to_world": mi.ScalarTransform4f().scale([PLANE, PLANE, 1.0]),
            "bsdf": {"type": "diffuse", "reflectance": {"type": "uniform", "value": GROUND_ALBEDO}},
        },
        "cloud": {
            "type": "cube",
            # The cube of Mitsuba is from -1 to 1.
            "to_world": place @ mi.ScalarTransform4f().translate([0.5] * 3).scale([0.5] * 3),
            "bsdf": {"type": "null"},
            "interior": {
                "type": "heterogeneous",
                "albedo": {"type": "constvolume", "value": {"type": "uniform", "value": ALBEDO}},
                "sigma_t": {
                    "type": "gridvolume",
                    "grid": mi.VolumeGrid(cells.astype(np.float32)),
                    "filter_type": "nearest",
                    "to_world": place,
                    "raw": True,
                },
                "phase": {"type": "hg", "g": ASYMMETRY},
            },
        },
        "sensor": {
            "type": "orthographic",
            "to_world": look @ mi.ScalarTransform4f().scale([HALF_WIDTH, HALF_WIDTH, 1.0]),
            "film": {
                "type": "hdrfilm",
                "width": PIXELS,
                "height": PIXELS,
                "rfilter": {"type": "box"},
                "pixel_format": "luminance",
                "component_format": "float32",
            },
            "sampler": {"type": "independent", "sample_count": SAMPLES},
        },
    }


def pixel_order(view: CloudView, scene: mi.Scene) -> np.ndarray:
    """Indices of pixels, row by row of ``CloudView.points``, by the origins of its rays."""
    sensor = scene.sensors()[0]
    across, upwards = view.axes
    order = np.full((PIXELS, PIXELS), -1)
    for row in range(PIXELS):
        for column in range(PIXELS):
            at = mi.Point2f((column + 0.5) / PIXELS, (row + 0.5) / PIXELS)
            ray, _ = sensor.sample_ray(0.0, 0.5, at, mi.Point2f(0.5))
            origin = np.ravel(ray.o)
            np.testing.assert_allclose(np.ravel(ray.d), view.along, atol=1e-5)
            x, y = (
                round(
                    (float(origin @ axis) - centre() * axis[2] + HALF_WIDTH)
                    * PIXELS
                    / (2 * HALF_WIDTH)
                    - 0.5
                )
                for axis in (across, upwards)
            )
            order[y, x] = row * PIXELS + column
    assert sorted(order.ravel()) == list(range(PIXELS**2))
    return order


def main() -> None:
    mi.set_variant("llvm_ad_mono" if "--llvm" in sys.argv else "scalar_rgb")
    rows = []
    for number, view in enumerate(VIEWS):
        scene = mi.load_dict(world(view))
        order = pixel_order(view, scene)
        shots = np.array(
            [
                np.array(mi.render(scene, seed=seed))[..., 0].ravel()[order]
                for seed in range(PICTURES)
            ]
        )
        mean, error = shots.mean(axis=0), shots.std(axis=0, ddof=1) / PICTURES**0.5
        print(
            view.name, f"mean {mean.mean():.4f}, error {error.mean() / mean.mean():.2%}", flush=True
        )
        rows += [
            f"{number},{y},{x},{mean[y, x]:.6g},{error[y, x]:.2g}"
            for y in range(PIXELS)
            for x in range(PIXELS)
        ]
    head = HEAD.format(version=mi.__version__, count=PICTURES, samples=SAMPLES)
    OUT.write_text(head + "\n".join(rows) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
