/**
 * The values of all parameters, with undo and redo, two states to compare, and a text for a link.
 */
import { checked } from "./parameters.js";

/** Most steps that can be undone. */
const MOST_STEPS = 500;
/** Paths of the view's own parameters, and of the constituents' switches. */
const VIEW = /^(view|display|light)\./;
/** Those of the planet that a page solves for itself. */
const AIR = /^air\./;
const SWITCH = /^light\.constituents\[(\d+)\]$/;

export class State {
  /**
   * @param {object[]} parameters As declared.
   * @param {Object<string, number | string | boolean>} values Where it begins, and returns on reset.
   */
  constructor(parameters, values) {
    this.parameters = new Map(parameters.map((one) => [one.path, one]));
    this.planet = "";
    this.initial = { ...values };
    this.values = { ...values };
    this.past = [];
    this.future = [];
    this.gesture = null;
    this.other = null;
    this.showing = "A";
    this.listeners = new Set();
  }

  /** Call `listener(changed)` with the set of paths after every change; returns how to stop it. */
  follow(listener) {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  get(path) {
    return this.values[path];
  }

  get canUndo() {
    return this.past.length > 0;
  }

  get canRedo() {
    return this.future.length > 0;
  }

  get hasOther() {
    return this.other !== null;
  }

  /** Another declared list, as after a change of what a planet consists of. */
  declare(parameters, values) {
    this.parameters = new Map(parameters.map((one) => [one.path, one]));
    this.show({ ...values });
  }

  /**
   * Change values.
   *
   * @param {Object<string, number | string | boolean>} changes
   * @param {string | null} gesture Changes of one gesture, such as a drag, are undone together.
   * @throws {RangeError} If a value cannot be; nothing is changed then.
   */
  set(changes, gesture = null) {
    const sound = {};
    for (const [path, value] of Object.entries(changes)) {
      const parameter = this.parameters.get(path);
      if (!parameter) throw new RangeError(`there is no parameter ${path}`);
      const taken = checked(parameter, value);
      if (taken !== this.values[path]) sound[path] = taken;
    }
    if (Object.keys(sound).length === 0) return;
    if (gesture === null || gesture !== this.gesture) {
      this.past.push(this.values);
      if (this.past.length > MOST_STEPS) this.past.shift();
    }
    this.gesture = gesture;
    this.future = [];
    this.show({ ...this.values, ...sound });
  }

  /** End a gesture: the next change is a step of its own. */
  rest() {
    this.gesture = null;
  }

  undo() {
    this.step(this.past, this.future);
  }

  redo() {
    this.step(this.future, this.past);
  }

  step(from, to) {
    if (from.length === 0) return;
    to.push(this.values);
    this.rest();
    this.show(from.pop());
  }

  /** Everything as it was in the beginning; can be undone. */
  reset() {
    this.rest();
    this.set(this.initial);
  }

  /** Keep what is shown as the other state of a comparison. */
  keepOther() {
    this.other = { ...this.values };
    this.tell(new Set());
  }

  /** Show the other state, and keep this one in its place. */
  swap() {
    if (this.other === null) return;
    const here = this.values;
    this.showing = this.showing === "A" ? "B" : "A";
    this.rest();
    const there = this.other;
    this.other = here;
    this.show(there);
  }

  /** Values that come from elsewhere: no step of undo. */
  take(values) {
    this.show({ ...this.values, ...values });
  }

  show(values) {
    const changed = new Set(
      Object.keys(values).filter((path) => values[path] !== this.values[path]),
    );
    this.values = { ...values };
    this.tell(changed);
  }

  tell(changed) {
    for (const listener of [...this.listeners]) listener(changed);
  }

  /** The values that are not as in the beginning. */
  changes() {
    const differs = ([path, value]) => value !== this.initial[path];
    return Object.entries(this.values).filter(differs);
  }

  /**
   * What differs from the beginning, as the part of an address behind `#`.
   *
   * It is the JSON of viewer/session/saved_state.py: `planet`, and by path `view` and `set`, `off` by place;
   * and `air`, the amounts of a page that solves for itself.
   */
  asFragment() {
    const changes = this.changes();
    if (changes.length === 0) return "";
    const found = { planet: this.planet };
    for (const [path, value] of changes) {
      const place = SWITCH.exec(path);
      if (place) (found.off ??= []).push(Number(place[1]));
      else if (AIR.test(path)) (found.air ??= {})[path] = value;
      else if (VIEW.test(path)) (found.view ??= {})[path] = value;
      else (found.set ??= {})[path] = this.inFile(path, value);
    }
    return encodeURI(JSON.stringify(found)).replaceAll("#", "%23");
  }

  /** A value as a planet file has it: with its unit. */
  inFile(path, value) {
    const { kind, unit } = this.parameters.get(path);
    return kind === "number" && unit !== "1" ? `${value} ${unit}` : value;
  }

  /**
   * Take what a fragment says.
   *
   * @param {string} fragment With or without the `#`.
   * @returns {string[]} One line for each thing that cannot be taken.
   */
  takeFragment(fragment) {
    const faults = [];
    const values = { ...this.initial };
    const take = (path, value) => {
      const parameter = this.parameters.get(path);
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
      if (planet !== this.planet) throw new RangeError(`it shows ${planet}, this is ${this.planet}`);
      for (const [path, value] of Object.entries({ ...view, ...air })) take(path, value);
      for (const [path, value] of Object.entries(set)) take(path, this.fromFile(path, value));
      for (const place of off) take(`light.constituents[${place}]`, false);
    } catch (error) {
      faults.push(error.message);
    }
    this.take(values);
    return faults;
  }

  fromFile(path, value) {
    const { kind, unit } = this.parameters.get(path) ?? {};
    if (kind !== "number" || typeof value !== "string") return value;
    return value.endsWith(` ${unit}`) ? Number(value.slice(0, -unit.length)) : NaN;
  }
}
