// Aerial perspective of `airlight aerial` as the last pass of a three.js picture.

import * as THREE from "three";

const VERTEX = /* glsl */ `
void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }
`;

const FRAGMENT = /* glsl */ `
uniform sampler2D colors;      // linear, 1: white facing the star
uniform highp sampler2D depths;
uniform mat4 fromClip;         // clip space to metres before the camera
uniform mat3 toLocal;          // camera space to x towards the star, z up
uniform vec2 size;
uniform float pixel;           // [rad]
uniform float exposure;
out vec4 seen;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(depths, at, 0).x;
  vec4 point = fromClip * vec4(2.0 * vec3(gl_FragCoord.xy / size, depth) - 1.0, 1.0);
  vec3 away = point.xyz / point.w;
  float distance = length(away);
  vec3 d = toLocal * (away / distance);
  vec3 light;
  if (depth < 1.0) {
    light = texelFetch(colors, at, 0).rgb * air_transmittance(d.x, d.y, d.z, distance).rgb
      + air_radiance(d.x, d.y, d.z, distance).rgb;
  } else {
    light = sky_radiance(d.x, d.y, d.z, pixel).rgb;
  }
  seen = vec4(1.0 - exp(-exposure * light), 1.0);
  seen = linearToOutputTexel(seen);
}
`;

async function texture(folder, name, about) {
  const file = Object.keys(about.files)[0];
  const bytes = await (await fetch(`${folder}/${file}`)).arrayBuffer();
  const made = new THREE.DataTexture(
    new Uint16Array(bytes), about.width, about.height, THREE.RGBAFormat, THREE.HalfFloatType,
  );
  made.needsUpdate = true;
  return [name, made];
}

export class AirPass {
  /** Load a folder of `airlight aerial`. */
  static async load(folder) {
    const about = await (await fetch(`${folder}/manifest.json`)).json();
    const functions = await (await fetch(`${folder}/air.glsl`)).text();
    const textures = Object.fromEntries(
      await Promise.all(Object.entries(about.textures).map(([n, one]) => texture(folder, n, one))),
    );
    return new AirPass(about, functions, textures);
  }

  constructor(about, functions, textures) {
    this.about = about;
    this.up = new THREE.Vector3(0, 1, 0); // of the scene
    this.star = new THREE.Vector3(0, 1, 0); // direction towards the star, in the scene
    this.exposure = 1.0;
    this.metresPerUnit = 1.0;
    const names = Object.keys(textures);
    this.material = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: VERTEX,
      fragmentShader: [
        ...names.map((name) => `uniform highp sampler2D ${name};`), functions, FRAGMENT,
      ].join("\n"),
      uniforms: Object.fromEntries([
        ...names.map((name) => [name, { value: textures[name] }]),
        ...["colors", "depths", "pixel", "exposure"].map((name) => [name, { value: null }]),
        ["fromClip", { value: new THREE.Matrix4() }],
        ["toLocal", { value: new THREE.Matrix3() }],
        ["size", { value: new THREE.Vector2() }],
      ]),
      depthTest: false,
      depthWrite: false,
      toneMapped: false,
    });
    const triangle = new THREE.BufferGeometry();
    const corners = new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]);
    triangle.setAttribute("position", new THREE.BufferAttribute(corners, 3));
    this.scene = new THREE.Scene();
    const mesh = new THREE.Mesh(triangle, this.material);
    mesh.frustumCulled = false;
    this.scene.add(mesh);
    this.camera = new THREE.Camera();
  }

  /** Draw a scene with its air to the renderer's current target. */
  render(renderer, scene, camera) {
    const size = renderer.getDrawingBufferSize(new THREE.Vector2());
    if (this.target === undefined || this.target.width !== size.x
        || this.target.height !== size.y) {
      this.target?.dispose();
      const depthTexture = new THREE.DepthTexture(size.x, size.y, THREE.FloatType);
      this.target = new THREE.WebGLRenderTarget(size.x, size.y, {
        type: THREE.HalfFloatType, depthTexture,
      });
    }
    const before = renderer.getRenderTarget();
    renderer.setRenderTarget(this.target);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.setRenderTarget(before);
    const uniforms = this.material.uniforms;
    uniforms.colors.value = this.target.texture;
    uniforms.depths.value = this.target.depthTexture;
    uniforms.size.value.copy(size);
    uniforms.exposure.value = this.exposure;
    uniforms.pixel.value = (camera.fov * Math.PI) / 180 / size.y;
    const unit = this.metresPerUnit;
    uniforms.fromClip.value.makeScale(unit, unit, unit).multiply(camera.projectionMatrixInverse);
    // rows: level towards the star, across, up
    const up = this.up.clone().normalize();
    const level = this.star.clone().addScaledVector(up, -this.star.dot(up));
    if (level.lengthSq() < 1e-12) level.set(up.y, up.z, up.x).cross(up);
    level.normalize();
    const across = new THREE.Vector3().crossVectors(up, level);
    const rows = new THREE.Matrix3().set(
      level.x, level.y, level.z, across.x, across.y, across.z, up.x, up.y, up.z,
    );
    const turn = new THREE.Matrix3().setFromMatrix4(camera.matrixWorld);
    uniforms.toLocal.value.multiplyMatrices(rows, turn);
    renderer.render(this.scene, this.camera);
  }
}
