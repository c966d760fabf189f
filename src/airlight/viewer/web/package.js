/** What a host is given: tables as text or as bytes, made into numbers. */

/**
 * The numbers of a table.
 *
 * @param {string | DataView | ArrayBuffer | Uint8Array} data Base64 of a deflated table whose bytes
 *     are sorted by their place in a number (see `viewer/package.py`), or little-endian float32.
 * @returns {Promise<Float32Array>}
 */
export async function numbersOf(data) {
  if (typeof data !== "string") return plainNumbers(data);
  const sorted = new Uint8Array(await inflated(data).arrayBuffer());
  const count = sorted.length / 4;
  const mixed = new Uint8Array(sorted.length);
  for (let place = 0; place < 4; place++) {
    for (let index = 0; index < count; index++) {
      mixed[4 * index + place] = sorted[count * place + index];
    }
  }
  return new Float32Array(mixed.buffer);
}

/** A promise of the text that was deflated into base64. */
export function textOf(data) {
  return inflated(data).text();
}

function inflated(data) {
  const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate")));
}

function plainNumbers(data) {
  const view = ArrayBuffer.isView(data) ? data : new Uint8Array(data);
  const { buffer, byteOffset, byteLength } = view;
  return new Float32Array(buffer.slice(byteOffset, byteOffset + byteLength));
}
