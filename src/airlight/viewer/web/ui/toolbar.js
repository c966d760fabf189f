/** Toolbar of buttons above the controls, with a menu behind the last. */
import { element } from "./element.js";

/**
 * Fill a toolbar.
 *
 * @param {HTMLElement} place Parent element of the buttons.
 * @param {[string, string, string, (state: State, viewer: Viewer) => object][]} buttons Action,
 *     text, explanation, and a function of the current `disabled`, `hidden` and `pressed`.
 * @param {[string, string, string, (state: State, viewer: Viewer) => object][]} entries Same, of
 *     the menu, which closes once one is chosen.
 * @param {Viewer} viewer Viewer that performs the actions and has the `state`.
 * @returns {() => void} Function that updates the buttons.
 */
export function toolbar(place, buttons, entries, viewer) {
  const menu = element("details", { className: "airlight-menu" });
  const make = ([action, text, help, moment]) => {
    const button = element("button", { type: "button", textContent: text, title: help });
    button.dataset.action = action;
    button.addEventListener("click", () => {
      menu.open = false;
      viewer.do(action);
    });
    return [button, moment];
  };
  const [shown, listed] = [buttons.map(make), entries.map(make)];
  const list = element("div", {}, ...listed.map(([button]) => button));
  menu.append(element("summary", { textContent: "menu", title: "What else can be done." }), list);
  menu.addEventListener("focusout", ({ relatedTarget }) => {
    if (relatedTarget && !menu.contains(relatedTarget)) menu.open = false;
  });
  place.replaceChildren(...shown.map(([button]) => button), menu);
  const update = () => {
    for (const [button, moment] of [...shown, ...listed]) {
      const { disabled = false, hidden = false, pressed } = moment(viewer.state, viewer);
      Object.assign(button, { disabled, hidden });
      if (pressed !== undefined) button.ariaPressed = String(pressed);
    }
  };
  update();
  return update;
}
