/** Search of parameters by what people say. */
import { element } from "./element.js";

/** Whether a parameter answers to a search, as `Parameter.answers` in parameters/parameter.py. */
export function answers(parameter, search) {
  const { label, group, synonyms = [], help, path } = parameter;
  const text = [label, group, ...synonyms, help, path].join(" ").toLowerCase();
  return search
    .toLowerCase()
    .split(/\s+/)
    .every((word) => text.includes(word));
}

/**
 * Search field; Escape clears it.
 *
 * @param {(words: string) => void} find Called with the words after each change.
 * @returns {HTMLInputElement}
 */
export function searchField(find) {
  const field = element("input", {
    type: "search",
    className: "airlight-search",
    placeholder: "find: haze, ozone, zoom, sunset …",
    ariaLabel: "find a parameter",
    spellcheck: false,
  });
  field.addEventListener("input", () => find(field.value.trim()));
  return field;
}
