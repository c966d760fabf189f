/**
 * Second light of a view: the Moon by date and time or by hand, or a second sun, with the rules of
 * parameters/second_light.py.
 */
import { WORLDS, moon_on_date } from "../generated/formulas.js";

const LIGHT = "view.second_light";
const BY_DATE = "view.moon_by_date";
const TEMPERATURE = "view.second_temperature";
const PLACED = [
  "view.second_zenith",
  "view.second_azimuth",
  "view.moon_phase",
  "view.second_radius",
];
const CLOCK = "view.clock";
const DATE = ["view.year", "view.day", "view.hour"];
const PLACE = ["view.latitude", "view.longitude"];

/**
 * Changes of a view, with the Moon that follows from date and place.
 *
 * @param {string | null | undefined} body World whose sky the planet has; Earth's moon is known.
 * @param {Object<string, number | string | boolean>} values Values before, by path.
 * @param {Object<string, number | string | boolean>} changes Validated changes, by path.
 * @returns {Object<string, number | string | boolean>}
 */
export function withMoon(body, values, changes) {
  const has = (paths) => paths.some((path) => path in changes);
  const byHand = has([LIGHT, ...PLACED, TEMPERATURE]);
  if (!byHand && !has([BY_DATE, CLOCK, ...DATE, ...PLACE])) return changes;
  const after = { ...values, ...changes };
  const found = { ...changes };
  if (byHand && !has([BY_DATE, CLOCK])) {
    if (values[BY_DATE] && BY_DATE in values) found[BY_DATE] = false;
    if (!(LIGHT in changes) && values[LIGHT] === "none") {
      found[LIGHT] = TEMPERATURE in changes ? "second sun" : "moon";
    }
    return found;
  }
  if (!(after[BY_DATE] && after[CLOCK])) return found;
  if (body !== WORLDS[0]) {
    if (after[LIGHT] === "moon") found[LIGHT] = "none";
    return found;
  }
  const [year, day, hour] = DATE.map((path) => after[path]);
  const place = PLACE.map((path) => after[path]);
  const moon = moon_on_date(...place, Math.floor(year), Math.floor(day), hour);
  moon[1] = (moon[1] + 360) % 360;
  PLACED.forEach((path, i) => (found[path] = moon[i]));
  return { ...found, [LIGHT]: "moon" };
}
