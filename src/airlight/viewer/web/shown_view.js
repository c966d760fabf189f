/** The fields of the uniform struct that belong to the view, from its parameters. */

/**
 * @param {Program} program
 * @param {object} camera From `cameraOf`.
 * @param {Object<string, number | string>} values Of all parameters.
 * @param {number} width
 * @param {number} height [pixel]
 */
export function setView(program, camera, values, width, height) {
  const [right, up, forward] = camera.axes;
  program.set("camera_right", right);
  program.set("camera_up", up);
  program.set("camera_forward", forward);
  program.set("frame", [width, height, Math.tan(0.5 * camera.fieldOfView)]);
}

/** @param {number} exposure [EV] */
export function setDisplay(program, values, exposure) {
  program.set("display", 2 ** exposure);
}
