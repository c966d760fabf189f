/** Film of the picture as it is shown, until it is ended. */

/** Pictures per second. [1/s] */
const RATE = 30;
/** Formats in order of preference; browsers write one of them. */
const FORMATS = ["video/webm;codecs=vp9", "video/webm", "video/mp4"];

export class Film {
  /**
   * Start to film a canvas, at its size of now.
   *
   * @param {HTMLCanvasElement} canvas
   * @throws {Error} If the browser cannot film; one line.
   */
  constructor(canvas) {
    if (!window.MediaRecorder) throw new Error("this browser cannot film");
    const type = FORMATS.find((one) => MediaRecorder.isTypeSupported(one));
    if (!type) throw new Error("this browser writes no film that is known here");
    this.canvas = canvas;
    // A canvas of its own keeps its size while moving pictures are drawn smaller.
    this.copy = Object.assign(document.createElement("canvas"), {
      width: canvas.width,
      height: canvas.height,
    });
    this.context = this.copy.getContext("2d");
    this.suffix = type.includes("mp4") ? "mp4" : "webm";
    this.parts = [];
    this.recorder = new MediaRecorder(this.copy.captureStream(RATE), { mimeType: type });
    this.recorder.ondataavailable = ({ data }) => data.size && this.parts.push(data);
    this.recorder.start();
  }

  /** Take over the picture that was just drawn. */
  frame() {
    const { width, height } = this.copy;
    this.context.drawImage(this.canvas, 0, 0, width, height);
  }

  /** End the film; promise of the file. */
  end() {
    return new Promise((resolve) => {
      this.recorder.onstop = () => resolve(new Blob(this.parts, { type: this.recorder.mimeType }));
      this.recorder.stop();
    });
  }
}
