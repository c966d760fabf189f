/** Full-screen fragment passes on WebGL2; the interface is described in device.js. */
import { screenSpace } from "./screen_space.js";
import { flatSize, wholeRows } from "./textures.js";
import { CHANNELS, PACKED_FORMAT } from "../generated/sizes.js";

/** Polling interval for unfinished compilation or rendering. [ms] */
const PATIENCE = 4;

/** Names of renderers that are the CPU. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

export class WebGl2Device {
  /** Whether there is a context that renders in software. */
  static async isSoftware() {
    const gl = document.createElement("canvas").getContext("webgl2");
    if (!gl) return false;
    const name = rendererName(gl);
    gl.getExtension("WEBGL_lose_context")?.loseContext();
    return SOFTWARE.test(name);
  }

  /**
   * @param {HTMLCanvasElement} canvas
   * @returns {Promise<WebGl2Device>}
   * @throws {Error} If there is no context, or none that renders to float targets.
   */
  static async open(canvas) {
    const gl = canvas.getContext("webgl2", { alpha: false, antialias: false, depth: false });
    if (!gl) throw new Error("not offered");
    if (!gl.getExtension("EXT_color_buffer_float")) throw new Error("no float targets");
    return new WebGl2Device(canvas, gl);
  }

  constructor(canvas, gl) {
    this.kind = "webgl2";
    this.name = rendererName(gl);
    this.canvas = canvas;
    this.gl = gl;
    if ("drawingBufferColorSpace" in gl) gl.drawingBufferColorSpace = screenSpace();
    this.space = gl.drawingBufferColorSpace ?? "srgb";
    this.parallel = gl.getExtension("KHR_parallel_shader_compile");
    this.vertices = gl.createVertexArray();
    this.screen = null;
    this.closed = false;
    this.lost = new Promise((resolve) => {
      canvas.addEventListener("webglcontextlost", (event) => {
        event.preventDefault();
        resolve("the context was lost");
      });
    });
  }

  flatTexture(format, data) {
    const { width, height } = flatSize(data.length, format);
    return this.image(format, width, height, wholeRows(data, format));
  }

  image(format, width, height, texels) {
    const { gl } = this;
    const texture = this.texture(format, width, height);
    const layout = format === "r32float" ? gl.RED : gl.RGBA;
    const kind = format === PACKED_FORMAT ? gl.UNSIGNED_BYTE : gl.FLOAT;
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, layout, kind, texels);
    return { texture, framebuffer: null, format, width, height };
  }

  target(format, width, height) {
    const { gl } = this;
    const texture = this.texture(format, width, height);
    return { texture, framebuffer: gl.createFramebuffer(), format, width, height };
  }

  texture(format, width, height) {
    const { gl } = this;
    const texture = gl.createTexture();
    const floats = { r32float: gl.R32F, rgba32float: gl.RGBA32F };
    const inside = format === PACKED_FORMAT ? gl.RGBA8 : floats[format];
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, inside, width, height);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    return texture;
  }

  async pipeline(shader, formats) {
    const { gl } = this;
    const program = gl.createProgram();
    const parts = [
      [gl.VERTEX_SHADER, shader.glsl.vertex],
      [gl.FRAGMENT_SHADER, shader.glsl.fragment],
    ].map(([stage, text]) => {
      const part = gl.createShader(stage);
      gl.shaderSource(part, text);
      gl.compileShader(part);
      gl.attachShader(program, part);
      return part;
    });
    gl.linkProgram(program);
    // Without the extension each question below waits for its shader; between them the page is drawn.
    if (!this.parallel) await new Promise((resolve) => setTimeout(resolve, PATIENCE));
    while (this.parallel && !gl.isContextLost()) {
      if (gl.getProgramParameter(program, this.parallel.COMPLETION_STATUS_KHR)) break;
      await new Promise((resolve) => setTimeout(resolve, PATIENCE));
    }
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      const logs = [...parts.map((p) => gl.getShaderInfoLog(p)), gl.getProgramInfoLog(program)];
      throw new Error(`shader ${shader.entry}: ${logs.filter(Boolean).join(" ").trim()}`);
    }
    for (const part of parts) gl.deleteShader(part);
    return { program, formats, buffers: this.buffers(program, shader), places: new Map() };
  }

  /** Buffers, with their slots, of the uniform structs that are active in the shader. */
  buffers(program, { uniforms }) {
    const { gl } = this;
    const found = [];
    const blocks = gl.getProgramParameter(program, gl.ACTIVE_UNIFORM_BLOCKS);
    for (let block = 0; block < blocks; block++) {
      // A block has the capitalised name of its variable.
      const name = gl.getActiveUniformBlockName(program, block).toLowerCase();
      const named = Object.entries(uniforms ?? {}).find(([one]) => name === one);
      gl.uniformBlockBinding(program, block, block);
      found.push({ slot: named?.[1], buffer: gl.createBuffer() });
    }
    return found;
  }

  run(compiled, uniforms, reads, targets, area = null) {
    const { gl } = this;
    gl.useProgram(compiled.program);
    compiled.buffers.forEach(({ slot, buffer }, block) => {
      const numbers = uniforms instanceof Float32Array ? uniforms : uniforms[slot];
      gl.bindBuffer(gl.UNIFORM_BUFFER, buffer);
      gl.bufferData(gl.UNIFORM_BUFFER, numbers, gl.DYNAMIC_DRAW);
      gl.bindBufferBase(gl.UNIFORM_BUFFER, block, buffer);
    });
    Object.entries(reads).forEach(([slot, texture], unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, texture.texture);
      gl.uniform1i(this.place(compiled, slot), unit);
    });
    if (targets) this.attach(targets);
    else this.attachScreen();
    gl.bindVertexArray(this.vertices);
    if (area) {
      gl.enable(gl.SCISSOR_TEST);
      gl.scissor(...area);
    }
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.disable(gl.SCISSOR_TEST);
    if (!targets) this.show();
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  place(compiled, slot) {
    if (!compiled.places.has(slot)) {
      const name = `texture_${slot.replace("/", "_")}`;
      compiled.places.set(slot, this.gl.getUniformLocation(compiled.program, name));
    }
    return compiled.places.get(slot);
  }

  attach(targets) {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, targets[0].framebuffer);
    const points = targets.map((target, index) => {
      const point = gl.COLOR_ATTACHMENT0 + index;
      gl.framebufferTexture2D(gl.FRAMEBUFFER, point, gl.TEXTURE_2D, target.texture, 0);
      return point;
    });
    gl.drawBuffers(points);
    gl.viewport(0, 0, targets[0].width, targets[0].height);
  }

  /**
   * Attach the buffer into which pictures are drawn first, to be flipped: the shaders' first row is
   * that of a texture, which is the bottom row of a canvas.
   */
  attachScreen() {
    const { gl, canvas } = this;
    if (!this.screen) {
      this.screen = { framebuffer: gl.createFramebuffer(), buffer: gl.createRenderbuffer() };
    }
    const { framebuffer, buffer } = this.screen;
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    if (this.screen.width !== canvas.width || this.screen.height !== canvas.height) {
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
      gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA8, canvas.width, canvas.height);
      gl.framebufferRenderbuffer(
        gl.FRAMEBUFFER,
        gl.COLOR_ATTACHMENT0,
        gl.RENDERBUFFER,
        buffer,
      );
      Object.assign(this.screen, { width: canvas.width, height: canvas.height });
    }
    gl.drawBuffers([gl.COLOR_ATTACHMENT0]);
    gl.viewport(0, 0, canvas.width, canvas.height);
  }

  show() {
    const { gl } = this;
    const { width, height } = this.canvas;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.screen.framebuffer);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    gl.blitFramebuffer(
      0,
      0,
      width,
      height,
      0,
      height,
      width,
      0,
      gl.COLOR_BUFFER_BIT,
      gl.NEAREST,
    );
  }

  async read(texture, area = [0, 0, texture.width, texture.height]) {
    const { gl } = this;
    const numbers = new Float32Array(area[2] * area[3] * 4);
    gl.bindFramebuffer(gl.FRAMEBUFFER, texture.framebuffer);
    const point = gl.COLOR_ATTACHMENT0;
    gl.framebufferTexture2D(gl.FRAMEBUFFER, point, gl.TEXTURE_2D, texture.texture, 0);
    gl.readBuffer(point);
    gl.readPixels(...area, gl.RGBA, gl.FLOAT, numbers);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    if (CHANNELS[texture.format] === 4) return numbers;
    return numbers.filter((_, index) => index % 4 === 0);
  }

  resize(width, height) {
    if (this.canvas.width === width && this.canvas.height === height) return;
    this.canvas.width = width;
    this.canvas.height = height;
  }

  async finished() {
    const { gl } = this;
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    while (!gl.isContextLost()) {
      const state = gl.clientWaitSync(fence, 0, 0);
      if (state !== gl.TIMEOUT_EXPIRED) break;
      await new Promise((resolve) => setTimeout(resolve, PATIENCE));
    }
    gl.deleteSync(fence);
  }

  release(texture) {
    this.gl.deleteTexture(texture.texture);
    if (texture.framebuffer) this.gl.deleteFramebuffer(texture.framebuffer);
  }

  close() {
    this.closed = true;
    this.gl.getExtension("WEBGL_lose_context")?.loseContext();
  }
}

/** Name of the GPU, or of the program in its place. */
function rendererName(gl) {
  const names = gl.getExtension("WEBGL_debug_renderer_info");
  return String(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
}
