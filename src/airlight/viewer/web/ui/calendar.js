/** Row of the sun's date and time, with the browser's own calendar and clock. */
import { quantityText } from "../state/number_text.js";
import { element } from "./element.js";

/** Paths of the date. */
export const YEAR = "view.year";
const DAY = "view.day";
const HOUR = "view.hour";
/** Milliseconds of a day, and its last minute. [ms], [h] */
const MILLISECONDS = 86400000;
const LAST = 24 - 1 / 60;

/**
 * Calendar and clock of a state, in UTC.
 *
 * @param {State} state
 * @param {(error: Error) => void} refuse Called where the state refuses a date.
 * @returns {{element: HTMLElement, show: () => void}} Row, and what updates it.
 */
export function calendarRow(state, refuse) {
  const { least, most } = state.parameters.get(YEAR);
  const date = element("input", {
    type: "date",
    min: `${least}-01-01`,
    max: `${most}-12-31`,
    ariaLabel: "date of the sun",
  });
  const clock = element("input", { type: "time", ariaLabel: "time of the sun, UTC" });
  const set = (changes) => {
    try {
      state.set(changes);
      state.rest();
    } catch (error) {
      refuse(error);
    }
  };
  date.addEventListener("change", () => {
    if (!date.valueAsDate) return show();
    const year = date.valueAsDate.getUTCFullYear();
    const day = (date.valueAsNumber - Date.UTC(year, 0, 1)) / MILLISECONDS + 1;
    set({ [YEAR]: year, [DAY]: day });
  });
  clock.addEventListener("change", () => {
    if (clock.value) set({ [HOUR]: clock.valueAsNumber / (MILLISECONDS / 24) });
  });
  function show() {
    const [year, day, hour] = [YEAR, DAY, HOUR].map((path) => state.get(path));
    const text = quantityText(Math.min(hour, LAST), "h").padStart(5, "0");
    // A field that is typed into keeps its text.
    if (document.activeElement !== date) {
      date.valueAsNumber = Date.UTC(Math.floor(year), 0, Math.floor(day));
    }
    if (document.activeElement !== clock) clock.value = text;
  }
  show();
  return { element: element("div", { className: "airlight-row airlight-date" }, date, clock), show };
}
