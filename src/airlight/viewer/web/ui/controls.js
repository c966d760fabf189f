/** Panel with one control per declared parameter, in collapsible groups, or those searched. */
import { checked, numberAt, read, rounded, shareOf, written } from "../state/parameters.js";
import { YEAR, calendarRow } from "./calendar.js";
import { element } from "./element.js";
import { answers } from "./search.js";

/** Groups that are shown first, expanded: amounts of the air, then the view's. */
const FIRST = ["amounts", "camera", "sun", "moon", "display", "light"];
/** Suffix of the label of a list's item. */
const ITEM = / (at \S+ \S+|\d+)$/;
/** Number of positions of a slider. */
const STEPS = 1000;

export class Controls {
  /**
   * @param {HTMLElement} place Parent element of the controls.
   * @param {State} state
   * @param {(text: string) => void} explain Called with the help text of the control in use.
   */
  constructor(place, state, explain) {
    this.place = place;
    this.state = state;
    this.explain = explain;
    this.rows = new Map();
    this.folded = new Map();
    this.advanced = false;
    this.words = "";
    this.build();
    this.stop = state.subscribe((changed) => this.update(changed));
  }

  /** Rebuild the controls, as after a change of the declared parameters. */
  build() {
    this.rows.clear();
    this.showDate = null;
    const groups = new Map();
    const all = [...this.state.parameters.values()];
    const rank = ({ group }) => (FIRST.indexOf(group) + FIRST.length + 1) % (FIRST.length + 1);
    for (const parameter of all.sort((a, b) => rank(a) - rank(b))) {
      if (parameter.mode === "derived") continue;
      if (this.words ? !answers(parameter, this.words) : !this.offers(parameter)) continue;
      const group = this.fold(groups, parameter.group, this.place, parameter.group);
      const list = parameter.part_of
        ? this.fold(groups, parameter.part_of, group.body, parameter.label.replace(ITEM, ""))
        : group;
      const row = this.row(parameter);
      this.rows.set(parameter.path, row);
      if (parameter.path === YEAR && !this.words) list.body.append(this.dateRow());
      list.body.append(row.element);
    }
    const tops = [...groups.values()].filter((one) => one.top);
    const none = element("p", { className: "airlight-none" }, "nothing of that name");
    this.place.replaceChildren(...(tops.length ? tops.map((one) => one.element) : [none]));
    this.update(new Set(this.rows.keys()));
  }

  /** Row with a calendar and a clock, which set the date of the sun. */
  dateRow() {
    const { element: row, show } = calendarRow(this.state, (error) => this.explain(error.message));
    this.showDate = show;
    return row;
  }

  offers({ mode }) {
    return mode !== "advanced" || this.advanced;
  }

  /** Show only the parameters that answer to some words; all again for none. */
  search(words) {
    this.words = words;
    this.build();
  }

  fold(groups, name, place, label) {
    if (groups.has(name)) return groups.get(name);
    const body = element("div", { className: "airlight-body" });
    const fold = element("details", {}, element("summary", { textContent: label }), body);
    fold.open = this.words !== "" || (this.folded.get(name) ?? FIRST.includes(name));
    if (!this.words) fold.addEventListener("toggle", () => this.folded.set(name, fold.open));
    const made = { element: fold, body, top: place === this.place };
    if (!made.top) place.append(fold);
    groups.set(name, made);
    return made;
  }

  row(parameter) {
    const make = { number: numberRow, choice: choiceRow, switch: switchRow, text: textRow };
    const set = (value, held = false) => {
      try {
        this.state.set({ [parameter.path]: value }, parameter.path, held);
        row.element.classList.remove("airlight-wrong");
      } catch (error) {
        row.element.classList.add("airlight-wrong");
        this.explain(error.message);
      }
    };
    const row = make[parameter.kind](parameter, set, () => this.state.rest());
    row.element.dataset.path = parameter.path;
    const help = () => this.explain(`${parameter.label}: ${parameter.help}`);
    row.element.addEventListener("pointerenter", help);
    row.element.addEventListener("focusin", help);
    return row;
  }

  update(changed) {
    this.showDate?.();
    for (const path of changed) {
      const row = this.rows.get(path);
      if (!row) continue;
      row.element.classList.remove("airlight-wrong");
      row.show(this.state.get(path));
    }
  }

  close() {
    this.stop();
    this.place.replaceChildren();
  }
}

function labelled(parameter, ...inputs) {
  const label = element("span", { className: "airlight-label" }, parameter.label);
  return element("label", { className: `airlight-row airlight-${parameter.kind}` }, label, ...inputs);
}

/** Call `take` once a text is entered; in JupyterLab, Enter alone does not tell of a change. */
function taken(field, take) {
  field.addEventListener("change", take);
  field.addEventListener("keydown", ({ key }) => key === "Enter" && take());
}

function numberRow(parameter, set, rest) {
  const field = element("input", { type: "text", inputMode: "decimal", spellcheck: false });
  const slider = element("input", { type: "range", min: 0, max: STEPS, step: 1 });
  field.ariaLabel = parameter.label;
  slider.ariaLabel = `${parameter.label}, slider`;
  slider.addEventListener("input", () => {
    const number = rounded(parameter, numberAt(parameter, slider.valueAsNumber / STEPS));
    const { least = -Infinity, most = Infinity } = parameter;
    set(Math.min(Math.max(number, least), most), true);
  });
  slider.addEventListener("change", rest);
  let shown = 0;
  // The text is rounded: one that was not changed is the value itself.
  const typed = () =>
    field.value === written(parameter, shown) ? shown : read(parameter, field.value);
  taken(field, () => {
    set(typed());
  });
  field.addEventListener("keydown", (event) => {
    if (event.key === "Escape") field.value = written(parameter, shown);
    const way = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (!way) return;
    event.preventDefault();
    const number = typed();
    const { step, scale } = parameter;
    const moved = scale === "log" ? number * step ** way : number + way * step;
    try {
      set(checked(parameter, rounded(parameter, moved)));
    } catch {
      // An arrow key at the end of the range does nothing.
    }
  });
  return {
    element: labelled(parameter, field, slider),
    show(value) {
      if (document.activeElement !== field || typed() !== value) {
        field.value = written(parameter, value);
      }
      shown = value;
      slider.value = String(Math.round(STEPS * shareOf(parameter, value)));
    },
  };
}

function choiceRow(parameter, set) {
  const options = parameter.options.map((name) => element("option", { value: name }, name));
  const list = element("select", {}, ...options);
  list.addEventListener("change", () => set(list.value));
  return { element: labelled(parameter, list), show: (value) => void (list.value = value) };
}

function switchRow(parameter, set) {
  const box = element("input", { type: "checkbox" });
  box.addEventListener("change", () => set(box.checked));
  return { element: labelled(parameter, box), show: (value) => void (box.checked = value) };
}

function textRow(parameter, set) {
  const field = element("input", { type: "text", spellcheck: false });
  taken(field, () => set(field.value));
  return { element: labelled(parameter, field), show: (value) => void (field.value = value) };
}
