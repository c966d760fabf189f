/** The uniforms that belong to the view; their names are those of gpu/uniforms.py. */

/** Orders of scattering as the shaders count them stand in the program; the rest is geometry. */

/** Angle of a pixel where the camera looks straight ahead, for each projection. [rad] */
const PIXEL_ANGLES = {
  perspective: (width, height, field) => (2 * Math.tan(0.5 * field)) / width,
  fisheye: (width, height, field) => field / Math.min(width, height),
  equirectangular: (width, height) => Math.PI / height,
  cubemap: (width, height) => 2 / height,
};

/**
 * Uniforms of the observer and the star.
 *
 * @param {object} planet `radius`, `thickness` [m], `star` [rad], and `paths` where light is bent.
 * @param {number} altitude [m]
 * @param {number[]} sun Towards the star, in the observer's frame.
 */
export function observerNumbers(planet, altitude, sun) {
  const { radius, thickness, star, paths } = planet;
  const outside = altitude >= thickness;
  const r = paths ? opticalRadius(planet, altitude) : radius + altitude;
  const bottom = paths ? paths.bottom : radius;
  const seen = paths && !outside ? seenStar(r, sun[2], paths) : sun[2];
  const reach = Math.sin(0.5 * star);
  return {
    r: Math.fround(bottom) + (r - bottom),
    outside: Number(outside),
    horizon_mu: -Math.sqrt(Math.max((r - bottom) * (r + bottom), 0)) / r,
    horizon_sine: bottom / r,
    sun_x: Math.hypot(sun[0], sun[1]),
    sun_z: sun[2],
    seen_x: Math.sqrt(Math.max((1 - seen) * (1 + seen), 0)),
    seen_z: seen,
    disc: star > 0 ? 1 / (4 * Math.PI * reach * reach) : 0,
    draws_disc: Number(star > 0),
  };
}

/** Uniforms of the camera. */
export function cameraNumbers(camera, width, height, projections) {
  const { projection, fieldOfView: field, axes, ground } = camera;
  const numbers = {
    width,
    height,
    field_of_view: field,
    projection: Object.keys(projections).indexOf(projection),
    pixel_angle: PIXEL_ANGLES[projection](width, height, field),
  };
  ["right", "up", "forward"].forEach((name, i) => {
    "xyz".split("").forEach((c, j) => {
      numbers[`${name}_${c}`] = axes[i][j];
    });
  });
  "xyz".split("").forEach((name, i) => {
    "xyz".split("").forEach((c, j) => {
      numbers[name + c] = ground[i][j];
    });
  });
  return numbers;
}

/** Distance from the centre at which light, drawn straight, passes an observer. [m] */
function opticalRadius({ radius, thickness, paths }, altitude) {
  if (altitude > thickness) return radius + altitude;
  const { excess } = paths;
  const x = (altitude / thickness) * (excess.length - 1);
  const node = Math.min(Math.floor(x), excess.length - 2);
  return radius + altitude + excess[node] + (x - node) * (excess[node + 1] - excess[node]);
}

/** Cosine of the zenith angle at which a star is seen: read as `seen_star` in geometry/bending. */
function seenStar(x, cosine, { bottom, top, lift }) {
  const [rows, columns] = [lift.length, lift[0].length];
  const reach = Math.sqrt(Math.max((x - bottom) * (x + bottom), 0));
  const at = (reach / Math.sqrt((top - bottom) * (top + bottom))) * (rows - 1);
  const row = Math.min(Math.floor(at), rows - 2);
  const f = at - row;
  const between = (column) => lift[row][column] * (1 - f) + lift[row + 1][column] * f;
  const horizon = -reach / x - between(0);
  const above = Math.min(Math.max(cosine - horizon, 0) / (1 - horizon), 1);
  const share = Math.sqrt(above) * (columns - 1);
  const column = Math.min(Math.floor(share), columns - 2);
  const e = share - column;
  return Math.min(cosine + between(column) * (1 - e) + between(column + 1) * e, 1);
}
