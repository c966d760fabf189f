/** Viewer in a notebook: the front end of `airlight.viewer.browser.notebook.Viewer`. */
import { KernelDevice, KernelPicture } from "./devices/kernel.js";
import { Picture } from "./drawing/picture.js";
import { RemoteState } from "./state/remote_state.js";
import { Viewer } from "./ui/viewer.js";

function render({ model, el }) {
  const ending = [];
  const on = (name, act) => {
    model.on(`change:${name}`, act);
    ending.push(() => model.off(`change:${name}`, act));
  };
  const state = new RemoteState(model);
  const place = document.createElement("div");
  place.style.height = `${model.get("height")}px`;
  el.replaceChildren(place);

  const preview = model.get("first");
  const viewer = new Viewer(place, {
    title: model.get("title"),
    first: preview
      ? Object.assign(new Image(), { className: "airlight-first", src: preview, alt: "" })
      : null,
    state,
    radius: () => model.get("picture").radius ?? 1,
    status: () => model.get("status"),
    stale: () => (model.get("stale") ? working(model.get("status")) : ""),
    device: model.get("device"),
    devices: { kernel: KernelDevice },
    picture: async (device, onProgress) => {
      model.set("drawer", device.kind);
      model.save_changes();
      await first(model, on);
      if (device.kind === "kernel") return new KernelPicture(model, device, on);
      return Picture.make(device, { ...model.get("program"), ...model.get("picture") }, onProgress);
    },
  });
  on("values", () => state.hear());
  on("heard", () => state.hear()); // a host may pass on one of the two before the other
  on("parameters", () => viewer.declare(model.get("parameters"), model.get("values")));
  on("picture", () => viewer.take(model.get("picture")));
  on("title", () => viewer.retitle(model.get("title")));
  on("status", () => {
    viewer.showStatus();
    viewer.showWork();
  });
  on("stale", () => viewer.showWork());
  on("can", () => {
    state.showing = model.get("can").showing;
    state.sharesCamera = model.get("can").camera;
    viewer.updateTools();
  });
  on("message", () => viewer.say(model.get("message")));
  on("height", () => {
    place.style.height = `${model.get("height")}px`;
  });
  viewer.say(model.get("message"));
  place.viewer = viewer;
  return () => {
    for (const end of ending) end();
    viewer.close();
  };
}

/** Promise that resolves once the first solution is available. */
function first(model, on) {
  if (model.get("picture").tables) return Promise.resolve();
  return new Promise((resolve) => {
    on("picture", () => model.get("picture").tables && resolve());
  });
}

export default { render };

/** Words of a status that says what is being done; it ends in an ellipsis then. */
function working(status) {
  return status.endsWith("…") ? status : "solving …";
}
