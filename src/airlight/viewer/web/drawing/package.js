/** Decoding of tables from text or bytes. */

/**
 * Decode a table.
 *
 * @param {string | DataView | ArrayBuffer | Uint8Array} data Text from
 *     viewer/browser/tables_text.py, or little-endian float32.
 * @returns {Promise<Float32Array>}
 */
export async function numbersOf(data) {
  if (typeof data !== "string") return plainNumbers(data);
  const stride = Number(data.slice(0, data.indexOf(";")));
  const text = data.slice(data.indexOf(";") + 1);
  const sorted = new Uint8Array(await inflated(text).arrayBuffer());
  const count = sorted.length / 4;
  const bits = new Int32Array(count);
  for (let index = 0; index < count; index++) {
    const folded =
      sorted[index] |
      (sorted[count + index] << 8) |
      (sorted[2 * count + index] << 16) |
      (sorted[3 * count + index] << 24);
    const step = (folded >>> 1) ^ -(folded & 1);
    bits[index] = index < stride ? step : step + bits[index - stride];
  }
  return new Float32Array(bits.buffer);
}

/** Promise of the text of deflated base64. */
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
