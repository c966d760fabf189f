/** State whose planet and history live in Python, to which every change is sent. */
import { State } from "./state.js";

export class RemoteState extends State {
  /**
   * @param {object} model Model of the widget: `values`, `gesture` and `command` to Python,
   *     `values` and `can` from Python.
   */
  constructor(model) {
    super(model.get("parameters"), model.get("values"));
    this.model = model;
    this.name = Math.random().toString(36).slice(2); // a widget may be shown more than once
    this.commands = 0;
    this.waiting = null;
    this.holding = false;
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

  /** Take over Python's values, unless a later edit is on its way: its answer follows. */
  hear() {
    const heard = this.model.get("can").heard[this.name] ?? 0;
    if (heard >= this.commands && !this.waiting) this.take(this.model.get("values"));
  }

  /** Python answers with the values that follow. */
  following(changes) {
    return changes;
  }

  record(name, before, after, held) {
    this.holding ||= held;
    this.sendLater({ name, held });
  }

  move(changes) {
    this.sendLater({ name: "", held: false });
    super.move(changes);
  }

  /** Send all changes of one gesture in one frame together. */
  sendLater(gesture) {
    if (this.waiting && this.waiting.name !== gesture.name) this.send();
    if (!this.waiting) requestAnimationFrame(() => this.send());
    this.waiting = gesture;
  }

  send() {
    if (!this.waiting) return;
    this.model.set("gesture", { ...this.waiting, ...this.signed() });
    this.waiting = null;
    this.model.set("values", { ...this.values });
    this.model.save_changes();
  }

  /** Send a command for Python's session. */
  command(name) {
    this.send();
    this.model.set("command", { name, ...this.signed() });
    this.model.save_changes();
  }

  /** Sender and number of a message, which Python repeats once it has it. */
  signed() {
    return { by: this.name, count: ++this.commands };
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

  shareCamera(shared) {
    this.command(shared ? "one camera" : "two cameras");
  }

  rest() {
    if (this.holding) this.command("rest");
    this.holding = false;
    this.letGo();
  }
}
