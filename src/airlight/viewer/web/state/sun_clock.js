/**
 * Sun of a view by its date and time, where a switch asks for it, with the rules of
 * parameters/sun_clock.py.
 */
import { WORLDS, date_after, sun_on_date } from "../generated/formulas.js";
import { withMoon } from "./second_light.js";

const CLOCK = "view.clock";
const DATE = ["view.year", "view.day", "view.hour"];
const PLACE = ["view.latitude", "view.longitude"];
const SUN = ["view.sun_zenith", "view.sun_azimuth"];

/**
 * Changes of a view, with the sun that follows from date and place, or the switch from the sun.
 *
 * @param {string | null | undefined} body World whose sky the planet has; none has no date.
 * @param {Object<string, number | string | boolean>} values Values before, by path.
 * @param {Object<string, number | string | boolean>} changes Validated changes, by path.
 * @returns {Object<string, number | string | boolean>}
 */
export function withSun(body, values, changes) {
  const has = (paths) => paths.some((path) => path in changes);
  if (!has([CLOCK, ...DATE, ...PLACE, ...SUN])) return changes;
  const world = WORLDS.indexOf(body);
  let on = Boolean(values[CLOCK]);
  if (CLOCK in changes) on = Boolean(changes[CLOCK]);
  else if (has(DATE) && !has(SUN)) on = true;
  else if (has(SUN) && !has(PLACE)) on = false;
  if (world < 0 || !on) {
    return values[CLOCK] || changes[CLOCK] ? { ...changes, [CLOCK]: false } : changes;
  }
  const after = { ...values, ...changes };
  const [year, day, hour] = DATE.map((path) => after[path]);
  const place = PLACE.map((path) => after[path]);
  const sun = sun_on_date(world, ...place, Math.floor(year), Math.floor(day), hour);
  return { ...changes, [CLOCK]: true, [SUN[0]]: sun[0], [SUN[1]]: (sun[1] + 360) % 360 };
}

/** Changes of a view, with the sun and the Moon that follow from them; arguments of `withSun`. */
export function withSky(body, values, changes) {
  return withMoon(body, values, withSun(body, values, changes));
}

/** Date of a view some hours later, with sun and Moon; null where the sun does not go by a date. [h] */
export function later(body, values, hours) {
  if (!values[CLOCK]) return null;
  const [year, day, hour] = DATE.map((path) => values[path]);
  const date = date_after(Math.floor(year), Math.floor(day), hour, hours);
  return withSky(body, values, Object.fromEntries(DATE.map((path, i) => [path, date[i]])));
}
