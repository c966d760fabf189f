/**
 * Renderer of a scene of several bodies.
 *
 * Layers are drawn from the farthest to the nearest; each covers what is behind it, or lets through
 * what its air transmits. Lines of sight, order and lights are those of
 * render/gpu_system_renderer.py. `space` of the description is the scene's geometry, see
 * scene_space.js; each planet has a `Picture` of its own on the same compiled passes.
 */
import { groundTexels } from "./ground.js";
import { layerArea, overlap } from "./layer_area.js";
import { numbersOf } from "./package.js";
import { Picture } from "./picture.js";
import { Program } from "./program.js";
import { StarLayers } from "./star_layers.js";
import { cameraUniforms, observerUniforms } from "./view_uniforms.js";
import {
  along,
  between,
  combined,
  dot,
  levelAxes,
  minus,
  scaled,
  unit,
} from "./scene_space.js";
import { PIXEL_ANGLES, light_visibility, rolled } from "../generated/formulas.js";
import { DISC_FORMAT, LEAST_HEIGHT, PACKED_FORMAT, SAMPLES, SMALL_DISC } from "../generated/sizes.js";

const DEGREE = 180 / Math.PI;
const AXES = ["x", "y", "z"];
/** Light without a moon before its disc, as of every light of a scene. */
const PLAIN = { phased: 0, faced: 0, occulter_radius: 0 };

export class ScenePicture extends Picture {
  /** See `Picture.make`. */
  static async make(device, description, onProgress = () => {}) {
    const program = new Program(device, description.plan, description.shaders);
    await program.build(onProgress);
    const picture = new ScenePicture(program, description);
    await Promise.all([picture.upload(), picture.take(description)]);
    return picture;
  }

  constructor(program, description) {
    super(program, description);
    this.space = description.space;
    const { bodies, home } = this.space.scene;
    /** Pictures of planets with air by the index of the body. */
    this.planets = new Map();
    bodies.forEach((body, i) => {
      if (i !== home && !body.planet) return;
      this.planets.set(i, new Picture(program.twin(), { ...description, ...body.planet }));
    });
    this.home = this.planets.get(home);
    /** Textures of maps, shadows and discs of stars. */
    this.surfaces = new Map();
    this.shadows = new Map();
    this.discs = [];
    this.seen = null;
    this.lit = new Map();
  }

  /** Upload what does not change: other planets, maps, shadows, discs of stars. */
  async upload() {
    const { device, space } = this;
    const { bodies, stars } = space.scene;
    const flat = async ({ format, data }) => device.flatTexture(format, await numbersOf(data));
    await Promise.all(
      bodies.map(async (body, i) => {
        if (body.planet) await this.planets.get(i).take({ ...this.fixed, ...body.planet });
        if (!this.planets.has(i)) {
          const { texels, size } = await groundTexels(body.map);
          const [map_rows, map_columns, map_levels] = size;
          const texture = device.flatTexture(PACKED_FORMAT, texels);
          this.surfaces.set(i, { texture, sizes: { map_rows, map_columns, map_levels } });
        }
        for (const [k, { shade }] of body.lights.entries()) {
          if (shade) this.shadows.set(`${i} ${k}`, await flat(shade));
        }
      }),
    );
    this.discs = await Promise.all(stars.map(({ disc }) => flat(disc)));
    const projections = Object.keys(this.fixed.projections);
    const { sky } = space.scene;
    if (sky) this.stars = await StarLayers.make(device, sky, projections);
  }

  async take(solution) {
    await this.home.take(solution);
    this.planet = solution;
    this.solutions += 1;
  }

  /** Lights of the planet below the observer; those of the others are kept. */
  lightsOf(values) {
    this.seen = this.space.seen(values);
    this.values = values;
    for (const [i, picture] of this.planets) this.lit.set(i, this.lightsOn(i, picture, values));
    const [first, ...others] = this.lit.get(this.space.scene.home);
    return [{ ...first, suns: this.visibleSuns(first.local) }, ...others];
  }

  /** Lights of a planet with air, as `lightsOf` of a picture. */
  lightsOn(i, picture, values) {
    const { lights } = this.seen.moment.bodies[i];
    const frames = lights.map((one) => this.lightFrom(i, one.towards, one.radius, one.numbers));
    const brightest = Math.max(...lights.map((light) => light.irradiance));
    const { radius, thickness } = picture.planet;
    const zenith = ({ camera }) => Math.acos(camera.sun[2]) * DEGREE;
    return frames.filter((one, k) => {
      const share = lights[k].irradiance / brightest;
      const places = [zenith(one), zenith(frames[0]), 0, share];
      return k === 0 || light_visibility(...places, one.altitude, radius, thickness) > 1;
    });
  }

