/** What was changed, one step after another: the rules of session/history.py. */
import { KEYS } from "../generated/keys.js";

const { steps: MOST_STEPS, together: TOGETHER } = KEYS.rates;

export class History {
  /** @param {() => number} clock Seconds that only grow, for joining quick edits into one step. */
  constructor(clock = () => performance.now() / 1000) {
    this.clock = clock;
    this.done = [];
    this.undone = [];
  }

  /**
   * A new edit: a step of its own, or part of the last one.
   *
   * @param {string} name What was changed: a path, or the name of a gesture.
   * @param {Object<string, number | string | boolean>} before
   * @param {Object<string, number | string | boolean>} after The values that it changed, by path.
   * @param {boolean} held Whether the step goes on until `close`, however long that takes.
   */
  record(name, before, after, held) {
    const now = this.clock();
    const last = this.done.at(-1);
    const quick = last && (last.open || now - last.time <= TOGETHER);
    if (quick && last.name === name && this.undone.length === 0) {
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

  /** End the last step: the next edit is one of its own. */
  close() {
    const last = this.done.at(-1);
    if (last) Object.assign(last, { open: false, time: -Infinity });
  }

  /** The values to go back to, or null. */
  undo() {
    const step = this.done.pop();
    if (!step) return null;
    this.undone.push(step);
    return step.before;
  }

  /** The values that were taken back, or null. */
  redo() {
    const step = this.undone.pop();
    if (!step) return null;
    this.done.push(Object.assign(step, { open: false, time: -Infinity }));
    return step.after;
  }
}
