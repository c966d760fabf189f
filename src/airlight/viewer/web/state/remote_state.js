/** A state whose planet and history live in Python; every change goes there too. */
import { State } from "./state.js";

export class RemoteState extends State {
  /**
   * @param {object} model Of the widget: `values` both ways, `command` to Python, `can` from there.
   */
  constructor(model) {
    super(model.get("parameters"), model.get("values"));
    this.model = model;
    this.commands = 0;
    this.sending = false;
  }

  get canUndo() {
    return Boolean(this.model.get("can").undo);
  }

  get canRedo() {
    return Boolean(this.model.get("can").redo);
  }

  get hasOther() {
    return Boolean(this.model.get("can").swap);
  }

  set(changes, gesture = null) {
    const before = this.values;
    super.set(changes, gesture);
    this.past = [];
    if (this.values === before || this.sending) return;
    // All changes of one frame go together.
    this.sending = true;
    requestAnimationFrame(() => this.send());
  }

  send() {
    if (!this.sending) return;
    this.sending = false;
    this.model.set("values", { ...this.values });
    this.model.save_changes();
  }

  /** Something that Python does to its session. */
  command(name) {
    this.send();
    this.commands += 1;
    this.model.set("command", { name, count: this.commands });
    this.model.save_changes();
  }

  undo() {
    this.command("undo");
  }

  redo() {
    this.command("redo");
  }

  reset() {
    this.command("reset");
  }

  keepOther() {
    this.command("keep");
  }

  swap() {
    this.command("swap");
  }

  rest() {
    if (this.gesture !== null) this.command("rest");
    super.rest();
  }
}
