/** Values of all parameters, with undo and redo, and two states to compare. */
import { withFollowing } from "./amounts.js";
import { History } from "./history.js";
import { fragmentOf, readFragment } from "./link.js";
import { checked } from "./parameters.js";
import { later, withSky } from "./sun_clock.js";

/** Paths of camera and sun, which the states of a comparison can share. */
const CAMERA = /^view\./;

export class State {
  /**
   * @param {object[]} parameters Declared parameters.
   * @param {Object<string, number | string | boolean>} values Initial values, restored by `reset`.
   * @param {string | null} body World whose sky the planet has, where no parameter says it.
   * @param {object | null} space Scene of several bodies, whose sun is above the place; see
   *     drawing/scene_space.js.
   */
  constructor(parameters, values, body = null, space = null) {
    this.fixedBody = body;
    this.space = space;
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

  /** Call `listener(changed)` with the changed paths after each change; returns the unsubscriber. */
  subscribe(listener) {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  /** World whose sky the planet has, if any. */
  get body() {
    return this.values.body ?? this.fixedBody;
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

  /** Whether the automatic exposure is locked. */
  get holdsExposure() {
    return Boolean(this.values["display.locked"]);
  }

  get hasOther() {
    return this.other !== null;
  }

  /** Replace the declared parameters, as after a change of a planet's composition. */
  declare(parameters, values) {
    this.parameters = new Map(parameters.map((one) => [one.path, one]));
    this.show({ ...values });
  }

  /**
   * Change values, as an undo step or part of the last one.
   *
   * @param {Object<string, number | string | boolean>} changes New values, by path.
   * @param {string | null} gesture Gesture, such as a drag, whose changes are undone together.
   * @param {boolean} held Whether the gesture lasts until `rest`; else it ends after a pause.
   * @throws {RangeError} If a value is invalid; nothing is changed then.
   */
  set(changes, gesture = null, held = gesture !== null) {
    const own = this.sound(changes);
    if (Object.keys(own).length === 0) return;
    const name = gesture ?? Object.keys(own).sort().join(" ");
    const sound = this.following(own, name);
    const before = Object.fromEntries(Object.keys(sound).map((path) => [path, this.get(path)]));
    this.record(name, before, sound, held);
    this.show({ ...this.values, ...sound });
  }

  /** Change values without an undo step, as time does. */
  move(changes) {
    this.show({ ...this.values, ...this.sound(changes) });
  }

  /** Validated values that differ from the current ones. */
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

  /** Changes, with those of values that follow from them and from the values at their start. */
  following(changes, name) {
    const start = { ...this.values, ...this.history.joined(name)?.before };
    return this.withSky(withFollowing(this.parameters, start, changes));
  }

  /** Changes, with the sun and the Moon that follow from them. */
  withSky(changes) {
    if (this.space) return this.space.follow(this.values, changes);
    return withSky(this.body, this.values, changes);
  }

  /** Values some hours later; null where the sun does not go by a date. [h] */
  later(hours) {
    return this.space ? this.space.later(this.values, hours) : later(this.body, this.values, hours);
  }

  record(name, before, after, held) {
    this.history.record(name, before, after, held);
  }

  /** End a gesture, so that the next change is a separate undo step. */
  rest() {
    this.history.close();
  }

  undo() {
    this.take(this.history.undo() ?? {});
  }

  redo() {
    this.take(this.history.redo() ?? {});
  }

  /** Restore all initial values, as one undo step. */
  reset() {
    this.rest();
    this.set(this.initial);
    this.rest();
  }

  /** Copy the shown state to the other state of the comparison. */
  keepOther() {
    this.other = { values: { ...this.values }, history: new History() };
    this.notify(new Set());
  }

  /** Swap the two states; the other is first copied from this one if there is none. */
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

  /** Set whether both states of a comparison share the camera and the sun. */
  shareCamera(shared) {
    this.sharesCamera = shared;
    this.notify(new Set());
  }

  /** Take over external values, without an undo step. */
  take(values) {
    this.show({ ...this.values, ...values });
  }

  show(values) {
    const changed = new Set(
      Object.keys(values).filter((path) => values[path] !== this.values[path]),
    );
    this.values = { ...values };
    this.notify(changed);
  }

  notify(changed) {
    for (const listener of [...this.listeners]) listener(changed);
  }

  /** Values that differ from the initial ones. */
  changes() {
    const differs = ([path, value]) => value !== this.initial[path];
    return Object.entries(this.values).filter(differs);
  }

  /** Differences from the initial values, as the fragment of a URL. */
  asFragment() {
    return fragmentOf(this);
  }

  /**
   * Apply the values of a fragment.
   *
   * @param {string} fragment Fragment, with or without the `#`.
   * @returns {string[]} One line for each entry that is rejected.
   */
  takeFragment(fragment) {
    const { values, faults } = readFragment(this, fragment);
    this.take(this.withSky(values));
    return faults;
  }
}
