/** Full-screen fragment passes on WebGPU; the interface is described in device.js. */
import { screenSpace } from "./screen_space.js";
import { flatSize, wholeRows } from "./textures.js";
import { CHANNELS } from "../generated/sizes.js";

/** Alignment of rows when a texture is copied into a buffer. [byte] */
const ROW_ALIGNMENT = 256;

/** Names of adapters that are the CPU. */
const SOFTWARE = /swiftshader|llvmpipe|lavapipe|software|basic render/i;

export class WebGpuDevice {
  /** Whether there is an adapter that renders in software. */
  static async isSoftware() {
    const adapter = await navigator.gpu?.requestAdapter();
    if (!adapter) return false;
    const { info = {} } = adapter;
    const names = [info.vendor, info.architecture, info.device, info.description].join(" ");
    return Boolean(info.isFallbackAdapter ?? adapter.isFallbackAdapter) || SOFTWARE.test(names);
  }

  /**
   * @param {HTMLCanvasElement} canvas
   * @returns {Promise<WebGpuDevice>}
   * @throws {Error} If there is no adapter, device or context.
   */
  static async open(canvas) {
    if (!navigator.gpu) throw new Error("not offered");
    const adapter = await navigator.gpu.requestAdapter();
    if (!adapter) throw new Error("no adapter");
    const device = await adapter.requestDevice();
    const context = canvas.getContext("webgpu");
    if (!context) throw new Error("no context on this canvas");
    return new WebGpuDevice(canvas, context, adapter, device);
  }

  constructor(canvas, context, adapter, device) {
    const info = adapter.info ?? {};
    this.kind = "webgpu";
    this.name = info.description || [info.vendor, info.architecture].filter(Boolean).join(" ");
    this.canvas = canvas;
    this.context = context;
    this.device = device;
    this.format = navigator.gpu.getPreferredCanvasFormat();
    this.space = screenSpace();
    context.configure({
      device,
      format: this.format,
      alphaMode: "opaque",
      colorSpace: this.space,
    });
    this.lost = device.lost.then((info) => info.message || info.reason);
    this.closed = false;
  }

  flatTexture(format, data) {
    const { width, height } = flatSize(data.length, format);
    return this.image(format, width, height, wholeRows(data, format));
  }

  image(format, width, height, texels) {
    const texture = this.device.createTexture({
      size: [width, height],
      format,
      usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST,
    });
    const bytesPerRow = width * CHANNELS[format] * texels.BYTES_PER_ELEMENT;
    this.device.queue.writeTexture({ texture }, texels, { bytesPerRow }, [width, height]);
    return wrapped(texture, format, width, height);
  }

  target(format, width, height) {
    const texture = this.device.createTexture({
      size: [width, height],
      format,
      usage:
        GPUTextureUsage.RENDER_ATTACHMENT |
        GPUTextureUsage.TEXTURE_BINDING |
        GPUTextureUsage.COPY_SRC,
    });
    return wrapped(texture, format, width, height);
  }

  async pipeline(shader, formats) {
    const module = this.device.createShaderModule({ code: shader.wgsl });
    const targets = formats.map((format) => ({
      format: format === "screen" ? this.format : format,
    }));
    const layout = this.layout(shader);
    const pipeline = await this.device.createRenderPipelineAsync({
      layout: this.device.createPipelineLayout({ bindGroupLayouts: layout }),
      vertex: { module, entryPoint: shader.vertex },
      fragment: { module, entryPoint: shader.entry, targets },
    });
    const buffers = new Map(slotsOf(shader).map((slot) => [slot, null]));
    return { pipeline, layout, buffers, groups: null, bound: null };
  }

