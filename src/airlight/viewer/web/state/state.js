/** The values of all parameters, with undo and redo, and two states to compare. */
import { History } from "./history.js";
import { fragmentOf, readFragment } from "./link.js";
import { checked } from "./parameters.js";

/** Paths of camera and sun, which both states of a comparison share. */
const CAMERA = /^view\./;

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
    this.history = new History();
    this.other = null;
    this.showing = "A";
    this.sharesCamera = true;
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
    return this.history.done.length > 0;
  }

  get canRedo() {
    return this.history.undone.length > 0;
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
   * Change values: a step to undo, or part of the last one.
   *
   * @param {Object<string, number | string | boolean>} changes
   * @param {string | null} gesture Changes of one gesture, such as a drag, are undone together.
   * @param {boolean} held Whether the gesture goes on until `rest`; else quick ones join.
   * @throws {RangeError} If a value cannot be; nothing is changed then.
   */
  set(changes, gesture = null, held = gesture !== null) {
    const sound = this.sound(changes);
    if (Object.keys(sound).length === 0) return;
    const before = Object.fromEntries(Object.keys(sound).map((path) => [path, this.get(path)]));
    this.record(gesture ?? Object.keys(sound).sort().join(" "), before, sound, held);
    this.show({ ...this.values, ...sound });
  }

  /** Change values without a step to undo, as time does. */
  move(changes) {
    this.show({ ...this.values, ...this.sound(changes) });
  }

  /** The values that differ, as their parameters take them. */
  sound(changes) {
    const sound = {};
    for (const [path, value] of Object.entries(changes)) {
      const parameter = this.parameters.get(path);
      if (!parameter) throw new RangeError(`there is no parameter ${path}`);
      const taken = checked(parameter, value);
      if (taken !== this.values[path]) sound[path] = taken;
    }
    return sound;
  }

  record(name, before, after, held) {
    this.history.record(name, before, after, held);
  }

  /** End a gesture: the next change is a step of its own. */
  rest() {
    this.history.close();
  }

  undo() {
    this.take(this.history.undo() ?? {});
  }

  redo() {
    this.take(this.history.redo() ?? {});
  }

  /** Everything as it was in the beginning: one step to undo. */
  reset() {
    this.rest();
    this.set(this.initial);
    this.rest();
  }

  /** Keep what is shown as the other state of a comparison. */
  keepOther() {
    this.other = { values: { ...this.values }, history: new History() };
    this.tell(new Set());
  }

  /** Show the other state, and keep this one in its place; the first time it is a copy of this. */
  swap() {
    if (this.other === null) this.keepOther();
    this.rest();
    const { values, history } = this.other;
    const camera = Object.entries(this.values).filter(([path]) => CAMERA.test(path));
    this.other = { values: this.values, history: this.history };
    this.history = history;
    this.showing = this.showing === "A" ? "B" : "A";
    this.show({ ...values, ...(this.sharesCamera && Object.fromEntries(camera)) });
  }

  /** Whether both states of a comparison are seen by one camera, under one sun. */
  shareCamera(shared) {
    this.sharesCamera = shared;
    this.tell(new Set());
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

  /** What differs from the beginning, as the part of an address behind `#`. */
  asFragment() {
    return fragmentOf(this);
  }

  /**
   * Take what a fragment says.
   *
   * @param {string} fragment With or without the `#`.
   * @returns {string[]} One line for each thing that cannot be taken.
   */
  takeFragment(fragment) {
    const { values, faults } = readFragment(this, fragment);
    this.take(values);
    return faults;
  }
}
