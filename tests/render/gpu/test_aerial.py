"""Look-ups of aerial perspective in WGSL against the CPU's."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.testing import assert_allclose

from airlight.engines.composition.aerial_perspective import AerialPerspective
from airlight.engines.composition.aerial_reading import (
    air_radiance,
    air_transmittance,
    sky_radiance,
)
from airlight.engines.composition.aerial_shader import TEXTURES, bound_tables
from airlight.kernel.lanes import LANES
from airlight.render.gpu.emit.shader_types import StructValue

COUNT = 2000


def test_a_device_reads_the_air_as_the_cpu(
    on_gpu: Callable[..., Any], aerial: AerialPerspective
) -> None:
    rng = np.random.default_rng(3)
    unit = rng.normal(size=(COUNT, 3))
    unit /= np.linalg.norm(unit, axis=1, keepdims=True)
    unit = unit.astype(np.float32).astype(np.float64)
    away = 10.0 ** rng.uniform(0.0, 6.0, COUNT)
    tables = StructValue(bound_tables(aerial.tables))
    spectra = {name: getattr(aerial.tables, name).reshape(-1, LANES)[:, :4] for name in TEXTURES}
    radiance, transmittance = aerial.air(unit, away)
    given = (*unit.T, away, tables)
    seen = on_gpu(air_radiance, *given, spectra=spectra)[:, :3]
    assert_allclose(seen, radiance, rtol=2e-4, atol=2e-5 * radiance.max())
    seen = on_gpu(air_transmittance, *given, spectra=spectra)[:, :3]
    assert_allclose(seen, transmittance, atol=2e-5)
    seen = on_gpu(sky_radiance, *unit.T, 1e-3, tables, spectra=spectra)[:, :3]
    sky = aerial.sky(unit, 1e-3)
    assert_allclose(seen, sky, rtol=2e-3, atol=1e-5)
