/**
 * Declared parameters: validation, slider position and formatting of values.
 *
 * A parameter is an object as declared in viewer/parameters/parameter.py and written by `as_json`.
 */
import { numberOf, quantityText } from "./number_text.js";

/**
 * Validate a value, wrapping it into the range if the parameter is periodic.
 *
 * @param {object} parameter
 * @param {number | string | boolean} value
 * @returns {number | string | boolean}
 * @throws {RangeError} If the value is invalid; one line with the allowed values.
 */
export function checked(parameter, value) {
  const refuse = (allowed) => {
    const { path, label } = parameter; // a page's amounts are no keys of a file
    throw new RangeError(`${path.startsWith("air.") ? label : path} is ${value}; allowed: ${allowed}`);
  };
  if (parameter.kind === "switch") {
    return typeof value === "boolean" ? value : refuse("true or false");
  }
  if (parameter.kind === "choice") {
    return parameter.options.includes(value) ? value : refuse(parameter.options.join(", "));
  }
  if (parameter.kind === "text") {
    return typeof value === "string" ? value : refuse("a text");
  }
  const { least = -Infinity, most = Infinity } = parameter;
  const unit = parameter.unit === "1" ? "" : ` ${parameter.unit}`;
  const number = typeof value === "number" ? value : NaN;
  if (!Number.isFinite(number)) refuse(`${least} to ${most}${unit}`);
  if (parameter.wraps) return wrapped(number, least, most);
  // A slider's end may miss the limit by rounding.
  const slack = (limit) => (Number.isFinite(limit) ? 1e-12 * Math.abs(limit) : 0);
  if (number < least - slack(least) || number > most + slack(most)) {
    refuse(`${least} to ${most}${unit}`);
  }
  return Math.min(Math.max(number, least), most);
}

/** Number wrapped into a range. */
export function wrapped(number, least, most) {
  const span = most - least;
  return least + ((((number - least) % span) + span) % span);
}

/** Value [unit] at a fraction of the slider, 0 at its low end, 1 at its high end. */
export function numberAt(parameter, share) {
  const { low, high, scale } = parameter;
  if (scale !== "log") return low + (high - low) * share;
  return low * (high / low) ** share;
}

/** Fraction of the slider at which a number lies, clamped to between 0 and 1. */
export function shareOf(parameter, number) {
  const { low, high, scale } = parameter;
  const share =
    scale === "log"
      ? Math.log(Math.max(number, low) / low) / Math.log(high / low)
      : (number - low) / (high - low);
  return Math.min(Math.max(share, 0), 1);
}

/** Number from a slider, rounded to the slider's resolution. */
export function rounded(parameter, number) {
  const fine =
    parameter.scale === "log" ? Math.abs(number) : Math.abs(parameter.high - parameter.low);
  if (!(fine > 0)) return number;
  const digits = Math.min(Math.max(3 - Math.floor(Math.log10(fine)), -12), 20);
  return digits >= 0 ? Number(number.toFixed(digits)) : Math.round(number * 10 ** digits) / 10 ** digits;
}

/** Text of a value in a field. */
export function written({ unit }, value) {
  return typeof value === "number" ? quantityText(value, unit) : String(value);
}

/** Number of a field's text [unit]; NaN for a text that is none. */
export function read({ unit }, text) {
  return numberOf(text, unit);
}
