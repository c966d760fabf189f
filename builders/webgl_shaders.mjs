// Translates entry points of WGSL modules to GLSL ES 3.00; used by webgl_shaders.py.
// Standard input: JSON [{module, wgsl, entries: [[stage, name], ...]}]; standard output: JSON
// [{module, entry, glsl}]. Run where naga-wasm is installed in node_modules.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

Symbol.dispose ??= Symbol("dispose"); // Node 20 has none, and the package wants one
const require = createRequire(`${process.cwd()}/`);
const naga = await import(pathToFileURL(require.resolve("naga-wasm")));

const made = [];
for (const { module, wgsl, entries } of JSON.parse(readFileSync(0, "utf8"))) {
  try {
    const parsed = naga.parseWgsl(wgsl);
    const info = naga.validate(parsed);
    for (const [stage, entry] of entries) {
      const options = { version: "300 es", stage, entryPoint: entry };
      made.push({ module, entry, glsl: naga.writeGlsl(parsed, info, options) });
    }
  } catch (error) {
    console.error(`${module}.wgsl: ${error.formatted ?? error}`);
    process.exit(1);
  }
}
console.log(JSON.stringify(made));
