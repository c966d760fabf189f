/**
 * From the view's parameters to what the shaders are told: directions in the observer's frame.
 *
 * The frame has z to the zenith, x to the sun's side and y to the left of x; azimuth grows
 * clockwise seen from above. The same as scene/directions.py and scene/observer.py, which say more.
 */

const RADIAN = Math.PI / 180;

/** Width over height of projections that have a shape of their own. */
const SHAPES = { equirectangular: 2, cubemap: 6 };

/** Unit vector of a direction given by its zenith angle and azimuth. [deg] */
export function direction(zenith, azimuth) {
  const flat = Math.sin(zenith * RADIAN);
  const turn = azimuth * RADIAN;
  return [flat * Math.cos(turn), -flat * Math.sin(turn), Math.cos(zenith * RADIAN)];
}

/** The camera's right, up and forward. [deg] */
export function cameraAxes(zenith, azimuth, roll) {
  const forward = direction(zenith, azimuth);
  const level = direction(90, azimuth + 90);
  const upright = cross(level, forward);
  const [cos, sin] = [Math.cos(roll * RADIAN), Math.sin(roll * RADIAN)];
  const right = level.map((x, i) => cos * x - sin * upright[i]);
  const up = upright.map((x, i) => cos * x + sin * level[i]);
  return [right, up, forward];
}

/** Rows of the rotation from the observer's frame to the frame that turns with the planet. */
export function groundFrame(latitude, longitude, bearing) {
  const [phi, lam, beta] = [latitude * RADIAN, longitude * RADIAN, bearing * RADIAN];
  const [sinPhi, cosPhi, sinLam, cosLam] = [
    Math.sin(phi),
    Math.cos(phi),
    Math.sin(lam),
    Math.cos(lam),
  ];
  const up = [cosPhi * cosLam, cosPhi * sinLam, sinPhi];
  const north = [-sinPhi * cosLam, -sinPhi * sinLam, cosPhi];
  const east = [-sinLam, cosLam, 0];
  const sunwards = north.map((x, i) => Math.cos(beta) * x + Math.sin(beta) * east[i]);
  const left = cross(up, sunwards);
  return [0, 1, 2].map((i) => [sunwards[i], left[i], up[i]]);
}

export function cross(a, b) {
  return [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
  ];
}

/** The largest picture of a projection's shape within a window. [pixel] */
export function fitting(projection, width, height) {
  const ratio = SHAPES[projection];
  if (!ratio) return [Math.max(1, width), Math.max(1, height)];
  const side = Math.max(1, Math.min(height, Math.floor(width / ratio)));
  return [ratio * side, side];
}

/**
 * The camera that a view shows.
 *
 * @param {Object<string, number | string>} values Of the view's parameters, by path.
 * @param {Object<string, [number, number]>} limits Fields of view of each projection. [deg]
 * @returns {{axes: number[][], sun: number[], fieldOfView: number, projection: string,
 *     ground: number[][]}} The field of view in radians.
 */
export function cameraOf(values, limits) {
  const projection = values["view.projection"];
  const [low, high] = limits[projection];
  const bearing = values["view.sun_azimuth"];
  const azimuth = (((values["view.heading"] - bearing) % 360) + 360) % 360;
  return {
    projection,
    axes: cameraAxes(values["view.look_zenith"], azimuth, values["view.roll"]),
    sun: direction(values["view.sun_zenith"], 0),
    fieldOfView: Math.min(Math.max(values["view.field_of_view"], low), high) * RADIAN,
    ground: groundFrame(values["view.latitude"], values["view.longitude"], bearing),
  };
}