  /**
   * A light of a planet, in the frame of the observer above it.
   *
   * @param {number} i Index of the body.
   * @param {number[]} towards Direction towards the light.
   * @param {number} star Angular radius of the light. [rad]
   * @param {Object<string, number>} numbers Uniforms of its colour.
   */
  lightFrom(i, towards, star, numbers) {
    const { seen, values, fixed, space } = this;
    const { planet } = this.planets.get(i);
    const { centre, axes } = seen.moment.bodies[i];
    const above = minus(seen.eye, centre);
    const up = i === space.scene.home ? seen.up : unit(above);
    const altitude =
      i === space.scene.home ? values["view.altitude"] : Math.hypot(...above) - planet.radius;
    const local = levelAxes(up, unit(towards));
    const camera = this.cameraIn(local, axes, unit(towards));
    const height = camera.detailed ? Math.max(altitude, LEAST_HEIGHT) : Math.max(altitude, 0);
    const place = observerUniforms({ ...planet, star }, height, camera.sun);
    const orders = fixed.orders[values["light.orders"]];
    return {
      camera,
      local,
      altitude,
      star,
      air: true,
      left: 1,
      law: null,
      suns: [],
      numbers: { ...numbers, ...PLAIN, ...place, orders, draws_air: 1, draws_disc: 0 },
    };
  }

  /** Camera in a local frame, see `cameraOf`. */
  cameraIn(local, body, towards) {
    const { values, fixed, seen } = this;
    const projection = values["view.projection"];
    const [low, high] = fixed.projections[projection];
    const axes = seen.axes.map((axis) => along(local, axis));
    const up = dot(local[2], towards);
    return {
      projection,
      axes,
      dehaze: values["view.dehaze"],
      filter: values["view.filter"] ? rolled(axes[1], axes[0], values["view.polariser"]) : null,
      sun: [Math.hypot(dot(local[0], towards), dot(local[1], towards)), 0, up],
      fieldOfView: Math.min(Math.max(values["view.field_of_view"], low), high) / DEGREE,
      detailed: values["view.ground"] === "detailed",
      ground: body.map((axis) => along(local, axis)),
    };
  }

  async fillSkyView(lights, effort) {
    for (const [i, picture] of this.planets) await picture.fillSkyView(this.lit.get(i), effort);
    const { skyViews, shape, texelTime } = this.home;
    Object.assign(this, { skyViews, shape, texelTime });
  }

  async metered(lights, width, height, others) {
    const [wide, high] = this.meteredSize(width, height);
    if (this.stars) this.backdrops.set("metering", this.putStars("metering", lights, wide, high));
    const found = await super.metered(lights, width, height, others);
    this.backdrops.delete("metering");
    return found;
  }

  putStars(name, [{ camera }], width, height) {
    const { eye, axes: world, north, moment } = this.seen;
    const { projection, fieldOfView, filter } = camera;
    const view = { projection, fieldOfView, filter, eye, world, hours: moment.hours };
    const raised = (true_) => combined(north, this.space.raised(this.values, along(north, true_)));
    return this.stars.put(name, width, height, view, raised);
  }

  /** The stars are the farthest layer. */
  async coverStars() {}

  skyViewKey(light) {
    return this.home.skyViewKey(light);
  }

  /** Render all layers into a target or an area of it. */
  sum(name, numbers, width, height, area = null) {
    const { program, space } = this;
    const whole = area ?? [0, 0, width, height];
    const both = ["layer_layered", "layer_covering"];
    for (const one of [...both, "layer_body", "layer_coverage", name]) {
      program.resize(one, width, height);
    }
    let [behind, front] = both.map((one) => program.textures.get(one));
    const black = program.textures.get("layer_added");
    const filter = { filter: numbers[0].filter, dehaze: numbers[0].dehaze };
    const frame = { name, width, height, whole, filter, ...this.order() };
    /** Put a layer in front of the picture, in a part of it. */
    const put = (pass, part, level, coarser = null) => {
      if (part !== whole) program.runIn("added", whole, { picture: behind, level: black }, [front]);
      program.runIn(pass, part, { picture: behind, level, coarser }, [front]);
      [behind, front] = [front, behind];
    };
    const farthest = this.backdrops.get(name)?.texture ?? black;
    program.runIn("added", whole, { picture: farthest, level: black }, [behind]);
    for (const i of frame.order) {
      if (!this.planets.has(i)) {
        this.putBody(i, frame, put);
        continue;
      }
      this.putPlanet(i, frame, i === space.scene.home ? numbers : null, put);
      frame.stars.forEach((air, k) => air === i && this.putStar(k, i, frame, put));
    }
    program.runIn("added", whole, { picture: behind, level: black }, [program.textures.get(name)]);
  }

