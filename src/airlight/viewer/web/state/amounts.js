/**
 * Amounts of the air that depend on each other: turbidity follows from gas and haze, and moves the
 * haze; as in session/edited_amounts.py. Their declarations are those of parameters/amounts.py.
 */
import { haze_of, turbidity_of } from "../generated/formulas.js";

/** Path of the turbidity, and of all numbers that are factors in the planet's file. */
const TURBIDITY = "air.turbidity";
const AIR = /^air\./;

/** Factor, in a link, of an amount; other values are as they are. */
export function toFactor(parameter, value) {
  return AIR.test(parameter.path) ? value / parameter.present : value;
}

/** Amount of a factor, in a link; other values are as they are. */
export function fromFactor(parameter, factor) {
  return AIR.test(parameter.path) ? factor * parameter.present : factor;
}

/** Whether a value follows from others, so that a link leaves it out. */
export function follows(path) {
  return path === TURBIDITY;
}

/**
 * Changes, with those that follow from them. Where changes have haze, as a reset and an undo do,
 * turbidity follows from it, whatever they say of it.
 *
 * @param {Map<string, object>} parameters Declared parameters, by path.
 * @param {Object<string, number>} values Values before.
 * @param {Object<string, number>} changes Validated changes, by path.
 * @returns {Object<string, number>}
 */
export function withFollowing(parameters, values, changes) {
  const turbidity = parameters.get(TURBIDITY);
  if (!turbidity || !Object.keys(changes).some((path) => AIR.test(path))) return changes;
  const all = [...parameters.values()];
  const of = (matter) => all.filter((one) => one.matter === matter);
  const depth = (matter, now) =>
    of(matter).reduce((sum, one) => sum + (now[one.path] / one.present) * one.depth, 0);
  const made = { ...changes };
  if (TURBIDITY in changes && !of("haze").some(({ path }) => path in changes)) {
    const before = depth("haze", values);
    // Without any haze it comes back as in the planet's file.
    const old = (one) => (before > 0 ? values[one.path] : one.present);
    const total = before > 0 ? before : of("haze").reduce((sum, one) => sum + one.depth, 0);
    const share = haze_of(changes[TURBIDITY], depth("gas", { ...values, ...changes })) / total;
    for (const one of of("haze")) made[one.path] = Math.min(old(one) * share, one.most);
  }
  const now = { ...values, ...made };
  const gas = depth("gas", now);
  made[TURBIDITY] = gas > 0 ? turbidity_of(gas, depth("haze", now)) : 1;
  return made;
}
