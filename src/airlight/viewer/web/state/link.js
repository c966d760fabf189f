/**
 * Conversion between a state and the fragment of a URL.
 *
 * The format is the JSON of viewer/session/saved_state.py: `planet`, `view` and `set` by path,
 * `off` by index; and `air`, the amounts of a page that solves its own edits, as factors of the
 * planet's own, which in a planet file are `constituents[…].amount` and `ground.brightness`. The
 * view is given by what differs from the declared defaults, as in a window, whose first view is not
 * that of the page.
 */
import { follows, fromFactor, toFactor, withFollowing } from "./amounts.js";
import { checked } from "./parameters.js";

/** Paths of the view's parameters, and of the constituents' switches. */
const VIEW = /^(view|display|light)\./;
/** Paths of the planet's parameters that a page solves. */
const AIR = /^air\./;
const SWITCH = /^light\.constituents\[(\d+)\]$/;

/** Differences of a state from its initial values, with its view; empty if there are none. */
export function fragmentOf(state) {
  const changes = state.changes();
  if (changes.length === 0) return "";
  const found = { planet: state.planet };
  for (const [path, value] of changes) {
    const place = SWITCH.exec(path);
    if (place) (found.off ??= []).push(Number(place[1]));
    else if (follows(path) || VIEW.test(path)) continue;
    else if (AIR.test(path)) (found.air ??= {})[path] = factorOf(state, path, value);
    else (found.set ??= {})[path] = inFile(state.parameters.get(path), value);
  }
  const defaults = viewDefaults(state);
  const differs = ([path]) => path in defaults && state.get(path) !== defaults[path];
  found.view = Object.fromEntries(Object.entries(state.values).filter(differs));
  return encodeURI(JSON.stringify(found)).replaceAll("#", "%23");
}

/**
 * Values of a fragment, and a line for each entry that is rejected.
 *
 * @param {State} state
 * @param {string} fragment Fragment, with or without the `#`.
 */
export function readFragment(state, fragment) {
  const faults = [];
  let values = { ...state.initial };
  const air = {};
  const take = (path, value) => {
    const parameter = state.parameters.get(path);
    try {
      if (!parameter) throw new RangeError(`there is no parameter ${path}`);
      values[path] = checked(parameter, fromFactor(parameter, value));
      if (AIR.test(path)) air[path] = values[path];
    } catch (error) {
      faults.push(error.message);
    }
  };
  try {
    const found = JSON.parse(decodeURIComponent(fragment.replace(/^#/, "")));
    const { planet, view, air: amounts = {}, set = {}, off = [] } = found;
    if (planet !== state.planet) throw new RangeError(`it shows ${planet}, this is ${state.planet}`);
    if (view) values = { ...values, ...viewDefaults(state) };
    for (const [path, value] of Object.entries({ ...view, ...amounts })) take(path, value);
    for (const [path, value] of Object.entries(set)) {
      const own = inPage(path);
      take(own, fromFile(state.parameters.get(own), value));
    }
    for (const place of off) take(`light.constituents[${place}]`, false);
  } catch (error) {
    faults.push(error.message);
  }
  return { values: { ...values, ...withFollowing(state.parameters, values, air) }, faults };
}

/** Values of the view in a link that does not give them. */
function viewDefaults(state) {
  const own = ([path]) => VIEW.test(path) && !SWITCH.test(path);
  const value = ([path, parameter]) => [path, parameter.default ?? state.initial[path]];
  return Object.fromEntries([...state.parameters].filter(own).map(value));
}

/** Amount as a factor of the planet's own, with the nine digits that a picture can show. */
function factorOf(state, path, value) {
  return Number(toFactor(state.parameters.get(path), value).toPrecision(9));
}

/** Path, on a page that solves its own edits, of a key of the planet file. */
function inPage(path) {
  if (path === "ground.brightness") return "air.ground";
  return path.replace(/^constituents(\[\d+\])\.amount$/, "air.amounts$1");
}

/** Value as in a planet file, with its unit. */
function inFile({ kind, unit }, value) {
  return kind === "number" && unit !== "1" ? `${value} ${unit}` : value;
}

function fromFile({ kind, unit } = {}, value) {
  if (kind !== "number" || typeof value !== "string") return value;
  return value.endsWith(` ${unit}`) ? Number(value.slice(0, -unit.length)) : NaN;
}