  /** Bodies from the farthest to the nearest, and for each star the planet in front of it. */
  order() {
    const { seen, space } = this;
    const { bodies } = space.scene;
    const power = bodies.map(({ outer }, i) => {
      const distance = Math.hypot(...minus(seen.moment.bodies[i].centre, seen.eye));
      return (distance - outer) * (distance + outer);
    });
    const order = bodies.map((_, i) => i).sort((a, b) => power[b] - power[a]);
    const airy = order.filter((i) => this.planets.has(i));
    const stars = space.scene.stars.map((_, k) => airy.find((i) => this.overlaps(k, i)) ?? airy[0]);
    return { order, airy, stars };
  }

  /** Direction, angular radius [rad] and share of the irradiance at the scene's eye, of a star. */
  star(k) {
    const { radius, distance } = this.space.scene.stars[k];
    const { stars } = this.seen.moment;
    const { eye } = this.seen;
    const towards = this.space.towards(stars[k], eye);
    if (distance === null) return { towards, radius, share: 1 };
    const nearer = distance / Math.hypot(...minus(stars[k].place, eye));
    return { towards, radius: Math.asin(Math.sin(radius) * nearer), share: nearer ** 2 };
  }

  /** Whether a body may stand before a star. */
  overlaps(k, i, { hides = false } = {}) {
    const { outer, radius, bend } = this.space.scene.bodies[i];
    const offset = minus(this.seen.moment.bodies[i].centre, this.seen.eye);
    const distance = Math.hypot(...offset);
    const star = this.star(k);
    const apart = between(unit(offset), star.towards);
    const angle = (size) => Math.asin(Math.min(size / distance, 1));
    if (hides) return apart < angle(radius) - star.radius - bend;
    return apart < angle(outer) + star.radius + bend;
  }

  /** Stars whose discs are visible, for metering; a zero vector if there are none. */
  visibleSuns(local) {
    const { bodies, stars } = this.space.scene;
    const found = stars
      .map((_, k) => k)
      .filter((k) => !bodies.some((_, i) => this.overlaps(k, i, { hides: true })))
      .map((k) => [along(local, this.star(k).towards), this.star(k).radius]);
    return found.length ? found : [[[0, 0, 0], 0]];
  }

  putPlanet(i, { name, width, height, whole, filter }, own, put) {
    const picture = this.planets.get(i);
    const { program } = picture;
    const numbers =
      own ??
      this.lit.get(i).map((one) => ({ ...picture.uniformsOf(one, width, height), ...filter }));
    picture.sum(name, numbers, width, height, whole);
    program.resize("layer_through", width, height);
    program.setAll(numbers[0]);
    program.runIn("through", whole);
    put("layered", whole, program.textures.get(name), program.textures.get("layer_through"));
  }

  /** Uniforms of a layer without air, seen through the air of a planet. */
  laid(light, { width, height, filter }) {
    const camera = cameraUniforms(light.camera, width, height, this.fixed.projections);
    const plain = { detailed: 0, edges: 0, body_samples: SAMPLES };
    return { ...light.numbers, ...camera, ...filter, ...plain, draws_disc: 1 };
  }

  putStar(k, air, frame, put) {
    const { program } = this.planets.get(air);
    const { towards, radius, share } = this.star(k);
    const part = this.part(towards, radius, air, frame);
    if (!part || radius <= 0) return;
    const { numbers } = this.space.scene.stars[k];
    const light = this.lightFrom(air, towards, radius, coloured(numbers, share));
    const { order, width, height } = frame;
    const hides = order
      .slice(0, order.indexOf(air))
      .filter((i) => !this.planets.has(i) && this.overlaps(k, i))
      .at(-1);
    const pixel = PIXEL_ANGLES[light.camera.projection](width, height, light.camera.fieldOfView);
    const kept = program.uniforms.slice();
    program.setAll(this.laid(light, frame));
    program.setAll({ star_radius: radius, body_hides: Number(hides !== undefined) });
    if (hides !== undefined) program.setAll(this.placed(hides, light.local));
    const pass = hides === undefined && radius < SMALL_DISC * pixel ? "small_disc" : "disc";
    const target = this.program.textures.get("layer_body");
    program.runIn(pass, part, { disc: this.discs[k] }, [target]);
    program.uniforms.set(kept);
    put("added", part, target);
  }

