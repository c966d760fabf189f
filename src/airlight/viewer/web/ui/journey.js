/** Moving over a planet: how the view's values change with a step of the observer. */
import { direction, groundFrame } from "../drawing/view.js";

const DEGREE = 180 / Math.PI;
/** Lowest and highest altitude that can be flown at. [m] */
export const LOWEST = 1;
export const HIGHEST = 1e12;

/**
 * The view after a step; the sun stays where it is in space, and the camera keeps its course.
 *
 * @param {Object<string, number>} values Of the view's parameters.
 * @param {number} radius Of the planet. [m]
 * @param {number[]} step East, north and up, of the observer. [m]
 * @returns {Object<string, number>} The values that changed.
 */
export function moved(values, radius, step) {
  const altitude = values["view.altitude"];
  const distance = radius + altitude;
  const [east, north, rise] = step;
  const along = Math.hypot(east, north);
  const up = distance + rise;
  // The new distance less the radius, without the difference of two large numbers.
  const gain = rise + (along * along) / (Math.hypot(up, along) + up);
  const next = {
    "view.altitude": Math.min(Math.max(altitude + gain, LOWEST), HIGHEST),
  };
  if (along === 0) return next;
  const before = frameAt(values["view.latitude"], values["view.longitude"]);
  const turned = normal([0, 1, 2].map((i) => up * before[2][i] + east * before[0][i] + north * before[1][i]));
  const latitude = Math.asin(Math.min(Math.max(turned[2], -1), 1)) * DEGREE;
  const longitude = Math.atan2(turned[1], turned[0]) * DEGREE;
  const after = frameAt(latitude, longitude);
  next["view.latitude"] = latitude;
  next["view.longitude"] = longitude;
  const sun = seenFrom(before, direction(values["view.sun_zenith"], values["view.sun_azimuth"]));
  const [sunZenith, sunBearing] = anglesIn(after, sun);
  next["view.sun_zenith"] = sunZenith;
  next["view.sun_azimuth"] = sunBearing;
  const course = transported(before, after, values["view.heading"], turned);
  next["view.heading"] = course;
  return next;
}

/** East, north and up of a place, in the planet's frame. [deg] */
function frameAt(latitude, longitude) {
  const rows = groundFrame(latitude, longitude, 0);
  const north = rows.map((row) => row[0]);
  const up = rows.map((row) => row[2]);
  const east = rows.map((row) => -row[1]);
  return [east, north, up];
}

/** A direction with x to the north and y to the west, in the planet's frame. */
function seenFrom(frame, [x, y, z]) {
  return [0, 1, 2].map((i) => x * frame[1][i] - y * frame[0][i] + z * frame[2][i]);
}

/** Zenith angle and bearing of a direction of the planet's frame. [deg] */
function anglesIn(frame, vector) {
  const [east, north, up] = frame.map((axis) => dot(axis, vector));
  return [Math.atan2(Math.hypot(east, north), up) * DEGREE, bearingOf(east, north)];
}

function bearingOf(east, north) {
  return (Math.atan2(east, north) * DEGREE + 360) % 360;
}

/** The bearing of a level direction that is carried along a great circle. [deg] */
function transported(before, after, heading, up) {
  const vector = seenFrom(before, direction(90, heading));
  // The rotation that takes the old zenith to the new one, the shortest way.
  const old = before[2];
  const axis = crossed(old, up);
  const cosine = dot(old, up);
  const turned = [0, 1, 2].map((i) => {
    const whirl = crossed(axis, vector)[i];
    return cosine * vector[i] + whirl + (axis[i] * dot(axis, vector)) / (1 + cosine);
  });
  return bearingOf(dot(after[0], turned), dot(after[1], turned));
}

function crossed(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function normal(vector) {
  const length = Math.hypot(...vector);
  return vector.map((x) => x / length);
}

/**
 * Camera's forward, right and up as east, north and up of the place. [1]
 *
 * @param {Object<string, number>} values Of the view's parameters.
 */
export function cameraInPlace(values) {
  const heading = values["view.heading"];
  const inPlace = ([x, y, z]) => [-y, x, z];
  // Counted from north instead of the sun's side, azimuth is a bearing.
  const forward = inPlace(direction(values["view.look_zenith"], heading));
  const right = inPlace(direction(90, heading + 90));
  return { forward, right };
}
