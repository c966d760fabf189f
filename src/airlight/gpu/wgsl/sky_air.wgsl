// The table of the sky: the air's light, and that of a white ground behind it.

struct Layers {
  @location(0) first: vec4f,
  @location(1) second: vec4f,
}

@fragment
fn sky_air(@builtin(position) at: vec4f) -> Layers {
  let columns = i32(frame.sky.x);
  let number = i32(at.y) * 2048 + i32(at.x);
  var found: array<vec4f, 4>;
  air_texel(number % columns, number / columns, columns, i32(frame.sky.y), &found);
  return Layers(found[0], found[1]);
}
