/** Undo history, with the rules of session/history.py. */
import { KEYS } from "../generated/keys.js";

const { steps: MOST_STEPS, together: TOGETHER } = KEYS.rates;

export class History {
  /** @param {() => number} clock Monotonic clock, to merge edits in quick succession. [s] */
  constructor(clock = () => performance.now() / 1000) {
    this.clock = clock;
    this.done = [];
    this.undone = [];
  }

  /**
   * Add an edit, as a new step or merged into the last one.
   *
   * @param {string} name Path of the changed parameter, or name of a gesture.
   * @param {Object<string, number | string | boolean>} before Previous values, by path.
   * @param {Object<string, number | string | boolean>} after New values, by path.
   * @param {boolean} held Whether the step lasts until `close`, regardless of time.
   */
  record(name, before, after, held) {
    const now = this.clock();
    const last = this.joined(name);
    if (last) {
      last.before = { ...before, ...last.before };
      last.after = { ...last.after, ...after };
      last.time = now;
      last.open ||= held;
      return;
    }
    this.undone = [];
    this.done.push({ name, before, after, time: now, open: held });
    if (this.done.length > MOST_STEPS) this.done.shift();
  }

  /** Step into which an edit would be merged, or null. */
  joined(name) {
    const last = this.done.at(-1);
    const quick = last && (last.open || this.clock() - last.time <= TOGETHER);
    return quick && last.name === name && this.undone.length === 0 ? last : null;
  }

  /** Close the last step, so that the next edit is a new one. */
  close() {
    const last = this.done.at(-1);
    if (last) Object.assign(last, { open: false, time: -Infinity });
  }

  /** Values to restore for undo, or null. */
  undo() {
    const step = this.done.pop();
    if (!step) return null;
    this.undone.push(step);
    return step.before;
  }

  /** Values to restore for redo, or null. */
  redo() {
    const step = this.undone.pop();
    if (!step) return null;
    this.done.push(Object.assign(step, { open: false, time: -Infinity }));
    return step.after;
  }
}
