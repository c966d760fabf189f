/** Help overlay of a viewer. */
import { KEYS } from "../generated/keys.js";
import { element } from "./element.js";

/** Help overlay with the table of keys. */
export function helpPanel() {
  const groups = KEYS.help.map(([group, lines]) => {
    const rows = lines.map(([keys, text]) =>
      element("tr", {}, element("th", {}, keys), element("td", {}, text)),
    );
    return element("div", {}, element("h3", {}, group), element("table", {}, ...rows));
  });
  const panel = { className: "airlight-over airlight-help", hidden: true };
  return element("div", panel, ...groups);
}
