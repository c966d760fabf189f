/** Entry point of the page: reads its embedded data, and keeps the URL in sync with the state. */
import { Edits } from "./solving/edits.js";
import { textOf } from "./drawing/package.js";
import { Picture } from "./drawing/picture.js";
import { ScenePicture } from "./drawing/scene_picture.js";
import { SceneSpace } from "./drawing/scene_space.js";
import { Viewer } from "./ui/viewer.js";

/** Delay from the last change to the update of the URL. [ms] */
const CALM = 300;

const data = JSON.parse(document.getElementById("airlight-data").textContent);
const place = document.getElementById("airlight-place");
const first = place.querySelector(".airlight-first");
const wanted = new URLSearchParams(location.search).get("device") ?? "auto";

/** Times that a lost device is replaced. */
const MOST_RESTARTS = 3;
const space = data.picture.scene ? new SceneSpace(data.picture.scene, data.picture) : null;
let viewer = null;
let restarts = 0;

/** Show the page by a device, with the state so far. */
function show(device) {
  const before = viewer;
  before?.close();
  viewer = new Viewer(place, {
    title: data.title,
    parameters: data.parameters,
    values: data.values,
    state: before?.state,
    body: data.body,
    space,
    note: data.note,
    device,
    first: before ? undefined : first,
    radius: () => data.picture.radius,
    link: (fragment) => location.href.replace(/#.*/, "") + (fragment ? `#${fragment}` : ""),
    picture: async (opened, onProgress) => {
      const shaders = JSON.parse(await textOf(data.picture.shaders));
      const kind = space ? ScenePicture : Picture;
      return kind.make(opened, { ...data.picture, shaders, space }, onProgress);
    },
    edits: (shown) => data.solver && new Edits(shown, data.solver, data.picture),
    lost: (reason) => {
      restarts += 1;
      if (restarts > MOST_RESTARTS) return viewer.say(`the GPU was lost (${reason}): reload`);
      show("webgl2");
      viewer.tell(`the GPU was lost (${reason}): shown by WebGL2`);
    },
  });
  window.airlight = viewer;
}

show(wanted);
viewer.state.planet = data.planet;

function takeAddress() {
  if (location.hash.length < 2) return;
  const faults = viewer.state.takeFragment(location.hash);
  viewer.say(faults.length ? `the address: ${faults.join("; ")}` : "");
}

let timer = null;
viewer.state.subscribe(() => {
  clearTimeout(timer);
  timer = setTimeout(() => {
    const address = viewer.source.link(viewer.state.asFragment());
    if (address !== location.href) history.replaceState(null, "", address);
  }, CALM);
});
addEventListener("hashchange", takeAddress);
takeAddress();
viewer.parts.canvas.focus({ preventScroll: true });
