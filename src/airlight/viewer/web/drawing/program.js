/**
 * Passes of a plan from Python, run on a device.
 *
 * A plan has `layout`, which maps each field of the uniform struct to its offset and length in
 * floats, `size`, the length of the struct, and `passes`; each pass has `name`, `shader`, `entry`,
 * `vertex`, `uniforms` (the slot "group/binding" of the struct), `reads` (slot to name of a
 * table or target) and `targets` (`{name, format, width, height}` each, or none for the canvas).
 * Passes that run the same entry are compiled once.
 */
export class Program {
  /**
   * @param {object} device See devices/device.js.
   * @param {object} plan
   * @param {Object<string, object>} shaders Texts by name: `wgsl`, and `glsl` by vertex function
   *     and entry.
   */
  constructor(device, plan, shaders) {
    this.device = device;
    this.plan = plan;
    this.shaders = shaders;
    this.uniforms = new Float32Array(plan.size);
    this.textures = new Map();
    this.compiled = new Map();
  }

  /**
   * Compile passes and create all targets.
   *
   * @param {(done: number, total: number) => void} [onProgress] Receives the number of shaders compiled.
   * @param {(name: string) => boolean} [wanted] Which passes; by default all.
   */
  async build(onProgress = () => {}, wanted = () => true) {
    const { device } = this;
    const promises = new Map();
    let done = 0;
    const passes = this.plan.passes.filter((pass) => wanted(pass.name));
    const work = passes.map(async (pass) => {
      const shader = this.shaders[pass.shader];
      const formats = pass.targets.length ? pass.targets.map((one) => one.format) : ["screen"];
      const key = [pass.shader, pass.entry, ...formats].join(" ");
      const text = {
        wgsl: shader.wgsl,
        glsl: { vertex: shader.glsl[pass.vertex], fragment: shader.glsl[pass.entry] },
        vertex: pass.vertex,
        entry: pass.entry,
        uniforms: pass.uniforms,
        reads: Object.keys(pass.reads),
      };
      if (!promises.has(key)) {
        const made = device.pipeline(text, formats);
        promises.set(key, made);
        made.then(() => onProgress((done += 1), promises.size), () => {});
      }
      // each pass has its own textures bound
      this.compiled.set(pass.name, { ...(await promises.get(key)) });
    });
    await Promise.all(work);
    return this.withTargets();
  }

  withTargets() {
    for (const { name, format, width, height } of this.plan.passes.flatMap((p) => p.targets)) {
      if (this.textures.has(name)) continue;
      this.textures.set(name, this.device.target(format, width, height));
    }
    return this;
  }

  /** The same compiled passes with uniforms, tables and targets of their own. */
  twin() {
    const other = new Program(this.device, this.plan, this.shaders);
    for (const [name, compiled] of this.compiled) other.compiled.set(name, { ...compiled });
    return other.withTargets();
  }

  /** Set a field of the uniform struct: a number, or the leading numbers of an array. */
  set(field, value) {
    const place = this.plan.layout[field];
    if (!place) throw new Error(`the shaders know no ${field}`);
    if (typeof value === "number") this.uniforms[place[0]] = value;
    else this.uniforms.set(value, place[0]);
  }

  /** Set several fields. */
  setAll(values) {
    for (const [field, value] of Object.entries(values)) this.set(field, value);
  }

  /** Resize a target; its contents are lost. */
  resize(name, width, height) {
    const before = this.textures.get(name);
    if (before.width === width && before.height === height) return;
    this.textures.set(name, this.device.target(before.format, width, height));
    this.device.release(before);
  }

  /** Upload a table by its name in the passes. */
  setTable(name, format, numbers) {
    const before = this.textures.get(name);
    this.textures.set(name, this.device.flatTexture(format, numbers));
    if (before) this.device.release(before);
  }

  /** Use an existing texture as a table, taking ownership. */
  takeTexture(name, texture) {
    const before = this.textures.get(name);
    this.textures.set(name, texture);
    if (before && before !== texture) this.device.release(before);
  }

  /** Run passes by name, in order. */
  run(...names) {
    for (const name of names) this.runIn(name, null);
  }

  /**
   * Run a pass in an area of its targets: left, top, width, height. [texel]
   *
   * @param {Object<string, object>} given Textures by the names of tables, instead of its own.
   * @param {object[] | null} into Targets instead of its own.
   */
  runIn(name, area, given = {}, into = null) {
    const pass = this.plan.passes.find((one) => one.name === name);
    const texture = (one) => given[one] ?? this.textures.get(one);
    const reads = Object.entries(pass.reads).map(([slot, one]) => [slot, texture(one)]);
    const targets = into ?? pass.targets.map((one) => this.textures.get(one.name));
    this.device.run(
      this.compiled.get(name),
      this.uniforms,
      Object.fromEntries(reads),
      targets.length ? targets : null,
      area,
    );
  }

  /** Promise of the values of a target or of an area. */
  read(name, area) {
    return this.device.read(this.textures.get(name), area);
  }
}
