/** Uniforms of the view, with the names of gpu/picture/uniforms.py. */
import {
  PIXEL_ANGLES,
  finest_cell,
  lattice_origin,
  observer_uniforms,
  apparent_sun_cosine,
} from "../generated/formulas.js";
import { NOMINAL_ROWS } from "../generated/sizes.js";

/**
 * Uniforms of the observer and the star.
 *
 * @param {object} planet `radius`, `thickness` [m], `flattening` [1], `star` [rad], and `geometry`
 *     with refraction.
 * @param {number} altitude Altitude of the observer. [m]
 * @param {number[]} sun Unit vector towards the star, in the observer's frame.
 */
export function observerUniforms(planet, altitude, sun) {
  const { radius, thickness, flattening, star, geometry } = planet;
  const outside = altitude >= thickness;
  const r = geometry ? opticalRadius(planet, altitude) : radius + altitude;
  const bottom = geometry ? geometry.bottom : radius;
  const apparentSunMu = apparentCosine(planet, altitude, sun[2]);
  const [horizonMu, horizonSine, level, seenLevel, disc] = observer_uniforms(
    r,
    bottom,
    sun[0],
    sun[1],
    apparentSunMu,
    star,
  );
  return {
    r: Math.fround(bottom) + (r - bottom),
    optical_altitude: r - bottom,
    outside: Number(outside),
    flattening: outside ? flattening : 0,
    ...vectors({ centre: [0, 0, -r] }),
    horizon_mu: horizonMu,
    horizon_sine: horizonSine,
    sun_x: level,
    sun_z: sun[2],
    seen_x: seenLevel,
    seen_z: apparentSunMu,
    disc,
    draws_disc: Number(star > 0),
  };
}

/** Cosine of the apparent zenith angle of a point at infinity from that of its true one. */
export function apparentCosine(planet, altitude, mu) {
  const { geometry, thickness } = planet;
  if (!geometry || altitude >= thickness) return mu;
  const { bottom, top, refraction_table: table } = geometry;
  return apparent_sun_cosine(opticalRadius(planet, altitude), mu, bottom, top, table);
}

/** Apparent direction of a point at infinity, in axes of which the last is to the zenith. */
export function raised(planet, altitude, [x, y, z]) {
  const seen = apparentCosine(planet, altitude, z);
  const level = Math.hypot(x, y);
  const scale = level > 0 ? Math.sqrt(Math.max(1 - seen ** 2, 0)) / level : 0;
  return level > 0 ? [x * scale, y * scale, seen] : [x, y, z];
}

/** Uniforms of the camera. */
export function cameraUniforms(camera, width, height, projections) {
  const { projection, fieldOfView: field, axes, ground, filter, dehaze } = camera;
  return {
    width,
    height,
    field_of_view: field,
    projection: Object.keys(projections).indexOf(projection),
    samples: 1,
    edges: 1,
    filter: Number(Boolean(filter)),
    dehaze,
    pixel_angle: PIXEL_ANGLES[projection](width, height, field),
    ...vectors({ filter_axis: filter ?? [0, 0, 0] }),
    ...vectors({ right: axes[0], up: axes[1], forward: axes[2] }),
    ...vectors({ ground_x: ground[0], ground_y: ground[1], ground_z: ground[2] }),
  };
}

/** Uniforms of vectors: their names with those of the components. */
function vectors(byName) {
  const named = ([name, vector]) => ["x", "y", "z"].map((c, i) => [`${name}_${c}`, vector[i]]);
  return Object.fromEntries(Object.entries(byName).flatMap(named));
}

/** Uniforms of the ground noise below the camera. */
export function detailUniforms({ radius, geometry, ground }, camera) {
  const bottom = geometry ? geometry.bottom : radius;
  const cell = finest_cell(bottom, ground?.rows ?? NOMINAL_ROWS);
  const origins = camera.ground.map((row) => lattice_origin(row[2], bottom, cell));
  const [whole, part] = [0, 1].map((i) => origins.map((origin) => origin[i]));
  return { detailed: Number(camera.detailed), detail_cell: cell, ...vectors({ whole, part }) };
}

/** Optical radius n·r of an observer. [m] */
function opticalRadius({ radius, thickness, geometry }, altitude) {
  if (altitude > thickness) return radius + altitude;
  const { excess } = geometry;
  const x = (altitude / thickness) * (excess.length - 1);
  const node = Math.min(Math.floor(x), excess.length - 2);
  return radius + altitude + excess[node] + (x - node) * (excess[node + 1] - excess[node]);
}
