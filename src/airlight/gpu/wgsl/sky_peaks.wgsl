// The table of the sky: what the two peaked constituents scatter once, without phase functions.

struct Layers {
  @location(0) first: vec4f,
  @location(1) second: vec4f,
}

@fragment
fn sky_peaks(@builtin(position) at: vec4f) -> Layers {
  let columns = i32(frame.sky.x);
  let number = i32(at.y) * 2048 + i32(at.x);
  var found: array<vec4f, 4>;
  peaks_texel(number % columns, number / columns, columns, i32(frame.sky.y), &found);
  return Layers(found[2], found[3]);
}
