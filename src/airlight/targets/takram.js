// A planet's air for @takram/three-atmosphere (WebGL): loads this folder and sets its parameters.
//
//   import { loadPlanet, setPlanet } from "./mars/planet.js";
//   const planet = await loadPlanet("mars", renderer);
//   const material = setPlanet(new SkyMaterial({ sunDirection }), planet);
//   new AerialPerspectiveEffect(camera, planet.textures, planet.atmosphere);

import { Color, Vector3 } from "three";
import { AtmosphereParameters, PrecomputedTexturesLoader } from "@takram/three-atmosphere";

const VECTORS = [
  "solarIrradiance", "rayleighScattering", "mieScattering", "mieExtinction",
  "skyRadianceToLuminance", "sunRadianceToLuminance",
];

/** Atmosphere and textures of the folder at `url`; `format` is "binary" or "exr". */
export async function loadPlanet(url, renderer, format = "exr") {
  const { combinedScattering, groundAlbedo, ...numbers } =
    await (await fetch(`${url}/atmosphere.json`)).json();
  for (const name of VECTORS) numbers[name] = new Vector3(...numbers[name]);
  const atmosphere = new AtmosphereParameters({
    ...numbers,
    groundAlbedo: new Color(...groundAlbedo),
  });
  const loader = new PrecomputedTexturesLoader({ format, combinedScattering }).setType(renderer);
  const textures = await loader.loadAsync(url);
  return { atmosphere, textures };
}

/** Give a SkyMaterial (or StarsMaterial) the planet, which its constructor does not take. */
export function setPlanet(material, { atmosphere, textures }) {
  Object.assign(material, textures);
  const { uniforms } = material;
  uniforms.ATMOSPHERE.value = atmosphere.toUniform().value;
  uniforms.SUN_SPECTRAL_RADIANCE_TO_LUMINANCE.value = atmosphere.sunRadianceToRelativeLuminance;
  uniforms.SKY_SPECTRAL_RADIANCE_TO_LUMINANCE.value = atmosphere.skyRadianceToRelativeLuminance;
  material.sunAngularRadius = atmosphere.sunAngularRadius;
  material.correctAltitude = false; // it would use the Earth's ellipsoid
  return material;
}
