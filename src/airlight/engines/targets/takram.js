// A planet's air for @takram/three-atmosphere (WebGL): loads this folder and sets its parameters.
//
//   import { loadPlanet, setPlanet } from "./mars/planet.js";
//   const planet = await loadPlanet("mars", renderer);
//   const sky = setPlanet(new SkyMaterial({ sunDirection }), planet);
//   const air = setPlanet(
//     new AerialPerspectiveEffect(camera, planet.textures, planet.atmosphere), planet);
//
// The globe is a sphere of the planet's radius (bottomRadius) about the origin. Another globe is
// named by its ellipsoid: setPlanet(sky, planet, Ellipsoid.WGS84) for tiles of the Earth.

import { Color, Vector3 } from "three";
import { AtmosphereParameters, PrecomputedTexturesLoader } from "@takram/three-atmosphere";
import { Ellipsoid } from "@takram/three-geospatial";

const VECTORS = [
  "solarIrradiance", "rayleighScattering", "mieScattering", "mieExtinction",
  "skyRadianceToLuminance", "sunRadianceToLuminance",
];
/** Difference from the Earth's radius above which heights over WGS84 mean nothing. [m] */
const NOT_THE_EARTH = 3e4;

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

/** Give a material, effect or light of the package the planet, and the globe that it stands on.
 *
 * SkyMaterial and StarsMaterial take no planet; all of them take the globe for WGS84. `ellipsoid`
 * is the globe's, if it is not a sphere of the planet's radius about the origin.
 */
export function setPlanet(drawn, { atmosphere, textures }, ellipsoid) {
  Object.assign(drawn, textures);
  const { bottomRadius } = atmosphere;
  const { ATMOSPHERE } = drawn.uniforms ?? {}; // of a material; others have it by their constructor
  if (ATMOSPHERE !== undefined) {
    const { uniforms } = drawn;
    ATMOSPHERE.value = atmosphere.toUniform().value;
    uniforms.SUN_SPECTRAL_RADIANCE_TO_LUMINANCE.value = atmosphere.sunRadianceToRelativeLuminance;
    uniforms.SKY_SPECTRAL_RADIANCE_TO_LUMINANCE.value = atmosphere.skyRadianceToRelativeLuminance;
  }
  drawn.atmosphere = atmosphere; // whose radius the correction of the altitude takes
  drawn.ellipsoid = ellipsoid ?? new Ellipsoid(bottomRadius, bottomRadius, bottomRadius);
  drawn.correctAltitude = ellipsoid !== undefined;
  if (Math.abs(bottomRadius - Ellipsoid.WGS84.maximumRadius) > NOT_THE_EARTH) {
    drawn.correctGeometricError = false; // it would fade in by the height over WGS84
  }
  if ("sunAngularRadius" in drawn) drawn.sunAngularRadius = atmosphere.sunAngularRadius;
  return drawn;
}
