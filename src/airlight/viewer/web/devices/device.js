/**
 * Device that runs full-screen fragment passes: WebGPU or WebGL2, whichever has a GPU.
 *
 * Both back ends have the same methods:
 *
 * - `flatTexture(format, data)` — table for `textureLoad`, see textures.js;
 * - `image(format, width, height, texels)` — the same of a frame's size;
 * - `target(format, width, height)` — texture that a pass renders to and later ones read;
 * - `pipeline(shader, formats)` — promise of a compiled pass; the shader has `wgsl`, `glsl` with
 *   `vertex` and `fragment`, the names `vertex` and `entry` of its functions, the slot `uniforms`
 *   ("group/binding"; or several by the names of their variables) and the slots `reads`; `formats`
 *   are those of its targets, only `"screen"` for the canvas;
 * - `run(pipeline, uniforms, reads, targets, area)` — run one pass; `uniforms` are the values of
 *   the struct, or of several by slot; `reads` maps "group/binding" to textures, `targets` are
 *   textures, or none for the canvas; an area (left, top, width, height) limits the texels that are
 *   written, and the others are kept;
 * - `read(texture, area)` — promise of a texture's values, or of an area's, row 0 first;
 * - `resize(width, height)` — resize the canvas;
 * - `finished()` — promise that the work submitted so far is complete;
 * - `release(texture)` and `close()`;
 * - `lost` — promise of the reason if the device is lost;
 * - `space` — colour space of the canvas: that of the screen, as pictures are encoded.
 */
import { WebGpuDevice } from "./device_webgpu.js";
import { WebGl2Device } from "./device_webgl2.js";

/** Back ends in order of preference, if both have a GPU. */
const BACK_ENDS = { webgpu: WebGpuDevice, webgl2: WebGl2Device };

/**
 * Open a device on a canvas.
 *
 * A canvas that has provided a context of one kind never provides the other, so each back end is
 * checked before it touches the canvas.
 *
 * @param {HTMLCanvasElement} canvas
 * @param {string} wanted auto, webgpu, webgl2, or a name of `others`.
 * @param {Object<string, object>} others Further back ends, better than a card in software.
 * @returns {Promise<WebGpuDevice | WebGl2Device>}
 * @throws {Error} If no back end works; one line with the reason of each.
 */
export async function openDevice(canvas, wanted = "auto", others = {}) {
  const reasons = [];
  const known = { ...BACK_ENDS, ...others };
  for (const name of wanted === "auto" ? await ordered(others) : [wanted]) {
    try {
      if (!known[name]) throw new Error("not offered");
      return await known[name].open(canvas);
    } catch (error) {
      reasons.push(`${name}: ${error.message}`);
    }
  }
  throw new Error(`this browser draws with neither WebGPU nor WebGL2 (${reasons.join("; ")})`);
}

/**
 * Names of the back ends, the fastest first.
 *
 * A software GPU runs on the CPU: there WebGL2 shows a page after 9 s, WebGPU after
 * 64 s, and draws its frames four times as fast.
 */
async function ordered(others) {
  const names = Object.keys(BACK_ENDS);
  const soft = await Promise.all(names.map((name) => BACK_ENDS[name].isSoftware()));
  const quick = names.filter((_, i) => !soft[i]);
  return [...quick, ...Object.keys(others), ...names.filter((_, i) => soft[i]).reverse()];
}
