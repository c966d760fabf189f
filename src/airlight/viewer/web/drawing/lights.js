/**
 * Lights of a view: the planet's star, and the Moon or a second star.
 *
 * A frame is the sum over lights, each rendered in its own frame.
 */
import {
  OCCULTER,
  SHADING,
  bright_limb,
  direction_of,
  light_left,
  light_visibility,
  moon_phase_factor,
  phase_shading,
} from "../generated/formulas.js";
import { cameraOf } from "./view.js";

const RADIAN = Math.PI / 180;
const CHANNELS = ["red", "green", "blue"];
/** Uniform disc: limb-darkening coefficients of six powers at four wavelengths. */
export const EVEN = Float32Array.from({ length: 24 }, (_, i) => Number(i < 4));
const STAR_DISC = { phased: 0, ...Object.fromEntries(SHADING.map((name) => [name, 0])) };
/** Light of the night, which belongs to the first light. */
const NIGHT = ["lamp_red", "lamp_green", "lamp_blue", "airglow", "skyglow"];

/**
 * Visible lights.
 *
 * @param {Object<string, number | string | boolean>} values Values of all parameters, by path.
 * @param {object} planet Data of the solution, see picture.js; `second` from
 *     viewer/browser/package.py.
 * @param {Object<string, [number, number]>} projections Limits of the field of view. [deg]
 * @returns {object[]} One or two lights: `camera`, `star` (angular radius [rad]), `air` (whether air
 *     and ground are lit), `left` (share of its light that a moon leaves), `numbers` (uniforms of
 *     its own), `law` (darkening of its disc; null for that of the planet's star), and of the first
 *     `suns`, directions and angular radii of all.
 */
export function lightsOf(values, planet, projections) {
  const camera = cameraOf(values, projections);
  const second = secondOf(values, planet, projections);
  const own = [...Object.keys(colorsOf([], [])), "star_radius", ...NIGHT];
  const numbers = Object.fromEntries(own.map((name) => [name, planet.uniforms[name]]));
  const suns = [[camera.sun, planet.star]];
  if (values["view.second_light"] !== "none") {
    const towards = direction_of(values["view.second_zenith"], azimuthOf(values));
    suns.push([towards, values["view.second_radius"] * RADIAN]);
  }
  const { left, moon } = occulted(values, suns);
  for (const name of Object.keys(colorsOf([], []))) numbers[name] *= left;
  const occulter = Object.fromEntries(OCCULTER.map((name, i) => [name, moon[i]]));
  const first = {
    camera,
    star: planet.star,
    air: true,
    left,
    numbers: { ...numbers, ...STAR_DISC, ...occulter, draws_air: 1 },
    law: null,
    suns,
  };
  return second ? [first, second] : [first];
}

/** Unocculted fraction of the star, direction and radius of the Moon: occulted_light.py. */
function occulted(values, [[sun, star], other]) {
  if (values["view.second_light"] === "moon") {
    const [moon, radius] = other;
    const apart = 2 * Math.asin(Math.min(0.5 * Math.hypot(...sun.map((x, i) => x - moon[i])), 1));
    if (apart < star + radius) {
      return { left: light_left(star, apart, radius), moon: [...moon, radius] };
    }
  }
  return { left: 1, moon: [0, 0, 0, 0] };
}

/** Azimuth of the second light from the sun's side, to the right. [deg] */
function azimuthOf(values) {
  return values["view.second_azimuth"] - values["view.sun_azimuth"];
}

function secondOf(values, planet, projections) {
  const kind = values["view.second_light"];
  if (kind === "none" || kind === undefined) return null;
  const radius = values["view.second_radius"];
  const zenith = values["view.second_zenith"];
  const share = Math.sin(radius * RADIAN) ** 2;
  const light = kind === "moon" ? moonOf(values, planet, share) : starOf(values, planet, share);
  const ratio = light.irradiance.map((one, i) => one / planet.second.irradiance[i]);
  const shown = light_visibility(
    zenith,
    values["view.sun_zenith"],
    radius,
    Math.max(...ratio),
    values["view.altitude"],
    planet.radius,
    planet.thickness,
  );
  if (shown === 0) return null;
  const azimuth = values["view.second_azimuth"];
  const moved = { ...values, "view.sun_zenith": zenith, "view.sun_azimuth": azimuth };
  const camera = cameraOf(moved, projections);
  return {
    camera,
    star: radius * RADIAN,
    air: shown > 1,
    left: 1,
    numbers: {
      ...colorsOf(light.irradiance, light.weights),
      ...Object.fromEntries([...NIGHT, ...OCCULTER].map((name) => [name, 0])),
      ...light.shading(Math.hypot(camera.sun[0], camera.sun[1]), camera.sun[2]),
      star_radius: radius * RADIAN,
      draws_air: Number(shown > 1),
    },
    law: light.law,
  };
}

/** Moon: reflected light of the planet's star. */
function moonOf(values, { second }, share) {
  const phase = values["view.moon_phase"];
  const limb = bright_limb(values["view.second_zenith"], azimuthOf(values), values["view.sun_zenith"]);
  const part = share * moon_phase_factor(phase);
  return {
    irradiance: second.irradiance.map((one, i) => one * second.moon.albedo[i] * part),
    weights: second.moon.weights,
    law: EVEN,
    shading(level, up) {
      const numbers = phase_shading(phase, limb, level, up);
      return { phased: 1, ...Object.fromEntries(SHADING.map((name, i) => [name, numbers[i]])) };
    },
  };
}

/** Second star: black body, interpolated in temperature. */
function starOf(values, { second: { stars } }, share) {
  const cold = 1 / values["view.second_temperature"];
  const after = stars.findIndex(({ temperature }) => 1 / temperature <= cold);
  const i = Math.max(1, after < 0 ? stars.length - 1 : after);
  const [low, high] = [stars[i - 1], stars[i]];
  const way = (cold - 1 / low.temperature) / (1 / high.temperature - 1 / low.temperature);
  const part = Math.min(Math.max(way, 0), 1);
  const between = (name) => low[name].map((one, k) => one + part * (high[name][k] - one));
  return {
    irradiance: between("irradiance").map((one) => share * Math.exp(one)),
    weights: between("weights"),
    law: Float32Array.from(between("darkening")),
    shading: () => STAR_DISC,
  };
}

/** Colour matrix uniforms; 0 for unused wavelengths. */
function colorsOf(irradiance, weights) {
  const numbers = {};
  CHANNELS.forEach((channel, c) => {
    for (let i = 0; i < 4; i++) {
      numbers[`${channel}_${i}`] = i < irradiance.length ? irradiance[i] * weights[3 * i + c] : 0;
    }
  });
  return numbers;
}
