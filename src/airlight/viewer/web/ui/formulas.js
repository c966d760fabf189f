/** The formulas of scene/flight.py, scene/great_circle.py and scene/sun_time.py, which say more. */

const RADIAN = Math.PI / 180;
const DEGREE = 180 / Math.PI;
const LOWEST_ALTITUDE = 1;
const HIGHEST_ALTITUDE = 1e12;
const FOOTING = 5;
const NOTCH = 1.15;
const WIDEST_TURN = 5;
const UPRIGHT = 1e-12;
const HOUR = 15;

export function compass(angle) {
  return angle - 360 * Math.floor(angle / 360);
}

function bearing_of(north, east, otherwise) {
  const found = compass(Math.atan2(east, north) * DEGREE);
  return Math.hypot(north, east) >= UPRIGHT ? found : otherwise;
}

function travelled(latitude, longitude, course, angle) {
  const [sine, cosine] = [Math.sin(latitude * RADIAN), Math.cos(latitude * RADIAN)];
  const [northward, eastward] = [Math.cos(course * RADIAN), Math.sin(course * RADIAN)];
  const [far, near] = [Math.sin(angle), Math.cos(angle)];
  const out = cosine * near - sine * northward * far;
  const east = eastward * far;
  const north = sine * near + cosine * northward * far;
  const alongOut = -sine * northward * near - cosine * far;
  const alongEast = eastward * near;
  const alongNorth = cosine * northward * near - sine * far;
  const turn = Math.atan2(east, out);
  const flat = Math.hypot(out, east);
  const outward = alongOut * Math.cos(turn) + alongEast * Math.sin(turn);
  const ahead = alongNorth * flat - north * outward;
  const aside = alongEast * Math.cos(turn) - alongOut * Math.sin(turn);
  return [
    Math.atan2(north, flat) * DEGREE,
    compass(longitude + turn * DEGREE + 180) - 180,
    bearing_of(ahead, aside, course),
  ];
}

function carried_star(zenith, bearing, course, angle, newCourse) {
  const [flat, up] = [Math.sin(zenith * RADIAN), Math.cos(zenith * RADIAN)];
  const apart = (bearing - course) * RADIAN;
  const [ahead, aside] = [flat * Math.cos(apart), flat * Math.sin(apart)];
  const on = ahead * Math.cos(angle) - up * Math.sin(angle);
  const over = up * Math.cos(angle) + ahead * Math.sin(angle);
  const level = Math.hypot(on, aside);
  const turned = compass(newCourse + Math.atan2(aside, on) * DEGREE);
  return [Math.atan2(level, over) * DEGREE, level >= UPRIGHT ? turned : bearing];
}

function within(altitude) {
  return Math.min(Math.max(altitude, LOWEST_ALTITUDE), HIGHEST_ALTITUDE);
}

export function climbed(altitude, lookZenith, ahead, up, reach) {
  const climb = ahead * Math.cos(lookZenith * RADIAN) + up;
  return within((altitude + FOOTING) * Math.exp(climb * reach) - FOOTING);
}

export function course_of(lookZenith, heading, right, ahead) {
  return heading + Math.atan2(right, ahead * Math.sin(lookZenith * RADIAN)) * DEGREE;
}

export function angle_flown(altitude, higher, lookZenith, right, ahead, reach, bottomRadius) {
  const middle = 0.5 * (altitude + higher);
  const level = Math.hypot(ahead * Math.sin(lookZenith * RADIAN), right);
  return (level * reach * (middle + FOOTING)) / (bottomRadius + middle);
}

export function turned(latitude, longitude, heading, sunZenith, sunAzimuth, course, angle) {
  const [newLatitude, newLongitude, newCourse] = travelled(latitude, longitude, course, angle);
  const [zenith, azimuth] = carried_star(sunZenith, sunAzimuth, course, angle, newCourse);
  return [newLatitude, newLongitude, compass(newCourse + heading - course), zenith, azimuth];
}

export function looked(lookZenith, heading, right, down) {
  const widen = 1 / Math.max(Math.sin(lookZenith * RADIAN), 1 / WIDEST_TURN);
  return [Math.min(Math.max(lookZenith + down, 0), 180), compass(heading + right * widen)];
}

export function risen(altitude, notches) {
  return within((altitude + FOOTING) * Math.exp(notches * Math.log(NOTCH)) - FOOTING);
}

export function sun_dragged(zenith, azimuth, right, down) {
  const lower = zenith + down;
  const over = lower < 0 || lower > 180;
  const far = lower > 180 ? 360 - lower : -lower;
  const reached = over ? far : lower;
  return [Math.min(Math.max(reached, 0), 180), compass(azimuth + right + (over ? 180 : 0))];
}

export function sun_at(latitude, declination, hour) {
  const [turn, tilt] = [HOUR * (12 - hour) * RADIAN, declination * RADIAN];
  const [out, east] = [Math.cos(tilt) * Math.cos(turn), Math.cos(tilt) * Math.sin(turn)];
  const pole = Math.sin(tilt);
  const [sine, cosine] = [Math.sin(latitude * RADIAN), Math.cos(latitude * RADIAN)];
  const [up, north] = [cosine * out + sine * pole, cosine * pole - sine * out];
  return [Math.atan2(Math.hypot(north, east), up) * DEGREE, bearing_of(north, east, 180)];
}

export function time_of(latitude, zenith, azimuth) {
  const [flat, up] = [Math.sin(zenith * RADIAN), Math.cos(zenith * RADIAN)];
  const [north, east] = [flat * Math.cos(azimuth * RADIAN), flat * Math.sin(azimuth * RADIAN)];
  const [sine, cosine] = [Math.sin(latitude * RADIAN), Math.cos(latitude * RADIAN)];
  const [out, pole] = [cosine * up - sine * north, sine * up + cosine * north];
  const hour = 12 - (Math.atan2(east, out) * DEGREE) / HOUR;
  return [Math.atan2(pole, Math.hypot(out, east)) * DEGREE, hour - 24 * Math.floor(hour / 24)];
}
