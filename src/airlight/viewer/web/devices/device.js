/**
 * A device that runs full-screen fragment passes: WebGPU where it works, WebGL2 elsewhere.
 *
 * Both back ends have the same methods:
 *
 * - `flatTexture(format, data)` — a table for `textureLoad`, see textures.js;
 * - `target(format, width, height)` — a texture that a pass draws into and later ones read;
 * - `pipeline(shader, formats)` — a promise of a compiled pass; the shader has `wgsl`, `glsl` with
 *   `vertex` and `fragment`, the names `vertex` and `entry` of its functions, the slot `uniforms`
 *   ("group/binding"; or several by the names of their variables) and the slots `reads`; `formats`
 *   are those of its targets, `"screen"` alone for the canvas;
 * - `run(pipeline, uniforms, reads, targets, area)` — one pass; `uniforms` are the numbers of the
 *   struct, or of several by slot; `reads` maps "group/binding" to textures, `targets` are textures,
 *   or none for the canvas; with an area (left, top, width, height) only its texels are filled, and
 *   the others stay;
 * - `read(texture, area)` — a promise of its numbers, or of an area's, row 0 first;
 * - `resize(width, height)` — of the canvas;
 * - `finished()` — a promise that the work handed over so far is done;
 * - `release(texture)` and `close()`;
 * - `lost` — a promise of the reason if the device goes away.
 */
import { WebGpuDevice } from "./device_webgpu.js";
import { WebGl2Device } from "./device_webgl2.js";

/** Back ends in the order in which they are tried. */
const BACK_ENDS = { webgpu: WebGpuDevice, webgl2: WebGl2Device };

/**
 * Open a device on a canvas.
 *
 * A canvas that has once given a context of one kind never gives the other: so each back end is
 * asked before it touches the canvas.
 *
 * @param {HTMLCanvasElement} canvas
 * @param {string} wanted auto, webgpu or webgl2.
 * @returns {Promise<WebGpuDevice | WebGl2Device>}
 * @throws {Error} One line with the reason of each back end.
 */
export async function openDevice(canvas, wanted = "auto") {
  const reasons = [];
  for (const [name, backEnd] of Object.entries(BACK_ENDS)) {
    if (wanted !== "auto" && wanted !== name) continue;
    try {
      return await backEnd.open(canvas);
    } catch (error) {
      reasons.push(`${name}: ${error.message}`);
    }
  }
  throw new Error(`this browser draws with neither WebGPU nor WebGL2 (${reasons.join("; ")})`);
}