  putBody(i, frame, put) {
    const { order, airy } = frame;
    const { bodies } = this.space.scene;
    const before = airy.filter((one) => order.indexOf(one) > order.indexOf(i));
    const refracting = before.filter((one) => bodies[one].refracts);
    const air = refracting.at(-1) ?? airy.at(-1);
    const offset = minus(this.seen.moment.bodies[i].centre, this.seen.eye);
    const size = Math.asin(Math.min(bodies[i].radius / Math.hypot(...offset), 1));
    const part = this.part(unit(offset), size, air, frame);
    if (!part) return;
    const { program } = this.planets.get(air);
    const [light] = this.lit.get(air);
    const map = this.surfaces.get(i).texture;
    const [level, coverage] = ["layer_body", "layer_coverage"].map((one) =>
      this.program.textures.get(one),
    );
    const kept = program.uniforms.slice();
    program.setAll({ ...this.laid(light, frame), ...this.placed(i, light.local) });
    program.setAll({ body_behind: Number(refracting.length > 0) });
    program.runIn("coverage", part, {}, [coverage]);
    const { lights } = this.seen.moment.bodies[i];
    const dimmed = light.camera.filter && frame.filter.filter ? 0.5 : 1;
    lights.forEach(({ numbers }, k) => {
      const { shade } = bodies[i].lights[k];
      program.setAll({ ...this.turned(numbers, light.local), ...shade?.places });
      program.setAll(times(numbers, "body_color", dimmed));
      const shadow = this.shadows.get(`${i} ${k}`) ?? this.discs[0];
      program.runIn("body", part, { ground: map, shade: shadow }, [level]);
      if (k === 0) put("covering", part, level, coverage);
      else put("added", part, level);
    });
    program.uniforms.set(kept);
  }

  /** Uniforms of place, map and law of a body without air. */
  placed(i, local) {
    const { centre, place } = this.seen.moment.bodies[i];
    const { radius } = this.space.scene.bodies[i];
    const offset = minus(centre, this.seen.eye);
    const distance = Math.hypot(...offset);
    const power = Math.max((distance - radius) * (distance + radius), 0) / radius ** 2;
    const towards = along(local, scaled(offset, 1 / radius));
    const { sizes } = this.surfaces.get(i);
    const turned = this.turned(place, local);
    return { ...turned, ...sizes, ...vector("body_centre", towards), body_power: power };
  }

  /** Uniforms whose vectors are turned into a local frame. */
  turned(numbers, local) {
    const found = { ...numbers };
    for (const name of this.space.scene.turned) {
      if (!(`${name}_x` in numbers)) continue;
      const one = AXES.map((axis) => numbers[`${name}_${axis}`]);
      Object.assign(found, vector(name, along(local, one)));
    }
    return found;
  }

  /** Part of a picture near a direction; null if there is none. */
  part(towards, radius, air, { width, height, whole }) {
    const [{ camera }] = this.lit.get(air);
    const reach = radius + this.space.scene.bodies[air].bend;
    const number = Object.keys(this.fixed.projections).indexOf(camera.projection);
    const near = along(this.seen.axes, towards);
    const found = layerArea(near, reach, camera, number, width, height);
    return found && overlap(found, whole);
  }
}

function vector(name, values) {
  return Object.fromEntries(AXES.map((axis, i) => [`${name}_${axis}`, values[i]]));
}

/** Uniforms of a vector, multiplied. */
function times(numbers, name, factor) {
  return vector(name, AXES.map((axis) => factor * numbers[`${name}_${axis}`]));
}

/** Uniforms of a star with a share of its irradiance. */
function coloured(numbers, share) {
  const matrix = /^(red|green|blue)_\d$/;
  const entries = Object.entries(numbers);
  return Object.fromEntries(entries.map(([n, x]) => [n, matrix.test(n) ? x * share : x]));
}
