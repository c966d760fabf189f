// Fills the texels of a flat texture whose numbers lie in a span; texel(index) is emitted.
@fragment
fn fill(@builtin(position) position: vec4f) -> @location(0) vec4f {
  let index = i32(position.y) * 2048 + i32(position.x);
  if (index < i32(span.texels.x) || index >= i32(span.texels.y)) {
    discard;
  }
  return texel(index);
}
