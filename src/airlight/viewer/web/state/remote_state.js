/** State whose planet and history live in Python, to which every change is sent. */
import { State } from "./state.js";

export class RemoteState extends State {
  /**
   * @param {object} model Model of the widget: `messages` to Python; `values`, `can` and `heard`,
   *     the number of the last message of each view, from Python.
   */
  constructor(model) {
    super(model.get("parameters"), model.get("values"));
    this.model = model;
    this.name = Math.random().toString(36).slice(2); // a widget may be shown more than once
    this.count = 0;
    this.unheard = []; // messages, all sent again with each new one: a host may drop one of them
    this.waiting = null; // edit of one gesture, not sent yet
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
    const heard = this.model.get("heard")[this.name] ?? 0;
    this.unheard = this.unheard.filter((message) => message.count > heard);
    if (this.waiting) requestAnimationFrame(() => this.sendWhenHeard());
    else if (this.unheard.length === 0) this.take(this.model.get("values"));
  }

  /** Python answers with the values that follow. */
  following(changes) {
    return changes;
  }

  record(name, before, after, held) {
    this.holding ||= held;
    this.sendLater(name, held, after);
  }

  move(changes) {
    this.sendLater("", false, changes);
    super.move(changes);
  }

  /** Send all changes of one gesture in one frame together. */
  sendLater(gesture, held, changes) {
    if (this.waiting && this.waiting.gesture !== gesture) this.send();
    if (!this.waiting) requestAnimationFrame(() => this.sendWhenHeard());
    this.waiting = { gesture, held, edit: { ...this.waiting?.edit, ...changes } };
  }

  /** Send an edit once Python has the last one, so that a busy kernel gets one of many frames. */
  sendWhenHeard() {
    if (this.unheard.length === 0) this.send();
  }

  send() {
    const edit = this.waiting;
    this.waiting = null;
    if (edit) this.post(edit);
  }

  /** Send a command for Python's session. */
  command(command) {
    this.send();
    this.post({ command });
  }

  post(message) {
    this.unheard = [...this.unheard, { ...message, count: ++this.count }];
    this.model.set("messages", { ...this.model.get("messages"), [this.name]: this.unheard });
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

  shareCamera(shared) {
    this.command(shared ? "one camera" : "two cameras");
  }

  rest() {
    if (this.holding) this.command("rest");
    this.holding = false;
  }
}
