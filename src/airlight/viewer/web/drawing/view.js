/**
 * Conversion of the view's parameters to directions in the observer's frame, for the shaders.
 *
 * The frame has z towards the zenith, x towards the sun's azimuth and y to the left of x; azimuth
 * increases clockwise seen from above. The formulas are those of scene/directions.py and
 * scene/observer.py.
 */
import { ASPECTS, camera_frame, direction_of, ground_axes, rolled } from "../generated/formulas.js";

const RADIAN = Math.PI / 180;

/** Largest size with a projection's aspect ratio that fits into a window. [pixel] */
export function fitting(projection, width, height) {
  const ratio = ASPECTS[projection];
  if (!ratio) return [Math.max(1, width), Math.max(1, height)];
  const side = Math.max(1, Math.min(height, Math.floor(width / ratio)));
  return [ratio * side, side];
}

/**
 * Camera of a view.
 *
 * @param {Object<string, number | string>} values View values by path.
 * @param {Object<string, [number, number]>} limits Limits of each projection's field of view. [deg]
 * @returns {{axes: number[][], sun: number[], fieldOfView: number, projection: string,
 *     detailed: boolean, ground: number[][], filter: number[] | null, dehaze: number}} Camera, with
 *     the field of view in radians, and the axis of its polarising filter.
 */
export function cameraOf(values, limits) {
  const projection = values["view.projection"];
  const [low, high] = limits[projection];
  const bearing = values["view.sun_azimuth"];
  const azimuth = (((values["view.heading"] - bearing) % 360) + 360) % 360;
  const axes = camera_frame(values["view.look_zenith"], azimuth, values["view.roll"]);
  return {
    projection,
    axes,
    dehaze: values["view.dehaze"],
    filter: values["view.filter"] ? rolled(axes[1], axes[0], values["view.polariser"]) : null,
    sun: direction_of(values["view.sun_zenith"], 0),
    fieldOfView: Math.min(Math.max(values["view.field_of_view"], low), high) * RADIAN,
    detailed: values["view.ground"] === "detailed",
    ground: ground_axes(values["view.latitude"], values["view.longitude"], bearing),
  };
}
