/** Rendering in the notebook's kernel, for browsers without a GPU. */

/** Paths of the view values on which a frame depends. */
const VIEW = /^(view|display|light)\./;

/** Device in the sense of device.js, whose canvas takes images. */
export class KernelDevice {
  static async open(canvas) {
    return new KernelDevice(canvas);
  }

  constructor(canvas) {
    this.kind = "kernel";
    this.name = "the kernel's CPU";
    this.canvas = canvas;
    this.lost = new Promise(() => {});
  }

  resize(width, height) {
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
  }

  async finished() {}

  close() {}
}

/** Picture in the sense of drawing/picture.js. */
export class KernelPicture {
  /**
   * @param {object} model Model of the widget: `wanted` to Python, `rendered` from Python.
   * @param {KernelDevice} device
   * @param {(name: string, act: () => void) => void} on Follows a trait of the model.
   */
  constructor(model, device, on) {
    this.model = model;
    this.device = device;
    this.context = device.canvas.getContext("2d");
    this.number = 0;
    this.exposure = 0;
    this.waiting = null;
    on("rendered", () => this.waiting?.());
  }

  get planet() {
    return { viewpoints: this.model.get("picture").viewpoints ?? [] };
  }

  async take() {}

  /** Request and display a frame; resolves to false, as no finer frame follows. */
  async display(values, width, height) {
    const view = Object.fromEntries(Object.entries(values).filter(([path]) => VIEW.test(path)));
    const number = ++this.number;
    const rendered = await new Promise((resolve) => {
      this.waiting = () => {
        const answer = this.model.get("rendered");
        if (answer.number === number) resolve(answer);
      };
      this.model.set("wanted", { number, view, size: [width, height] });
      this.model.save_changes();
    });
    this.waiting = null;
    if (rendered.error) throw new Error(rendered.error);
    this.exposure = rendered.exposure;
    const bitmap = await createImageBitmap(new Blob([rendered.png], { type: "image/png" }));
    this.device.resize(width, height);
    this.context.drawImage(bitmap, 0, 0, width, height);
    bitmap.close();
    return false;
  }
}
