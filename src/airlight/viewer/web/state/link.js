/**
 * A state as the part of an address behind `#`, and back.
 *
 * It is the JSON of viewer/session/saved_state.py: `planet`, and by path `view` and `set`, `off` by
 * place; and `air`, the amounts of a page that solves for itself, which a planet file knows as
 * `constituents[…].amount` and `ground.brightness`.
 */
import { checked } from "./parameters.js";

/** Paths of the view's own parameters, and of the constituents' switches. */
const VIEW = /^(view|display|light)\./;
/** Those of the planet that a page solves for itself. */
const AIR = /^air\./;
const SWITCH = /^light\.constituents\[(\d+)\]$/;

/** What differs from the beginning of a state; empty if nothing does. */
export function fragmentOf(state) {
  const changes = state.changes();
  if (changes.length === 0) return "";
  const found = { planet: state.planet };
  for (const [path, value] of changes) {
    const place = SWITCH.exec(path);
    if (place) (found.off ??= []).push(Number(place[1]));
    else if (AIR.test(path)) (found.air ??= {})[path] = value;
    else if (VIEW.test(path)) (found.view ??= {})[path] = value;
    else (found.set ??= {})[path] = inFile(state.parameters.get(path), value);
  }
  return encodeURI(JSON.stringify(found)).replaceAll("#", "%23");
}

/**
 * The values that a fragment says, and a line for each thing that cannot be taken.
 *
 * @param {State} state
 * @param {string} fragment With or without the `#`.
 */
export function readFragment(state, fragment) {
  const faults = [];
  const values = { ...state.initial };
  const take = (path, value) => {
    const parameter = state.parameters.get(path);
    try {
      if (!parameter) throw new RangeError(`there is no parameter ${path}`);
      values[path] = checked(parameter, value);
    } catch (error) {
      faults.push(error.message);
    }
  };
  try {
    const found = JSON.parse(decodeURIComponent(fragment.replace(/^#/, "")));
    const { planet, view = {}, air = {}, set = {}, off = [] } = found;
    if (planet !== state.planet) throw new RangeError(`it shows ${planet}, this is ${state.planet}`);
    for (const [path, value] of Object.entries({ ...view, ...air })) take(path, value);
    for (const [path, value] of Object.entries(set)) {
      const own = inPage(path);
      take(own, fromFile(state.parameters.get(own), value));
    }
    for (const place of off) take(`light.constituents[${place}]`, false);
  } catch (error) {
    faults.push(error.message);
  }
  return { values, faults };
}

/** The path by which a page that solves for itself knows a key of the planet file. */
function inPage(path) {
  if (path === "ground.brightness") return "air.ground";
  return path.replace(/^constituents(\[\d+\])\.amount$/, "air.amounts$1");
}

/** A value as a planet file has it: with its unit. */
function inFile({ kind, unit }, value) {
  return kind === "number" && unit !== "1" ? `${value} ${unit}` : value;
}

function fromFile({ kind, unit } = {}, value) {
  if (kind !== "number" || typeof value !== "string") return value;
  return value.endsWith(` ${unit}`) ? Number(value.slice(0, -unit.length)) : NaN;
}
