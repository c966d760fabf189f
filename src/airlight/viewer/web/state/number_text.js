/** Numbers and quantities as people write them: the rules of parameters/number_text.py. */

/** Length from which it is written in kilometres, and in millions of them. [m] */
const FAR = 1e4;
const VERY_FAR = 1e9;
/** Luminance from which it is written without a prefix, and prefixes below it. [cd m⁻²], [1] */
const BRIGHT = 0.1;
const PREFIXES = [[1e3, "m"], [1e6, "µ"], [1e9, "n"]];
/** Powers of ten between which a number is written without one. */
const [SMALLEST, LARGEST] = [-3, 6];
const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";

const raised = (text) =>
  text.replace(/[-0-9]/g, (one) => (one === "-" ? "⁻" : RAISED[Number(one)]));
const lowered = (text) =>
  text.replace(/[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]/g, (one) => (one === "⁻" ? "-" : RAISED.indexOf(one)));
const short = (digits) => (digits.includes(".") ? digits.replace(/\.?0+$/, "") : digits);

/** Number with three significant digits, and all its digits before the point. */
export function numberText(value, decimals = 0) {
  if (value === 0) return "0";
  const [mantissa, exponent] = value.toExponential(2).split("e");
  const power = Number(exponent);
  if (power < SMALLEST || power >= LARGEST) return `${short(mantissa)}·10${raised(String(power))}`;
  return short(value.toFixed(Math.max(decimals, 2 - power, 0)));
}

/** Number with its unit: lengths in m or km, hours as a clock has them. */
export function quantityText(value, unit) {
  if (unit === "m" && Math.abs(value) >= VERY_FAR) return `${numberText(1e-9 * value)} million km`;
  if (unit === "m" && Math.abs(value) >= FAR) return `${numberText(1e-3 * value)} km`;
  if (unit === "h" && value >= 0 && value <= 24) {
    const minutes = Math.floor(60 * value + 0.5);
    return `${Math.floor(minutes / 60)}:${String(minutes % 60).padStart(2, "0")}`;
  }
  if (unit === "cd/m^2") return luminanceText(value);
  return withUnit(numberText(value, unit === "deg" ? 1 : 0), unit);
}

/** Luminance [cd m⁻²]; a dark one in thousandths, millionths or billionths. */
export function luminanceText(value) {
  const [factor, prefix] = PREFIXES.find(([one]) => value * one >= 1) ?? [1, ""];
  if (value > 0 && value < BRIGHT) return `${numberText(value * factor)} ${prefix}cd/m²`;
  return `${numberText(value)} cd/m²`;
}

function withUnit(number, unit) {
  if (unit === "deg") return `${number}°`;
  if (unit === "1" || unit === "") return number;
  const [above, ...below] = unit.split("/");
  const power = (one) => one.replace(/^um/, "µm").replace(/\^(.*)$/, (_, digits) => raised(digits));
  const words = below.filter(Boolean).map(power);
  const under = words.length === 1 ? words[0] : `(${words.join(" ")})`;
  const over = above === "1" ? "" : power(above);
  return `${number} ${words.length ? `${over}/${under}` : over}`;
}

/** Time [ms], in ms or in s. */
export function timeText(milliseconds) {
  return milliseconds < 1000
    ? `${milliseconds.toFixed(0)} ms`
    : `${(milliseconds / 1000).toFixed(1)} s`;
}

/** Number of a text [unit], with or without the unit; NaN for a text that is none. */
export function numberOf(text, unit) {
  const words = text.trim().replace(",", ".").replace(/^−/, "-");
  const clock = /^(\d{1,2}):(\d{2})$/.exec(words);
  if (clock) return unit === "h" ? Number(clock[1]) + Number(clock[2]) / 60 : NaN;
  const [, digits, power, rest] =
    /^([-+.\de]+)(?:·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?\s*(.*)$/.exec(words) ?? [];
  const number = Number(`${digits}${power ? `e${lowered(power)}` : ""}`);
  if (digits === undefined) return NaN;
  if (unit === "m") return number * ({ "": 1, m: 1, km: 1e3, "million km": 1e9 }[rest] ?? NaN);
  return ["", unit, withUnit("", unit).trim()].includes(rest) ? number : NaN;
}