  /** Explicit bind group layouts; automatic ones omit bindings that an entry does not use. */
  layout(shader) {
    const groups = [];
    const visibility = GPUShaderStage.VERTEX | GPUShaderStage.FRAGMENT;
    const add = (slot, kind) => {
      const [group, binding] = slot.split("/").map(Number);
      (groups[group] ??= []).push({ binding, visibility, ...kind });
    };
    for (const slot of slotsOf(shader)) add(slot, { buffer: { type: "uniform" } });
    for (const slot of shader.reads) add(slot, { texture: { sampleType: "unfilterable-float" } });
    return Array.from(groups, (entries) =>
      this.device.createBindGroupLayout({ entries: entries ?? [] }),
    );
  }

  run(compiled, uniforms, reads, targets, area = null) {
    const { device } = this;
    const usage = GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST;
    for (const [slot, buffer] of compiled.buffers) {
      const numbers = uniforms instanceof Float32Array ? uniforms : uniforms[slot];
      if (!buffer) {
        const made = device.createBuffer({ size: numbers.byteLength, usage });
        compiled.buffers.set(slot, made);
      }
      device.queue.writeBuffer(compiled.buffers.get(slot), 0, numbers);
    }
    this.bind(compiled, reads);
    const views = targets
      ? targets.map((target) => target.view)
      : [this.context.getCurrentTexture().createView()];
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginRenderPass({
      colorAttachments: views.map((view) => ({
        view,
        loadOp: area ? "load" : "clear",
        storeOp: "store",
      })),
    });
    if (area) pass.setScissorRect(...area);
    pass.setPipeline(compiled.pipeline);
    compiled.groups.forEach((group, index) => pass.setBindGroup(index, group));
    pass.draw(3);
    pass.end();
    device.queue.submit([encoder.finish()]);
  }

  /** Make the bind groups, which are kept as long as a pass reads the same textures. */
  bind(compiled, reads) {
    const same =
      compiled.bound && Object.entries(reads).every(([slot, t]) => compiled.bound[slot] === t);
    if (same) return;
    const groups = [];
    const add = (slot, resource) => {
      const [group, binding] = slot.split("/").map(Number);
      (groups[group] ??= []).push({ binding, resource });
    };
    for (const [slot, buffer] of compiled.buffers) add(slot, { buffer });
    for (const [slot, texture] of Object.entries(reads)) add(slot, texture.view);
    compiled.groups = Array.from(groups, (entries, index) =>
      this.device.createBindGroup({
        layout: compiled.layout[index],
        entries: entries ?? [],
      }),
    );
    compiled.bound = { ...reads };
  }

  async read(texture, area = [0, 0, texture.width, texture.height]) {
    const { device } = this;
    const [x, y, width, height] = area;
    const channels = CHANNELS[texture.format];
    const bytesPerRow = Math.ceil((width * channels * 4) / ROW_ALIGNMENT) * ROW_ALIGNMENT;
    const buffer = device.createBuffer({
      size: bytesPerRow * height,
      usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ,
    });
    const encoder = device.createCommandEncoder();
    const from = { texture: texture.texture, origin: [x, y] };
    encoder.copyTextureToBuffer(from, { buffer, bytesPerRow }, [width, height]);
    device.queue.submit([encoder.finish()]);
    await buffer.mapAsync(GPUMapMode.READ);
    const mapped = buffer.getMappedRange();
    const numbers = new Float32Array(width * height * channels);
    for (let row = 0; row < height; row++) {
      const line = new Float32Array(mapped, row * bytesPerRow, width * channels);
      numbers.set(line, row * width * channels);
    }
    buffer.destroy();
    return numbers;
  }

  resize(width, height) {
    if (this.canvas.width === width && this.canvas.height === height) return;
    this.canvas.width = width;
    this.canvas.height = height;
  }

  async finished() {
    await this.device.queue.onSubmittedWorkDone();
  }

  release(texture) {
    texture.texture.destroy();
  }

  close() {
    this.closed = true;
    this.context.unconfigure();
    this.device.destroy();
  }
}

/** Slots of a shader's uniform structs. */
function slotsOf({ uniforms }) {
  if (!uniforms) return [];
  return typeof uniforms === "string" ? [uniforms] : Object.values(uniforms);
}

function wrapped(texture, format, width, height) {
  return { texture, view: texture.createView(), format, width, height };
}
